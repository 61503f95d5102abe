"""The friction coefficient of a surface, handed on as JSON by ``stonepass friction``."""

from __future__ import annotations

import json
import math
from pathlib import Path

from stonepass.errors import BadInput

__all__ = ["read_friction"]

LARGEST_FILE = 10_000_000  # bytes
KEY = "friction_coefficient"


def read_friction(path: Path) -> float:
    """Read ``friction_coefficient`` from a JSON file.

    Raises
    ------
    BadInput
        No such file, one that is too large or no JSON object, or no finite number under that key.
    """
    if not path.is_file():
        raise BadInput("friction file", str(path), "a file that exists", "check the path")
    if path.stat().st_size > LARGEST_FILE:
        raise BadInput("friction file", str(path), f"smaller than {LARGEST_FILE // 1_000_000} MB")
    try:
        document = json.loads(path.read_bytes())
    except (ValueError, RecursionError) as problem:
        raise BadInput("friction file", str(path), f"valid JSON ({problem})") from problem
    if not isinstance(document, dict) or KEY not in document:
        allowed = "as 'stonepass friction IMAGE --json' writes it"
        raise BadInput(f"in {path.name}, '{KEY}'", "missing", allowed)
    value = document[KEY]
    try:
        number = math.nan if isinstance(value, bool | str) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise BadInput(f"in {path.name}, '{KEY}'", value, "a number")
    return number
