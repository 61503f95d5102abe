"""The paper's model: the seated contact, cut off at an angle, balances the urine (Eqs 4–17)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import ClassVar

import numpy as np

from stonepass.caution import caution
from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import BadInput, Misplaced, Outcome, require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.materials.protocol import Law
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.answer import Answer, Quantity, unanswered
from stonepass.model.closure import (
    ORDER,
    Series,
    first_radius,
    fit_series,
    linear_closure,
    series_through,
)
from stonepass.model.far_field import far_field_law, lumen_ratio, urine_pressure
from stonepass.model.force_balance import drive, resistance
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.roots import first_root
from stonepass.model.seating import SEATINGS, Seating
from stonepass.model.states.seated_state import Contact, NoSeat, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.stone import FRICTION
from stonepass.model.validity import ring_buckling, soft_law, strain_range
from stonepass.units import Values

__all__ = ["Closure", "SeatedBalance", "SeatedBalanceDetail", "balance", "balance_pressure"]

SMALLEST_OPENING, LARGEST_OPENING = 0.5, 2.0  # of a series: r_a/R_a, r_a/R_s
NO_LUMEN = "the far field without the ground matrix has no lumen under this load"
NO_CURVE = "too few loaded states were found for the series that closes the gap to be fitted"


@dataclass(frozen=True)
class SeatedBalance:
    """The paper's model.

    Parameters
    ----------
    seating : {"pressed", "frictionless", "growing"}
        How the stone came to its place: its arc pressed radially into the wall as in the paper,
        without friction, or a sphere growing in place.
    seating_friction : float, optional
        Coulomb coefficient while the stone is seated, 0 to 2; by default the stone's.
    as_printed : bool
        Take Eq. 5 with the sign printed in the paper (the wall behind the stone assists).
    closure_start : {"inner-radius", "lumen"}
        Where the closure starts: at R_a as in the paper, or at the lumen that load leaves open.
    closure : {"linear", "series"}
        Eq. 15; or the series of Eqs 13–14, fitted to `opening_curve` or to loaded states of the
        case.
    series_order : int
        Order of the series, 1 to 8.
    opening_curve : OpeningCurve, optional
        Opened angles and radii to fit the series to (`read_opening_curve`).
    far_field_ground : bool
        Whether the far field contains the ground matrix of the law (Eq. 22 does not).
    """

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "paper"
    MEANING: ClassVar[str] = "the seated contact of the paper, cut off by a closure"
    NEEDS_ELEMENTS: ClassVar[bool] = True

    seating: str = declared(
        Kind.CHOICE,
        "--seating",
        "How the stone came to its place.",
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
        "Sign of the axial wall-pressure term (Eq. 5): as printed, which lowers the critical "
        "pressure by 10 to 20 %, or as derived.",
        default=False,
        shown_default="as derived",
    )
    closure_start: str = declared(
        Kind.CHOICE,
        "--closure-start",
        "Where the closure starts: the unloaded inner radius, or the lumen that the load leaves.",
        default="inner-radius",
        choices=("inner-radius", "lumen"),
    )
    closure: str = declared(
        Kind.CHOICE,
        "--closure",
        "Eq. 15 (linear), or the series of Eqs 13-14, fitted.",
        default="linear",
        choices=("linear", "series"),
    )
    series_order: int = declared(
        Kind.WHOLE, "--series-order", "Order of the series closure.", default=3, bounds=ORDER
    )
    opening_curve: OpeningCurve | None = declared(
        Kind.OPENING_CURVE,
        "--opening-curve",
        "Opened angles and radii to fit the series to: alpha_deg, radius_ratio.",
        default=None,
        shown_default="loaded states of the case",
        metavar="FILE.csv",
    )
    far_field_ground: bool = declared(
        Kind.FLAG,
        "--far-field-ground/--far-field-fibres",
        "Whether the far field contains the ground matrix.",
        default=False,
        shown_default="fibres",
    )

    __repr__ = described

    def __post_init__(self) -> None:
        check_inputs(self)
        if self.seating == "frictionless" and self.seating_friction not in (None, 0.0):
            raise Misplaced("seating_friction", "a frictionless seating", "")
        curve = self.opening_curve
        if curve is None:
            return
        allowed = "as read_opening_curve gives it"
        require(isinstance(curve, OpeningCurve), "opening_curve", curve, allowed)
        if self.closure != "series":
            raise Misplaced("opening_curve", f"the closure '{self.closure}'",
                            "belongs to the closure 'series'")  # fmt: skip
        least = f"at least as many points as coefficients, {self.series_order}"
        count = len(curve.alpha)
        require(count >= self.series_order, "opening_curve", f"{count} points", least)

    def seating_of(self, case: Problem) -> Seating:
        """How the stone of a case comes to its place."""
        if self.seating == "frictionless":
            return Seating(self.seating, 0.0)
        given = self.seating_friction
        return Seating(self.seating, case.stone.friction if given is None else given)

    def require_any_size(self) -> None:
        """Refuse an opening curve: it belongs to the one stone that it was found for."""
        if self.opening_curve is not None:
            why = "the series is fitted to loaded states where it is left out"
            raise Misplaced("opening_curve", "sizes that vary", "belongs to one stone", why)

    def largest_size(self, case: Problem) -> float:
        """The end of the material's strain range."""
        return case.ureter.material.strain_range[1]

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Answer a stuck stone by its seated contact, the closure and the far field."""
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
class Closure:
    """How the pressure follows from the opened angle: shape of the gap, and far field.

    Attributes
    ----------
    law : Law
        The law of the far field.
    start : float
        r_a/R_a at which Eq. 15 starts.
    series : Series or None
        A fitted series in the place of Eq. 15.
    """

    law: Law
    start: float = 1.0
    series: Series | None = None

    def pressure(self, contact: Contact, alpha: Values) -> Values:
        """P_u(α) in Pa (Eq. 16): the far field at the radius that the closure gives to α."""
        case, width = contact.case, contact.case.stone.shape.width
        shape: Callable[[Values, float, float], Values]
        shape = self.series or partial(linear_closure, start=self.start)
        first = float(width(np.array(contact.contact_angle)))
        radius = shape(width(np.asarray(alpha)), first, case.size_ratio)
        return urine_pressure(radius, case.wall_ratio, self.law, case.load)

    def end_pressure(self, contact: Contact) -> float:
        """P_u in Pa at which the closure ends, not a physical bound."""
        return float(self.pressure(contact, np.array(np.pi / 2)))


@dataclass(frozen=True)
class SeatedBalanceDetail:
    """What the paper's model knows beside the answer.

    Attributes
    ----------
    closure : Closure
    closure_end_pressure : float
        P_u in Pa at which the closure ends (r_a = R_s), not a physical bound.
    printed_series : tuple of float or None
        Coefficients of a fitted series as Eq. 14 has them, in inner radii.
    """

    closure: Closure
    closure_end_pressure: float
    printed_series: tuple[float, ...] | None = None

    def quantities(self) -> tuple[Quantity, ...]:
        """The end of the closure, and the coefficients of a fitted series."""
        series = self.closure.series
        return (
            Quantity("closure_end_pressure", self.closure_end_pressure / 1e3, "kPa", "closure end"),
            Quantity("series_coefficients", None if series is None else series.coefficients),
            Quantity("printed_series_coefficients", self.printed_series),
        )


def balance_pressure(
    contact: Contact, closure: Closure, *, as_printed: bool = False
) -> float | None:
    """P_ucr in Pa of a seated stone by a closure; None where the forces do not balance."""
    found = _critical(contact, closure, as_printed=as_printed)
    return None if found is None else found.pressure


def balance(
    model: SeatedBalance, case: Problem, numerics: Numerics, seated: SeatedState, closure: Closure
) -> Answer:
    """The answer of a seated state by a closure."""
    found = _critical(seated, closure, as_printed=model.as_printed)
    coarse = (
        None
        if seated.coarse is None
        else _critical(seated.coarse, closure, as_printed=model.as_printed)
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
            *soft_law(case.ureter.material),
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
    """The series fitted to the curve given, or to loaded states of the case.

    Loaded states are of the whole law, ground matrix included, so a series fitted to them is turned
    back to a pressure by the whole law: that gives each state its own pressure.
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


