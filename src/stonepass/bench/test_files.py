"""Readers of laboratory data of strips in tension and of tubes under pressure, in CSV files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from stonepass.bench.data_checks import check_inflation, check_tension, inner_ratio
from stonepass.bench.specimen_inputs import read_sizes
from stonepass.bench.test_data import AXES, Inflation, Tension
from stonepass.errors import BadInput
from stonepass.io.csv_file import Columns, read_columns
from stonepass.model.ureter import Ureter
from stonepass.units import Area, Length, Quantity

__all__ = ["read_inflation", "read_tension", "table_of_test"]


def read_tension(
    path: str | Path,
    width: str | Length | Quantity | None = None,
    thickness: str | Length | Quantity | None = None,
    gauge_length: str | Length | Quantity | None = None,
    section: str | Area | Quantity | None = None,
) -> Tension:
    """Read the tension tests of strips from a CSV file.

    Parameters
    ----------
    path : str or Path
        CSV file with a column ``stretch`` or ``extension_mm``, and a column ``nominal_stress_kPa``
        or ``force_N``. An optional column ``axis`` has the direction of each strip, circumferential
        (the default) or axial.
    width, thickness : str, Length or pint.Quantity, optional
        Width and thickness of the strip at rest, e.g. ``"10 mm"``; needed if the file has forces.
    gauge_length : str, Length or pint.Quantity, optional
        Gauge length at rest; needed if the file has extensions. The stretch is
        1 + extension/gauge_length.
    section : str, Area or pint.Quantity, optional
        Cross-section of the strip at rest, e.g. ``"12 mm2"``, instead of `width` and `thickness`.

    Returns
    -------
    Tension

    Raises
    ------
    BadInput
        The file cannot be read (the message names the row and the column), a size at rest is
        missing or not needed, the stresses have the wrong sign, or strains are given as stretches.

    References
    ----------
    docs/bench.md, "The data".
    """
    path = Path(path)
    rest = read_sizes(width=width, thickness=thickness, gauge_length=gauge_length, section=section)
    along = "stretch" if gauge_length is None else "extension_mm"
    try:
        columns = _read_strips(path, along)
    except BadInput as problem:
        if gauge_length is None and _has(path, "extension_mm"):
            raise BadInput("length of the strip", "missing", "given as --gauge-length",
                           f"{path.name} has a column of extensions") from problem  # fmt: skip
        if gauge_length is not None and _has(path, "stretch"):
            raise BadInput("length of the strip", "given as --gauge-length", "left out",
                           f"{path.name} has a column of stretches") from problem  # fmt: skip
        raise
    along = _one_of(path, columns, "the column of stretches", ("stretch", "extension_mm"))
    across = _one_of(path, columns, "the column of stresses", ("nominal_stress_kPa", "force_N"))
    stretch = columns[along]
    if gauge_length is not None:
        stretch = 1.0 + 1e-3 * stretch / rest["gauge_length"]
    if across == "force_N":
        stress = columns["force_N"] / _section(
            path, rest["width"], rest["thickness"], rest["section"]
        )
    else:
        if any(each is not None for each in (width, thickness, section)):
            raise BadInput("section of the strip", "given", "left out",
                           f"{path.name} has a column of stresses")  # fmt: skip
        stress = 1e3 * columns["nominal_stress_kPa"]
    check_tension(path.name, columns, along, stretch, stress)
    which = columns.get("axis", np.zeros(len(stress)))
    return Tension(stretch, stress, tuple(AXES[int(k)] for k in which), columns.lines)


def _read_strips(path: Path, along: str) -> Columns:
    others = ("stretch", "nominal_stress_kPa", "force_N", "extension_mm", "axis")
    optional = tuple(name for name in others if name != along)
    bounds = {"nominal_stress_kPa": (-1e7, 1e7), "force_N": (-1e6, 1e6)}
    return read_columns(path, (along,), optional, bounds, words={"axis": AXES})


def _has(path: Path, along: str) -> bool:
    try:
        return along in _read_strips(path, along)
    except BadInput:
        return False


def _one_of(path: Path, columns: Columns, what: str, names: tuple[str, str]) -> str:
    """Return which of two alternative columns the table has; it must have exactly one."""
    given = [name for name in names if name in columns]
    if len(given) != 1:
        state = "missing" if not given else "given twice"
        raise BadInput(f"in {path.name}, {what}", state, f"given as either {' or '.join(names)}")
    return given[0]


def _section(
    path: Path, width: Length | None, thickness: Length | None, section: float | None
) -> float:
    """Return the cross-section of the strip at rest in m²."""
    if section is not None and (width, thickness) != (None, None):
        raise BadInput("section of the strip", "given twice",
                       "given as --section, or as --width and --thickness")  # fmt: skip
    if section is None and (width is None or thickness is None):
        raise BadInput("section of the strip", "missing",
                       "given as --width and --thickness, or as --section",
                       f"{path.name} has a column of forces")  # fmt: skip
    if section is not None:
        return section
    assert width is not None
    assert thickness is not None
    return width * thickness


def table_of_test(path: Path) -> tuple[str, Columns]:
    """Return the kind of test that a table is from, "tensile" or "inflation", and its columns.

    Parameters
    ----------
    path : Path
        CSV file for `read_tension` or `read_inflation`. Sizes at rest are not needed.

    Raises
    ------
    BadInput
        The file cannot be read, or its columns are those of neither test.
    """
    readers: tuple[tuple[str, Callable[[], Columns]], ...] = (
        ("tensile", lambda: _read_strips(path, "stretch")),
        ("tensile", lambda: _read_strips(path, "extension_mm")),
        ("inflation", lambda: _read_tube(path)),
    )
    refusals = []
    for test, read in readers:
        try:
            return test, read()
        except BadInput as problem:
            refusals.append(problem)
    # The table is meant for the reader that got farthest: it does not miss its first column.
    found = [each for each in refusals if each.value != "missing" and each.argument != "file"]
    raise found[0] if found else refusals[0]


def read_inflation(path: str | Path, ureter: Ureter) -> Inflation:
    """Read the inflation test of a tube from a CSV file.

    Parameters
    ----------
    path : str or Path
        CSV file with the columns ``pressure_kPa`` (transmural pressure) and ``inner_diameter_mm``
        or ``outer_diameter_mm``. An optional column ``axial_stretch`` has the axial stretch, 0.5 to
        3; it is 1 by default.
    ureter : Ureter
        Inner and outer diameter of the tube at rest. With a measured outer diameter the inner one
        follows from the constant volume of the wall.

    Returns
    -------
    Inflation

    Raises
    ------
    BadInput
        The file cannot be read (the message names the row and the column), `ureter` has no
        diameters, the pressures have the wrong sign, or radii are given as diameters.

    References
    ----------
    docs/bench.md, "The data".
    """
    path = Path(path)
    columns = _read_tube(path)
    names = ("inner_diameter_mm", "outer_diameter_mm")
    given = _one_of(path, columns, "the column of diameters", names)
    if ureter.inner_diameter is None:
        raise BadInput("inner diameter", "missing", "given as --inner", "the data are in mm")
    axial = columns.get("axial_stretch", np.ones(len(columns["pressure_kPa"])))
    ratio = inner_ratio(columns[given], given, ureter, axial)
    check_inflation(path.name, columns, given, ureter, axial)
    return Inflation(ratio, 1e3 * columns["pressure_kPa"], ureter.wall_ratio, axial, columns.lines)


def _read_tube(path: Path) -> Columns:
    return read_columns(
        path,
        ("pressure_kPa",),
        ("inner_diameter_mm", "outer_diameter_mm", "axial_stretch"),
        bounds={"pressure_kPa": (-1e3, 1e4), "inner_diameter_mm": (1e-3, 1e3),
                "outer_diameter_mm": (1e-3, 1e3), "axial_stretch": (0.5, 3.0)},
    )  # fmt: skip
