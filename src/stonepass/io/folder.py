"""Check of output folders before a calculation begins."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryFile

from stonepass.errors import BadInput

__all__ = ["require_writable"]


def require_writable(folder: Path, what: str, remedy: str = "") -> None:
    """Make a folder, and check that files can be written in it.

    Parameters
    ----------
    folder : Path
        The folder.
    what : str
        Name of the folder or option in messages.
    remedy : str
        The action that helps the user if the check fails; may be empty.

    Raises
    ------
    BadInput
        The folder cannot be made or written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder) as file:
            file.write(b"0")
    except OSError as problem:
        allowed = f"writable ({problem.strerror})"
        raise BadInput(what, str(folder), allowed, remedy) from problem
