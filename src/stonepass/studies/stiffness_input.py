"""The factor on the stiffness of a material, declared once for all doors."""

from __future__ import annotations

from stonepass.declaration import DeclaredInput, Input, Kind

__all__ = ["STIFFNESS", "STIFFNESS_BOUNDS"]

STIFFNESS_BOUNDS = (0.05, 20.0)
STIFFNESS = DeclaredInput(
    "",
    "stiffness",
    1.0,
    Input(
        Kind.NUMBER,
        "--stiffness",
        "Factor on all moduli of the material.",
        title="stiffness",
        bounds=STIFFNESS_BOUNDS,
    ),
)
