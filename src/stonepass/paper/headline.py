"""The paper's headline: critical sizes of the thin and the thick human ureter (section 3.2)."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, as_completed
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.case import Load, Ureter
from stonepass.model.size import SizeAnswer, critical_size
from stonepass.paper.inputs import CONFINING, FRICTION, LIMIT, PUBLISHED, ureter_case
from stonepass.studies.curve import solve_slim
from stonepass.studies.executor import executor

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
    with executor(workers) as pool:
        sizes = {
            eta: pool.submit(critical_size, Ureter(wall_ratio=eta), LIMIT, FRICTION)
            for eta in PUBLISHED
        }
        curves = {
            eta: [pool.submit(solve_slim, ureter_case(eta, xi, Load())) for xi in SIZE_RATIOS]
            for eta in PUBLISHED
        }
        confined = {
            eta: [pool.submit(solve_slim, ureter_case(eta, xi, load)) for load in loads]
            for eta, xi in PUBLISHED.items()
        }
        everything: list[Future[Any]] = [
            *sizes.values(),
            *chain.from_iterable([*curves.values(), *confined.values()]),
        ]
        for done, _ in enumerate(as_completed(everything), start=1):
            if progress is not None:
                progress(done, len(everything))
        return [
            Wall(
                eta,
                published,
                sizes[eta].result(),
                [future.result() for future in curves[eta]],
                [future.result() for future in confined[eta]],
            )
            for eta, published in PUBLISHED.items()
        ]
