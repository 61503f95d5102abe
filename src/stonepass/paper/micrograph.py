"""Section 2.3: the friction coefficient from the two slopes of the surface (Eq. 18)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from stonepass.paper.inputs import SLOPES
from stonepass.paper.jobs import Job, Results
from stonepass.paper.section import Asked, Claim, Section

__all__ = ["Eq18"]


class Eq18:
    """μ_f = tan(arctan k₀ + arctan k₁)."""

    def jobs(self, asked: Asked) -> list[Job]:
        """Nothing to solve."""
        return []

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Only a claim."""
        friction = float(np.tan(sum(np.arctan(slope) for slope in SLOPES)))
        claim = Claim.number(
            "friction coefficient from slopes 0.38 and 0.12 (Eq. 18)",
            0.5,
            friction,
            0.03,
            "Eq. 18 gives 0.52, which the paper rounds to 0.5",
        )
        return Section.written("Section 2.3: friction from the surface", "", folder, claims=[claim])
