"""The inputs of the study of rising urine pressure, declared once for all doors."""

from __future__ import annotations

from stonepass.declaration import DeclaredInput, Input, Kind

__all__ = ["HIGHEST", "STEPS"]

STEPS = DeclaredInput(
    "",
    "steps",
    13,
    Input(Kind.WHOLE, "--steps", "Number of urine pressures, including 0.", bounds=(2, 200)),
)
HIGHEST = DeclaredInput(
    "",
    "to",
    None,
    Input(
        Kind.PRESSURE,
        "--to",
        "Highest urine pressure.",
        shown_default="the critical pressure",
        metavar="PRESSURE",
    ),
)
