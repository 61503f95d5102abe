"""Reader of TOML files into nested dictionaries."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput
from stonepass.io.text_file import read_text

__all__ = ["read_document"]

LARGEST_FILE = 100_000  # largest size of a file in bytes
LONGEST_LINE = 1000  # largest number of characters of a line


def read_document(path: Path) -> dict[str, Any]:
    """Read a TOML file.

    Raises
    ------
    BadInput
        The file does not exist, is larger than 100 kB, has a line of more than 1000 characters, or
        is no valid TOML.
    """
    text = read_text(path, LARGEST_FILE, "valid TOML")
    longest = max(map(len, text.splitlines()), default=0)
    if longest > LONGEST_LINE:  # reading a key of very many parts would take minutes
        shown = f"a line of {longest} characters"
        raise BadInput(f"in {path.name}, the longest line", shown, f"at most {LONGEST_LINE}")
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as problem:  # Python also refuses integers of 5000 digits
        raise BadInput("file", path, f"valid TOML ({problem})") from problem
