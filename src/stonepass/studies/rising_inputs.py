"""The inputs of the study of rising urine pressure, declared once for all doors."""

from __future__ import annotations

from stonepass.declaration import Kind, free_input

__all__ = ["HIGHEST", "STEPS"]

STEPS = free_input(
    "steps",
    Kind.WHOLE,
    "--steps",
    "Number of urine pressures, including 0.",
    default=13,
    bounds=(2, 200),
)
HIGHEST = free_input(
    "to",
    Kind.PRESSURE,
    "--to",
    "Highest urine pressure.",
    shown_default="the critical pressure",
)
