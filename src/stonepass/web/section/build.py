"""Solve the sections that come with the package and write them: run this module to renew them.

The states are those of the paper's model: seated by pressing, with the default friction, without
a load. Solved states are kept in the cache folder of the user.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.contact_state import SolvedState
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.report.section import wall_surface
from stonepass.studies.executor import process_pool
from stonepass.studies.jobs import PressureJob, run_jobs
from stonepass.studies.solution_cache import default_folder
from stonepass.web.section.grid import FOLDER, PLACES, STATIONS, Section, digest, scaled

__all__ = ["build", "case_of_section", "section_of"]

MATERIALS = ("ureter", "latex")
SIZES = (1.02, 1.05, 1.1, 1.17, 1.25, 1.35, 1.47, 1.6)
WALLS = (1.1, 1.16, 1.25, 1.4, 1.6, 1.9, 2.3, 3.0, 4.0)


def case_of_section(material: str, size_ratio: float, wall_ratio: float) -> Case:
    """Return the case of a section."""
    return Case(Stone(size_ratio=size_ratio), Ureter(material=material, wall_ratio=wall_ratio))


def section_of(answer: Answer) -> Section:
    """Return the section of a solved answer of the paper's model with its stress field."""
    contact = answer.contact
    assert isinstance(contact, SolvedState)
    assert contact.wall is not None
    wall, lines = contact.wall, []
    for radius in (wall.R.min(), wall.R.max()):
        on_it = np.isclose(wall.R, radius)
        reference = np.unique(wall.Z[on_it])
        z, r = wall_surface(wall, float(radius))
        lines += [np.interp(PLACES, reference, z), np.interp(PLACES, reference, r)]
    first = contact.contact_angle
    theta = first + STATIONS * (np.pi / 2.0 - first)
    return Section(lines[0], lines[1], lines[2], lines[3], first, contact.pressure_at(theta))


def build(folder: Path, workers: int) -> None:
    """Solve all sections and write one file for each material.

    Parameters
    ----------
    folder : Path
        Where the files are written.
    workers : int
        Number of processes.
    """
    jobs = {
        (material, size, wall): PressureJob(case_of_section(material, size, wall), wall=True)
        for material in MATERIALS
        for size in SIZES
        for wall in WALLS
    }
    with process_pool(workers) as pool:
        found = run_jobs(jobs.values(), pool, default_folder(), _told)
    folder.mkdir(parents=True, exist_ok=True)
    for material in MATERIALS:
        rows = [
            [
                scaled(section_of(found[jobs[material, size, wall]]), size, wall)
                for wall in WALLS
            ]
            for size in SIZES
        ]  # fmt: skip
        values: dict[str, Any] = {
            name: np.array([[each[name] for each in row] for row in rows], np.float32)
            for name in rows[0][0]
        }
        np.savez_compressed(
            folder / f"{material}.npz",
            digest=digest(material),
            size_ratio=np.array(SIZES),
            wall_ratio=np.array(WALLS),
            **values,
        )


def _told(done: int, total: int) -> None:
    print(f"\r{done} of {total} states", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    build(Path(__file__).parent / FOLDER, int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    print(file=sys.stderr)
