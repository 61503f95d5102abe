"""Sections of TOML files that other files share with case files, as pydantic models."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, create_model

from stonepass.declaration import Kind
from stonepass.inputs.catalogue import sections

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
    """A section of a TOML file: no unknown keys, no conversions."""

    model_config = ConfigDict(extra="forbid", strict=True)


def section_model(section: str) -> type[FileSection]:
    """The pydantic model of a section of a case file, made from the declared inputs."""
    keys: dict[str, Any] = {
        name: (_TYPES.get(each.declaration.kind, str) | None, None)
        for name, each in sections()[section].items()
    }
    return create_model(f"{section.title()}Section", __base__=FileSection, **keys)


def section_values(parsed: FileSection, section: str) -> dict[str, Any]:
    """The values that were given in a section, by key."""
    given = parsed.model_dump(exclude_none=True)
    return {f"{section}.{name}": value for name, value in given.items()}
