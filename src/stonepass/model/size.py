"""The critical size: the largest stone whose critical pressure stays within a limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from stonepass.array_dataclass import array_dataclass
from stonepass.caution import Caution
from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.answer import Answer, Model
from stonepass.model.case import Case
from stonepass.model.critical import refuse_parts, solve
from stonepass.model.far_field import lumen_ratio
from stonepass.model.load import Load
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.pressure_limit import read_limit
from stonepass.model.problem import EXAMPLES, require_kind
from stonepass.model.shape import Shape
from stonepass.model.size_search import (
    NoValue,
    Root,
    TooSmall,
    local_slope,
    root_in_range,
    secant_root,
)
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.result import Result
from stonepass.units import Length, Pressure, Quantity

__all__ = ["SizeAnswer", "critical_size"]

# Absolute tolerance of ξ, and relative tolerance of the pressure limit. The second one is not
# coarser than the first, because P_ucr grows by several limits per unit of ξ.
TOLERANCE = 1e-6
FIRST_TOLERANCE = 1e-4  # tolerance on the coarser mesh, whose root is only a first guess
# A critical size less than this fraction above the lumen is not distinguished from the lumen.
SMALLEST_CRITICAL_OVERSIZE = 2e-4
SMALL_LIMIT = 100.0  # Pa; every stuck stone may need more than a limit that is smaller than this


@array_dataclass
@dataclass(frozen=True, repr=False)
class SizeAnswer(Result):
    """The critical size at a pressure limit, or the reason why it does not exist.

    Attributes
    ----------
    case : Case
        Ureter, friction, load, model and numerics of the search. The size of its stone is not a
        result but the upper end of the range that was searched.
    outcome : Outcome
        SOLVED if a critical size was found.
    message : str
        The outcome as a sentence.
    size_ratio : float or None
        Critical size ratio ξ_cr; None if no size was found.
    diameter : Length or None
        Critical stone diameter in m; None if no size was found or the ureter has only a ratio.
    limit : Pressure
        Pressure limit in Pa.
    at_size : Answer or None
        Answer at the critical size. If no size was found, it is the answer at the size at which the
        search ended, or None if every held stone needs more than the limit.
    size_ratio_error : float or None
        Estimated error of ξ_cr: the discretisation error of P_ucr divided by dP_ucr/dξ, plus the
        tolerance of the search, 1e-6. None if it is not known.
    warnings : tuple of Caution
        Warnings about the answer at the critical size.
    """

    case: Case
    outcome: Outcome
    message: str
    limit: Pressure
    size_ratio: float | None = None
    diameter: Length | None = None
    at_size: Answer | None = None
    size_ratio_error: float | None = None
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return outcome, critical size, limit and case in one line."""
        case, size = self.case, ""
        if self.size_ratio is not None:
            error = "" if self.size_ratio_error is None else f" ± {self.size_ratio_error:.1g}"
            size = f", ξ_cr {self.size_ratio:.4f}{error}"
        if self.diameter is not None:
            size += f" ({self.diameter * 1e3:.3f} mm)"
        return (
            f"{self.outcome.name}{size} at {self.limit / 1e3:.4g} kPa; η {case.wall_ratio:.4g}, "
            f"{case.ureter.material.name}, friction {case.stone.friction:g}, "
            f"model {case.model.NAME}"
        )

    @property
    def diameter_mm(self) -> float | None:
        """Critical stone diameter in mm; None if `diameter` is None."""
        return None if self.diameter is None else self.diameter * 1e3


