"""From the values of a door to a case: files are read, parts are made, misfits are refused.

A door hands over raw values by key (``{"stone.diameter": "4.2 mm", …}``), as text, numbers and
truth values, and the words in which it names each input, for refusals.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from stonepass.declaration import Kind, inputs_of
from stonepass.errors import BadInput, Misplaced
from stonepass.inputs.catalogue import MODEL, all_inputs, models_with
from stonepass.inputs.material_file import find_material
from stonepass.inputs.opening_curve_file import find_opening_curve
from stonepass.inputs.shape_file import find_shape
from stonepass.model.answer import Model
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.registry import MODELS, model_named
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

__all__ = ["Values", "build_case", "build_load", "build_method", "build_model", "in_words"]

Values = Mapping[str, Any]

_READERS: dict[Kind, Callable[[Any, Path | None], Any]] = {
    Kind.MATERIAL: find_material,
    Kind.SHAPE: find_shape,
    Kind.OPENING_CURVE: find_opening_curve,
}


def build_case(values: Values, folder: Path | None = None) -> Case:
    """Make a case of raw values.

    Parameters
    ----------
    values : mapping
        Raw values by key; an input that is missing has its default.
    folder : Path, optional
        Where relative paths of materials, shapes and opening curves start.

    Raises
    ------
    BadInput
        In the titles of the inputs; see `in_words`.
    """
    model, numerics = build_method(values, folder)
    stone = Stone(**_section("stone", values, folder))
    ureter = Ureter(**_section("ureter", values, folder))
    return Case(stone, ureter, build_load(values), model, numerics)


def build_load(values: Values) -> Load:
    """Make the load of raw values."""
    return Load(**_section("load", values, None))


def build_method(values: Values, folder: Path | None = None) -> tuple[Model, Numerics]:
    """Make model and numerics; an option that the model does not have is refused."""
    name = values.get(MODEL, SeatedBalance.NAME)
    chosen = inputs_of(model_named(name))
    numerical = inputs_of(Numerics)
    for key in values:
        section, _, field = key.partition(".")
        if section != "method" or key == MODEL or field in chosen or field in numerical:
            continue
        known = " or ".join(f"'{each}'" for each in models_with(field))
        raise Misplaced(all_inputs()[key].title, f"the model '{name}'", f"belongs to {known}")
    numerics = Numerics(**{n: values[f"method.{n}"] for n in numerical if f"method.{n}" in values})
    return build_model(name, values, folder), numerics


def build_model(name: str, values: Values, folder: Path | None = None) -> Model:
    """Make a model by its name of those values that are its own options."""
    owner = MODELS[name]
    own = _section("method", values, folder)
    return owner(**{field: own[field] for field in inputs_of(owner) if field in own})


def in_words(problem: BadInput, words: Mapping[str, str]) -> BadInput:
    """The same refusal with the input named as the door names it; `words` are by title."""
    return problem.named(words[problem.argument]) if problem.argument in words else problem


def _section(section: str, values: Values, folder: Path | None) -> dict[str, Any]:
    found = {}
    for key, value in values.items():
        if key.partition(".")[0] == section and key != MODEL:
            declared = all_inputs()[key]
            read = _READERS.get(declared.declaration.kind)
            found[declared.name] = value if read is None else read(value, folder)
    return found
