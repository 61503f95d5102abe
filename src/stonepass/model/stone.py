"""The stone: size, shape, and friction coefficient between stone and wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, declared, described, set_inputs
from stonepass.errors import BadInput, Misplaced, require
from stonepass.model.shape import ASPECT, Shape
from stonepass.units import Length, Quantity

__all__ = ["DIAMETER", "FRICTION", "SIZE_RATIO", "Stone"]

SIZE_RATIO = (0.1, 3.0)
FRICTION = (0.0, 2.0)
DIAMETER = (1e-5, 1.0)  # m


@dataclass(frozen=True, init=False)
class Stone:
    """A rigid stone: a convex body of revolution whose axis lies along the ureter.

    Either the diameter or the size ratio must be given.

    Parameters
    ----------
    diameter : str, Length or pint.Quantity, optional
        Largest diameter 2 R_s across the ureter, 0.01 mm to 1 m; text has a unit, e.g.
        ``"4.2 mm"``. The attribute is in m.
    friction : float, optional
        Coulomb coefficient μ_f between stone and wall, 0 to 2; by default 0.5, the paper's value.
    size_ratio : float, optional
        Size ratio ξ = R_s/R_a, 0.1 to 3.
    aspect : float, optional
        Length of a spheroid along the ureter divided by its diameter across it, 0.5 to 2. The
        default of 1 is a sphere.
    shape : Shape, optional
        Any other convex shape, e.g. from `read_shape` or `shape_through`. It replaces `aspect`.

    Raises
    ------
    BadInput
        The size is missing, given twice, without a unit or out of bounds, another value is out of
        bounds, or both a shape and a different aspect are given.
    """

    SECTION: ClassVar[str] = "stone"

    diameter: Length | None = declared(
        Kind.LENGTH,
        "--stone",
        "Stone diameter, the largest across the ureter, e.g. 4.2mm.",
        default=None,
        title="stone diameter",
        bounds=DIAMETER,
    )
    friction: float = declared(
        Kind.NUMBER,
        "--friction",
        "Coulomb coefficient of friction between stone and wall.",
        default=0.5,
        bounds=FRICTION,
    )
    size_ratio: float | None = declared(
        Kind.NUMBER,
        "--xi",
        "Size ratio: stone diameter over inner diameter.",
        default=None,
        bounds=SIZE_RATIO,
    )
    aspect: float = declared(
        Kind.NUMBER,
        "--aspect",
        "Length of a spheroid along the ureter over its diameter across it.",
        default=None,
        bounds=ASPECT,
        shown_default="1",
    )
    shape: Shape = declared(
        Kind.SHAPE,
        "--shape",
        "File of a convex shape: points z, rho of its meridian from pole to pole, z downstream.",
        default=None,
        shown_default="a sphere",
        metavar="FILE.csv",
    )

    def __init__(
        self,
        diameter: str | Length | Quantity | None = None,
        friction: float | None = None,
        size_ratio: float | None = None,
        aspect: float | None = None,
        shape: Shape | None = None,
    ) -> None:
        if (diameter is None) == (size_ratio is None):
            state = "missing" if diameter is None else "given twice"
            raise BadInput("size of the stone", state, "given once, as diameter or size_ratio")
        if shape is not None:
            require(isinstance(shape, Shape), "shape", shape, "a Shape, as read_shape gives it")
            if aspect is not None and aspect != shape.aspect:
                raise Misplaced("aspect", "a shape", "", "a shape has its own aspect")
        set_inputs(
            self,
            diameter=diameter,
            friction=friction,
            size_ratio=size_ratio,
            aspect=aspect if shape is None else None,
            shape=shape,
        )
        if shape is None:
            object.__setattr__(self, "shape", Shape(1.0 if aspect is None else float(aspect)))
        object.__setattr__(self, "aspect", self.shape.aspect)

    def __repr__(self) -> str:
        implied = {"shape"} if self.shape.spheroidal else {"aspect"}
        return described(self, *implied, *({"aspect"} if self.shape.spherical else ()))
