"""Equality of values that hold arrays, which Python's own dataclasses cannot compare."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

import numpy as np

__all__ = ["compared_by_value", "equal"]

Class = TypeVar("Class", bound=type)


def compared_by_value(kind: Class) -> Class:
    """Give a dataclass an equality that compares arrays element by element.

    Two values are equal where their class and all their fields are; NaN equals NaN. They cannot be
    hashed, since arrays cannot.
    """

    def __eq__(self: Any, other: object) -> bool:  # noqa: N807
        if type(other) is not type(self):
            return NotImplemented
        return equal(self, other)

    kind.__eq__ = __eq__  # type: ignore[method-assign,assignment]
    kind.__hash__ = None  # type: ignore[assignment]
    return kind


def equal(one: Any, other: Any) -> bool:
    """Whether two values are equal, looking into dataclasses, sequences, mappings and arrays."""
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
