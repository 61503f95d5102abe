"""What a bench measures: strips in tension, tubes under pressure; read from CSV."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

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
from stonepass.units import Length

__all__ = ["Inflation", "Tension", "read_inflation", "read_tension"]


@array_dataclass
@dataclass(frozen=True)
class Tension:
    """Strips pulled along directions of the wall.

    Attributes
    ----------
    stretch : array (n)
        Length over length at rest.
    stress : array (n)
        Force over the section at rest in Pa.
    axis : tuple of str
        "circumferential" or "axial", of each.
    lines : tuple of int
        Line of the file that each stands in; empty where there is no file.
    """

    stretch: Float[np.ndarray, " n"]
    stress: Float[np.ndarray, " n"]
    axis: tuple[str, ...]
    lines: tuple[int, ...] = ()

    measured = "nominal stress"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """The measured quantity, in Pa."""
        return self.stress

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """The quantity on the horizontal axis of a drawing."""
        return self.stretch

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each belongs to."""
        return self.axis

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch."""
        return float(self.stretch.min()), float(self.stretch.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """The measured quantity as a law predicts it, in Pa."""
        return strip_stress(law, self.stretch, self._around)[0]

    def unstable_at(self, law: Law) -> float | None:
        """First stretch at which a strip of the law would not keep its shape; None where none."""
        _, stiffness = strip_stress(law, self.stretch, self._around)
        lost = self.stretch[~(stiffness > 0.0)]
        return float(lost[np.argmin(np.abs(lost - 1.0))]) if len(lost) else None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Tension]]:
        """The data with a size at rest, by name of the caution, that is wrong by a small part."""
        return {"rest_size": lambda part: replace(self, stretch=self.stretch * (1.0 + part))}

    def taut_from(self, stretch: float) -> Tension:
        """The strips with their length at rest where they are taut, at this stretch, not before."""
        loose = np.minimum(self.stretch, 1.0)
        return replace(self, stretch=np.maximum(self.stretch / stretch, loose))

    @property
    def _around(self) -> Bool[np.ndarray, " n"]:
        return np.array(self.axis) == AXES[0]


@array_dataclass
@dataclass(frozen=True)
class Inflation:
    """A tube under pressure, its ends held at an axial stretch (paper, Eq. 12).

    Attributes
    ----------
    radius_ratio : array (n)
        Inner radius over inner radius at rest.
    pressure : array (n)
        Transmural pressure in Pa.
    wall_ratio : float
        η of the tube at rest.
    axial_stretch : array (n)
    lines : tuple of int
        Line of the file that each stands in; empty where there is no file.
    """

    radius_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    wall_ratio: float
    axial_stretch: Float[np.ndarray, " n"]
    lines: tuple[int, ...] = ()

    measured = "transmural pressure"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """The measured quantity, in Pa."""
        return self.pressure

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """The quantity on the horizontal axis of a drawing."""
        return self.radius_ratio

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each belongs to."""
        return tuple(f"axial stretch {stretch:g}" for stretch in self.axial_stretch)

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest circumferential stretch, of the inner wall."""
        return float(self.radius_ratio.min()), float(self.radius_ratio.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """The measured quantity as a law predicts it, in Pa."""
        return tube_pressure(law, self.radius_ratio, self.wall_ratio, self.axial_stretch)

    def unstable_at(self, law: Law) -> float | None:
        """None: a tube keeps its shape by its ends."""
        return None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Inflation]]:
        """The data with a size at rest, by name of the caution, that is wrong by a small part."""
        return {
            "rest_size": lambda part: replace(self, radius_ratio=self.radius_ratio * (1.0 + part)),
            "axial_rest_length": lambda part: replace(
                self, axial_stretch=self.axial_stretch * (1.0 + part)
            ),
        }

    def taut_from(self, stretch: float) -> None:
        """None: a tube does not hang loose."""
        return


def read_tension(
    path: str | Path,
    width: Length | None = None,
    thickness: Length | None = None,
    gauge_length: Length | None = None,
    section: float | None = None,
) -> Tension:
    """Read ``stretch`` or ``extension_mm``, ``nominal_stress_kPa`` or ``force_N``, and ``axis``.

    Parameters
    ----------
    path : str or Path
        CSV file; without a column ``axis`` the strips are circumferential.
    width, thickness : Length, optional
        Of the strip at rest; they turn a force into a stress.
    gauge_length : Length, optional
        Length at rest to which ``extension_mm`` belongs; stretch is 1 + extension/length.
    section : float, optional
        Section of the strip at rest in m², in place of `width` and `thickness`.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault; a section or a length at rest
        that is missing or not needed; stresses of the wrong sign, strains in place of stretches.
    """
    path = Path(path)
    along = "stretch" if gauge_length is None else "extension_mm"
    try:
        columns = _read_strips(path, along)
    except BadInput as problem:
        if gauge_length is None and _has_extensions(path):
            raise BadInput("length of the strip", "missing", "given as --gauge-length",
                           f"{path.name} has extensions") from problem  # fmt: skip
        raise
    along = _one_of(path, columns, "how far it was stretched", ("stretch", "extension_mm"))
    across = _one_of(path, columns, "what was measured", ("nominal_stress_kPa", "force_N"))
    stretch = columns[along]
    if gauge_length is not None:
        require(gauge_length > 0.0, "--gauge-length", f"{1e3 * gauge_length:g} mm", "above 0")
        stretch = 1.0 + 1e-3 * stretch / gauge_length
    if across == "force_N":
        stress = columns["force_N"] / _section(path, width, thickness, section)
    else:
        if not width is thickness is section is None:
            raise BadInput("section of the strip", "given", "left out",
                           f"{path.name} has stresses")  # fmt: skip
        stress = 1e3 * columns["nominal_stress_kPa"]
    check_tension(path.name, columns, along, stretch, stress)
    which = columns.get("axis", np.zeros(len(stress)))
    return Tension(stretch, stress, tuple(AXES[int(k)] for k in which), columns.lines)


def _read_strips(path: Path, along: str) -> Columns:
    others = ("stretch", "nominal_stress_kPa", "force_N", "extension_mm", "axis")
    optional = tuple(name for name in others if name != along)
    bounds = {"nominal_stress_kPa": (-1e7, 1e7), "force_N": (-1e6, 1e6)}
    return read_columns(path, (along,), optional, bounds, words={"axis": AXES})


def _has_extensions(path: Path) -> bool:
    try:
        return "extension_mm" in _read_strips(path, "extension_mm")
    except BadInput:
        return False


def _one_of(path: Path, columns: Columns, what: str, names: tuple[str, str]) -> str:
    """Name of the one of two columns that the table has."""
    given = [name for name in names if name in columns]
    if len(given) != 1:
        state = "missing" if not given else "given twice"
        raise BadInput(f"in {path.name}, {what}", state, f"given once, as {' or '.join(names)}")
    return given[0]


def _section(
    path: Path, width: Length | None, thickness: Length | None, section: float | None
) -> float:
    """Section at rest in m²."""
    if section is not None and (width, thickness) != (None, None):
        raise BadInput("section of the strip", "given twice",
                       "given as --section, or as --width and --thickness")  # fmt: skip
    if section is None and (width is None or thickness is None):
        raise BadInput("section of the strip", "missing",
                       "given as --width and --thickness, or as --section",
                       f"{path.name} has forces")  # fmt: skip
    found = width * thickness if width is not None and thickness is not None else section
    if found is None or not found > 0.0:
        raise BadInput("section of the strip", f"{found:g} m²", "above 0")
    return found


def read_inflation(path: str | Path, ureter: Ureter) -> Inflation:
    """Read ``pressure_kPa`` and ``inner_diameter_mm`` or ``outer_diameter_mm``.

    ``axial_stretch`` may stand beside them, 1 without. `ureter` has the diameters at rest; of an
    outer diameter the inner one follows from the volume of the wall.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault; pressures of the wrong sign,
        radii in place of diameters.
    """
    path = Path(path)
    columns = read_columns(
        path,
        ("pressure_kPa",),
        ("inner_diameter_mm", "outer_diameter_mm", "axial_stretch"),
        bounds={"pressure_kPa": (-1e3, 1e4), "inner_diameter_mm": (1e-3, 1e3),
                "outer_diameter_mm": (1e-3, 1e3), "axial_stretch": (0.5, 3.0)},
    )  # fmt: skip
    given = _one_of(path, columns, "the diameter", ("inner_diameter_mm", "outer_diameter_mm"))
    if ureter.inner_diameter is None:
        raise BadInput("inner diameter", "missing", "given as --inner", "the data are in mm")
    axial = columns.get("axial_stretch", np.ones(len(columns["pressure_kPa"])))
    ratio = inner_ratio(columns[given], given, ureter, axial)
    check_inflation(path.name, columns, given, ureter, axial)
    return Inflation(ratio, 1e3 * columns["pressure_kPa"], ureter.wall_ratio, axial, columns.lines)
