"""Options that several models have, each declared once."""

from __future__ import annotations

from typing import Any

from stonepass.declaration import Kind, declared

__all__ = ["far_field_ground"]


def far_field_ground() -> Any:
    """Return the field of a model that tells whether its far field includes the ground matrix."""
    return declared(
        Kind.FLAG,
        "--far-field-ground/--far-field-fibres",
        "Include the ground matrix in the far field; otherwise only the fibres are included.",
        default=False,
        shown_default="fibres",
    )
