"""Construction of a surrogate of the direct model: solve the cases, fit the functions of p."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import BadInput
from stonepass.materials.relaxed_energy import Microbuckling
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.numerics import Numerics
from stonepass.studies.case_solver import CaseSolver
from stonepass.studies.conditions import Conditions, case_at
from stonepass.studies.surrogates.box import Box, Setting, fit_lumen
from stonepass.studies.surrogates.buckling_limit import MARGIN, stable_loads
from stonepass.studies.surrogates.claimed_error import FLOOR, claimed_error
from stonepass.studies.surrogates.domain import Domain
from stonepass.studies.surrogates.held_functions import HIGHEST, HeldFunctions, in_contact
from stonepass.studies.surrogates.held_stone import HeldStone
from stonepass.studies.surrogates.origin import origin
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.refinement import least_certain_cases
from stonepass.studies.surrogates.regression import FEWEST, fit_polynomial, joined
from stonepass.studies.surrogates.solved import MOVES
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["build_held_stone"]

# Largest load as a fraction of the load at which the tube buckles, if the fibres of the wall
# microbuckle. Above it thin walls have several states, whose pressures differ by up to 1 %.
WRINKLED = 0.4
NEARLY_NONE = 1e-4  # friction coefficient of the cases that stand for no friction
GENTLER = 0.3  # factor on the friction of the second level
MOST_LOST = 0.05  # largest fraction of cases without an answer

Values = Float[np.ndarray, "n functions"]


@dataclass(frozen=True)
class _Sizes:
    """Numbers of cases of the three levels, and the degrees of the polynomials.

    Attributes
    ----------
    free, gentle, pushed : (int, int)
        Number of cases of a level, and number of those whose leak pressure is computed too; that
        takes several times as long.
    refined : int
        Number of further cases of the third level where the surrogate is least certain.
    base : tuple of 4 int
        Largest degrees of the functions without friction in the coordinates of the box.
    change : tuple of 4 int
        Largest degrees of what the pressure changes, see `in_contact`.
    total : int
        Largest total degree of what the pressure changes.
    """

    free: tuple[int, int]
    gentle: tuple[int, int]
    pushed: tuple[int, int]
    refined: int
    base: tuple[int, int, int, int]
    change: tuple[int, int, int, int]
    total: int


UNLOADED = _Sizes((384, 160), (96, 32), (448, 128), 64, (20, 16, 0, 0), (16, 12, 8, 0), 16)
LOADED = _Sizes((2048, 256), (160, 48), (1024, 160), 256, (20, 16, 0, 8), (16, 12, 8, 6), 16)
BASE_TOTAL = 20  # largest total degree of the functions without friction


def _sizes(*, loaded: bool, wrinkles: bool) -> _Sizes:
    """Return the sizes for a box with or without loads.

    The solves of a wall that microbuckles scatter by up to 0.5 % where several states exist. Higher
    degrees and refined cases then make the surrogate slower and not more accurate.
    """
    sizes = LOADED if loaded else UNLOADED
    if not wrinkles:
        return sizes
    return replace(sizes, refined=0, change=(8, 8, 8, 5 if loaded else 0), total=8)


@array_dataclass
@dataclass(frozen=True)
class _Cases:
    """Solved cases: conditions, answers, and p with the functions at p."""

    at: Setting
    answers: list[Answer]
    values: Values

    def joined(self, other: _Cases) -> _Cases:
        """Return the cases of both."""
        return _Cases(
            self.at.joined(other.at),
            [*self.answers, *other.answers],
            np.concatenate([self.values, other.values]),
        )

    def part(self, rows: slice) -> _Cases:
        """Return some of the cases."""
        chosen = np.zeros(len(self.answers), dtype=bool)
        chosen[rows] = True
        return _Cases(self.at.where(chosen), self.answers[rows], self.values[rows])


def build_held_stone(case: Case, box: Box, solver: CaseSolver, effort: float) -> Surrogate:
    """Build a surrogate of the direct model; for parameters see `build.build_surrogate`.

    Three levels of cases are solved: nearly without friction, with little friction, and with the
    friction of the box. Cases of the third level whose pressure would be above the largest one of a
    surrogate, by the fit to the second level, are left out. Further cases with the friction of the
    box are solved where the surrogate is least certain.

    Raises
    ------
    BadInput
        Too many cases have no answer.

    References
    ----------
    docs/surrogates.md, "The direct model".
    """
    quick = replace(case, numerics=Numerics("fast", case.numerics.half_length))
    wrinkles = isinstance(case.ureter.material.law, Microbuckling)
    sizes = _sizes(loaded=case.load.confining_pressure > 0.0, wrinkles=wrinkles)
    stable = stable_loads(case, box.wall_ratio, WRINKLED if wrinkles else MARGIN)
    domain, physics = Domain(box, stable), HeldStone()

    def count(number: int) -> int:
        return max(FEWEST, round(effort * number))

    def solved(asked: Conditions, leaks: int) -> _Cases:
        """Solve cases; with an error estimate the model computes the leak pressure too."""
        cases = [case_at(quick, asked, k) for k in range(len(asked.friction))]
        answers = [*solver.answers(cases[:leaks]), *solver.answers(cases[leaks:], error=False)]
        at = domain.setting(quick, asked)
        return _Cases(at, answers, physics.learnt(quick, at, answers))

    asked = domain.training(quick, count(sizes.free[0]))
    nearly = np.full(len(asked.friction), NEARLY_NONE)
    free = solved(replace(asked, friction=nearly), count(sizes.free[1]))
    base = _base(free, sizes)

    gentle = count(sizes.gentle[0])
    asked = domain.training(quick, gentle + count(sizes.pushed[0]))
    first = np.arange(len(asked.friction)) < gentle
    little = asked.where(first)
    second = solved(replace(little, friction=GENTLER * little.friction), count(sizes.gentle[1]))
    functions, _ = _with_changes(base, second, sizes)

    rest = asked.where(~first)
    at = domain.setting(quick, rest)
    below = physics.solve(quick, at, functions(at)).outcome == MOVES
    third = solved(rest.where(below), count(sizes.pushed[1]))
    both = second.joined(third)

    def pressures(half: slice, there: Setting) -> Float[np.ndarray, " m"]:
        """Return P_ucr by a fit to a part of the second and third level."""
        fitted, _ = _with_changes(base, both.part(half), sizes)
        found: Float[np.ndarray, " m"] = physics.solve(quick, there, fitted(there)).pressure
        return found

    if sizes.refined:
        more = least_certain_cases(domain, quick, pressures, count(sizes.refined))
        both = both.joined(solved(more, leaks=0))
    _refuse_lost([*free.answers, *both.answers])
    learnt, left_out = _with_changes(base, both, sizes)
    error = _claimed(quick, physics, learnt, both, left_out)
    about = origin(case, [(quick, each.answers) for each in (free, both)])
    lumen = fit_lumen(case, box) if case.load != Load() else None
    return Surrogate(case, box, physics, learnt, error, FLOOR, domain.stable, lumen, about)


def _base(free: _Cases, sizes: _Sizes) -> SparsePolynomial:
    """Fit ln((π/2 − α)/root) and the functions of p without friction."""
    _, *functions = free.values.T
    widths = np.log(functions[1])
    return joined([
        fit_polynomial(free.at.unit, each, sizes.base, BASE_TOTAL).polynomial
        for each in (widths, *functions)
    ])  # fmt: skip


def _with_changes(
    base: SparsePolynomial, solved: _Cases, sizes: _Sizes
) -> tuple[HeldFunctions, Values]:
    """Fit what the pressure changes in all functions; return leave-one-out errors too."""
    at, p = solved.at, solved.values[:, 0]
    without = base(at.unit)
    points = in_contact(at, without, p)
    rest = solved.values[:, 1:] - without[:, 1:]
    rest[~(p <= HIGHEST)] = np.nan  # beyond the largest pressure of a surrogate, or unknown
    fits = [fit_polynomial(points, each, sizes.change, sizes.total, p) for each in rest.T]
    functions = HeldFunctions(base, joined([each.polynomial for each in fits]))
    return functions, np.stack([each.left_out for each in fits], axis=1)


def _claimed(
    case: Case, physics: HeldStone, learnt: HeldFunctions, solved: _Cases, left_out: Values
) -> SparsePolynomial:
    """Return the claimed error from the leave-one-out errors of ln h."""
    known = np.isfinite(left_out[:, 0])
    at = solved.at.where(known)
    coefficients = learnt(at)
    coefficients[:, 0] += left_out[known, 0]
    true = np.array([each.pressure for each in solved.answers], dtype=float)[known]
    return claimed_error(at.unit, physics.solve(case, at, coefficients).pressure, true)


def _refuse_lost(answers: Sequence[Answer]) -> None:
    """Raise BadInput if too many cases have no answer."""
    lost = [each.reason for each in answers if each.pressure is None]
    if len(lost) > MOST_LOST * len(answers):
        raise BadInput(
            "number of cases of the box without an answer", f"{len(lost)} of {len(answers)}",
            f"at most {100.0 * MOST_LOST:g} %",
            f"make the box smaller; the first reason is: {lost[0]}",
        )  # fmt: skip
