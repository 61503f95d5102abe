"""Conversion of results to JSON and arrays and back, without pickle, for listed types only."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from stonepass.fe.axisymmetric.wall_values import Field, Volume
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState, PushReport
from stonepass.model.states.seated_state import Contact, NoSeat, SeatedState, SolverReport
from stonepass.model.states.stability_report import StabilityReport

__all__ = ["deserialise", "serialise"]

TYPES = {
    each.__name__: each
    for each in (
        Contact, Critical, ErrorEstimate, Field, NoPush, NoSeat, OpeningCurve, PushReport,
        PushedState, SeatedState, SolverReport, StabilityReport, Volume,
    )
}  # fmt: skip


def serialise(value: Any) -> tuple[Any, dict[str, Any]]:
    """Convert a result to a JSON document and the arrays that the document refers to by name.

    The case of the result is left out, since the caller of `deserialise` provides it.
    """
    arrays: dict[str, Any] = {}

    def plain(part: Any) -> Any:
        """Convert one part to JSON and collect its arrays."""
        if part is None or isinstance(part, str | bool | int):
            return part
        if isinstance(part, np.bool_):
            return bool(part)
        if isinstance(part, np.integer):
            return int(part)
        if isinstance(part, float):  # NumPy's too
            if not np.isfinite(part):
                raise FloatingPointError("a number that is not finite is no result")
            return float(part)
        if isinstance(part, np.ndarray):
            name = f"array_{len(arrays)}"
            arrays[name] = part
            return {"array": name}
        if isinstance(part, tuple):
            return {"tuple": [plain(each) for each in part]}
        if isinstance(part, Problem):
            return {"case": True}
        assert is_dataclass(part), type(part)
        name = type(part).__name__
        assert TYPES[name] is type(part), name
        return {"type": name} | {
            each.name: plain(getattr(part, each.name)) for each in fields(part)
        }

    return plain(value), arrays


def deserialise(document: Any, arrays: dict[str, Any], case: Problem) -> Any:
    """Make a result from a JSON document and its arrays.

    Parameters
    ----------
    document : JSON value
        The document that `serialise` returned.
    arrays : dict of str to array
        The arrays by name.
    case : Problem
        The case that the result belongs to.
    """
    if not isinstance(document, dict):
        return document
    if "array" in document:
        return arrays[document["array"]]
    if "tuple" in document:
        return tuple(deserialise(each, arrays, case) for each in document["tuple"])
    if "case" in document and document["case"] is True:
        return case
    values = {
        name: deserialise(part, arrays, case) for name, part in document.items() if name != "type"
    }
    return TYPES[document["type"]](**values)
