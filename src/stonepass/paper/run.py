"""Reproduction of the paper: the jobs of all parts, their sections, and the page of all."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from stonepass.errors import refuse_unknown
from stonepass.io.folder import require_writable
from stonepass.paper.fig6 import Fig6
from stonepass.paper.fig8 import Fig8
from stonepass.paper.fig9 import Fig9
from stonepass.paper.micrograph import Eq18
from stonepass.paper.page import write_page
from stonepass.paper.seated_figures import Fig4, Fig5, Fig7
from stonepass.paper.section import Asked, Section
from stonepass.paper.sensitivity import Sensitivity
from stonepass.report.table import grouped_warnings
from stonepass.studies.jobs import Job, Progress, Results
from stonepass.studies.study import run_studies

__all__ = ["PARTS", "Part", "PartStudy", "chosen", "reproduce"]


@runtime_checkable
class Part(Protocol):
    """A part of the paper; `PartStudy` makes a study of it."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return the jobs of the part."""

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Write pictures and data into a folder and return the section of the page."""


@dataclass(frozen=True)
class PartStudy:
    """A part of the paper as a study whose outcome is its section, written into `folder`."""

    part: Part
    asked: Asked
    folder: Path

    def jobs(self) -> list[Job[Any]]:
        """Return the jobs of the part."""
        return self.part.jobs(self.asked)

    def reduce(self, results: Results) -> Section:
        """Write the part and return its section, with the warnings behind its answers."""
        section = self.part.write(results, self.asked, self.folder)
        return replace(section, warnings=_warnings(results))


PARTS: dict[str, Part] = {
    "fig4": Fig4(),
    "fig5": Fig5(),
    "fig6": Fig6(),
    "fig7": Fig7(),
    "fig8": Fig8(),
    "fig9": Fig9(),
    "friction": Eq18(),
    "sensitivity": Sensitivity(),
}
WITH_CLAIMS = ("fig6", "fig7", "fig8", "fig9", "friction")


def chosen(names: Sequence[str]) -> list[str]:
    """Return the names of parts; none or ``all`` mean all, ``claims`` means those with claims."""
    known = [*PARTS, "claims", "all"]
    for name in names:
        if name not in known:
            refuse_unknown("part of the paper", name, known)
    if not names or "all" in names:
        return list(PARTS)
    wanted = {*names, *(WITH_CLAIMS if "claims" in names else ())}
    return [name for name in PARTS if name in wanted]


def reproduce(
    names: Sequence[str],
    folder: Path,
    asked: Asked,
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: Progress | None = None,
) -> list[Section]:
    """Solve the jobs of the parts, and write the parts and ``index.html`` into `folder`.

    Parameters
    ----------
    names : sequence of str
        Parts (see `chosen`).
    folder : Path
        Folder, which is made if necessary.
    asked : Asked
        Limit and measured points.
    executor : concurrent.futures.Executor, optional
        By default the work runs in this process.
    cache_folder : Path, optional
        Folder of the solution cache; by default there is no cache.
    progress : callable, optional
        Is called with (done, all) after each job.

    Raises
    ------
    BadInput
        For an unknown part, or a folder that cannot be written.
    """
    wanted = chosen(names)
    require_writable(folder, "output folder")
    studies = [PartStudy(PARTS[name], asked, folder) for name in wanted]
    sections = run_studies(studies, executor, cache_folder, progress)
    missing = [name for name in PARTS if name not in wanted]
    write_page(sections, asked, folder / "index.html", missing)
    return sections


def _warnings(found: Results) -> tuple[str, ...]:
    """Return the warnings of a part, each kind once; missing error estimates are intended."""
    sizes = [size.at_size for size in found.sizes.values() if size.at_size is not None]
    answers = [*found.pressures.values(), *sizes]
    return tuple(grouped_warnings(answers, left_out=("error_not_estimated",)))
