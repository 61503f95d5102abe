"""The height range of a grey picture: given, or from the edge of cubic crystals."""

from __future__ import annotations

from math import sqrt

from stonepass.declaration import read_declared
from stonepass.errors import BadInput
from stonepass.surface.analysis import CRYSTAL, HEIGHT_RANGE
from stonepass.surface.surface_image import SurfaceImage
from stonepass.units import Length, Quantity

__all__ = ["CRYSTAL_DIAGONAL", "crystal_height", "height_scale"]

# Height range of a cubic crystal that stands on a corner, divided by its edge: its space diagonal.
CRYSTAL_DIAGONAL = sqrt(3.0)


def crystal_height(edge: str | Length | Quantity, argument: str = "crystal") -> Length:
    """Return the height range of a surface of cubic crystals that stand on a corner.

    Parameters
    ----------
    edge : str, Length or pint.Quantity
        Edge of the crystals, 1 nm to 5 mm.
    argument : str
        How the caller names the edge in an error message.

    Raises
    ------
    BadInput
        The edge has no unit or is out of bounds.
    """
    return Length(CRYSTAL_DIAGONAL * read_declared(CRYSTAL.declaration, argument, edge))


def height_scale(
    picture: SurfaceImage, height_range: str | Length | Quantity | None
) -> float | None:
    """Return the height in m from the darkest to the brightest grey level; None for heights.

    Parameters
    ----------
    picture : SurfaceImage
    height_range : str, Length, pint.Quantity or None
        Height range, 1 nm to 10 mm.

    Raises
    ------
    BadInput
        The height range of a grey picture is missing, has no unit or is out of bounds; or there is
        one for a height map.
    """
    if picture.has_heights:
        if height_range is not None:
            raise BadInput(
                "height range", str(height_range), "left out", "a height map has its own"
            )
        return None
    if height_range is None:
        raise BadInput(
            "height range", "missing", "given for a grey picture, as --height-range or --crystal"
        )
    return float(read_declared(HEIGHT_RANGE.declaration, "height range", height_range))
