"""Reader and writer of case files, TOML files that describe a `Case`."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w

from stonepass.declaration import DeclaredInput, Kind, inputs_of
from stonepass.errors import BadInput, refuse_unknown
from stonepass.inputs.build import build_case, in_words
from stonepass.inputs.catalogue import MODEL, all_inputs, sections
from stonepass.inputs.material_file import material_table
from stonepass.inputs.opening_curve_file import opening_curve_table
from stonepass.inputs.shape_file import shape_table
from stonepass.io.text_file import write_file
from stonepass.io.toml_document import read_document
from stonepass.materials.protocol import Material, names_a_file
from stonepass.model.case import Case
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.shape import Shape
from stonepass.units import Length, Pressure, exact_length, exact_pressure

__all__ = [
    "WORDS",
    "checked_values",
    "held_values",
    "read_case",
    "read_values",
    "values_of",
    "write_case",
]

REQUIRED = ("stone", "ureter")
# Types of TOML values for each kind of input, and their names in messages. A table may be given
# instead of the name of a file.
_TYPES: dict[Kind, tuple[tuple[type, ...], str]] = {
    Kind.LENGTH: ((str,), "text in quotes"),
    Kind.PRESSURE: ((str,), "text in quotes"),
    Kind.NUMBER: ((int, float), "a number"),
    Kind.WHOLE: ((int,), "a whole number"),
    Kind.FLAG: ((bool,), "true or false"),
    Kind.CHOICE: ((str,), "text in quotes"),
    Kind.MATERIAL: ((str, dict), "text in quotes or a table"),
    Kind.SHAPE: ((str, dict), "text in quotes or a table"),
    Kind.OPENING_CURVE: ((str, dict), "text in quotes or a table"),
}
# Names of the inputs in a case file, by their titles.
WORDS = {each.title: f"'{each.key}'" for each in all_inputs().values()}


def read_case(path: str | Path) -> Case:
    """Read a case file.

    Parameters
    ----------
    path : str or Path
        A TOML file. Relative paths of materials, shapes and opening curves start at its folder.

    Raises
    ------
    BadInput
        The file does not exist or is no valid TOML, a key is unknown or missing, or a value has the
        wrong type or is out of bounds. The message names the file and the key.
    """
    path = Path(path)
    values = read_values(path)
    try:
        return build_case(values, path.parent)
    except BadInput as problem:
        raise in_words(problem, WORDS).within(path.name) from problem


def read_values(path: Path) -> dict[str, Any]:
    """Return the raw values of a case file by key; only keys and types are checked.

    Raises
    ------
    BadInput
        The file cannot be read or is no valid TOML, a key is unknown, a required section is
        missing, or a value has the wrong type.
    """
    document = read_document(path)
    values = checked_values(document, path)
    for section in REQUIRED:
        if section not in document:
            raise BadInput(f"in {path.name}, '{section}'", "missing", "given")
    return values


def checked_values(document: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """Return the raw values of the sections of a case file by key.

    Parameters
    ----------
    document : mapping of str to section
        The sections that were read; none is required.
    path : Path
        The file, whose name is part of messages.

    Raises
    ------
    BadInput
        A section or a key is unknown, or a value has the wrong type.
    """
    known = sections()
    for section, keys in document.items():
        if section not in known:
            refuse_unknown(f"in {path.name}, key", section, list(known))
        if not isinstance(keys, dict):
            raise BadInput(f"in {path.name}, '{section}'", keys, f"a section, written [{section}]")
    return {
        f"{section}.{name}": _checked(path, known[section], section, name, value)
        for section, keys in document.items()
        for name, value in keys.items()
    }


def _checked(
    path: Path, known: Mapping[str, DeclaredInput], section: str, name: str, value: Any
) -> Any:
    if name not in known:
        refuse_unknown(f"in {path.name}, key of [{section}]", name, list(known))
    types, allowed = _TYPES[known[name].declaration.kind]
    is_flag = isinstance(value, bool)
    if not isinstance(value, types) or (is_flag and bool not in types):
        raise BadInput(f"in {path.name}, '{section}.{name}'", value, allowed)
    return value


def write_case(case: Case, path: Path) -> None:
    """Write a case file from which `read_case` returns the same case.

    A material of the catalogue is written by its name. Materials, shapes and opening curves that
    were read from files are written as paths relative to the folder of the case file. Other laws,
    shapes and opening curves are written by their numbers.

    Parameters
    ----------
    case : Case
        The case to be written.
    path : Path
        The case file.

    Raises
    ------
    BadInput
        The file cannot be written, or the law is a function that was not read from a file.
    """
    document: dict[str, dict[str, Any]] = {}
    for key, value in values_of(case, path.resolve().parent).items():
        section, _, name = key.partition(".")
        document.setdefault(section, {})[name] = value
    write_file(path, tomli_w.dumps(document), "case file")


def values_of(case: Case, folder: Path) -> dict[str, Any]:
    """Return the raw values of a case by key, as they are written in a case file.

    Parameters
    ----------
    case : Case
        The case to be described.
    folder : Path
        Folder of the case file, at which relative paths start.

    Raises
    ------
    BadInput
        The law is a function that was not read from a file.
    """
    return {key: _raw(value, folder) for key, value in held_values(case).items()}


def held_values(case: Case) -> dict[str, Any]:
    """Return the values of a case by key as objects, e.g. lengths and materials.

    Values that follow from others are left out, so that `build_case` makes the same case of them.
    """
    values: dict[str, Any] = {MODEL: case.model.NAME}
    for part in (case.stone, case.ureter, case.load, case.model, case.numerics):
        for each in inputs_of(type(part)).values():
            value = getattr(part, each.name)
            if value is not None:
                values[each.key] = value
    if case.ureter.outer_diameter is not None:
        del values["ureter.wall_ratio"], values["ureter.wall_thickness"]
    shape = case.stone.shape
    if shape.reference:
        del values["stone.aspect"]
    elif shape.spheroidal:
        del values["stone.shape"]
    else:
        del values["stone.aspect"]
    order = {key: k for k, key in enumerate(all_inputs())}
    return dict(sorted(values.items(), key=lambda item: order[item[0]]))


def _raw(value: Any, folder: Path) -> Any:
    if isinstance(value, Length):
        return exact_length(value)
    if isinstance(value, Pressure):
        return exact_pressure(value)
    if isinstance(value, Material):
        name = value.reference
        if not name:
            return material_table(value)
        return _beside(folder, name) if names_a_file(name) else name
    if isinstance(value, Shape):
        return _beside(folder, value.reference) if value.reference else shape_table(value)
    if isinstance(value, OpeningCurve):
        named = value.reference
        return _beside(folder, named) if named else opening_curve_table(value)
    return value


def _beside(folder: Path, reference: str) -> str:
    """Return the path of a file relative to the folder of the case file."""
    return os.path.relpath(reference, folder)
