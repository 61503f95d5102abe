"""Combination of a case file with command-line options, which override the file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stonepass.declaration import inputs_of
from stonepass.errors import Misplaced
from stonepass.inputs.catalogue import MODEL, all_inputs, models_with
from stonepass.model.models.registry import MODELS

__all__ = ["EXCLUSIVE", "of_other_models", "overlay", "refuse_pairs"]

# Alternative inputs for the same quantity: an option overrides the alternatives in the file.
EXCLUSIVE = (
    ("stone.diameter", "stone.size_ratio"),
    ("ureter.outer_diameter", "ureter.wall_ratio"),
    ("ureter.outer_diameter", "ureter.wall_thickness"),
    ("ureter.wall_thickness", "ureter.wall_ratio"),
    ("stone.aspect", "stone.shape"),
    ("method.circumferential_modulus", "method.secant_stretch"),
    ("method.longitudinal_modulus", "method.secant_stretch"),
)
# Values of an input that exclude another input. If an option has such a value, the other input is
# removed from the values of the file.
DISPLACING = {
    ("method.closure", "linear"): "method.opening_curve",
    ("method.seating", "frictionless"): "method.seating_friction",
}


def overlay(base: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of a case file, overridden by given values.

    A given value also removes values of the file that cannot be used with it.

    Parameters
    ----------
    base : mapping of str to value
        Raw values of the file by key.
    given : mapping of str to value
        Raw values of the options by key.
    """
    displaced = {there for pair in EXCLUSIVE for here, there in (pair, pair[::-1]) if here in given}
    displaced |= {there for (key, value), there in DISPLACING.items() if given.get(key) == value}
    if MODEL in given and given[MODEL] in MODELS:
        displaced |= of_other_models(given[MODEL])
    return {key: value for key, value in base.items() if key not in displaced} | dict(given)


def of_other_models(name: str) -> set[str]:
    """Return the keys of options that other models have, but not the named model."""
    kept = inputs_of(MODELS[name])
    return {
        key
        for key, each in all_inputs().items()
        if each.section == "method" and models_with(each.name) and each.name not in kept
    }


def refuse_pairs(given: Mapping[str, Any], words: Mapping[str, str]) -> None:
    """Refuse two given inputs that determine the same quantity.

    Parameters
    ----------
    given : mapping of str to value
        Given values by key.
    words : mapping of str to str
        Names of the inputs in messages, by key.

    Raises
    ------
    Misplaced
        Two alternative inputs are given.
    """
    for first, second in EXCLUSIVE:
        if first in given and second in given:
            raise Misplaced(words[first], words[second], "", "give one of the two")
