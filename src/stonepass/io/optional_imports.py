"""Libraries of an extra: loaded where they are used, and what to install where they are missing."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from stonepass.errors import BadInput

__all__ = ["library"]


def library(name: str, purpose: str, extra: str) -> Any:
    """Load a module; `BadInput` with the extra that brings it where it is not installed."""
    try:
        return import_module(name)
    except ImportError as problem:
        raise BadInput(
            "library", name.split(".")[0], f"installed to {purpose}",
            f"pip install 'stonepass[{extra}]'",
        ) from problem  # fmt: skip
