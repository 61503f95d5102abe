"""Reader of the friction coefficient in a JSON file of ``stonepass friction``."""

from __future__ import annotations

import json
import math
from pathlib import Path

from stonepass.errors import BadInput, require
from stonepass.io.text_file import read_text
from stonepass.model.stone import FRICTION

__all__ = ["read_friction"]

LARGEST_FILE = 10_000_000  # largest size of the file in bytes
KEY = "friction_coefficient"


def read_friction(path: Path) -> float:
    """Read the key ``friction_coefficient`` of a JSON file.

    Raises
    ------
    BadInput
        The file does not exist, is too large or is no JSON object, or the value is not a number
        from 0 to 2.
    """
    # A redirected output of Windows PowerShell is UTF-16.
    text = read_text(path, LARGEST_FILE, "valid JSON", "friction file", other_encodings=True)
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as problem:
        raise BadInput("friction file", path, f"valid JSON ({problem})") from problem
    if not isinstance(document, dict) or KEY not in document:
        allowed = "given, as in the output of 'stonepass friction IMAGE --json'"
        raise BadInput(f"in {path.name}, '{KEY}'", "missing", allowed)
    value = document[KEY]
    try:
        number = math.nan if isinstance(value, bool | str) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    low, high = FRICTION
    require(low <= number <= high, f"in {path.name}, '{KEY}'", value,
            f"a number from {low:g} to {high:g}")  # fmt: skip
    return number
