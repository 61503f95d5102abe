"""The cases that a surrogate may be built with: the box with the largest loads in it."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.model.case import Case
from stonepass.studies.conditions import Conditions, joined, lumen_ratios
from stonepass.studies.surrogates.box import HELD_OUT, Box, Setting
from stonepass.studies.surrogates.stable_loads import StableLoads

__all__ = ["CANDIDATES", "POOL", "Domain"]

# Candidates of the refinement, from the sequence of sampled cases after those of a check.
POOL, CANDIDATES = 2048, 2048
AFTER = POOL + CANDIDATES  # first case of the sequence after all of these


@dataclass(frozen=True)
class Domain:
    """The box of a surrogate and the largest loads in it."""

    box: Box
    stable: StableLoads

    def training(self, case: Case, count: int) -> Conditions:
        """Return conditions for the fit; those of a check and of the refinement are left out."""
        first = self.box.sample(case, self.stable, min(count, HELD_OUT))
        if count <= HELD_OUT:
            return first
        return joined(first, self.box.sample(case, self.stable, count - HELD_OUT, AFTER))

    def candidates(self, case: Case, count: int) -> Conditions:
        """Return conditions among which the refinement chooses, at most `CANDIDATES`."""
        return self.box.sample(case, self.stable, min(count, CANDIDATES), POOL)

    def setting(self, case: Case, at: Conditions) -> Setting:
        """Return the coordinates of conditions in the box."""
        lumen = lumen_ratios(case, at.wall_ratio, at.load_factor)
        return self.box.setting(case, at, lumen, self.stable.narrowest)
