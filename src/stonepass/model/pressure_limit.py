"""The pressure limit: the largest urine pressure that is tolerated, which gives a critical size."""

from __future__ import annotations

from stonepass.declaration import Kind, free_input, read_declared
from stonepass.units import Pressure, Quantity

__all__ = ["PRESSURE_LIMIT", "read_limit"]

PRESSURE_LIMIT = free_input(
    "limit",
    Kind.PRESSURE,
    "--limit",
    "Maximum tolerable urine pressure, e.g. 12kPa.",
    bounds=(1.0, 1e6),
)


def read_limit(value: str | Pressure | Quantity, name: str = "limit") -> Pressure:
    """Read a pressure limit.

    Parameters
    ----------
    value : str, Pressure or pint.Quantity
        Text has a unit, e.g. ``"6 kPa"``.
    name : str
        Name of the input in messages.

    Raises
    ------
    BadInput
        The value has no unit, or it is not from 0.001 kPa to 1000 kPa.
    """
    limit: Pressure = read_declared(PRESSURE_LIMIT.declaration, name, value)
    return limit
