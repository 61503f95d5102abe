"""The paper's model: balance of urine pressure and resistance of the seated contact (Eqs 4–17)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from stonepass.caution import caution
from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import BadInput, Misplaced, Outcome, require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.answer import Answer, NamedQuantity, unanswered
from stonepass.model.closure import (
    ORDER,
    Closure,
    first_radius,
    fit_series,
    series_through,
)
from stonepass.model.critical_state import CriticalState, critical_state
from stonepass.model.far_field import far_field_law, lumen_ratio
from stonepass.model.models.shared_options import far_field_ground
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.seating import SEATINGS, Seating
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.stone import FRICTION
from stonepass.model.validity import law_cautions, ring_buckling, strain_range

__all__ = ["SeatedBalance", "SeatedBalanceDetail", "balance"]

# Range of an admissible series closure: smallest r_a/R_a and largest r_a/R_s.
SMALLEST_OPENING, LARGEST_OPENING = 0.5, 2.0
NO_LUMEN = "the load closes the lumen of the far field, which is evaluated without ground matrix"
NO_CURVE = "too few loaded states were found to fit the series closure"


@dataclass(frozen=True)
class SeatedBalance:
    """The paper's model.

    Finite elements give the contact pressure of the seated state. Urine opens the contact from
    upstream. A closure relates the angle up to which it is open to the radius of the tube upstream,
    and the far field relates that radius to the urine pressure. The stone moves at the first angle
    at which the urine pressure on the open part of the stone balances the resistance of the
    remaining contact. See "Resistance and drive" and "Closure and critical state" in
    docs/theory.md.

    Parameters
    ----------
    seating : {"pressed", "frictionless", "growing"}
        The way in which the stone is brought into the wall, see `model.seating.Seating`.
    seating_friction : float, optional
        Coulomb coefficient during the seating, 0 to 2; by default that of the stone.
    as_printed : bool
        True to use Eq. 5 with the sign printed in the paper, by which the axial resultant of the
        contact pressure assists the motion.
    closure_start : {"inner-radius", "lumen"}
        Radius at which the closure starts: R_a as in the paper, or the lumen under the load.
    closure : {"linear", "series"}
        ``"linear"`` is Eq. 15. ``"series"`` is the series of Eqs 13–14, fitted to `opening_curve`
        or, without one, to loaded states of the direct model.
    series_order : int
        Number of coefficients of the series, 1 to 8.
    opening_curve : OpeningCurve, optional
        Angles and radii to which the series is fitted (see `read_opening_curve`).
    far_field_ground : bool
        True if the far field includes the ground matrix of the law. Eq. 22 does not include it.

    Raises
    ------
    BadInput
        An option is out of bounds, or options contradict each other.
    """

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "paper"
    MEANING: ClassVar[str] = "the paper's balance of the seated contact, with a closure"
    NEEDS_ELEMENTS: ClassVar[bool] = True

    seating: str = declared(
        Kind.CHOICE,
        "--seating",
        "How the stone was seated: pressed radially into the wall, without friction, or by "
        "growing in its place.",
        default="pressed",
        choices=SEATINGS,
    )
    seating_friction: float | None = declared(
        Kind.NUMBER,
        "--seating-friction",
        "Coefficient of friction while the stone is seated.",
        default=None,
        bounds=FRICTION,
        shown_default="--friction",
    )
    as_printed: bool = declared(
        Kind.FLAG,
        "--as-printed/--as-derived",
        "Use the printed sign of the axial wall-pressure term (Eq. 5), which lowers the critical "
        "pressure (by 2 to 26 % in the comparison of closures); otherwise use the derived sign.",
        default=False,
        shown_default="as derived",
    )
    closure_start: str = declared(
        Kind.CHOICE,
        "--closure-start",
        "Radius at which the closure starts: unloaded inner radius, or lumen under the load.",
        default="inner-radius",
        choices=("inner-radius", "lumen"),
    )
    closure: str = declared(
        Kind.CHOICE,
        "--closure",
        "Closure of the opening wall: linear in the width of the stone (Eq. 15), or a fitted "
        "series (Eqs 13-14).",
        default="linear",
        choices=("linear", "series"),
    )
    series_order: int = declared(
        Kind.WHOLE, "--series-order", "Order of the fitted series.", default=3, bounds=ORDER
    )
    opening_curve: OpeningCurve | None = declared(
        Kind.OPENING_CURVE,
        "--opening-curve",
        "Points that the series is fitted to, in the columns alpha_deg and radius_ratio.",
        default=None,
        shown_default="computed loaded states",
        metavar="FILE.csv",
    )
    far_field_ground: bool = far_field_ground()

    __repr__ = described

    def __post_init__(self) -> None:
        check_inputs(self)
        if self.seating == "frictionless" and self.seating_friction not in (None, 0.0):
            raise Misplaced("seating_friction", "a frictionless seating", "")
        curve = self.opening_curve
        if curve is None:
            return
        allowed = "as read_opening_curve returns it"
        require(isinstance(curve, OpeningCurve), "opening_curve", curve, allowed)
        if self.closure != "series":
            raise Misplaced("opening_curve", f"the closure '{self.closure}'",
                            "belongs to the closure 'series'")  # fmt: skip
        least = f"at least as many points as coefficients, {self.series_order}"
        count = len(curve.alpha)
        require(count >= self.series_order, "opening_curve", f"{count} points", least)

    def seating_of(self, case: Problem) -> Seating:
        """Return kind and friction of the seating for the stone of a case."""
        if self.seating == "frictionless":
            return Seating(self.seating, 0.0)
        given = self.seating_friction
        return Seating(self.seating, case.stone.friction if given is None else given)

    def require_any_size(self) -> None:
        """Raise `Misplaced` if there is an opening curve, which is valid for one stone only."""
        if self.opening_curve is not None:
            why = "without it the series is fitted to loaded states of each stone"
            raise Misplaced("opening_curve", "sizes that vary", "is valid for one stone only", why)

    def largest_size(self, case: Problem) -> float:
        """Return the upper end of the material's strain range as the largest size ratio."""
        return case.ureter.material.strain_range[1]

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Find the critical pressure from the seated contact, the closure and the far field.

        For the parameters and exceptions see `Model.solve`.
        """
        start = _closure_start(self, case, self.far_field_ground)
        if start is None:
            return unanswered(case, self, numerics, NO_LUMEN)
        seated = states.seat(case, self.seating_of(case), numerics, resolution)
        if isinstance(seated, NoSeat):
            return unanswered(case, self, numerics, seated.reason, steps=seated.newton_steps,
                              seconds=seated.seconds)  # fmt: skip
        closure = Closure(far_field_law(case, ground=self.far_field_ground), start)
        if self.closure == "series":
            found = _fitted(self, case, numerics, seated, start, states)
            if found is None:
                did = seated.solver
                return unanswered(case, self, numerics, NO_CURVE, steps=did.newton_steps,
                                  seconds=did.seconds)  # fmt: skip
            closure = found
        return balance(self, case, numerics, seated, closure)


@dataclass(frozen=True)
class SeatedBalanceDetail:
    """Additional results of the paper's model.

    Attributes
    ----------
    closure : Closure
        The closure that was used.
    closure_end_pressure : float
        Urine pressure in Pa at α = π/2, where the closure ends; it is not a physical bound.
    printed_series : tuple of float or None
        Coefficients of a fitted series in the form of Eq. 14, in inner radii; None for Eq. 15.
    """

    closure: Closure
    closure_end_pressure: float
    printed_series: tuple[float, ...] | None = None

    def quantities(self) -> tuple[NamedQuantity, ...]:
        """Return the end pressure of the closure, and the coefficients of a fitted series."""
        series = self.closure.series
        return (
            NamedQuantity(
                "closure_end_pressure", self.closure_end_pressure / 1e3, "kPa", "closure end"
            ),
            NamedQuantity("series_coefficients", None if series is None else series.coefficients),
            NamedQuantity("printed_series_coefficients", self.printed_series),
        )


def balance(
    model: SeatedBalance, case: Problem, numerics: Numerics, seated: SeatedState, closure: Closure
) -> Answer:
    """Compute the answer of the paper's model for a seated state and a closure.

    Parameters
    ----------
    model : SeatedBalance
    case : Problem
        The case that the seated state solves.
    numerics : Numerics
    seated : SeatedState
    closure : Closure
    """
    found = critical_state(seated, closure, as_printed=model.as_printed)
    coarse = (
        None
        if seated.coarse is None
        else critical_state(seated.coarse, closure, as_printed=model.as_printed)
    )
    undecided = seated.coarse is not None and (found is None) != (coarse is None)
    answer = Answer(
        case,
        model,
        numerics,
        Outcome.BEYOND_CLOSURE,
        contact=seated,
        detail=SeatedBalanceDetail(
            closure, closure.end_pressure(seated), _printed(case, seated, closure)
        ),
        error=_error(seated, numerics, found, coarse, closure),
        newton_steps=seated.solver.newton_steps,
        seconds=seated.solver.seconds,
        warnings=(
            *case.stone.shape.warnings(),
            *law_cautions(case.ureter.material),
            *strain_range(case),
            *ring_buckling(case),
            *seated.warnings(),
            *([caution("smaller_than_lumen")] if closure.start == case.size_ratio < 1.0 else []),
            *([caution("closure_undecided")] if undecided else []),
        ),
    )
    if found is None:
        return answer
    at_edge = [caution("moves_at_contact_angle")] if found.at_edge else []
    return replace(
        answer,
        outcome=Outcome.MOVES,
        pressure=found.pressure,
        critical_angle=found.angle,
        warnings=(*answer.warnings, *at_edge),
    )


def _printed(case: Problem, seated: SeatedState, closure: Closure) -> tuple[float, ...] | None:
    if closure.series is None:
        return None
    first = float(case.stone.shape.width(np.array(seated.contact_angle)))
    return closure.series.printed(first, case.size_ratio)


def _fitted(
    model: SeatedBalance,
    case: Problem,
    numerics: Numerics,
    seated: SeatedState,
    start: float,
    states: StateSolver,
) -> Closure | None:
    """Fit the series closure to the given opening curve, or else to loaded states of the case.

    Loaded states are solved with the ground matrix. With a series fitted to them the far field is
    therefore evaluated with the ground matrix too, so that each state has its own pressure.
    """
    curve, order = model.opening_curve, model.series_order
    if curve is None:
        found = states.opening_curve(case, numerics)
        series = None if found is None else series_through(case, found, order)
        if series is None:
            return None
        return Closure(far_field_law(case, ground=True), start, series)
    width = case.stone.shape.width
    alpha, radius = curve.arrays
    first = float(width(np.array(seated.contact_angle)))
    fitted = fit_series(width(alpha), radius, first, case.size_ratio, order, start)
    opened = np.asarray(fitted(np.linspace(first, 1.0, 91), first, case.size_ratio))
    reach = float(opened.flat[np.argmax(np.abs(opened - 1.0))])
    low, high = SMALLEST_OPENING, LARGEST_OPENING * case.size_ratio
    if not (low <= opened.min() and opened.max() <= high):
        shown = f"such that its series reaches r_a = {reach:.3g} R_a"
        allowed = f"a curve whose series stays from {low:g} to {high:.3g} R_a"
        raise BadInput("opening_curve", shown, allowed, "give more points or a lower order")
    return Closure(far_field_law(case, ground=model.far_field_ground), start, fitted)


def _error(
    seated: SeatedState,
    numerics: Numerics,
    found: CriticalState | None,
    coarse: CriticalState | None,
    closure: Closure,
) -> ErrorEstimate | None:
    """Return the error estimates of the contact and of P_ucr.

    The error of P_ucr follows from the critical pressure of the coarser contact. If the forces of
    the coarser contact do not balance, the end pressure of its closure is used instead.
    """
    if seated.error is None or seated.coarse is None or found is None:
        return seated.error
    pressure = closure.end_pressure(seated.coarse) if coarse is None else coarse.pressure
    claim = numerics.level.pressure_claim(pressure - found.pressure, found.pressure)
    return replace(seated.error, critical_pressure=claim)


def _closure_start(model: SeatedBalance, case: Problem, ground: bool) -> float | None:
    # For ξ ≤ 1 a series that starts at R_a would be constant, so there would be nothing to fit.
    degenerate = model.closure == "series" and case.size_ratio <= 1.0
    if model.closure_start == "inner-radius" and not degenerate:
        return first_radius(case.size_ratio)
    return lumen_ratio(case.wall_ratio, far_field_law(case, ground=ground), case.load)
