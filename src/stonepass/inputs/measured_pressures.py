"""Reader of a series of measured critical pressures from a CSV file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from stonepass.io.csv_file import read_columns
from stonepass.model.load import CONFINING
from stonepass.model.stone import SIZE_RATIO
from stonepass.model.ureter import WALL_RATIO
from stonepass.units import Pressure

__all__ = ["Point", "read_points"]

COLUMNS = ("xi", "eta", "confining_kPa", "pressure_kPa")
PRESSURE = (0.0, 1e3)  # smallest and largest measured pressure in kPa
BOUNDS = {
    "xi": SIZE_RATIO,
    "eta": WALL_RATIO,
    "confining_kPa": (CONFINING[0] / 1e3, CONFINING[1] / 1e3),
    "pressure_kPa": PRESSURE,
    "sd_kPa": PRESSURE,
}


@dataclass(frozen=True)
class Point:
    """A measured critical pressure.

    Attributes
    ----------
    size_ratio : float
        Size ratio ξ, 0.1 to 3.
    wall_ratio : float
        Wall ratio η, 1.02 to 10.
    confining_pressure : Pressure
        Confining pressure P_out in Pa.
    pressure : Pressure
        Measured critical pressure in Pa.
    sd : Pressure or None
        Standard deviation of the measured pressure in Pa; None if it is unknown.
    """

    size_ratio: float
    wall_ratio: float
    confining_pressure: Pressure
    pressure: Pressure
    sd: Pressure | None = None


def read_points(path: str | Path) -> tuple[Point, ...]:
    """Read a series of measured critical pressures.

    Parameters
    ----------
    path : str or Path
        CSV file with the columns ``xi``, ``eta``, ``confining_kPa`` and ``pressure_kPa``; the
        column ``sd_kPa`` with standard deviations is optional.

    Raises
    ------
    BadInput
        The file cannot be read, or a value is out of bounds. The message names the file, the row
        and the column.
    """
    path = Path(path)
    columns = read_columns(path, COLUMNS, ("sd_kPa",), BOUNDS)
    spread = columns.get("sd_kPa")
    return tuple(
        Point(
            float(xi),
            float(eta),
            Pressure(1e3 * confining),
            Pressure(1e3 * pressure),
            None if spread is None else Pressure(1e3 * spread[k]),
        )
        for k, (xi, eta, confining, pressure) in enumerate(
            zip(*(columns[name] for name in COLUMNS), strict=True)
        )
    )
