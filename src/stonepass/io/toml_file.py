"""TOML files from outside: read, checked against a schema, refused in one sentence."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from stonepass.errors import BadInput, refuse_unknown
from stonepass.io.text_file import read_text

__all__ = ["read_toml"]

LARGEST_FILE, LONGEST_LINE = 100_000, 1000  # bytes, characters

Schema = TypeVar("Schema", bound=BaseModel)

_ALLOWED = {
    "missing": "given",
    "string_type": "text in quotes",
    "float_type": "a number",
    "bool_type": "true or false",
    "too_long": "shorter",
    "tuple_type": "a list",
    "string_too_short": "not empty",
}


def read_toml(path: Path, schema: type[Schema]) -> Schema:
    """Read a TOML file into `schema`.

    Raises
    ------
    BadInput
        Naming the file and the key: missing or broken file, a key that is unknown (with the
        nearest known one), missing or of the wrong type.
    """
    text = read_text(path, LARGEST_FILE, "valid TOML")
    longest = max(map(len, text.splitlines()), default=0)
    if longest > LONGEST_LINE:  # a key of many parts takes minutes to read
        shown = f"a line of {longest} characters"
        raise BadInput(f"in {path.name}, the longest line", shown, f"at most {LONGEST_LINE}")
    try:
        raw = tomllib.loads(text)
    except (ValueError, RecursionError) as problem:  # integers of 5000 digits are a ValueError too
        raise BadInput("file", path, f"valid TOML ({problem})") from problem
    _refuse_stray_keys(raw, schema, path.name, "")
    try:
        return schema.model_validate(raw)
    except ValidationError as problem:
        first = problem.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        missing = first["type"] == "missing"
        allowed = _ALLOWED.get(first["type"], f"valid ({first['msg']})")
        value = "missing" if missing else first["input"]
        raise BadInput(f"in {path.name}, '{key}'", value, allowed) from problem


def _refuse_stray_keys(
    raw: dict[str, Any], schema: type[BaseModel], file: str, section: str
) -> None:
    fields = schema.model_fields
    for key, value in raw.items():
        if key not in fields:
            where = f"key of [{section}]" if section else "key"
            refuse_unknown(f"in {file}, {where}", key, list(fields))
        inner = fields[key].annotation
        if isinstance(inner, type) and issubclass(inner, BaseModel):
            if not isinstance(value, dict):
                raise BadInput(f"in {file}, '{key}'", value, f"a section, written [{key}]")
            _refuse_stray_keys(value, inner, file, key)
