"""The force balance of the direct model for many cases, from learnt functions of the pressure.

The critical pressure P_ucr of a held stone is proportional to the friction coefficient μ as long as
the urine changes little in the contact. The factor of proportion h = P_ucr/(μ P_s) is a smooth
function of stone, wall and p = P_ucr/P_s, where P_s opens the tube to the width of the stone. A
surrogate solves p = μ h(p). The radius of the opened tube and the frictional dissipation follow
from P_ucr in closed form: at the critical state D = I(P_ucr). See "The push-through, solved
directly" in docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval
from scipy.optimize import elementwise

from stonepass.array_types import Float
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.models.push_through import PushThroughDetail
from stonepass.model.states.loaded_state import PushedState
from stonepass.studies.conditions import urine_pressures
from stonepass.studies.surrogates.box import Setting, opening_pressure
from stonepass.studies.surrogates.held_functions import HIGHEST
from stonepass.studies.surrogates.solved import MOVES, NO_SOLUTION, Solved

__all__ = ["HeldStone"]

FUNCTIONS = 3  # ln h, (π/2 − α)/root, ln(P_leak/P_s)
# Largest number of steps of Newton's method; the surrogates of the package take at most 5.
STEPS = 50
TOLERANCE = 1e-10
GAUSS = 8  # number of quadrature points of the work of the urine


@dataclass(frozen=True)
class HeldStone:
    """The balance of a stone that is held against the urine pressure, solved for many cases.

    The learnt functions of p are ln h, (π/2 − α)/root with the angle α at which the contact begins,
    and ln(P_leak/P_s).
    """

    def learnt(
        self, case: Case, at: Setting, answers: Sequence[Answer]
    ) -> Float[np.ndarray, "n functions"]:
        """Return p and the values of the functions at p; NaN where an answer has none.

        Parameters
        ----------
        case : Case
            The common material and model.
        at : Setting
            The conditions of the answers.
        answers : sequence of Answer
            The n answers. Answers whose energy balance does not hold have no values.
        """
        found = np.full((len(answers), 1 + FUNCTIONS), np.nan)
        opening = opening_pressure(case, at)
        for k, answer in enumerate(answers):
            state, detail = answer.contact, answer.detail
            if answer.pressure is None or not balanced(answer):
                continue
            assert isinstance(state, PushedState)
            p = answer.pressure / opening[k]
            leak = detail.leak_pressure if isinstance(detail, PushThroughDetail) else None
            angle = (np.pi / 2 - state.contact_angle) / at.root[k]
            ratio = np.nan if leak is None else leak / opening[k]
            found[k] = [p, np.log(p / answer.case.stone.friction), angle, np.log(ratio)]
        return found

    def solve(self, case: Case, at: Setting, learnt: Float[np.ndarray, "n f"]) -> Solved:
        """Solve p = μ h(p) for n cases.

        Parameters
        ----------
        case : Case
            The common material and model.
        at : Setting
        learnt : array (n, coefficients)
            Base and coefficients of each function, see `HeldFunctions`.
        """
        count = len(learnt)
        parts = learnt.reshape(count, FUNCTIONS, learnt.shape[1] // FUNCTIONS)
        friction, opening = at.conditions.friction, opening_pressure(case, at)
        p, found = _balanced_pressure(parts[:, 0], friction)
        pressure = np.where(found, p * opening, np.nan)
        narrow, leak = (_value(parts[:, k], p) for k in (1, 2))
        radius = _opened(case, at, np.where(found, pressure, 0.0))
        work = _work(case, at, radius, pressure)
        known = np.where(found, 1.0, np.nan)
        return Solved(
            np.where(found, MOVES, NO_SOLUTION),
            pressure,
            np.where(found, 0.0, HIGHEST * opening),
            {
                "contact_angle": known * (np.pi / 2 - at.root * narrow),
                "leak_pressure": known * np.exp(leak) * opening,
                "friction_work": work,
                "opened_radius": known * radius,
            },
        )


def balanced(answer: Answer) -> bool:
    """Return whether the answer fulfils its own energy balance."""
    return all(each.code != "loaded_imbalance" for each in answer.warnings)


def _value(part: Float[np.ndarray, "n c"], p: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Return base + p × correction of one function."""
    return part[:, 0] + p * chebval(2.0 * p / HIGHEST - 1.0, part[:, 1:].T, tensor=False)


def _balanced_pressure(
    part: Float[np.ndarray, "n c"], friction: Float[np.ndarray, " n"]
) -> tuple[Float[np.ndarray, " n"], np.ndarray]:
    """Return p with p = μ h(p), and whether it was found and is at most `HIGHEST`.

    Newton's method is kept inside a bracket, which is halved where a step leaves it.
    """
    series = np.ascontiguousarray(part[:, 1:].T)
    slopes = chebder(series)
    low, high = np.zeros(len(part)), np.full(len(part), HIGHEST)
    found = friction * np.exp(_value(part, high)) <= HIGHEST
    p = np.minimum(friction * np.exp(part[:, 0]), HIGHEST)
    for _ in range(STEPS):
        x = 2.0 * p / HIGHEST - 1.0
        correction = chebval(x, series, tensor=False)
        slope = correction + p * chebval(x, slopes, tensor=False) * 2.0 / HIGHEST
        other = friction * np.exp(part[:, 0] + p * correction)
        excess = p - other
        low, high = np.where(excess < 0.0, p, low), np.where(excess < 0.0, high, p)
        step = excess / np.maximum(1.0 - other * slope, 0.1)
        after = p - step
        after = np.where((after < low) | (after > high), (low + high) / 2.0, after)
        done = np.abs(after - p) <= TOLERANCE * np.maximum(p, TOLERANCE)
        p = after
        if done.all():
            break
    return p, found & done


def _opened(case: Case, at: Setting, pressure: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Return r_a/R_a of the tube under the urine pressure, which is at most `HIGHEST` P_s."""
    factor = at.conditions.load_factor

    def excess(radius: np.ndarray, wall: np.ndarray, part: np.ndarray, urine: np.ndarray) -> Any:
        return urine_pressures(case, radius, wall, part) - urine

    ends = (at.lumen, np.maximum(at.conditions.size_ratio, at.lumen))
    args = (at.conditions.wall_ratio, factor, pressure)
    found = elementwise.find_root(excess, ends, args=args)
    return np.where(found.success, found.x, at.lumen)


def _work(
    case: Case,
    at: Setting,
    radius: Float[np.ndarray, " n"],
    pressure: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " n"]:
    """Return I(P)/(π R_s²) = (r_a² P − 2 ∫ r p(r) dr)/ξ² in Pa, which is equal to D.

    The integral extends from the lumen to r_a.
    """
    asked = at.conditions
    points, weights = np.polynomial.legendre.leggauss(GAUSS)
    inside = np.zeros(len(radius))
    for point, weight in zip(points.tolist(), weights.tolist(), strict=True):
        r = at.lumen + (point + 1.0) / 2.0 * (radius - at.lumen)
        inside += weight * r * urine_pressures(case, r, asked.wall_ratio, asked.load_factor)
    inside *= (radius - at.lumen) / 2.0
    return (radius**2 * pressure - 2.0 * inside) / asked.size_ratio**2
