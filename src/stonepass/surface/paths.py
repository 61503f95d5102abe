"""Straight paths across a picture, and the profiles along them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float, Num
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.surface.analysis import PATH_COUNT
from stonepass.surface.gaps import MISSING, bridge, bridgeable, gap_length, known_area
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["Profiles", "StraightPath", "evenly_spaced", "profiles_along", "read_path", "rows_moved"]

UNEVEN = 0.01  # relative difference of the lengths of paths above which a warning is given
# A point within this distance, in pixels, of the centre of a pixel takes the value of this pixel.
SNAP = 1e-9
MICRO = 1e6  # µm per m


@dataclass(frozen=True)
class StraightPath:
    """A straight line from (x0, y0) to (x1, y1) in pixels.

    Attributes
    ----------
    x0, x1 : float
        Columns of the start and the end, counted to the right in pixels.
    y0, y1 : float
        Rows of the start and the end, counted downwards in pixels. (0, 0) is the centre of the
        first pixel.
    """

    x0: float
    y0: float
    x1: float
    y1: float

    def length(self, pixel: tuple[float, float]) -> float:
        """Return the length in m; `pixel` is the width and the height of a pixel in m."""
        return math.hypot((self.x1 - self.x0) * pixel[0], (self.y1 - self.y0) * pixel[1])

    def part(self, begin: float, end: float) -> StraightPath:
        """Return a part of the path.

        Parameters
        ----------
        begin, end : float
            Start and end of the part as fractions of the length of the path, 0 to 1.
        """
        x, y = self.x1 - self.x0, self.y1 - self.y0
        return StraightPath(
            self.x0 + begin * x, self.y0 + begin * y, self.x0 + end * x, self.y0 + end * y
        )


@array_dataclass
@dataclass(frozen=True)
class Profiles:
    """Values of a picture along several paths, at n equal distances from their starts.

    Attributes
    ----------
    distance : array (n)
        Distance from the start of a path in m.
    values : array (paths, n)
        Grey levels, or heights in m.
    columns, rows : array (paths, n)
        Coordinates of the samples in the picture, in pixels.
    known : array (paths, n) of bool
        False where a gap in a height map was bridged, otherwise True.
    warnings : tuple of Caution
        Warnings about paths of different lengths and about bridged gaps.

    References
    ----------
    docs/friction.md, "What is done".
    """

    distance: Float[np.ndarray, " n"]
    values: Float[np.ndarray, "paths n"]
    columns: Float[np.ndarray, "paths n"]
    rows: Float[np.ndarray, "paths n"]
    known: Bool[np.ndarray, "paths n"]
    warnings: tuple[Caution, ...] = ()


def read_path(text: str, name: str = "path") -> StraightPath:
    """Read a path from a text such as ``10,40,500,40``: x0, y0, x1, y1 in pixels.

    Parameters
    ----------
    text : str
    name : str
        Name of the input in messages.

    Raises
    ------
    BadInput
        The text is not four numbers.
    """
    parts = text.split(",")
    try:
        numbers = [float(part) for part in parts]
    except ValueError:
        numbers = []
    if len(numbers) != 4 or not all(math.isfinite(number) for number in numbers):
        raise BadInput(name, text, "four numbers x0,y0,x1,y1 in pixels")
    return StraightPath(*numbers)


def evenly_spaced(
    picture: SurfaceImage, count: int, longest_gap: float = 0.0
) -> list[StraightPath]:
    """Return evenly spaced horizontal paths across the whole area of a picture.

    In a height map a row whose gaps cannot be bridged (see `profiles_along`) is replaced by the
    nearest row whose gaps can. Each row is used once.

    Parameters
    ----------
    picture : SurfaceImage
        Grey levels or heights.
    count : int
        Number of paths, 1 to 100 and at most the number of rows.
    longest_gap : float
        Longest gap that is bridged, as a fraction of the length of the path.

    Raises
    ------
    BadInput
        The count is out of bounds, or a height map has too few rows whose gaps can be bridged. If
        an area without the border of the map would help, the message names it.

    References
    ----------
    docs/friction.md, "What is done".
    """
    low, high = PATH_COUNT
    area = picture.area
    height = area.bottom - area.top
    high = min(high, height)
    require(low <= count <= high, "paths", count, f"a whole number from {low} to {high}")
    rows = _even_rows(area, count)
    if picture.has_heights:
        found = _complete_rows(picture, area, rows, longest_gap)
        if found is None:
            raise _too_many_gaps(picture, count, longest_gap)
        rows = found
    return [StraightPath(area.left, row, area.right - 1.0, row) for row in rows]


def rows_moved(area: PixelArea, paths: Sequence[StraightPath]) -> int:
    """Return how many paths of `evenly_spaced` were moved to other rows because of gaps.

    Parameters
    ----------
    area : PixelArea
        Area that the paths cross, in pixels.
    paths : sequence of StraightPath
        The paths that `evenly_spaced` returned for it.
    """
    rows = _even_rows(area, len(paths))
    return sum(path.y0 != row for path, row in zip(paths, rows, strict=True))


def _even_rows(area: PixelArea, count: int) -> list[int]:
    height = area.bottom - area.top
    return [area.top + round(height * (k + 0.5) / count - 0.5) for k in range(count)]


def _complete_rows(
    picture: SurfaceImage, area: PixelArea, wanted: Sequence[int], longest_gap: float
) -> list[int] | None:
    """Return for each wanted row the nearest row with bridgeable gaps; None without enough rows."""
    part = picture.values[:, area.left : area.right]
    longest = longest_gap * (area.right - area.left)
    good: dict[int, bool] = {}
    found: list[int] = []
    for row in wanted:
        for near in sorted(range(area.top, area.bottom), key=lambda each: abs(each - row)):
            if near not in good:
                good[near] = bridgeable(np.isfinite(part[near]), longest)
            if good[near] and near not in found:
                found.append(near)
                break
        else:
            return None
    return sorted(found)


def _too_many_gaps(picture: SurfaceImage, count: int, longest_gap: float) -> BadInput:
    """Return the error for a height map with too many gaps; it suggests a smaller area."""
    missing = float(np.mean(~np.isfinite(picture.surface)))
    width = picture.area.right - picture.area.left
    allowed = (
        f"such that {count} rows have heights at both ends, gaps of at most "
        f"{int(longest_gap * width)} pixels between, and at most {MISSING:.0%} missing"
    )
    remedy = "give paths that avoid the gaps with --path"
    part = known_area(picture.values, picture.area)
    helps = (
        part is not None
        and part != picture.area
        and part.bottom - part.top >= count
        and _complete_rows(picture, part, _even_rows(part, count), longest_gap) is not None
    )
    if part is not None and helps:
        remedy = f"leave out the border, where heights are missing, with {part.option}"
    shown = f"without a height at {missing:.1%} of its points"
    return BadInput("height map", shown, allowed, remedy)


def profiles_along(
    picture: SurfaceImage, paths: Sequence[StraightPath], longest_gap: float = 0.0
) -> Profiles:
    """Sample a picture along paths by bilinear interpolation, about one sample per pixel.

    Paths longer than the shortest one are cut to its length, so that the profiles can be averaged.
    Gaps in a height map are bridged by straight lines, with a warning.

    Parameters
    ----------
    picture : SurfaceImage
        Grey levels or heights; its pixel size must be known.
    paths : sequence of StraightPath
        1 to 100 paths in pixels.
    longest_gap : float
        Longest gap that is bridged, as a fraction of the length of the path. By default no gap is
        bridged.

    Raises
    ------
    BadInput
        The pixel size is unknown, the number of paths is out of bounds, or a path leaves the area
        of the picture, is shorter than two pixels, has no height at one of its ends, or crosses a
        gap that is too long.

    References
    ----------
    docs/friction.md, "What is done".
    """
    pixel = picture.pixel
    if pixel is None:
        remedy = picture.pixel_hint or "the file does not contain it"
        raise BadInput("pixel size", "missing", "given as --pixel", remedy)
    low, high = PATH_COUNT
    require(low <= len(paths) <= high, "number of paths", len(paths), f"from {low} to {high}")
    for path in paths:
        _check(picture, path)
    lengths = np.array([path.length(pixel) for path in paths])
    across = min(math.hypot(path.x1 - path.x0, path.y1 - path.y0) for path in paths)
    distance = np.linspace(0.0, lengths.min(), 1 + math.floor(across + 1e-9))
    share = distance / lengths[:, None]
    ends = np.array([[path.x0, path.y0, path.x1, path.y1] for path in paths])[:, :, None]
    columns = ends[:, 0] + share * (ends[:, 2] - ends[:, 0])
    rows = ends[:, 1] + share * (ends[:, 3] - ends[:, 1])
    values = _bilinear(picture.values, columns, rows)
    known = np.isfinite(values)
    told = []
    if lengths.max() > (1.0 + UNEVEN) * lengths.min():
        told.append(caution("uneven_paths", ratio=float(lengths.max() / lengths.min())))
    if not known.all():
        for path, each in zip(paths, known, strict=True):
            _check_gaps(path, each, longest_gap)
        values = np.array([bridge(*pair) for pair in zip(values, known, strict=True)])
        length_um = max(map(gap_length, known)) * float(distance[1]) * MICRO
        told.append(caution("gaps_bridged", fraction=float(np.mean(~known)), length_um=length_um))
    return Profiles(distance, values, columns, rows, known, tuple(told))


def _bilinear(
    values: Num[np.ndarray, "rows columns"],
    columns: Float[np.ndarray, "paths n"],
    rows: Float[np.ndarray, "paths n"],
) -> Float[np.ndarray, "paths n"]:
    """Interpolate between the four pixels around each point.

    Pixels with the weight zero are left out, so that a missing height (NaN) there has no effect.
    """
    found = np.zeros(columns.shape)
    left, right, to_right = _neighbours(columns, values.shape[1])
    top, bottom, to_bottom = _neighbours(rows, values.shape[0])
    for row, down in ((top, 1.0 - to_bottom), (bottom, to_bottom)):
        for column, across in ((left, 1.0 - to_right), (right, to_right)):
            weight = down * across
            found += weight * np.where(weight > 0.0, values[row, column], 0.0)
    return found


def _neighbours(
    places: Float[np.ndarray, "paths n"], count: int
) -> tuple[Num[np.ndarray, "paths n"], Num[np.ndarray, "paths n"], Float[np.ndarray, "paths n"]]:
    """Return the pixels before and after each point, and the weight of the pixel after it."""
    nearest = np.round(places)
    places = np.where(np.abs(places - nearest) < SNAP, nearest, places)
    before = np.clip(np.floor(places), 0, count - 1).astype(int)
    return before, np.minimum(before + 1, count - 1), places - before


def _check_gaps(path: StraightPath, known: Bool[np.ndarray, " n"], longest_gap: float) -> None:
    """Refuse a path with gaps that cannot be bridged."""
    steps = len(known) - 1
    if bridgeable(known, longest_gap * len(known)):
        return
    where = np.flatnonzero(known)
    if len(where) > 2 and not (known[0] and known[-1]):
        part = _shown(path.part(where[0] / steps, where[-1] / steps))
        raise BadInput("path", _shown(path), "one with measured heights at both ends",
                       f"shorten it to {part}")  # fmt: skip
    longest = int(longest_gap * len(known))
    more = f" longer than {longest} pixels" if longest else ""
    raise BadInput("path", _shown(path), f"one without gaps{more} in the height map",
                   "choose other paths")  # fmt: skip


def _check(picture: SurfaceImage, path: StraightPath) -> None:
    area = picture.area
    for x, y in ((path.x0, path.y0), (path.x1, path.y1)):
        if not (area.left <= x <= area.right - 1 and area.top <= y <= area.bottom - 1):
            allowed = (
                f"within columns {area.left} to {area.right - 1} and rows {area.top} to "
                f"{area.bottom - 1}"
            )
            raise BadInput("path", _shown(path), allowed)
    if math.hypot(path.x1 - path.x0, path.y1 - path.y0) < 2.0:
        raise BadInput("path", _shown(path), "at least two pixels long")


def _shown(path: StraightPath) -> str:
    return f"{path.x0:g},{path.y0:g},{path.x1:g},{path.y1:g}"
