"""The paper's headline: critical sizes of the thin and the thick human ureter (section 3.2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.case import Load
from stonepass.model.size import SizeAnswer
from stonepass.paper.inputs import CONFINING, LIMIT, PUBLISHED, ureter_case
from stonepass.studies.jobs import Job, PressureJob, SizeJob, run_jobs

__all__ = ["Wall", "headline"]

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


def headline(progress: Callable[[int, int], None] | None = None, workers: int = 1) -> list[Wall]:
    """Compute P_ucr(ξ), ξ_cr at 12 kPa, and what confining pressure adds, for both walls.

    `progress` is told (done, all) after every case and every critical size.
    """
    loads = [Load(), *(Load(p) for p in CONFINING)]
    curves = {eta: [ureter_case(eta, xi) for xi in SIZE_RATIOS] for eta in PUBLISHED}
    confined = {eta: [ureter_case(eta, xi, p) for p in loads] for eta, xi in PUBLISHED.items()}
    jobs: list[Job] = [SizeJob(stones[-1], LIMIT) for stones in curves.values()]
    jobs += [
        PressureJob(case) for each in (curves, confined) for row in each.values() for case in row
    ]
    found = run_jobs(jobs, None, workers, progress)
    return [
        Wall(
            eta,
            published,
            found.size(curves[eta][-1], LIMIT),
            [found.answer(case) for case in curves[eta]],
            [found.answer(case) for case in confined[eta]],
        )
        for eta, published in PUBLISHED.items()
    ]
