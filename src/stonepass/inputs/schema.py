"""Generator of the JSON schema of case files from the declared inputs."""

from __future__ import annotations

from typing import Any

from stonepass.declaration import DeclaredInput, Kind
from stonepass.inputs.catalogue import models_with, sections
from stonepass.units import Length, Pressure, text_pattern

__all__ = ["case_schema", "property_schema"]

_TYPES: dict[Kind, Any] = {
    Kind.NUMBER: "number",
    Kind.WHOLE: "integer",
    Kind.FLAG: "boolean",
    Kind.SHAPE: ["string", "object"],
    Kind.MATERIAL: ["string", "object"],
    Kind.OPENING_CURVE: ["string", "object"],
}
_QUANTITIES: dict[Kind, type[Length] | type[Pressure]] = {
    Kind.LENGTH: Length,
    Kind.PRESSURE: Pressure,
}


def case_schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of a case file.

    Lengths and pressures are texts with a unit; their bounds are part of the description.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "stonepass case",
        "type": "object",
        "additionalProperties": False,
        "required": ["stone", "ureter"],
        "properties": {
            section: {
                "type": "object",
                "additionalProperties": False,
                "properties": {name: property_schema(each) for name, each in keys.items()},
            }
            for section, keys in sections().items()
        },
    }


def property_schema(each: DeclaredInput) -> dict[str, Any]:
    """Return the JSON Schema of one input: type, meaning, choices, bounds and default."""
    declaration = each.declaration
    found: dict[str, Any] = {
        "type": _TYPES.get(declaration.kind, "string"),
        "description": _description(each),
    }
    if declaration.kind in _QUANTITIES:
        found["pattern"] = text_pattern(_QUANTITIES[declaration.kind])
    if declaration.choices:
        found["enum"] = list(declaration.choices)
    if declaration.bounds is not None and declaration.kind in (Kind.NUMBER, Kind.WHOLE):
        found["minimum"], found["maximum"] = declaration.bounds
    if each.default is not None:
        found["default"] = _plain(each.default)
    return found


def _description(each: DeclaredInput) -> str:
    declaration, models = each.declaration, models_with(each.name)
    parts = [declaration.meaning]
    if declaration.kind in (Kind.LENGTH, Kind.PRESSURE) and declaration.bounds is not None:
        parts.append(f"Text with a unit, {declaration.allowed}.")
    if each.section == "method" and models and len(models) < 3:
        parts.append("Model " + " or ".join(models) + " only.")
    return " ".join(parts)


def _plain(value: Any) -> Any:
    return f"{value / 1e3:g} kPa" if type(value).__name__ == "Pressure" else value
