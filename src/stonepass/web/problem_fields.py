"""The input of a request that an error is about."""

from __future__ import annotations

import re

from stonepass.errors import BadInput
from stonepass.inputs.catalogue import all_inputs

__all__ = ["field_of", "part_of_table"]

# Inputs that only the API has are named by their keys, and so are those of a table of constants.
KEY = re.compile(r"[a-z_]+|ureter\.material\.[\w.]+")
# Inputs that a message about more than one input belongs to.
SHARED_FIELDS = {
    "size of the stone": "stone.diameter",
    "size of the ureter": "ureter.inner_diameter",
    "size ratio (stone diameter over inner diameter)": "stone.size_ratio",
    "wall of the ureter": "ureter.wall_thickness",
    "dilated inner diameter": "dilated.inner_diameter",
    "dilated outer diameter": "dilated.outer_diameter",
    "place": "stone.place",
    "order of the baseline": "baseline_order",
    "height range": "height_range",
    "shape of the stone": "stone.shape",
    "opening_curve": "method.opening_curve",
}


# The arguments of messages about parts of an input that is a table, and the key of the input.
PARTS = (
    (re.compile(r"(.*) of the shape"), "stone.shape"),
    (re.compile(r"(.*) of the opening curve|(.* of pair \d+)"), "method.opening_curve"),
)


def field_of(problem: BadInput) -> str | None:
    """Return the key of the input that an error is about, e.g. ``stone.diameter``."""
    fields = {each.title: key for key, each in all_inputs().items()} | SHARED_FIELDS
    found = problem.argument if problem.argument in all_inputs() else fields.get(problem.argument)
    for pattern, key in PARTS:
        if pattern.fullmatch(problem.argument):
            return key
    return problem.argument if found is None and KEY.fullmatch(problem.argument) else found


def part_of_table(argument: str) -> str | None:
    """Return the part of a table that a message is about, e.g. ``'aspect'``, or None."""
    for pattern, _ in PARTS:
        found = pattern.fullmatch(argument)
        if found:
            return next(filter(None, found.groups()))
    return None
