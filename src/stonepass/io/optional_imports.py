"""Import of the libraries of optional extras, with an error that says what to install."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from stonepass.errors import BadInput

__all__ = ["library"]


def library(name: str, purpose: str, extra: str) -> Any:
    """Import a module of an optional library.

    Parameters
    ----------
    name : str
        Name of the module.
    purpose : str
        The purpose of the library: an infinitive without "to" for the message.
    extra : str
        The extra of stonepass that installs the library.

    Raises
    ------
    BadInput
        The library is not installed.
    """
    try:
        return import_module(name)
    except ImportError as problem:
        raise BadInput(
            "library", name.split(".")[0], f"installed to {purpose}",
            f"pip install 'stonepass[{extra}]'",
        ) from problem  # fmt: skip
