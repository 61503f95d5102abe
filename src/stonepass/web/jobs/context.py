"""The context that a worker process gives to the function that does a job."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
    area : sequence of 4 int, or None
        Part of the uploaded image that was chosen when it was uploaded, see `PixelArea`.
    format : str
        Format of the report to print, ``html`` or ``pdf``; empty for no report.
    """

    tell: Tell
    cache_folder: Path | None = None
    file: Path | None = None
    area: Sequence[int] | None = None
    format: str = ""


@dataclass(frozen=True)
class Done:
    """The result of a job.

    Attributes
    ----------
    result : dict
        The JSON-ready result.
    page : str
        The report to print as an HTML page; empty if no report was asked for.
    """

    result: dict[str, Any]
    page: str = ""
