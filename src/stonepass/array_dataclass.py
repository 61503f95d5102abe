"""Equality and a short description for dataclasses that contain arrays."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

import numpy as np

__all__ = ["abridged", "array_dataclass", "equal"]

Class = TypeVar("Class", bound=type)
LONGEST_VALUE = 60  # largest number of characters of one value in a short description


def array_dataclass(kind: Class) -> Class:
    """Decorate a dataclass that contains arrays with equality and a short description.

    Two objects are equal if they have the same class and all their fields are equal. Arrays are
    compared element by element, and NaN is equal to NaN. The objects cannot be hashed, since arrays
    cannot be hashed. The description (``repr``) replaces arrays and long sequences by their size; a
    dataclass with ``repr=False`` keeps its own description.
    """

    def __eq__(self: Any, other: object) -> bool:  # noqa: N807
        if type(other) is not type(self):
            return NotImplemented
        return equal(self, other)

    kind.__eq__ = __eq__  # type: ignore[method-assign,assignment]
    kind.__hash__ = None  # type: ignore[assignment]
    if kind.__dataclass_params__.repr:  # type: ignore[attr-defined]
        kind.__repr__ = abridged  # type: ignore[method-assign,assignment]
    return kind


def equal(one: Any, other: Any) -> bool:
    """Return whether two values are equal, including the arrays inside them.

    Dataclasses, tuples, lists and dictionaries are compared element by element.

    Parameters
    ----------
    one, other : object
        The values to be compared.
    """
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        numbers = one.dtype.kind in "fc" and other.dtype.kind in "fc"
        return bool(np.array_equal(one, other, equal_nan=numbers))
    if is_dataclass(one):
        compared = (each.name for each in fields(one) if each.compare)
        return all(equal(getattr(one, name), getattr(other, name)) for name in compared)
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(equal, one, other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(equal(one[key], other[key]) for key in one)
    return bool(one == other) or (isinstance(one, float) and one != one and other != other)


def abridged(value: Any) -> str:
    """Return a description of a dataclass in one line, with the sizes of arrays and long sequences.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass
    ... class Series:
    ...     name: str
    ...     values: list[float]
    >>> abridged(Series("latex", [0.5] * 40))
    "Series(name='latex', values=<list of 40>)"
    """
    shown = (each for each in fields(value) if each.repr)
    parts = ", ".join(f"{each.name}={_short(getattr(value, each.name))}" for each in shown)
    return f"{type(value).__name__}({parts})"


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"<array of shape {value.shape}>"
    if isinstance(value, tuple | list | dict) and len(value) > 6:
        return f"<{type(value).__name__} of {len(value)}>"
    text = repr(value)
    if len(text) <= LONGEST_VALUE:
        return text
    if is_dataclass(value) or isinstance(value, tuple | list | dict):
        return f"<{type(value).__name__}>"
    return f"{text[: LONGEST_VALUE - 3]}..."
