"""A case: a physical problem, the model that answers it, and its numerics."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from stonepass.errors import BadInput
from stonepass.model.answer import Model
from stonepass.model.load import Load
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

__all__ = ["Case", "Load", "Stone", "Ureter"]


@dataclass(frozen=True)
class Case(Problem):
    """A stone in a ureter under a load, the model and its numerics: all an answer depends on.

    Parameters
    ----------
    stone : Stone
    ureter : Ureter
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    model : Model, optional
        `SeatedBalance` (the paper's, the default), `PushThrough` or `ElasticFoundation`, each with
        its own options.
    numerics : Numerics, optional
        Accuracy and length of the tube.

    Raises
    ------
    BadInput
        Where the parts do not go together: a stone with a diameter in a ureter without one, a size
        ratio out of bounds, a tube that is too short for the stone.
    """

    model: Model = field(default_factory=SeatedBalance)
    numerics: Numerics = field(default_factory=Numerics)

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, value, kind in (
            ("model", self.model, Model),
            ("numerics", self.numerics, Numerics),
        ):
            _require_kind(name, value, kind)
        self.numerics.check(self.extent)

    def with_size_ratio(self, size_ratio: float) -> Case:
        """Return the same case with another stone of the same friction and shape.

        Raises
        ------
        BadInput
            Where an option of the model belongs to the stone that the case has.
        """
        if size_ratio != self.size_ratio:
            self.model.require_any_size()
        return super().with_size_ratio(size_ratio)


def _require_kind(name: str, value: Any, kind: Any) -> None:
    if isinstance(value, type) or not isinstance(value, kind):
        remedy = "e.g. PushThrough()" if name == "model" else ""
        raise BadInput(name, value, f"a {kind.__name__}", remedy)
