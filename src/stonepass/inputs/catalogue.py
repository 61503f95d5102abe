"""The declared inputs of a case by their keys, collected from the classes that declare them."""

from __future__ import annotations

from functools import lru_cache

from stonepass.declaration import DeclaredInput, Input, Kind, inputs_of
from stonepass.model.load import Load
from stonepass.model.models.registry import MODELS
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

__all__ = ["MODEL", "all_inputs", "models_with", "option_of", "sections"]

MODEL = "method.model"  # key of the input that names the model


@lru_cache(maxsize=1)
def all_inputs() -> dict[str, DeclaredInput]:
    """Return every input by its key ``section.name``, in the order of the help and the reference.

    An option that several models have must have the same declaration in all of them.
    """
    found: dict[str, DeclaredInput] = {}
    parts: tuple[type, ...] = (Stone, Ureter, Load)
    for owner in parts:
        found |= {each.key: each for each in inputs_of(owner).values()}
    found[MODEL] = _model()
    methods: tuple[type, ...] = (*MODELS.values(), Numerics)
    for owner in methods:
        for each in inputs_of(owner).values():
            assert found.get(each.key, each) == each, each.key
            found[each.key] = each
    return found


def _model() -> DeclaredInput:
    """Return the declaration of the input that selects one of the registered models."""
    section, _, name = MODEL.partition(".")
    meanings = "; ".join(f"{each}: {owner.MEANING}" for each, owner in MODELS.items())
    choice = Input(Kind.CHOICE, "--model", f"{meanings}.", choices=tuple(MODELS))
    return DeclaredInput(section, name, SeatedBalance.NAME, choice)


def sections() -> dict[str, dict[str, DeclaredInput]]:
    """Return the inputs by section and name, in the structure of a case file."""
    found: dict[str, dict[str, DeclaredInput]] = {}
    for each in all_inputs().values():
        found.setdefault(each.section, {})[each.name] = each
    return found


def models_with(name: str) -> list[str]:
    """Return the names of the models that have an option; empty if it belongs to no model."""
    return [each for each, owner in MODELS.items() if name in inputs_of(owner)]


def option_of(key: str) -> str:
    """Return the command-line option of an input, e.g. ``--stone``."""
    return all_inputs()[key].declaration.option.split("/")[0]
