"""Construction of a surrogate of the direct model: solve the cases, fit the functions of p."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

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
from stonepass.studies.surrogates.solved_cases import LearntCases
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["build_held_stone"]

# Largest load as a fraction of the load at which the tube buckles, if the fibres of the wall
# microbuckle. Above it thin walls have several states, whose pressures differ by up to 1 %.
WRINKLED = 0.4
CANDIDATES = 512  # number of cases among which the refinement chooses
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


@dataclass(frozen=True)
class _Build:
    """Solves the cases of the three levels.

    Attributes
    ----------
    case : Case
        Material, model and load of the cases; the numerics are those of the surrogate.
    domain : Domain
    physics : HeldStone
    solver : CaseSolver
    sizes : _Sizes
    effort : float
        Factor on the number of cases.
    """

    case: Case
    domain: Domain
    physics: HeldStone
    solver: CaseSolver
    sizes: _Sizes
    effort: float

    def count(self, number: int) -> int:
        """Return a number of cases for the effort."""
        return max(FEWEST, round(self.effort * number))

    def solved(self, asked: Conditions, leaks: int) -> LearntCases:
        """Solve cases; with an error estimate the model computes the leak pressure too."""
        cases = [case_at(self.case, asked, k) for k in range(len(asked.friction))]
        answers = [
            *self.solver.answers(cases[:leaks]),
            *self.solver.answers(cases[leaks:], error=False),
        ]
        at = self.domain.setting(self.case, asked)
        return LearntCases(at, answers, self.physics.learnt(self.case, at, answers))

    def free(self) -> LearntCases:
        """Solve the first level, nearly without friction."""
        count, leaks = map(self.count, self.sizes.free)
        asked = self.domain.training(self.case, count)
        nearly = np.full(len(asked.friction), NEARLY_NONE)
        return self.solved(replace(asked, friction=nearly), leaks)

    def held(self, base: SparsePolynomial) -> LearntCases:
        """Solve the second and the third level, whose first level gave `base`."""
        gentle = self.count(self.sizes.gentle[0])
        asked = self.domain.training(self.case, gentle + self.count(self.sizes.pushed[0]))
        first = np.arange(len(asked.friction)) < gentle
        little, rest = asked.where(first), asked.where(~first)
        little = replace(little, friction=GENTLER * little.friction)
        second = self.solved(little, self.count(self.sizes.gentle[1]))
        functions, _ = _with_changes(base, second, self.sizes)
        at = self.domain.setting(self.case, rest)
        below = self.physics.solve(self.case, at, functions(at)).outcome == MOVES
        return second.joined(self.solved(rest.where(below), self.count(self.sizes.pushed[1])))

    def refined(self, base: SparsePolynomial, held: LearntCases) -> LearntCases:
        """Return the cases of `held` with further ones where the surrogate is least certain."""
        if not self.sizes.refined:
            return held

        def pressures(half: slice, there: Setting) -> Float[np.ndarray, " m"]:
            """Return P_ucr by a fit to a part of the cases."""
            fitted, _ = _with_changes(base, held.part(half), self.sizes)
            found: Float[np.ndarray, " m"] = self.physics.solve(
                self.case, there, fitted(there)
            ).pressure
            return found

        count = self.count(self.sizes.refined)
        more = least_certain_cases(self.domain, self.case, pressures, count, CANDIDATES)
        return held.joined(self.solved(more, leaks=0))


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
    build = _Build(quick, Domain(box, stable), HeldStone(), solver, sizes, effort)
    free = build.free()
    base = _base(free, sizes)
    held = build.refined(base, build.held(base))
    _refuse_lost([*free.answers, *held.answers])
    learnt, left_out = _with_changes(base, held, sizes)
    error = _claimed(quick, build.physics, learnt, held, left_out)
    about = origin(case, [(quick, each.answers) for each in (free, held)])
    lumen = fit_lumen(case, box) if case.load != Load() else None
    return Surrogate(
        case, box, build.physics, learnt, error, FLOOR, build.domain.stable, lumen, about
    )


def _base(free: LearntCases, sizes: _Sizes) -> SparsePolynomial:
    """Fit ln((π/2 − α)/root) and the functions of p without friction."""
    _, *functions = free.values.T
    widths = np.log(functions[1])
    return joined([
        fit_polynomial(free.at.unit, each, sizes.base, BASE_TOTAL).polynomial
        for each in (widths, *functions)
    ])  # fmt: skip


def _with_changes(
    base: SparsePolynomial, solved: LearntCases, sizes: _Sizes
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
    case: Case, physics: HeldStone, learnt: HeldFunctions, solved: LearntCases, left_out: Values
) -> SparsePolynomial:
    """Return the claimed error from the leave-one-out errors of ln h."""
    known = np.isfinite(left_out[:, 0])
    at = solved.at.where(known)
    coefficients = learnt(at)
    coefficients[:, 0] += left_out[known, 0]
    found = physics.solve(case, at, coefficients).pressure
    return claimed_error(at.unit, found, solved.pressures[known])


def _refuse_lost(answers: Sequence[Answer]) -> None:
    """Raise BadInput if too many cases have no answer."""
    lost = [each.reason for each in answers if each.pressure is None]
    if len(lost) > MOST_LOST * len(answers):
        raise BadInput(
            "number of cases of the box without an answer", f"{len(lost)} of {len(answers)}",
            f"at most {100.0 * MOST_LOST:g} %",
            f"make the box smaller; the first reason is: {lost[0]}",
        )  # fmt: skip
