"""The case of a request: the sections of a case file, in which nothing may name a file."""

from __future__ import annotations

import re
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, create_model

from stonepass.declaration import Kind
from stonepass.errors import BadInput, refuse_unknown
from stonepass.inputs.build import build_case
from stonepass.inputs.catalogue import all_inputs, sections
from stonepass.inputs.material_file import find_material
from stonepass.inputs.overlay import refuse_pairs
from stonepass.inputs.sections import section_model, section_values
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.known_laws import ONES_OWN
from stonepass.materials.protocol import Material
from stonepass.model.case import Case

__all__ = ["TABLES", "CaseBody", "case_of", "refuse_files", "values_of_body"]

MATERIAL = "ureter.material"
NO_FILES = "stonepass serve opens no file that a request names"
TABLES = {
    Kind.SHAPE: "a table with 'aspect', or with the lists of points 'z' and 'rho'",
    Kind.OPENING_CURVE: "a table with the lists 'alpha_deg' and 'radius_ratio'",
}


class _Body(BaseModel):
    """The sections of a case file."""

    model_config = ConfigDict(extra="forbid")


CaseBody: type[BaseModel] = create_model(
    "Case",
    __base__=_Body,
    **{  # type: ignore[call-overload]
        section: (
            section_model(section) | None,
            Field(None, description=f"section `{section}` of a case file"),
        )
        for section in sections()
    },
)


def values_of_body(body: BaseModel) -> dict[str, Any]:
    """Return the raw values of a case by key, after files have been refused.

    Parameters
    ----------
    body : BaseModel
        The case of a request.

    Raises
    ------
    BadInput
        A value names a file, or two inputs determine the same quantity.
    """
    values: dict[str, Any] = {}
    for section in sections():
        part = getattr(body, section)
        if part is not None:
            values |= section_values(part, section)
    refuse_files(values)
    refuse_pairs(values, {key: key for key in values})
    return values


def case_of(body: BaseModel, size_ratio: float | None = None) -> Case:
    """Return the case of a request.

    Parameters
    ----------
    body : BaseModel
        The case of a request.
    size_ratio : float, optional
        Size ratio that replaces the size of the stone of the request.

    Raises
    ------
    BadInput
        A value names a file, is out of bounds, or contradicts another one.
    """
    values = values_of_body(body)
    table = values.get(MATERIAL)
    if isinstance(table, dict):
        values[MATERIAL] = _material_of(table)
    if size_ratio is not None:
        sizes = ("stone.diameter", "stone.size_ratio")
        values = {key: value for key, value in values.items() if key not in sizes}
        values["stone.size_ratio"] = size_ratio
    return build_case(values)


def _material_of(table: dict[str, Any]) -> Material:
    """Return the material of a table of constants.

    Errors name the key of the request, e.g. ``ureter.material.C10``.
    """
    try:
        return find_material(table)
    except BadInput as problem:
        key = problem.argument.removeprefix("material, ").strip("'")
        stray = re.fullmatch(r"key(?: of \[([\w.]+)\])?", key)
        if stray:  # a table has a key that is not known
            unknown, known = str(problem.value), problem.allowed.removeprefix("one of ")
            section, inner = MATERIAL, table
            for part in stray[1].split(".") if stray[1] else ():
                section, inner = f"{section}.{part}", inner[part]
            where, value = f"{section}.{unknown}", inner[unknown]
            if not re.fullmatch(r"\w+", unknown):
                where, value = section, f"a table with the key '{unknown}'"
            raise BadInput(where, value, "left out, because there is no such key",
                           problem.remedy or f"known keys are {known}") from problem  # fmt: skip
        where = f"{MATERIAL}.{key}" if re.fullmatch(r"[\w.]+", key) else MATERIAL
        # A law of one's own is a Python file, which a request cannot name.
        remedy = problem.remedy.removesuffix(ONES_OWN).removesuffix("; ")
        raise BadInput(where, problem.value, problem.allowed, remedy) from problem


def refuse_files(values: dict[str, Any]) -> None:
    """Refuse values that would be read as the name of a file.

    A material is a name of the catalogue or a table of constants. A shape and an opening curve are
    tables.

    Parameters
    ----------
    values : dict of str to value
        Raw values by key.

    Raises
    ------
    BadInput
        A value is a text where a table is needed, or a material is not in the catalogue.
    """
    for key, value in values.items():
        declared = all_inputs().get(key)
        kind = None if declared is None else declared.declaration.kind
        if kind is Kind.MATERIAL and isinstance(value, str) and value not in CATALOGUE:
            refuse_unknown(
                "material", value, list(CATALOGUE), f"or a table of constants; {NO_FILES}"
            )
        if kind in TABLES and isinstance(value, str):
            assert declared is not None
            raise BadInput(declared.title, value, TABLES[kind], NO_FILES)
