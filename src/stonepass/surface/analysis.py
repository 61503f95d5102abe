"""The inputs of the analysis of a surface, declared once for all doors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, check_inputs, declared, free_input
from stonepass.errors import require

__all__ = [
    "CRYSTAL",
    "HEIGHT_RANGE",
    "MARGIN",
    "ORDER",
    "PATHS",
    "PATH_COUNT",
    "PIXEL_SIZE",
    "Analysis",
]

PATH_COUNT = (1, 100)  # smallest and largest number of paths
# Margin at each end in which the slope is not evaluated, in units of the shortest wavelength.
MARGIN = 0.5
ORDER = (1, 200)  # smallest and largest order of a baseline
RICHER = 2  # default ratio of the orders of the second and the first baseline
PIXEL_SIZE = free_input(
    "pixel",
    Kind.LENGTH,
    "--pixel",
    "Size of a pixel of a picture, instead of that in the file, e.g. 0.5um.",
)
HEIGHT_RANGE = free_input(
    "height_range",
    Kind.LENGTH,
    "--height-range",
    "Difference in height from black to white, e.g. 35um.",
    title="height range",
    bounds=(1e-9, 1e-2),
)
CRYSTAL = free_input(
    "crystal",
    Kind.LENGTH,
    "--crystal",
    "Edge of the cubic crystals on the surface; the height range is then sqrt(3) times the edge.",
    bounds=(1e-9, 5e-3),
)
PATHS = free_input(
    "paths",
    Kind.WHOLE,
    "--paths",
    "Number of horizontal profiles, evenly spaced.",
    default=6,
    bounds=PATH_COUNT,
)


@dataclass(frozen=True)
class Analysis:
    """Choices of the analysis of profiles.

    Parameters
    ----------
    baseline_order : int
        Order N of the first baseline, 1 to 200. It follows waves of the length 2L/N and longer.
    deviation_order : int, optional
        Order of the second baseline, larger than the first; by default twice the first. With equal
        orders the second baseline would be zero, since a least-squares residual is orthogonal to
        its basis.
    level : bool
        True if the least-squares plane of the area is subtracted first, which removes the tilt of
        the specimen.
    margin : float
        Margin at the ends of the paths in which slopes are not evaluated, in units of the shortest
        wavelength of each baseline, 0 to 2. The margin is a quarter of the path at most.

    Raises
    ------
    BadInput
        A value is out of bounds, or the second order is not larger than the first.
    """

    SECTION: ClassVar[str] = ""

    baseline_order: int = declared(
        Kind.WHOLE,
        "--baseline-order",
        "Number of half waves in the baseline of the mean profile.",
        default=8,
        title="order of the baseline",
        bounds=ORDER,
    )
    deviation_order: int | None = declared(
        Kind.WHOLE,
        "--deviation-order",
        "Number of half waves in the baseline of the deviations from it.",
        default=None,
        title="order of the deviation's baseline",
        bounds=ORDER,
        shown_default="twice --baseline-order",
    )
    level: bool = declared(
        Kind.FLAG,
        "--level",
        "Subtract the least-squares plane first, which removes the tilt of the specimen.",
        default=False,
    )
    margin: float = declared(
        Kind.NUMBER,
        "--margin",
        "Length at both ends of a profile that is left out when the steepest slope is sought, in "
        "shortest waves of the baseline.",
        default=MARGIN,
        bounds=(0.0, 2.0),
        metavar="WAVES",
    )

    def __post_init__(self) -> None:
        check_inputs(self)
        first, second = self.baseline_order, self.second_order
        allowed = f"larger than the order of the first baseline, {first}"
        why = "with equal orders the baseline of the deviation would be zero"
        require(second > first, "order of the deviation's baseline", second, allowed, why)

    @property
    def second_order(self) -> int:
        """Order of the second baseline."""
        if self.deviation_order is not None:
            return self.deviation_order
        return min(RICHER * self.baseline_order, ORDER[1])
