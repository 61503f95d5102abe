"""TOML files from outside as nested dictionaries, refused in one sentence where they are none."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput
from stonepass.io.text_file import read_text

__all__ = ["read_document"]

LARGEST_FILE, LONGEST_LINE = 100_000, 1000  # bytes, characters


def read_document(path: Path) -> dict[str, Any]:
    """Read a TOML file.

    Raises
    ------
    BadInput
        A missing file, one larger than 100 kB, a line that is too long, or broken TOML.
    """
    text = read_text(path, LARGEST_FILE, "valid TOML")
    longest = max(map(len, text.splitlines()), default=0)
    if longest > LONGEST_LINE:  # a key of many parts takes minutes to read
        shown = f"a line of {longest} characters"
        raise BadInput(f"in {path.name}, the longest line", shown, f"at most {LONGEST_LINE}")
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as problem:  # integers of 5000 digits are a ValueError too
        raise BadInput("file", path, f"valid TOML ({problem})") from problem
