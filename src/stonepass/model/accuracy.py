"""How finely a case is solved, and how far its numbers may be from the limit of fine meshes."""

from __future__ import annotations

from dataclasses import dataclass, replace

from stonepass.fe.axisymmetric.problem import Resolution

__all__ = ["LEVELS", "ErrorEstimate", "Level"]


@dataclass(frozen=True)
class Level:
    """A resolution, a coarser companion, and what their difference says of the error.

    Every case is solved with both; the error of the finer answer is estimated as `factor` × their
    difference, plus `floor` × the number itself (for α₀ the half-width π/2 − α₀ of the contact),
    since two solves may agree by chance. The companion's fitted mesh has elements of one order less
    and is coarser, and its path half the increments (a quarter at `reference`). That path converges
    with the first order of the increments, so there the difference equals the error left.
    `error_estimates` of the verification page measures how often a claim holds.
    """

    resolution: Resolution
    companion: Resolution
    factor: float
    floor: float

    def claim(self, difference: float, value: float) -> float:
        """The error to claim where the companion differs from `value` by `difference`."""
        return self.factor * abs(difference) + self.floor * abs(value)


_FAST = Resolution(order=4, closed=6, edge=0.05, growth=2.0, increments=4, path_columns=7)
_STANDARD = Resolution()
_REFERENCE = Resolution(order=5, closed=16, edge=0.008, growth=1.5, increments=32, path_columns=20)

LEVELS = {
    "fast": Level(
        _FAST,
        Resolution(order=3, closed=5, edge=0.1, growth=2.5, increments=2, path_columns=5),
        3.0,
        1e-3,
    ),
    "standard": Level(_STANDARD, replace(_FAST, order=3), 2.0, 2e-4),
    # Four times the increments of its companion: a third of the difference is left.
    "reference": Level(_REFERENCE, _STANDARD, 2.0 / 3.0, 5e-5),
}


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated discretisation error, absolute: the limit should lie within ± of the number.

    An estimate, not a bound (see `Level`).

    Attributes
    ----------
    contact_angle : float
        Of α₀, in rad.
    equator_contact_pressure : float
        Of σ(π/2), in Pa.
    critical_pressure : float or None
        Of P_ucr, in Pa, where there is one.
    """

    contact_angle: float
    equator_contact_pressure: float
    critical_pressure: float | None = None
