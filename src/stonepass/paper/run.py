"""The whole paper: jobs of the parts, solved once; every part written; one page over all."""

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
    """A part of the paper; see `PartStudy`, which makes a study of it."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return what must be solved for it."""

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Write pictures and data into a folder and return what the page says of them."""


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
    """The parts meant by names: none or ``all`` is every one, ``claims`` those that have any."""
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
    """Solve what the parts need, write them into `folder`, and ``index.html`` over them.

    Parameters
    ----------
    names : sequence of str
        Parts (see `chosen`).
    folder : Path
        Made on demand.
    asked : Asked
        Limit and measured points.
    executor : concurrent.futures.Executor, optional
        By default the work runs in this process.
    cache_folder : Path, optional
        Folder of the solution cache; without one everything is solved.
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
    """What the answers behind a part warn of, each kind once; errors are left out on purpose."""
    sizes = [size.at_size for size in found.sizes.values() if size.at_size is not None]
    answers = [*found.pressures.values(), *sizes]
    return tuple(grouped_warnings(answers, left_out=("error_not_estimated",)))
