"""Laboratory data of strips in tension and of tubes under pressure, read from CSV files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.bench.bench_stress import strip_stress, tube_pressure
from stonepass.bench.data_checks import check_inflation, check_tension, inner_ratio
from stonepass.errors import BadInput, require
from stonepass.io.csv_file import Columns, read_columns
from stonepass.materials.protocol import Law
from stonepass.materials.uniaxial import AXES
from stonepass.model.ureter import Ureter
from stonepass.units import Area, Length, Quantity, area, format_length, length

__all__ = ["Inflation", "Tension", "read_inflation", "read_tension", "size_at_rest"]

S = TypeVar("S", Length, Area)


@array_dataclass
@dataclass(frozen=True)
class Tension:
    """Uniaxial tension tests of strips that were cut along an axis of the wall.

    Attributes
    ----------
    stretch : array (n)
        Stretch, the length over the length at rest.
    stress : array (n)
        Nominal stress, the force over the cross-section at rest, in Pa.
    axis : tuple of str
        Direction of the strip of each point, "circumferential" or "axial".
    lines : tuple of int
        Line number in the file of each point; empty if the data were not read from a file.

    References
    ----------
    docs/bench.md, "The data".
    """

    stretch: Float[np.ndarray, " n"]
    stress: Float[np.ndarray, " n"]
    axis: tuple[str, ...]
    lines: tuple[int, ...] = ()

    measured = "nominal stress"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """Measured nominal stress in Pa."""
        return self.stress

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """Stretch of each point."""
        return self.stretch

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to: the direction of its strip."""
        return self.axis

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch of the data."""
        return float(self.stretch.min()), float(self.stretch.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """Return the nominal stress that a law predicts in Pa; NaN where it predicts none."""
        return strip_stress(law, self.stretch, self._around)[0]

    def unstable_at(self, law: Law) -> float | None:
        """Return the stretch nearest to 1 at which the width of a strip is unstable, or None."""
        _, stiffness = strip_stress(law, self.stretch, self._around)
        lost = self.stretch[~(stiffness > 0.0)]
        return float(lost[np.argmin(np.abs(lost - 1.0))]) if len(lost) else None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Tension]]:
        """Function that changes all stretches by a fraction, for a wrong length at rest."""
        return {"rest_size": lambda part: replace(self, stretch=self.stretch * (1.0 + part))}

    def taut_from(self, stretch: float) -> Tension:
        """Return the data corrected for strips that are slack up to a stretch.

        The length at which the strips become taut becomes the length at rest, so that all stretches
        are divided by `stretch`. A point at which a strip was slack gets the stretch 1, at which it
        carries no load. Stretches below 1 are unchanged.
        """
        loose = np.minimum(self.stretch, 1.0)
        return replace(self, stretch=np.maximum(self.stretch / stretch, loose))

    def without(self, point: int) -> Tension:
        """Return the data without a point."""
        kept = [k for k in range(len(self.stress)) if k != point]
        lines = tuple(self.lines[k] for k in kept if self.lines)
        axis = tuple(self.axis[k] for k in kept)
        return Tension(self.stretch[kept], self.stress[kept], axis, lines)

    @property
    def _around(self) -> Bool[np.ndarray, " n"]:
        return np.array(self.axis) == AXES[0]


@array_dataclass
@dataclass(frozen=True)
class Inflation:
    """Inflation test of a tube whose ends are held at a given axial stretch.

    Attributes
    ----------
    radius_ratio : array (n)
        Inner radius over the inner radius at rest, r_a/R_a.
    pressure : array (n)
        Transmural pressure, inside minus outside, in Pa.
    wall_ratio : float
        Wall ratio η = R_b/R_a of the tube at rest.
    axial_stretch : array (n)
        Axial stretch λ_z of each point.
    lines : tuple of int
        Line number in the file of each point; empty if the data were not read from a file.

    References
    ----------
    Liu et al. 2022, Eq. 12; docs/theory.md, "Far field".
    """

    radius_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    wall_ratio: float
    axial_stretch: Float[np.ndarray, " n"]
    lines: tuple[int, ...] = ()

    measured = "transmural pressure"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """Measured transmural pressure in Pa."""
        return self.pressure

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """Radius ratio r_a/R_a of each point."""
        return self.radius_ratio

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to: its axial stretch."""
        return tuple(f"axial stretch {stretch:g}" for stretch in self.axial_stretch)

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest circumferential stretch of the inner wall."""
        return float(self.radius_ratio.min()), float(self.radius_ratio.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """Return the transmural pressure that a law predicts in Pa; NaN where it predicts none."""
        return tube_pressure(law, self.radius_ratio, self.wall_ratio, self.axial_stretch)

    def unstable_at(self, law: Law) -> float | None:
        """Return None: the radius of the tube is prescribed and its ends are held."""
        return None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Inflation]]:
        """Functions that change all radius ratios, or all axial stretches, by a fraction.

        They correct the data for a wrong diameter or a wrong length at rest.
        """
        return {
            "rest_size": lambda part: replace(self, radius_ratio=self.radius_ratio * (1.0 + part)),
            "axial_rest_length": lambda part: replace(
                self, axial_stretch=self.axial_stretch * (1.0 + part)
            ),
        }

    def without(self, point: int) -> Inflation:
        """Return the data without a point."""
        kept = [k for k in range(len(self.pressure)) if k != point]
        lines = tuple(self.lines[k] for k in kept if self.lines)
        ratio, axial = self.radius_ratio[kept], self.axial_stretch[kept]
        return Inflation(ratio, self.pressure[kept], self.wall_ratio, axial, lines)

    def taut_from(self, stretch: float) -> None:
        """Return None: a tube cannot be slack."""
        return


def size_at_rest(value: Any, argument: str, read: Callable[[Any, str], S]) -> S:
    """Read a length or an area of a specimen at rest, which must be above 0.

    Parameters
    ----------
    value : str, Length, Area or pint.Quantity
        The size with its unit.
    argument : str
        Name of the size in messages.
    read : callable
        `stonepass.units.length` or `stonepass.units.area`.

    Raises
    ------
    BadInput
        The unit is missing or wrong, or the size is not above 0.
    """
    found = read(value, argument)
    given = format_length(found) if isinstance(found, Length) else f"{1e6 * found:.12g} mm2"
    require(found > 0.0, argument, value if isinstance(value, str) else given, "above 0")
    return found


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
    width, thickness, gauge_length = (
        None if each is None else size_at_rest(each, name, length)
        for name, each in (
            ("width", width), ("thickness", thickness), ("gauge_length", gauge_length),
        )
    )  # fmt: skip
    section = None if section is None else size_at_rest(section, "section", area)
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
        stretch = 1.0 + 1e-3 * stretch / gauge_length
    if across == "force_N":
        stress = columns["force_N"] / _section(path, width, thickness, section)
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
