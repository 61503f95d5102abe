"""Section 2.3: the friction coefficient from the two slopes of the surface (Eq. 18)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from stonepass.paper.inputs import SLOPES
from stonepass.paper.section import Asked, Claim, Section
from stonepass.studies.jobs import Job, Results
from stonepass.surface.friction import friction_of_slopes

__all__ = ["Eq18"]


class Eq18:
    """The friction coefficient of the published slopes."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return no jobs, since nothing has to be solved."""
        return []

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Return a section that has only a claim."""
        claim = Claim.number(
            "friction coefficient from slopes 0.38 and 0.12 (Eq. 18)",
            0.5,
            friction_of_slopes(*SLOPES),
            0.03,
            "Eq. 18 gives 0.52, which the paper rounds to 0.5",
        )
        return Section.written("Section 2.3: friction from the surface", "", folder, claims=[claim])
