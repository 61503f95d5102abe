"""Pydantic models of the sections of case files, for other files with the same sections."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field, create_model

from stonepass.declaration import Kind
from stonepass.inputs.catalogue import sections
from stonepass.inputs.schema import property_schema

__all__ = ["FileSection", "section_model", "section_values"]

_TYPES: dict[Kind, Any] = {
    Kind.NUMBER: float,
    Kind.WHOLE: int,
    Kind.FLAG: bool,
    Kind.SHAPE: str | dict[str, Any],
    Kind.MATERIAL: str | dict[str, Any],
    Kind.OPENING_CURVE: str | dict[str, Any],
}


class FileSection(BaseModel):
    """A section of a TOML file; unknown keys and values of another type are refused."""

    model_config = ConfigDict(extra="forbid", strict=True)


def section_model(section: str) -> type[FileSection]:
    """Return the pydantic model of a section of a case file, made from the declared inputs.

    The JSON schema of the model has the meanings, bounds and defaults of the inputs.
    """
    keys: dict[str, Any] = {}
    for name, each in sections()[section].items():
        schema = property_schema(each)
        meaning = schema.pop("description")
        extra: dict[str, Any] = {
            key: schema[key] for key in ("enum", "minimum", "maximum", "pattern") if key in schema
        }
        field = Field(None, description=meaning, json_schema_extra=extra)
        keys[name] = (_TYPES.get(each.declaration.kind, str) | None, field)
    return create_model(f"{section.title()}Section", __base__=FileSection, **keys)


def section_values(parsed: FileSection, section: str) -> dict[str, Any]:
    """Return the given values of a section.

    Parameters
    ----------
    parsed : FileSection
        The section that was read.
    section : str
        Name of the section.

    Returns
    -------
    dict of str to value
        Raw values by key ``section.name``.
    """
    given = parsed.model_dump(exclude_none=True)
    return {f"{section}.{name}": value for name, value in given.items()}
