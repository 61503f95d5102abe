"""Measured critical pressures: a series of stones and tubes, read from a CSV file."""

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
PRESSURE = (0.0, 1e3)  # kPa
BOUNDS = {
    "xi": SIZE_RATIO,
    "eta": WALL_RATIO,
    "confining_kPa": (CONFINING[0] / 1e3, CONFINING[1] / 1e3),
    "pressure_kPa": PRESSURE,
    "sd_kPa": PRESSURE,
}


@dataclass(frozen=True)
class Point:
    """One measured critical pressure in Pa, with its standard deviation where it was given."""

    size_ratio: float
    wall_ratio: float
    confining_pressure: Pressure
    pressure: Pressure
    sd: Pressure | None = None


def read_points(path: str | Path) -> tuple[Point, ...]:
    """Read ``xi, eta, confining_kPa, pressure_kPa`` and, where it is there, ``sd_kPa``.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
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
