"""Names of files and texts of libraries, shortened for use in messages."""

from __future__ import annotations

from pathlib import Path

__all__ = ["said_of", "short_name"]

LONGEST = 40  # largest number of characters of a file name in a message
SAID = 160  # largest number of characters of the message of a library


def short_name(path: Path) -> str:
    """Return the name of a file; the middle of a long one is left out."""
    name = path.name.encode(errors="replace").decode()
    half = LONGEST // 2 - 2
    return name if len(name) <= LONGEST else f"{name[:half]}...{name[-half:]}"


def said_of(path: Path, problem: BaseException) -> str:
    """Return the error message of a library in one line, without the name of the file.

    Parameters
    ----------
    path : Path
        The file; its path and name are replaced by "the file".
    problem : BaseException
        The error that the library raised.
    """
    said = " ".join(f"{type(problem).__name__}: {problem}".split())
    for name in (str(path), path.name):
        said = said.replace(repr(name), "the file").replace(name, "the file")
    return said if len(said) <= SAID else said[: SAID - 3] + "..."
