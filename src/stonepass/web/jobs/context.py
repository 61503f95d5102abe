"""What a worker process gives to the function that does a job."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

__all__ = ["Context", "Done"]

Tell = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Context:
    """The surroundings of a job.

    Attributes
    ----------
    tell : callable
        Reports the progress: steps done, steps in total (0 if unknown), and a sentence.
    cache_folder : Path or None
        Folder of the solution cache.
    file : Path or None
        The uploaded file, under a name of the server.
    """

    tell: Tell
    cache_folder: Path | None = None
    file: Path | None = None


@dataclass(frozen=True)
class Done:
    """The result of a job.

    Attributes
    ----------
    result : dict
        The JSON-ready result.
    report : str
        The result as an HTML page to print; empty if there is none.
    """

    result: dict[str, Any]
    report: str = ""
