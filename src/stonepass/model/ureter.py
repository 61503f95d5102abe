"""The ureter: a uniform tube without load."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, declared, set_inputs
from stonepass.errors import BadInput, Misplaced, require
from stonepass.materials.catalogue import material as catalogued
from stonepass.materials.protocol import Material, names_a_file
from stonepass.model.stone import DIAMETER
from stonepass.units import Length, format_length

__all__ = ["BY_RATIO", "WALL_RATIO", "Ureter"]

WALL_RATIO = (1.02, 10.0)
BY_RATIO = "give both diameters, or the ratio alone"


@dataclass(frozen=True, init=False)
class Ureter:
    """A uniform tube without load, by its diameters or by its wall ratio η = R_b/R_a.

    Parameters
    ----------
    inner_diameter, outer_diameter : str or Length, optional
        Text with a unit, e.g. ``"3.5 mm"``; in metres once read.
    material : str or Material
        Catalogue name (human wall by default) or a `Material`; `load_material` reads one from a
        file.
    wall_ratio : float, optional
        η, where no lengths are known (also beside `inner_diameter` alone); 1.02 to 10.
    """

    SECTION: ClassVar[str] = "ureter"

    inner_diameter: Length | None = declared(
        Kind.LENGTH,
        "--inner",
        "Inner diameter of the ureter.",
        default=None,
        title="inner diameter",
        bounds=DIAMETER,
        metavar="LENGTH",
    )
    outer_diameter: Length | None = declared(
        Kind.LENGTH,
        "--outer",
        "Outer diameter of the ureter.",
        default=None,
        title="outer diameter",
        bounds=DIAMETER,
        metavar="LENGTH",
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

    def __init__(
        self,
        inner_diameter: str | Length | None = None,
        outer_diameter: str | Length | None = None,
        material: str | Material | None = None,
        wall_ratio: float | None = None,
    ) -> None:
        if outer_diameter is not None and inner_diameter is None:
            raise BadInput("inner diameter", "missing", "given with the outer one", BY_RATIO)
        if outer_diameter is None and wall_ratio is None:
            what = "size of the ureter" if inner_diameter is None else "outer diameter"
            raise BadInput(what, "missing", "given", BY_RATIO)
        set_inputs(
            self,
            inner_diameter=inner_diameter,
            outer_diameter=outer_diameter,
            material=material,
            wall_ratio=wall_ratio if outer_diameter is None else None,
        )
        object.__setattr__(self, "material", _material(self.material))
        if self.inner_diameter is not None and self.outer_diameter is not None:
            ratio = _ratio(self.inner_diameter, self.outer_diameter)
            if wall_ratio is not None and not abs(wall_ratio - ratio) <= 1e-9 * ratio:
                raise Misplaced("wall_ratio", "both diameters", "", f"they give {ratio:.6g}")
            object.__setattr__(self, "wall_ratio", ratio)


def _ratio(inner: Length, outer: Length) -> float:
    allowed = f"larger than the inner diameter, {format_length(inner)}"
    require(outer > inner, "outer diameter", format_length(outer), allowed)
    low, high = WALL_RATIO
    ratio = outer / inner
    require(low <= ratio <= high, "wall_ratio", ratio, f"a number from {low:g} to {high:g}")
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
