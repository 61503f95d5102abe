"""A model that keeps the processor busy for a stated time."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any, ClassVar

from stonepass.errors import Outcome
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.answer import Answer
from stonepass.model.models.registry import MODELS

SECONDS = 0.1  # processor time of a case


@dataclass(frozen=True)
class BusyWall(NeoHookean):
    """A wall of this module: whoever reads it in another process has registered the model too."""


@dataclass(frozen=True)
class Busy:
    """A model without physics."""

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "busy"
    MEANING: ClassVar[str] = "a case that takes a stated time"
    NEEDS_ELEMENTS: ClassVar[bool] = False
    far_field_ground: ClassVar[bool] = False

    def require_any_size(self) -> None:
        """Any size will do."""

    def largest_size(self, case: Any) -> float:
        return 3.0

    def solve(self, case: Any, numerics: Any, states: Any, resolution: Any = None) -> Answer:
        end = time.process_time() + SECONDS
        while time.process_time() < end:
            sum(range(1000))
        return Answer(case, self, numerics, Outcome.MOVES, pressure=1e3 * case.size_ratio)


MODELS.setdefault("busy", Busy)
