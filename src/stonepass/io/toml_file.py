"""Reader of TOML files that are checked against a pydantic schema."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from stonepass.errors import BadInput, refuse_unknown
from stonepass.io.toml_document import read_document

__all__ = ["merged", "parse_table", "read_toml"]

Schema = TypeVar("Schema", bound=BaseModel)

_ALLOWED = {
    "missing": "given",
    "string_type": "text in quotes",
    "float_type": "a number",
    "bool_type": "true or false",
    "too_long": "shorter",
    "tuple_type": "a list",
    "dict_type": "a table",
    "string_too_short": "not empty",
}


def read_toml(path: Path, schema: type[Schema]) -> Schema:
    """Read a TOML file and check it against a schema.

    Parameters
    ----------
    path : Path
        The TOML file.
    schema : type
        The pydantic model of the file.

    Raises
    ------
    BadInput
        The file cannot be read, or a key is unknown (the message names the nearest known one),
        missing or of the wrong type. The message names the file and the key.
    """
    return parse_table(read_document(path), schema, f"in {path.name}, ")


def merged(found: dict[str, Any], more: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entries of both tables.

    Raises
    ------
    BadInput
        Both tables have the same key, e.g. because TOML has it once quoted and once with a dot.
    """
    for key in more:
        if key in found:
            raise BadInput(f"'{key}'", "given twice", "given once")
    return {**found, **more}


def parse_table(raw: dict[str, Any], schema: type[Schema], where: str) -> Schema:
    """Check a table against a schema.

    Parameters
    ----------
    raw : dict
        The table as it was read.
    schema : type
        The pydantic model of the table.
    where : str
        Beginning of the messages, e.g. the name of the file.

    Raises
    ------
    BadInput
        A key is unknown (the message names the nearest known one), missing or of the wrong type.
    """
    _refuse_stray_keys(raw, schema, where, "")
    try:
        return schema.model_validate(raw)
    except ValidationError as problem:
        first = problem.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        missing = first["type"] == "missing"
        allowed = _ALLOWED.get(first["type"], f"valid ({first['msg']})")
        value = "missing" if missing else first["input"]
        raise BadInput(f"{where}'{key}'", value, allowed) from problem


def _refuse_stray_keys(
    raw: dict[str, Any], schema: type[BaseModel], begin: str, section: str
) -> None:
    fields = schema.model_fields
    for key, value in raw.items():
        if key not in fields:
            where = f"key of [{section}]" if section else "key"
            refuse_unknown(f"{begin}{where}", key, list(fields))
        inner = fields[key].annotation
        if isinstance(inner, type) and issubclass(inner, BaseModel):
            if not isinstance(value, dict):
                raise BadInput(f"{begin}'{key}'", value, f"a section, written [{key}]")
            _refuse_stray_keys(value, inner, begin, key)
