"""A case: a physical problem, the model that solves it, and the numerics."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from stonepass.model.answer import Model
from stonepass.model.load import Load
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.registry import MODELS
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem, require_kind
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

__all__ = ["Case", "Load", "Stone", "Ureter"]


@dataclass(frozen=True)
class Case(Problem):
    """A stone in a ureter under a load, with the model and its numerics.

    A case contains everything that an answer depends on.

    Parameters
    ----------
    stone : Stone
        Size, shape and friction coefficient of the stone. The size is a diameter or a size ratio.
    ureter : Ureter
        Size and material of the ureter. The size is two diameters, or a wall ratio.
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    model : Model, optional
        `SeatedBalance` (the paper's model, the default), `PushThrough` or `ElasticFoundation`, each
        with its own options.
    numerics : Numerics, optional
        Accuracy of the solution and length of the tube.

    Raises
    ------
    BadInput
        The stone has a diameter but the ureter has none, the size ratio is out of bounds, the tube
        is too short for the stone, or an argument has the wrong type.

    Examples
    --------
    >>> import stonepass as sp
    >>> case = sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", "4.54 mm"))
    >>> round(case.size_ratio, 3), round(case.wall_ratio, 3)
    (1.2, 1.297)
    """

    model: Model = field(default_factory=SeatedBalance)
    numerics: Numerics = field(default_factory=Numerics)

    def __repr__(self) -> str:
        parts = (self.stone, self.ureter, self.load, self.model, self.numerics)
        return f"Case({', '.join(map(repr, parts))})"

    def __post_init__(self) -> None:
        super().__post_init__()
        require_kind("model", self.model, Model, _model_example(self.model))
        require_kind("numerics", self.numerics, Numerics, 'Numerics("fast")')
        self.numerics.check(self.extent)

    def with_size_ratio(self, size_ratio: float) -> Case:
        """Return the same case with a stone of another size but the same friction and shape.

        Parameters
        ----------
        size_ratio : float
            Size ratio ξ of the new stone, 0.1 to 3.

        Raises
        ------
        BadInput
            The size ratio is out of bounds, or an option of the model, such as an opening curve, is
            valid for the original stone only.
        """
        if size_ratio != self.size_ratio:
            self.model.require_any_size()
        return super().with_size_ratio(size_ratio)


def _model_example(given: Any) -> str:
    """Return Python code that makes the model of this name, as an example for an error message.

    If `given` is not the name of a model, the example is the direct model.
    """
    named = MODELS.get(given, PushThrough) if isinstance(given, str) else PushThrough
    return f"{named.__name__}()"
