"""The two critical sizes that the paper reports, of a thin and a thick ureter (section 3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.size import SizeAnswer
from stonepass.paper.inputs import CONFINING, LIMIT, PUBLISHED, ureter_case
from stonepass.studies.jobs import PressureJob, Results, SizeJob

__all__ = ["Headline", "Wall"]

SIZE_RATIOS = tuple(float(x) for x in np.round(np.linspace(1.0, 1.3, 11), 10))


@dataclass(frozen=True)
class Wall:
    """One of the two limiting walls.

    Attributes
    ----------
    wall_ratio, published : float
        Wall ratio η, and the critical size ratio ξ_cr of the paper.
    size : SizeAnswer
        The critical size at 12 kPa, computed here.
    curve : list of Answer
        P_ucr over ξ.
    confined : list of Answer
        P_ucr at the published ξ_cr, without confining pressure and with each of `CONFINING`.
    """

    wall_ratio: float
    published: float
    size: SizeAnswer
    curve: list[Answer]
    confined: list[Answer]

    @property
    def deviation(self) -> float | None:
        """The computed ξ_cr minus the published one; None without a computed one."""
        return None if self.size.size_ratio is None else self.size.size_ratio - self.published


@dataclass(frozen=True)
class Headline:
    """The study of both walls: P_ucr(ξ), ξ_cr at 12 kPa, and the effect of confining pressure."""

    def jobs(self) -> list[PressureJob | SizeJob]:
        """Return the two critical sizes and every case of the curves."""
        cases = [case for eta in PUBLISHED for case in (*_curve(eta), *_confined(eta))]
        sizes = [SizeJob(_curve(eta)[-1], LIMIT) for eta in PUBLISHED]
        return [*sizes, *map(PressureJob, cases)]

    def reduce(self, results: Results) -> list[Wall]:
        """Return the thin wall and the thick one."""
        return [
            Wall(
                eta,
                published,
                results.size(_curve(eta)[-1], LIMIT),
                [results.answer(case) for case in _curve(eta)],
                [results.answer(case) for case in _confined(eta)],
            )
            for eta, published in PUBLISHED.items()
        ]


def _curve(wall_ratio: float) -> list[Case]:
    return [ureter_case(wall_ratio, xi) for xi in SIZE_RATIOS]


def _confined(wall_ratio: float) -> list[Case]:
    """Return the cases of the published critical size under each confining pressure."""
    loads = [Load(), *(Load(pressure) for pressure in CONFINING)]
    return [ureter_case(wall_ratio, PUBLISHED[wall_ratio], load) for load in loads]
