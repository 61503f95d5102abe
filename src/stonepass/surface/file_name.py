"""The name of a file in a sentence: short enough to leave room for what is wrong with it."""

from __future__ import annotations

from pathlib import Path

__all__ = ["said_of", "short_name"]

LONGEST = 40  # characters of a name
SAID = 160  # characters of what a library says


def short_name(path: Path) -> str:
    """Return the name of a file; the middle of a long one is left out."""
    name = path.name.encode(errors="replace").decode()
    half = LONGEST // 2 - 2
    return name if len(name) <= LONGEST else f"{name[:half]}...{name[-half:]}"


def said_of(path: Path, problem: BaseException) -> str:
    """Return in one line what a library says of a file, which it need not name."""
    said = " ".join(f"{type(problem).__name__}: {problem}".split())
    for name in (str(path), path.name):
        said = said.replace(repr(name), "the file").replace(name, "the file")
    return said if len(said) <= SAID else said[: SAID - 3] + "..."
