"""How every figure looks: fonts, colours, saving."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.io.text_file import write_file
from stonepass.units import PASCAL_PER

__all__ = ["COLOURS", "add_mmhg_axis", "in_style", "new_figure", "save", "tidy"]

P = ParamSpec("P")
R = TypeVar("R")

# Distinguishable with colour blindness and in grey (Okabe–Ito).
COLOURS = {
    "blue": "#0072B2",
    "orange": "#D55E00",
    "green": "#009E73",
    "pink": "#CC79A7",
    "grey": "#6B7280",
    "ink": "#1F2937",
    "stone": "#D6CFC4",
}
FORMATS = ("svg", "png", "pdf")

_STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
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
    """Let a function that makes or draws figures do so in this style.

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
    """Leave only the left and bottom frame, and a light grid."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25, linewidth=0.6)
    axes.set_axisbelow(True)


def add_mmhg_axis(axes: Axes) -> None:
    """Put a scale in mmHg on the right of axes in kPa."""
    factor = PASCAL_PER["kPa"] / PASCAL_PER["mmHg"]

    def to_mmhg(kilopascals: Any) -> Any:
        return kilopascals * factor

    def to_kpa(mmhg: Any) -> Any:
        return mmhg / factor

    right = axes.secondary_yaxis("right", functions=(to_mmhg, to_kpa))
    right.set_ylabel("mmHg")


def angle_label(*, sphere: bool) -> str:
    """Label of an axis of θ, which is parametric for a stone that is no sphere."""
    return "θ from the upstream axis (°)" if sphere else "parametric angle θ, from upstream (°)"


@in_style
def save(figure: Figure, path: Path) -> None:
    """Write the figure; the ending of `path` says which format, the same bytes every time."""
    ending = path.suffix.lower().lstrip(".")
    if ending not in FORMATS:
        raise BadInput("figure", str(path), "a file name ending in ." + ", .".join(FORMATS))
    metadata: dict[str, Any] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(
        ending, {}
    )
    drawn = io.BytesIO()
    figure.savefig(drawn, format=ending, dpi=200, metadata=metadata)
    write_file(path, drawn.getvalue(), "figure")
