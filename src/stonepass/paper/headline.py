"""The paper's headline: critical sizes of the thin and the thick human ureter (section 3.2)."""

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
        η, and the published ξ_cr.
    size : SizeAnswer
        Our ξ_cr at 12 kPa.
    curve : list of Answer
        P_ucr over ξ.
    confined : list of Answer
        P_ucr at the published ξ_cr without and with each of `CONFINING`.
    """

    wall_ratio: float
    published: float
    size: SizeAnswer
    curve: list[Answer]
    confined: list[Answer]

    @property
    def deviation(self) -> float | None:
        """Our ξ_cr minus the published one."""
        return None if self.size.size_ratio is None else self.size.size_ratio - self.published


@dataclass(frozen=True)
class Headline:
    """The study of both walls: P_ucr(ξ), ξ_cr at 12 kPa, and what confining pressure adds."""

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
    """The published critical size without and with each confining pressure."""
    loads = [Load(), *(Load(pressure) for pressure in CONFINING)]
    return [ureter_case(wall_ratio, PUBLISHED[wall_ratio], load) for load in loads]