def critical_size(
    ureter: Ureter | Case,
    limit: str | Pressure | Quantity,
    friction: float | None = None,
    load: Load | None = None,
    model: Model | None = None,
    numerics: Numerics | None = None,
    progress: Callable[[float], None] | None = None,
    shape: Shape | None = None,
    states: StateSolver = UNCACHED,
) -> SizeAnswer:
    """Compute the size of the stone whose critical pressure equals a pressure limit.

    P_ucr rises with ξ, from 0 for a stone of the size of the lumen. Therefore ξ_cr is searched
    between the lumen and the largest size for which the model is used, with a tolerance of 1e-6.
    That size is the upper end of the material's strain range. In the beam model it is the size at
    which the contact becomes as long as the stone, but at most ξ = 2.

    Parameters
    ----------
    ureter : Ureter or Case
        The ureter; or a case, which then also replaces `friction`, `load`, `model`, `numerics` and
        `shape`. The size of its stone is ignored.
    limit : str, Pressure or pint.Quantity
        Maximum tolerable urine pressure, e.g. ``"12 kPa"``; 0.001 to 1000 kPa.
    friction : float, optional
        Friction coefficient between stone and wall, 0 to 2; by default that of `Stone`.
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    model : Model, optional
        `SeatedBalance` (the paper's model, the default), `PushThrough` or `ElasticFoundation`.
    numerics : Numerics, optional
        Accuracy of the solution and length of the tube.
    progress : callable, optional
        Function that is called with every size ratio that is tried.
    shape : Shape, optional
        Shape of the stone; a sphere by default. ``Shape(1.4)`` is a spheroid whose length is 1.4
        times its diameter.
    states : StateSolver, optional
        Source of the finite-element states, e.g. a `SolutionCache`; by default they are solved.

    Returns
    -------
    SizeAnswer
        Its attribute `size_ratio` is ξ_cr, and `diameter` is the critical diameter in m; both are
        None if no size was found.

    Raises
    ------
    BadInput
        An argument is out of bounds, of the wrong type, or given in addition to a case; or the
        model does not apply to the case.
    UnstableLaw
        The material law is not stable.

    Notes
    -----
    docs/theory.md, section "The question"; Liu et al. 2022.

    Examples
    --------
    >>> import stonepass as sp
    >>> beam = sp.ElasticFoundation("0.4 MPa", "0.02 MPa")
    >>> ureter = sp.Ureter("3.5 mm", wall_thickness="0.5 mm")
    >>> f"{sp.critical_size(ureter, '6 kPa', model=beam).size_ratio:.3f}"
    '1.131'
    """
    if isinstance(ureter, Case):
        refuse_parts(friction=friction, load=load, model=model, numerics=numerics, shape=shape)
        case = ureter
    else:
        require_kind("ureter", ureter, Ureter, EXAMPLES["ureter"])
        high = ureter.material.strain_range[1]
        stone = Stone(size_ratio=high, friction=friction, shape=shape)
        case = Case(stone, ureter, load or Load(), model or SeatedBalance(), numerics or Numerics())
    bound = read_limit(limit)
    case = case.with_size_ratio(case.ureter.material.strain_range[1])
    case = case.with_size_ratio(case.model.largest_size(case))
    return _search(case, bound, progress or (lambda size_ratio: None), states)


def _search(
    case: Case,
    limit: Pressure,
    progress: Callable[[float], None],
    states: StateSolver,
) -> SizeAnswer:
    level = case.numerics.level
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    if lumen is None:  # the answer of solve() contains the reason
        progress(case.size_ratio)
        return _without_size(case, limit, solve(case, level.resolution, states))
    mesh = _OneMesh(case, limit, lumen, level.resolution, TOLERANCE, progress, states)
    tried: dict[float, Answer] = {}
    whole: dict[float, Answer] = {}
    found: Root | NoValue | TooSmall | None = None
    if case.model.NEEDS_ELEMENTS:  # a solve on a coarser mesh provides the first guess
        coarse = replace(mesh, resolution=level.companion, tolerance=FIRST_TOLERANCE)
        start = coarse.root({})
        if isinstance(start, Root):
            found = _from_coarse(mesh, start, tried, whole)
    if found is None:
        found = mesh.root(tried)
    if isinstance(found, NoValue):
        return _without_size(case, limit, tried[found.x])
    if isinstance(found, TooSmall):
        return _beyond_range(case, limit, tried[found.x])
    if found is None or found.x <= mesh.smallest:
        return _below_range(case, limit)
    return _found(mesh, found, mesh.whole_answer(found.x, whole))


@dataclass(frozen=True)
class _OneMesh:
    """The search of a critical size with one resolution; the caller stores the solved answers.

    The search needs answers without an error estimate. Close to the root, complete answers with an
    error estimate are solved instead.
    """

    case: Case
    limit: Pressure
    lumen: float
    resolution: Resolution
    tolerance: float
    progress: Callable[[float], None]
    states: StateSolver

    @property
    def smallest(self) -> float:
        """Smallest size ratio that is distinguished from the lumen."""
        return self.lumen * (1.0 + SMALLEST_CRITICAL_OVERSIZE)

    def answer(self, size_ratio: float, tried: dict[float, Answer]) -> Answer:
        """Return the answer for a size ratio on this mesh; `tried` keeps the solved answers."""
        self.progress(size_ratio)
        if size_ratio not in tried:
            question = self.case.with_size_ratio(size_ratio)
            tried[size_ratio] = solve(question, self.resolution, self.states)
        return tried[size_ratio]

    def whole_answer(self, size_ratio: float, whole: dict[float, Answer]) -> Answer:
        """Return the answer for a size ratio with its error estimate; it is solved once."""
        if size_ratio not in whole:
            self.progress(size_ratio)
            question = self.case.with_size_ratio(size_ratio)
            whole[size_ratio] = solve(question, states=self.states)
        return whole[size_ratio]

    def excess(self, size_ratio: float, tried: dict[float, Answer]) -> float | None:
        """Return P_ucr minus the limit in Pa; None if it is not known.

        If P_ucr does not exist because the closure ends, the pressure at its end is used instead,
        provided that it is not below the limit.
        """
        answer = self.answer(size_ratio, tried)
        if answer.pressure is not None:
            return answer.pressure - self.limit
        end = answer.closure_end_pressure
        # P_ucr would be above the end of the closure, and so above the limit if the end is.
        return None if end is None or end < self.limit else end - self.limit

    def root(self, tried: dict[float, Answer]) -> Root | NoValue | TooSmall | None:
        """Find the root between the lumen and the largest size.

        The result is None if the root lies below the smallest size that is distinguished from the
        lumen.
        """
        low, high, limit = self.lumen, self.case.size_ratio, float(self.limit)

        def excess(size_ratio: float) -> float | None:
            return self.excess(size_ratio, tried)

        found = root_in_range(
            excess,
            low,
            high,
            -limit,
            self.smallest,
            self.tolerance,
            may_lie_below=limit < SMALL_LIMIT,
        )
        if not isinstance(found, float):
            return found
        known = {x: a.pressure for x, a in tried.items() if a.pressure is not None}
        return Root(found, local_slope(known, found))