@dataclass(frozen=True)
class _Critical:
    """Where drive and resistance balance; `at_edge` where the drive wins from the first angle."""

    angle: float
    pressure: float
    at_edge: bool = False


def _critical(contact: Contact, closure: Closure, *, as_printed: bool) -> _Critical | None:
    """Smallest α in [α₀, π/2] with F_re = F_dr: scan first, since it need not be the only one."""
    forces = resistance(contact, as_printed=as_printed)
    width = contact.case.stone.shape.width
    first, last = contact.contact_angle, np.pi / 2
    # Without friction nothing holds the stone, whatever the load: the root is α₀, and P_ucr = 0.
    if contact.case.stone.friction == 0.0:
        return _Critical(first, 0.0)

    def excess(alpha: Values) -> Values:
        push = drive(closure.pressure(contact, alpha), width(np.asarray(alpha)))
        return forces.total(alpha) - push

    found = first_root(excess, first, last)
    if found is None:
        return None
    if found == first:
        disc = float(width(np.array(first))) ** 2
        # P_u whose drive equals the resistance of the whole contact.
        return _Critical(first, max(float(forces.total(np.array(first))), 0.0) / disc, at_edge=True)
    return _Critical(found, float(closure.pressure(contact, np.array(found))))


def _error(
    seated: SeatedState,
    numerics: Numerics,
    found: _Critical | None,
    coarse: _Critical | None,
    closure: Closure,
) -> ErrorEstimate | None:
    """The error of the contact, with that of P_ucr, from the balance of the coarser contact.

    Where that one has no balance, its pressure lies beyond the end of its closure.
    """
    if seated.error is None or seated.coarse is None or found is None:
        return seated.error
    pressure = closure.end_pressure(seated.coarse) if coarse is None else coarse.pressure
    claim = numerics.level.claim(pressure - found.pressure, found.pressure)
    return replace(seated.error, critical_pressure=claim)


def _closure_start(model: SeatedBalance, case: Problem, ground: bool) -> float | None:
    # A series of a stone that is no larger than its first radius has no slope to fit.
    degenerate = model.closure == "series" and case.size_ratio <= 1.0
    if model.closure_start == "inner-radius" and not degenerate:
        return first_radius(case.size_ratio)
    return lumen_ratio(case.wall_ratio, far_field_law(case, ground=ground), case.load)
