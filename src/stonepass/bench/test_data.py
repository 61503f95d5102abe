"""What a bench measures: strips in tension, tubes under pressure; read from CSV."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput
from stonepass.io.csv_file import read_columns
from stonepass.materials.protocol import Law
from stonepass.materials.uniaxial import AXES, nominal_stress
from stonepass.model.far_field import inflation
from stonepass.model.ureter import Ureter
from stonepass.units import Length

__all__ = ["Inflation", "Tension", "read_inflation", "read_tension"]


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
    """

    stretch: Float[np.ndarray, " n"]
    stress: Float[np.ndarray, " n"]
    axis: tuple[str, ...]

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
        found = np.empty_like(self.stress)
        names = np.array(self.axis)
        for axis in AXES:
            chosen = names == axis
            if chosen.any():
                found[chosen] = nominal_stress(law, self.stretch[chosen], axis)
        return found


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
    """

    radius_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    wall_ratio: float
    axial_stretch: Float[np.ndarray, " n"]

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
        found = np.empty_like(self.pressure)
        for stretch in np.unique(self.axial_stretch):
            chosen = self.axial_stretch == stretch
            found[chosen] = inflation(
                self.radius_ratio[chosen], self.wall_ratio, law, float(stretch)
            )
        return found


def read_tension(
    path: str | Path, width: Length | None = None, thickness: Length | None = None
) -> Tension:
    """Read ``stretch`` and ``nominal_stress_kPa`` or ``force_N``, and ``axis`` where it varies.

    Parameters
    ----------
    width, thickness : Length, optional
        Of the strip at rest; they turn a force into a stress.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    path = Path(path)
    columns = read_columns(
        path,
        ("stretch",),
        ("nominal_stress_kPa", "force_N", "axis"),
        bounds={"stretch": (0.2, 5.0), "nominal_stress_kPa": (-1e7, 1e7), "force_N": (-1e6, 1e6)},
        words={"axis": AXES},
    )
    given = [name for name in ("nominal_stress_kPa", "force_N") if name in columns]
    if len(given) != 1:
        state = "missing" if not given else "given twice"
        allowed = "given once, as nominal_stress_kPa or force_N"
        raise BadInput(f"in {path.name}, what was measured", state, allowed)
    if "force_N" in columns:
        if width is None or thickness is None:
            raise BadInput("section of the strip", "missing", "given as --width and --thickness",
                           f"{path.name} has forces")  # fmt: skip
        stress = columns["force_N"] / (width * thickness)
    else:
        if width is not None or thickness is not None:
            raise BadInput("section of the strip", "given", "left out",
                           f"{path.name} has stresses")  # fmt: skip
        stress = 1e3 * columns["nominal_stress_kPa"]
    which = columns.get("axis", np.zeros(len(stress)))
    return Tension(columns["stretch"], stress, tuple(AXES[int(k)] for k in which))


def read_inflation(path: str | Path, ureter: Ureter) -> Inflation:
    """Read ``pressure_kPa`` and ``inner_diameter_mm`` or ``outer_diameter_mm``.

    ``axial_stretch`` may stand beside them, 1 without. `ureter` has the diameters at rest; of an
    outer diameter the inner one follows from the volume of the wall.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    path = Path(path)
    columns = read_columns(
        path,
        ("pressure_kPa",),
        ("inner_diameter_mm", "outer_diameter_mm", "axial_stretch"),
        bounds={"pressure_kPa": (-1e3, 1e4), "inner_diameter_mm": (1e-3, 1e3),
                "outer_diameter_mm": (1e-3, 1e3), "axial_stretch": (0.5, 3.0)},
    )  # fmt: skip
    given = [name for name in ("inner_diameter_mm", "outer_diameter_mm") if name in columns]
    if len(given) != 1:
        state = "missing" if not given else "given twice"
        allowed = "given once, as inner_diameter_mm or outer_diameter_mm"
        raise BadInput(f"in {path.name}, the diameter", state, allowed)
    inner = ureter.inner_diameter
    if inner is None:
        raise BadInput("inner diameter", "missing", "given as --inner", "the data are in mm")
    axial = columns.get("axial_stretch", np.ones(len(columns["pressure_kPa"])))
    ratio = 1e-3 * columns[given[0]] / inner
    if given == ["outer_diameter_mm"]:
        squared = ratio**2 - (ureter.wall_ratio**2 - 1.0) / axial
        if not np.all(squared > 0.0):
            at = int(np.argmin(squared > 0.0))
            place = f"in {path.name}, {columns.place(at, given[0])}"
            shown = f"{columns[given[0]][at]:g}"
            raise BadInput(place, shown, "such that the wall has room inside it")
        ratio = np.sqrt(squared)
    return Inflation(ratio, 1e3 * columns["pressure_kPa"], ureter.wall_ratio, axial)
