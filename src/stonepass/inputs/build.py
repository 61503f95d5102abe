"""Construction of cases from the raw values that case files and the command line provide.

Raw values are texts, numbers and booleans by the key of the input, e.g.
``{"stone.diameter": "4.2 mm"}``. Files that they name are read here, and combinations that are not
allowed are refused. Errors name an input by its title; `in_words` replaces the title by the name
that the user knows, such as ``--stone`` or ``'stone.diameter'``.
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
    """Make a case from raw values.

    Parameters
    ----------
    values : mapping of str to value
        Raw values by key; an input that is missing has its default.
    folder : Path, optional
        Folder in which relative paths of materials, shapes and opening curves start; by default the
        current one.

    Raises
    ------
    BadInput
        A value is out of bounds, or two values contradict each other. The message names the inputs
        by their titles (see `in_words`).
    """
    model, numerics = build_method(values, folder)
    stone = Stone(**_section("stone", values, folder))
    ureter = Ureter(**_section("ureter", values, folder))
    return Case(stone, ureter, build_load(values), model, numerics)


def build_load(values: Values) -> Load:
    """Make the load of a case from raw values."""
    return Load(**_section("load", values, None))


def build_method(values: Values, folder: Path | None = None) -> tuple[Model, Numerics]:
    """Make the model and the numerics from raw values.

    Parameters
    ----------
    values : mapping of str to value
        Raw values by key; the key ``method.model`` names the model.
    folder : Path, optional
        Folder in which the relative path of an opening curve starts.

    Raises
    ------
    BadInput
        The model is unknown, it does not have one of the options, or a value is out of bounds.
    """
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
    """Make a model from raw values; values that are no options of this model are ignored.

    Parameters
    ----------
    name : str
        Name of a registered model.
    values : mapping of str to value
        Raw values by key.
    folder : Path, optional
        Folder in which the relative path of an opening curve starts.

    Raises
    ------
    BadInput
        A value is out of bounds, or two values contradict each other.
    """
    owner = MODELS[name]
    own = _section("method", values, folder)
    return owner(**{field: own[field] for field in inputs_of(owner) if field in own})


def in_words(problem: BadInput, words: Mapping[str, str]) -> BadInput:
    """Return an error with the title of its input replaced by the name that the user knows.

    Parameters
    ----------
    problem : BadInput
        The error; its argument may be the title of an input.
    words : mapping of str to str
        Names of the inputs by their titles, e.g. ``{"friction": "--friction"}``.
    """
    return problem.named(words[problem.argument]) if problem.argument in words else problem


def _section(section: str, values: Values, folder: Path | None) -> dict[str, Any]:
    found = {}
    for key, value in values.items():
        if key.partition(".")[0] == section and key != MODEL:
            declared = all_inputs()[key]
            read = _READERS.get(declared.declaration.kind)
            found[declared.name] = value if read is None else read(value, folder)
    return found
