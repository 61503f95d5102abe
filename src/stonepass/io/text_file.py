"""Files of text: read if there, small enough, readable, written if writable, else refused in one
sentence."""

from __future__ import annotations

from pathlib import Path

from stonepass.errors import BadInput, require

__all__ = ["existing", "read_text", "write_text"]


def existing(path: Path, what: str = "file") -> Path:
    """The path, refused where no file is there."""
    try:
        there = path.is_file()
    except (OSError, ValueError):  # a name too long for the system, or with a NUL
        there = False
    if not there:
        raise BadInput(what, path, "a file that exists", "check the path")
    return path


def read_text(path: Path, largest: int, kind: str, what: str = "file") -> str:
    """The text of a file in UTF-8 of at most `largest` bytes, a byte order mark left out.

    Raises
    ------
    BadInput
        Naming the file; `kind` is what it should have been.
    """
    existing(path, what)
    size = f"{largest // 1000} kB" if largest < 1_000_000 else f"{largest // 1_000_000} MB"
    try:
        require(path.stat().st_size <= largest, what, path, f"smaller than {size}")
        with path.open("rb") as file:
            raw = file.read(largest + 1)  # some files do not know their size
        require(len(raw) <= largest, what, path, f"smaller than {size}")
        return raw.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as problem:
        raise BadInput(what, path, f"{kind} ({problem})") from problem


def write_text(path: Path, text: str) -> None:
    """Write a file in UTF-8.

    Raises
    ------
    BadInput
        It cannot be written.
    """
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as problem:
        raise BadInput("output file", str(path), f"writable ({problem.strerror})") from problem
