"""Accuracy levels: resolutions of the finite elements, and the estimate of their error."""

from __future__ import annotations

from dataclasses import dataclass, replace

from stonepass.fe.axisymmetric.problem import Resolution

__all__ = ["LEVELS", "AccuracyLevel", "ErrorEstimate", "ErrorRule"]


@dataclass(frozen=True)
class ErrorRule:
    """The rule of an error estimate: `factor` × a difference + `floor` × the result.

    The difference is that between a result and the result of a coarser solve. The second term is
    needed because two results may agree by chance.

    Attributes
    ----------
    factor, floor : float
        Dimensionless factors, positive.
    """

    factor: float
    floor: float

    def __call__(self, difference: float, value: float) -> float:
        """Return the error estimate of a result.

        Parameters
        ----------
        difference : float
            Difference between the results of both solves.
        value : float
            The result, or its scale, in the unit of `difference`.
        """
        return self.factor * abs(difference) + self.floor * abs(value)


@dataclass(frozen=True)
class AccuracyLevel:
    """An accuracy level: a resolution, a coarser companion, and the rules of the error estimates.

    Every case is solved with both resolutions. The fitted mesh of the companion is coarser and its
    elements are of one order less. Its loading path has half the increments, or a quarter at the
    level `reference`. The error of a path is proportional to the size of its increments, so the
    difference from a path with half the increments is about equal to the remaining error. P_ucr is
    an integral over the contact pressure, so that oscillations of the latter cancel in part, and a
    smaller claim suffices. See "How far a number is from the limit" in docs/theory.md;
    docs/verification.md reports how often the true error is within the estimate.

    Attributes
    ----------
    resolution, companion : Resolution
        The fine and the coarse resolution.
    contact_claim : ErrorRule
        Rule for α₀ and σ(π/2). For α₀ the half-width π/2 − α₀ of the contact takes the place of the
        result.
    pressure_claim : ErrorRule
        Rule for P_ucr.
    """

    resolution: Resolution
    companion: Resolution
    contact_claim: ErrorRule
    pressure_claim: ErrorRule


_FAST = Resolution(order=4, closed=6, edge=0.05, growth=2.0, increments=4, path_columns=7)
_STANDARD = Resolution()
_REFERENCE = Resolution(order=5, closed=16, edge=0.008, growth=1.5, increments=32, path_columns=20)

LEVELS = {
    "fast": AccuracyLevel(
        _FAST,
        Resolution(order=3, closed=5, edge=0.1, growth=2.5, increments=2, path_columns=5),
        ErrorRule(3.0, 1e-3),
        ErrorRule(1.5, 2e-4),
    ),
    "standard": AccuracyLevel(
        _STANDARD, replace(_FAST, order=3), ErrorRule(2.0, 2e-4), ErrorRule(1.5, 1e-4)
    ),
    # With four times the increments of the companion, a third of the difference remains as error.
    "reference": AccuracyLevel(
        _REFERENCE, _STANDARD, ErrorRule(2.0 / 3.0, 5e-5), ErrorRule(2.0 / 3.0, 5e-5)
    ),
}


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated absolute discretisation errors of an answer.

    The result in the limit of fine meshes and many increments is expected to lie within ± the
    estimate of the number. The estimates are not strict bounds (see `AccuracyLevel`).

    Attributes
    ----------
    contact_angle : float
        Error of α₀ in rad.
    equator_contact_pressure : float
        Error of σ(π/2) in Pa.
    critical_pressure : float or None
        Error of P_ucr in Pa; None if the answer has no critical pressure.
    """

    contact_angle: float
    equator_contact_pressure: float
    critical_pressure: float | None = None
