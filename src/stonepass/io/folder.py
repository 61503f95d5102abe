"""Folders that results go to: refused before the work, not after it."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryFile

from stonepass.errors import BadInput

__all__ = ["require_writable"]


def require_writable(folder: Path, what: str, remedy: str = "") -> None:
    """Make a folder and try to write in it; `BadInput` where that fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder) as file:
            file.write(b"0")
    except OSError as problem:
        allowed = f"writable ({problem.strerror})"
        raise BadInput(what, str(folder), allowed, remedy) from problem
