"""The ureter: material and size of a uniform tube in its unloaded state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, declared, described, set_inputs
from stonepass.errors import BadInput, Misplaced, require
from stonepass.materials.catalogue import material as catalogued
from stonepass.materials.protocol import Material, names_a_file
from stonepass.model.stone import DIAMETER
from stonepass.units import Length, Quantity, format_length

__all__ = ["BY_RATIO", "WALL_RATIO", "Ureter"]

WALL_RATIO = (1.02, 10.0)
ROUNDING = 1e-9  # relative distance outside these bounds that a rounded quotient may have
CONSISTENT = 1e-9  # largest relative difference of two values of one length or ratio
BY_RATIO = "give the inner diameter with the outer one or the wall thickness, or the ratio alone"


@dataclass(frozen=True, init=False)
class Ureter:
    """A uniform tube in its unloaded state, described by lengths or by its wall ratio η = R_b/R_a.

    Text of a length has a unit; the attributes of all lengths are in m.

    Parameters
    ----------
    inner_diameter : str, Length or pint.Quantity, optional
        Inner diameter 2 R_a, 0.01 mm to 1 m, e.g. ``"3.5 mm"``.
    outer_diameter : str, Length or pint.Quantity, optional
        Outer diameter 2 R_b, 0.01 mm to 1 m.
    material : str or Material, optional
        Name in the catalogue, or a `Material`, which `load_material` can read from a file. The
        default, ``"ureter"``, is the wall of the human ureter.
    wall_ratio : float, optional
        Wall ratio η, 1.02 to 10; required unless the outer diameter or the wall thickness is given.
    wall_thickness : str, Length or pint.Quantity, optional
        Wall thickness R_b − R_a, e.g. ``"0.52 mm"``, instead of `outer_diameter`.

    Raises
    ------
    BadInput
        A size is missing, has no unit or is out of bounds, two sizes contradict each other, or the
        material is unknown.

    Notes
    -----
    Sizes that follow from the given ones are attributes too, so that `dataclasses.replace` passes
    them on and they contradict a new size. Set them to None, as in the second example.

    Examples
    --------
    >>> import stonepass as sp
    >>> sp.Ureter("3.5 mm", wall_thickness="0.52 mm") == sp.Ureter("3.5 mm", "4.54 mm")
    True
    >>> from dataclasses import replace
    >>> ureter = sp.Ureter("3.5 mm", "4.54 mm")
    >>> replace(ureter, outer_diameter="5 mm", wall_thickness=None, wall_ratio=None)
    Ureter(inner_diameter='3.5 mm', outer_diameter='5 mm', material='ureter')
    """

    SECTION: ClassVar[str] = "ureter"

    inner_diameter: Length | None = declared(
        Kind.LENGTH,
        "--inner",
        "Inner diameter of the ureter.",
        default=None,
        title="inner diameter",
        bounds=DIAMETER,
    )
    outer_diameter: Length | None = declared(
        Kind.LENGTH,
        "--outer",
        "Outer diameter of the ureter.",
        default=None,
        title="outer diameter",
        bounds=DIAMETER,
    )
    material: Material = declared(
        Kind.MATERIAL,
        "--material",
        "Wall: catalogue name, law.toml or file.py:function.",
        default="ureter",
        metavar="NAME|FILE",
    )
    wall_ratio: float = declared(
        Kind.NUMBER,
        "--eta",
        "Wall ratio: outer diameter over inner diameter.",
        default=None,
        bounds=WALL_RATIO,
    )

    wall_thickness: Length | None = declared(
        Kind.LENGTH,
        "--wall-thickness",
        "Wall thickness, in place of the outer diameter.",
        default=None,
        title="wall thickness",
        bounds=DIAMETER,
    )

    def __init__(
        self,
        inner_diameter: str | Length | Quantity | None = None,
        outer_diameter: str | Length | Quantity | None = None,
        material: str | Material | None = None,
        wall_ratio: float | None = None,
        wall_thickness: str | Length | Quantity | None = None,
    ) -> None:
        thick = wall_thickness is not None
        if inner_diameter is None and (thick or outer_diameter is not None):
            beside = "the wall thickness" if thick else "the outer one"
            raise BadInput("inner diameter", "missing", f"given with {beside}", BY_RATIO)
        if outer_diameter is None and wall_ratio is None and not thick:
            what = "size of the ureter" if inner_diameter is None else "outer diameter"
            raise BadInput(what, "missing", "given", BY_RATIO)
        by_length = outer_diameter is not None or thick
        set_inputs(
            self,
            inner_diameter=inner_diameter,
            outer_diameter=outer_diameter,
            material=material,
            wall_ratio=None if by_length else wall_ratio,
            wall_thickness=wall_thickness,
        )
        object.__setattr__(self, "material", _material(self.material))
        if self.inner_diameter is not None:
            self._complete(self.inner_diameter, wall_ratio)

    def __repr__(self) -> str:
        implied = () if self.outer_diameter is None else ("wall_ratio",)
        return described(self, "wall_thickness", *implied)

    def _complete(self, inner: Length, wall_ratio: float | None) -> None:
        """Derive the lengths that were not given, and refuse those that contradict each other."""
        outer, thickness = self.outer_diameter, self.wall_thickness
        if thickness is not None:
            derived = Length(f"{inner + 2.0 * thickness:.15g}")
            if outer is not None and not abs(outer - derived) <= CONSISTENT * outer:
                remedy = f"the diameters give {format_length((outer - inner) / 2.0)}"
                raise Misplaced("wall thickness", "both diameters", "", remedy)
            outer = derived if outer is None else outer
        if outer is None:
            return
        ratio = _ratio(inner, outer)
        if wall_ratio is not None and not abs(wall_ratio - ratio) <= CONSISTENT * ratio:
            raise Misplaced("wall_ratio", "both diameters", "", f"they give {ratio:.6g}")
        object.__setattr__(self, "outer_diameter", outer)
        object.__setattr__(self, "wall_ratio", ratio)
        object.__setattr__(self, "wall_thickness", Length(f"{(outer - inner) / 2.0:.15g}"))


def _ratio(inner: Length, outer: Length) -> float:
    allowed = f"larger than the inner diameter, {format_length(inner)}"
    require(outer > inner, "outer diameter", format_length(outer), allowed)
    low, high = WALL_RATIO
    ratio = outer / inner
    inside = low * (1.0 - ROUNDING) <= ratio <= high * (1.0 + ROUNDING)
    require(inside, "wall_ratio", ratio, f"a number from {low:g} to {high:g}")
    return ratio


def _material(value: str | Material) -> Material:
    if isinstance(value, Material):
        return value
    if not isinstance(value, str):
        raise BadInput("material", value, "a name of the catalogue or a Material")
    if names_a_file(value):
        raise BadInput("material", value, "a name of the catalogue or a Material",
                       "read the file first, with stonepass.load_material")  # fmt: skip
    return catalogued(value)
