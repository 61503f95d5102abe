"""Surrogate of the direct model: critical pressure, leak pressure and contact angle are learnt.

The critical pressure is divided by the friction coefficient and by the pressure that opens the tube
to the width of the stone. The logarithm of this ratio is bounded at the size of the lumen and for
vanishing friction, and it varies slowly in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import Outcome
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.studies.surrogates.box import Setting, opening_pressure
from stonepass.studies.surrogates.solved import LEAKS, MOVES, NO_SOLUTION, Solved

__all__ = ["PushedStone"]

# Value of the indicator of a solution above which a solution is expected; it is 1 at solved cases
# and -1 at the others.
SOLVED = 0.0


@dataclass(frozen=True)
class PushedStone:
    """The learnt functions of the direct model.

    They are ln(P_ucr/(μ P_s)), ln(P_leak/P_s'), ln(w/root), and the indicator of a solution. P_s is
    the pressure that opens the tube to the width of the stone, P_s' is P_s plus the confining
    pressure, w is the half-width of the contact upstream of the widest section, and `root` is the
    coordinate of the size.
    """

    indicator: float = SOLVED

    @classmethod
    def fitted_to(cls, answers: Sequence[Answer | None]) -> PushedStone:
        """Return the physics; the answers are not needed."""
        return cls()

    def learnt(
        self, case: Case, at: Setting, answers: Sequence[Answer | None]
    ) -> Float[np.ndarray, "n 4"]:
        """Return the values of the learnt functions; NaN where they do not exist.

        Parameters
        ----------
        case : Case
            The common material, load and model.
        at : Setting
            The conditions of the answers.
        answers : sequence of Answer or None
            The n answers.
        """
        scale, friction = opening_pressure(case, at), at.conditions.friction
        found = np.full((len(answers), 4), np.nan)
        for k, answer in enumerate(answers):
            if answer is None:
                continue
            pressure, detail = answer.pressure, answer.detail
            leak = getattr(detail, "leak_pressure", None)
            found[k, 3] = 1.0 if answer.outcome in (Outcome.MOVES, Outcome.LEAKS) else -1.0
            if pressure:
                found[k, 0] = np.log(pressure / (friction[k] * scale[k]))
            if leak:
                found[k, 1] = np.log(leak / (scale[k] + at.confining[k]))
            if answer.contact is not None:
                width = np.pi / 2 - answer.contact.contact_angle
                found[k, 2] = np.log(width / at.root[k]) if width > 0.0 else np.nan
        return found

    def solve(self, case: Case, at: Setting, learnt: Float[np.ndarray, "n 4"]) -> Solved:
        """Return the critical pressure, the leak pressure and the contact angle of n cases.

        Parameters
        ----------
        case : Case
            The common material, load and model.
        at : Setting
        learnt : array (n, 4)
            Values of the learnt functions.
        """
        scale = opening_pressure(case, at)
        pressure = at.conditions.friction * scale * np.exp(learnt[:, 0])
        leak = (scale + at.confining) * np.exp(learnt[:, 1])
        angle = np.pi / 2 - at.root * np.exp(learnt[:, 2])
        solved = learnt[:, 3] > self.indicator
        leaks = solved & (pressure > leak)
        outcome = np.where(leaks, LEAKS, np.where(solved, MOVES, NO_SOLUTION))
        moves = outcome == MOVES
        quantities = {
            "contact_angle": np.where(moves, angle, np.nan),
            "leak_pressure": np.where(solved, leak, np.nan),
        }
        bound = np.where(leaks, leak, 0.0)
        return Solved(outcome, np.where(moves, pressure, np.nan), bound, quantities)
