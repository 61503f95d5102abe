"""The physical problem: a stone in a ureter under a load, independent of the model."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from stonepass.errors import BadInput, require
from stonepass.model.load import Load
from stonepass.model.stone import SIZE_RATIO, Stone
from stonepass.model.ureter import BY_RATIO, Ureter
from stonepass.units import Length

__all__ = ["EXAMPLES", "Problem", "require_kind"]

Kind = TypeVar("Kind", bound="Problem")
EXAMPLES = {
    "stone": 'Stone(diameter="4.2 mm")',
    "ureter": 'Ureter(inner_diameter="3.5 mm", outer_diameter="4.54 mm")',
    "load": 'Load(confining_pressure="2 kPa")',
}


@dataclass(frozen=True)
class Problem:
    """A stone in a ureter under a load.

    Attributes
    ----------
    stone : Stone
        Size, shape and coefficient of friction of the stone.
    ureter : Ureter
        Size and material of the ureter.
    load : Load
        Confining pressure and pre-stretch; none by default.

    Raises
    ------
    BadInput
        The stone has a diameter but the ureter has none, or the size ratio is out of bounds.
    """

    stone: Stone
    ureter: Ureter
    load: Load = field(default_factory=Load)

    def __post_init__(self) -> None:
        for name, value, kind in (
            ("stone", self.stone, Stone),
            ("ureter", self.ureter, Ureter),
            ("load", self.load, Load),
        ):
            require_kind(name, value, kind, EXAMPLES[name])
        if self.stone.diameter is not None and self.ureter.inner_diameter is None:
            raise BadInput(
                "inner diameter", "missing", "given if the stone has a diameter", BY_RATIO
            )
        low, high = SIZE_RATIO
        require(
            low <= self.size_ratio <= high,
            "size ratio (stone diameter over inner diameter)",
            round(self.size_ratio, 6),
            f"{low:g} to {high:g}",
        )

    @property
    def size_ratio(self) -> float:
        """Size ratio ξ = R_s/R_a."""
        if self.stone.size_ratio is not None:
            return self.stone.size_ratio
        assert isinstance(self.stone.diameter, Length)
        assert isinstance(self.ureter.inner_diameter, Length)
        return self.stone.diameter / self.ureter.inner_diameter

    @property
    def stone_diameter(self) -> Length | None:
        """Diameter of the stone in m; None if neither stone nor ureter has a length."""
        inner = self.ureter.inner_diameter
        if self.stone.diameter is not None or inner is None:
            return self.stone.diameter
        return Length(self.size_ratio * inner)

    @property
    def extent(self) -> float:
        """Axial distance from the widest place to the farther pole, but at least R_s; in R_a."""
        return self.size_ratio * max(1.0, self.stone.shape.reach)

    @property
    def wall_ratio(self) -> float:
        """Wall ratio η = R_b/R_a."""
        return self.ureter.wall_ratio

    def with_friction(self: Kind, friction: float) -> Kind:
        """Return the same problem with another coefficient of friction."""
        return replace(self, stone=replace(self.stone, friction=friction))

    def with_size_ratio(self: Kind, size_ratio: float) -> Kind:
        """Return the same problem with a stone of another size but the same friction and shape."""
        stone = Stone(size_ratio=size_ratio, friction=self.stone.friction, shape=self.stone.shape)
        return replace(self, stone=stone)


def require_kind(name: str, value: Any, kind: Any, example: str) -> None:
    """Check the type of an argument, which is wrong e.g. if arguments are in the wrong order.

    Parameters
    ----------
    name : str
        Name of the argument in the error message.
    value : object
        The argument.
    kind : type
        The expected type.
    example : str
        Python code that creates an instance of `kind`, for the error message.

    Raises
    ------
    BadInput
        The argument is not an instance of `kind`.
    """
    if not isinstance(value, kind) or isinstance(value, type):
        raise BadInput(name, _described(value), _with_article(kind), f"write it like {example}")


def _described(value: Any) -> Any:
    if isinstance(value, type):
        return f"the class {value.__name__}"
    return value if isinstance(value, str | float | int) else _with_article(type(value))


def _with_article(kind: type) -> str:
    return f"{'an' if kind.__name__[0] in 'AEIO' else 'a'} {kind.__name__}"
