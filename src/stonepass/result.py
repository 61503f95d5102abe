"""The base class of results, which can be printed, converted, plotted and saved.

Tables, pictures and records are made by layers above this module. The package registers the
functions that make them once, with `present_with`; they are loaded when they are first needed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

from stonepass.errors import BadInput, StonepassError

__all__ = ["Presentation", "Result", "present_with"]


class Presentation(Protocol):
    """The functions that show a result, each chosen by the type of the result."""

    def record(self, result: Any) -> dict[str, Any]:
        """Return a JSON-ready dictionary."""

    def rows(self, result: Any) -> list[dict[str, Any]]:
        """Return the rows of a table with one scalar in each cell."""

    def text(self, result: Any) -> str:
        """Return the tables and sentences of a terminal."""

    def html(self, result: Any) -> str:
        """Return the tables and sentences of a notebook."""

    def plot(self, result: Any, axes: Any) -> None:
        """Draw the main graph on axes of matplotlib."""

    def figure(self, result: Any) -> Any:
        """Return the whole picture as a figure of matplotlib."""

    def save(self, result: Any, path: Path) -> None:
        """Write the result in the format that the ending of the file names."""


_loader: Callable[[], Presentation] | None = None


def present_with(loader: Callable[[], Presentation]) -> None:
    """Register the presentation of results; `loader` is called when a result is first shown."""
    global _loader
    _loader = loader


def _presentation() -> Presentation:
    if _loader is None:
        raise RuntimeError("no presentation of results was registered")
    return _loader()


class Result:
    """The base class of results, with a short description, tables, plots and plain values.

    A subclass is a frozen dataclass with ``repr=False``. It says in `summary` what its short
    description contains, and registers its table, record and pictures in `report.presentation`.
    """

    __slots__ = ()

    def summary(self) -> str:
        """Return the result in a few words."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.summary()}>"

    def __str__(self) -> str:
        return _presentation().text(self)

    def _repr_html_(self) -> str:
        return _presentation().html(self)

    def to_dict(self) -> dict[str, Any]:
        """Return a JSON-ready dictionary, with the keys that ``--json`` prints.

        Returns
        -------
        dict
            A number that does not exist is None; units are part of the keys.
        """
        return _presentation().record(self)

    def to_frame(self) -> Any:
        """Return a pandas DataFrame with one scalar in each cell.

        Returns
        -------
        pandas.DataFrame
            One row for each answer, closure, constant or point of the result; units are part of
            the column names, and a missing number is NaN.

        Raises
        ------
        StonepassError
            pandas is not installed.
        """
        return _pandas().DataFrame([_with_nan(row) for row in _presentation().rows(self)])

    def to_series(self) -> Any:
        """Return a pandas Series of the scalars of a result that has one row.

        Returns
        -------
        pandas.Series
            Its index are the columns of `to_frame`.

        Raises
        ------
        BadInput
            The result has several rows.
        StonepassError
            pandas is not installed.
        """
        rows = _presentation().rows(self)
        if len(rows) != 1:
            raise BadInput("result", f"a table of {len(rows)} rows", "one row", "use to_frame()")
        return _pandas().Series(_with_nan(rows[0]), dtype=object)

    def plot(self, ax: Any = None) -> Any:
        """Draw the main graph of the result.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default the axes of a new figure of pyplot.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        BadInput
            There is nothing to draw, e.g. because the stone is loose.
        """
        if ax is None:
            # pyplot, so that a notebook or plt.show() displays the figure.
            _, ax = import_module("matplotlib.pyplot").subplots(layout="constrained")
        _presentation().plot(self, ax)
        return ax

    def figure(self) -> Any:
        """Return the whole picture, as ``--figure`` writes it.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        BadInput
            There is nothing to draw.
        """
        return _presentation().figure(self)

    def save(self, path: str | Path) -> None:
        """Write the result to a file; an existing file is replaced.

        Parameters
        ----------
        path : str or Path
            A picture for the endings .svg, .png and .pdf, the record for .json, and the rows of
            `to_frame` for .csv.

        Raises
        ------
        BadInput
            Another ending, a folder that cannot be written, or nothing to draw.
        """
        _presentation().save(self, Path(path))


def _with_nan(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row as pandas expects it: a missing number is NaN."""
    return {name: math.nan if value is None else value for name, value in row.items()}


def _pandas() -> Any:
    try:
        return import_module("pandas")
    except ImportError as missing:
        raise StonepassError(
            "pandas must be installed for to_series() and to_frame(): pip install pandas. "
            "to_dict() works without it."
        ) from missing
