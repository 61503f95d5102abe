"""The style of all figures: fonts, colours, line styles, axes, saving."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.io.text_file import write_file
from stonepass.units import PASCAL_PER

__all__ = [
    "COLOURS",
    "SERIES",
    "add_heading",
    "add_mmhg_axis",
    "in_style",
    "mark_unanswered",
    "new_figure",
    "ordered_colours",
    "save",
    "series",
    "signed",
    "tidy",
]

P = ParamSpec("P")
R = TypeVar("R")

# Colours after Okabe and Ito. A test measures their distances for deuteranopia and protanopia.
COLOURS = {
    "blue": "#0072B2",
    "orange": "#D55E00",
    "green": "#009E73",
    "pink": "#CC79A7",
    "grey": "#6B7280",
    "ink": "#1F2937",
    "stone": "#D6CFC4",
}
# Colour, line style and marker of each curve of a figure; curves differ in more than their colour.
SERIES: tuple[tuple[str, Any, str], ...] = (
    ("blue", "-", "o"),
    ("orange", "--", "s"),
    ("green", "-.", "^"),
    ("ink", ":", "D"),
    ("pink", (0, (6, 1, 1, 1, 1, 1)), "v"),
)
FORMATS = ("svg", "png", "pdf")
LETTERS_PER_INCH = 12.5  # characters of the heading per inch of the figure

_STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "figure.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "axes.labelcolor": COLOURS["ink"],
    "axes.edgecolor": COLOURS["grey"],
    "xtick.color": COLOURS["ink"],
    "ytick.color": COLOURS["ink"],
    "text.color": COLOURS["ink"],
    "legend.frameon": False,
    "svg.hashsalt": "stonepass",
    "svg.fonttype": "path",
}


def in_style(function: Callable[P, R]) -> Callable[P, R]:
    """Return the function so that it makes or draws figures in this style.

    The user's own settings of matplotlib are neither used nor changed.
    """

    @wraps(function)
    def styled(*arguments: P.args, **keywords: P.kwargs) -> R:
        with mpl.rc_context(_STYLE):
            return function(*arguments, **keywords)

    return styled


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure, sizes in inches, that lays itself out."""
    return Figure(figsize=(width, height), layout="constrained")


def tidy(axes: Axes) -> None:
    """Remove the top and right frame, and draw a light grid."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25, linewidth=0.6)
    axes.set_axisbelow(True)


def series(k: int, *, marker: bool = True) -> dict[str, Any]:
    """Return colour, line style and, if wanted, marker of the curve number `k` of a figure."""
    colour, line, mark = SERIES[k % len(SERIES)]
    look = {"color": COLOURS[colour], "linestyle": line}
    return look | {"marker": mark} if marker else look


def ordered_colours(count: int) -> list[Any]:
    """Return `count` colours for the values of an ordered parameter, from dark to light."""
    return list(colormaps["viridis"](np.linspace(0.0, 0.85, count)))


def add_heading(figure: Figure, text: str) -> None:
    """Write the case that the figure shows above all panels; long text is wrapped."""
    lines = textwrap.fill(text, round(LETTERS_PER_INCH * figure.get_figwidth()))
    figure.suptitle(lines, x=0.01, ha="left")


def add_mmhg_axis(axes: Axes) -> None:
    """Add an axis in mmHg on the right of axes whose vertical axis is in kPa."""
    factor = PASCAL_PER["kPa"] / PASCAL_PER["mmHg"]

    def to_mmhg(kilopascals: Any) -> Any:
        return kilopascals * factor

    def to_kpa(mmhg: Any) -> Any:
        return mmhg / factor

    right = axes.secondary_yaxis("right", functions=(to_mmhg, to_kpa))
    right.set_ylabel("pressure (mmHg)")


def mark_unanswered(axes: Axes, at: Sequence[float], why: str, colour: str) -> None:
    """Mark abscissas without an answer by crosses at the top of the axes.

    Parameters
    ----------
    axes : Axes
    at : sequence of float
        Abscissas; nothing is drawn for an empty sequence.
    why : str
        Entry of the legend.
    colour : str
        Any colour of matplotlib.
    """
    if at:
        heights = np.full(len(at), 0.985)
        axes.plot(at, heights, "x", color=colour, markersize=5, label=why, clip_on=False,
                  transform=axes.get_xaxis_transform())  # fmt: skip


def angle_label(*, sphere: bool, name: str = "θ") -> str:
    """Return the label of an axis of θ, which is a parameter if the stone is not a sphere."""
    kind = "angle" if sphere else "parametric angle"
    return f"{kind} {name} from the upstream axis (°)"


def signed(value: float, digits: int) -> str:
    """Return a number with its sign, with a minus sign instead of a hyphen."""
    return f"{value:+.{digits}f}".replace("-", "−")


@in_style
def save(figure: Figure, path: Path) -> None:
    """Write the figure in the format of the ending of `path`; the bytes are reproducible."""
    ending = path.suffix.lower().lstrip(".")
    if ending not in FORMATS:
        raise BadInput("figure", str(path), "a file name ending in ." + ", .".join(FORMATS))
    metadata: dict[str, Any] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(
        ending, {}
    )
    drawn = io.BytesIO()
    figure.savefig(drawn, format=ending, dpi=200, metadata=metadata)
    write_file(path, drawn.getvalue(), "figure")