def _from_coarse(
    mesh: _OneMesh, start: Root, tried: dict[float, Answer], whole: dict[float, Answer]
) -> Root | None:
    """Find the root by secants, from the root on a coarser mesh; None if they do not converge."""

    def pressure_of(size_ratio: float, last: bool) -> float | None:
        if last:
            return mesh.whole_answer(size_ratio, whole).pressure
        return mesh.answer(size_ratio, tried).pressure

    high = mesh.case.size_ratio
    return secant_root(pressure_of, float(mesh.limit), start, mesh.smallest, high, mesh.tolerance)


def _without_size(case: Case, limit: Pressure, answer: Answer) -> SizeAnswer:
    """Return the result of a search that ended at a size for which there is no answer."""
    where = f"at size ratio {answer.case.size_ratio:.4g}"
    return SizeAnswer(case, answer.outcome, _located(answer, where), limit, at_size=answer)


def _found(mesh: _OneMesh, found: Root, at_size: Answer) -> SizeAnswer:
    case, limit, root = mesh.case, mesh.limit, found.x
    if at_size.outcome is not Outcome.MOVES:
        where = f"at size ratio {root:.4g}, where the limit is reached"
        return SizeAnswer(case, at_size.outcome, _located(at_size, where), limit, at_size=at_size)
    inner = case.ureter.inner_diameter
    return SizeAnswer(
        case=case,
        outcome=Outcome.SOLVED,
        message=f"A stone of {root:.4g} times the inner diameter moves at the pressure limit.",
        limit=limit,
        size_ratio=root,
        diameter=None if inner is None else Length(root * inner),
        at_size=at_size,
        size_ratio_error=_size_ratio_error(at_size, found.slope),
        warnings=at_size.warnings,
    )


def _located(answer: Answer, where: str) -> str:
    """Return the sentence of an answer, and the size to which it applies."""
    reason = f": {answer.reason}" if answer.reason else ""
    return f"{answer.outcome.value}{reason} ({where})."


def _size_ratio_error(at_size: Answer, slope: float | None) -> float | None:
    """Return the error of P_ucr divided by dP_ucr/dξ, plus the tolerance of the search."""
    if at_size.error is None or at_size.error.critical_pressure is None or slope is None:
        return None
    return abs(at_size.error.critical_pressure / slope) + TOLERANCE


def _below_range(case: Case, limit: Pressure) -> SizeAnswer:
    message = (
        f"{Outcome.BELOW_RANGE.value}, {limit / 1e3:.4g} kPa, "
        f"if it is more than {SMALLEST_CRITICAL_OVERSIZE:.2%} larger than the lumen."
    )
    return SizeAnswer(case, Outcome.BELOW_RANGE, message, limit)


def _beyond_range(case: Case, limit: Pressure, top: Answer) -> SizeAnswer:
    assert top.pressure is not None
    if case.stone.friction == 0.0:
        message = (
            "Without friction a stone of any size moves without urine pressure, "
            "so that there is no critical size."
        )
        return SizeAnswer(case, Outcome.BEYOND_RANGE, message, limit, at_size=top)
    within = Outcome.BEYOND_RANGE.value
    if not case.model.NEEDS_ELEMENTS:
        within = (
            "The pressure limit is not reached within the range of sizes of the model "
            f"'{case.model.NAME}'"
        )
    message = (
        f"{within}: at its end, size ratio {case.size_ratio:.4g}, the "
        f"critical pressure is {top.pressure / 1e3:.4g} kPa, so the critical size lies above it."
    )
    return SizeAnswer(case, Outcome.BEYOND_RANGE, message, limit, at_size=top)
