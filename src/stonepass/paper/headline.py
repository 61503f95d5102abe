"""The paper's headline: critical sizes of the thin and the thick human ureter (section 3.2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from stonepass.model.case import Case, Stone, Ureter
from stonepass.model.critical import Answer
from stonepass.model.size import SizeAnswer, critical_size
from stonepass.studies.curve import curve
from stonepass.units import Pressure

__all__ = ["FRICTION", "LIMIT", "PUBLISHED", "Wall", "headline"]

LIMIT = Pressure(12e3)  # the paper's bearable pressure, a pig study; see the theory page
FRICTION = 0.5
# wall ratio η: published ξ_cr, Fung wall, friction 0.5, no confining pressure (paper, Fig. 8a)
PUBLISHED = {1.30: 1.22, 3.40: 1.11}
SIZE_RATIOS = tuple(float(x) for x in np.round(np.linspace(1.0, 1.3, 16), 10))


@dataclass(frozen=True)
class Wall:
    """One of the two limiting walls: its curve, its critical size, the published one."""

    wall_ratio: float
    published: float
    size: SizeAnswer
    curve: list[Answer]

    @property
    def deviation(self) -> float | None:
        """Our ξ_cr minus the published one."""
        return None if self.size.size_ratio is None else self.size.size_ratio - self.published


def headline(progress: Callable[[int, int], None] | None = None) -> list[Wall]:
    """Compute P_ucr(ξ), ξ = 1–1.3, and ξ_cr at 12 kPa for both walls.

    `progress` is told (done, all) after every curve point and every critical size.
    """
    total = len(PUBLISHED) * (len(SIZE_RATIOS) + 1)
    done = 0

    def tick(*_: int) -> None:
        nonlocal done
        done += 1
        if progress is not None:
            progress(done, total)

    walls = []
    for wall_ratio, published in PUBLISHED.items():
        ureter = Ureter(wall_ratio=wall_ratio)
        case = Case(Stone(size_ratio=1.0, friction=FRICTION), ureter)
        answers = curve(case, SIZE_RATIOS, tick)
        size = critical_size(ureter, LIMIT, FRICTION)
        tick()
        walls.append(Wall(wall_ratio, published, size, answers))
    return walls
