"""Options beside a case file: an option displaces what the file says of the same thing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stonepass.declaration import inputs_of
from stonepass.errors import Misplaced
from stonepass.inputs.catalogue import MODEL, all_inputs, models_with
from stonepass.model.models.registry import MODELS

__all__ = ["EXCLUSIVE", "of_other_models", "overlay", "refuse_pairs"]

# Inputs that say the same thing in two ways: the one given displaces the others.
EXCLUSIVE = (
    ("stone.diameter", "stone.size_ratio"),
    ("ureter.outer_diameter", "ureter.wall_ratio"),
    ("ureter.outer_diameter", "ureter.wall_thickness"),
    ("ureter.wall_thickness", "ureter.wall_ratio"),
    ("stone.aspect", "stone.shape"),
    ("method.circumferential_modulus", "method.secant_stretch"),
    ("method.longitudinal_modulus", "method.secant_stretch"),
)
# A value that leaves no place for another input.
DISPLACING = {
    ("method.closure", "linear"): "method.opening_curve",
    ("method.seating", "frictionless"): "method.seating_friction",
}


def overlay(base: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """The values of a file with those that were given beside it in their place."""
    displaced = {there for pair in EXCLUSIVE for here, there in (pair, pair[::-1]) if here in given}
    displaced |= {there for (key, value), there in DISPLACING.items() if given.get(key) == value}
    if MODEL in given and given[MODEL] in MODELS:
        displaced |= of_other_models(given[MODEL])
    return {key: value for key, value in base.items() if key not in displaced} | dict(given)


def of_other_models(name: str) -> set[str]:
    """Keys of the options that a model does not have, but another one has."""
    kept = inputs_of(MODELS[name])
    return {
        key
        for key, each in all_inputs().items()
        if each.section == "method" and models_with(each.name) and each.name not in kept
    }


def refuse_pairs(given: Mapping[str, Any], words: Mapping[str, str]) -> None:
    """Refuse two options that say the same thing; `words` names them by key."""
    for first, second in EXCLUSIVE:
        if first in given and second in given:
            raise Misplaced(words[first], words[second], "", "give one of the two")
