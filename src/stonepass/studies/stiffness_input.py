"""The factor on the stiffness of a material, declared once for all doors."""

from __future__ import annotations

from stonepass.declaration import Kind, free_input

__all__ = ["STIFFNESS", "STIFFNESS_BOUNDS"]

STIFFNESS_BOUNDS = (0.05, 20.0)
STIFFNESS = free_input(
    "stiffness",
    Kind.NUMBER,
    "--stiffness",
    "Factor on all moduli of the material.",
    default=1.0,
    title="stiffness",
    bounds=STIFFNESS_BOUNDS,
)
