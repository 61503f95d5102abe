"""The whole paper: jobs of the parts, solved once; every part written; one page over all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

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
from stonepass.studies.executor import executor
from stonepass.studies.jobs import Job, Results, run_jobs

__all__ = ["PARTS", "Part", "chosen", "reproduce"]


class Part(Protocol):
    """A part of the paper."""

    def jobs(self, asked: Asked) -> list[Job]:
        """What must be solved for it."""

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Write pictures and data into a folder."""


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
    store: Path | None = None,
    workers: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[Section]:
    """Solve what the parts need, write them into `folder`, and ``index.html`` over them.

    Parameters
    ----------
    names : sequence of str
        Parts (see `chosen`).
    asked : Asked
        Limit and measured points.
    store : Path, optional
        Folder of remembered finite-element results; without one everything is solved.
    progress : callable
        Told (done, all) of the jobs.
    """
    wanted = chosen(names)
    require_writable(folder, "output folder")
    jobs = {name: PARTS[name].jobs(asked) for name in wanted}
    found = run_jobs([job for each in jobs.values() for job in each], store, workers, progress)
    with executor(workers) as pool:
        parts = [
            pool.submit(PARTS[name].write, found.of(jobs[name]), asked, folder) for name in wanted
        ]
        sections = [
            replace(part.result(), warnings=_warnings(found.of(jobs[name])))
            for name, part in zip(wanted, parts, strict=True)
        ]
    write_page(sections, asked, folder / "index.html")
    return sections


def _warnings(found: Results) -> tuple[str, ...]:
    """What the answers behind a part warn of, each kind once; errors are left out on purpose."""
    sizes = [size.at_size for size in found.sizes.values() if size.at_size is not None]
    told = grouped_warnings([*found.pressures.values(), *sizes])
    return tuple(each for each in told if "the error is not estimated" not in each)
