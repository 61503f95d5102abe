"""Solve the sections that come with the package and write them: run this module to renew them.

The states are those of the paper's model: seated by pressing, with the default friction, under
confining pressures up to the largest ones of the model's surrogate. They are solved at the accuracy
`fast`, whose errors are far below the width of a line. Solved states are kept in the cache folder
of the user.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.contact_state import SolvedState
from stonepass.model.load import Load
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.report.section import wall_surface
from stonepass.studies.executor import process_pool
from stonepass.studies.jobs import PressureJob, run_jobs
from stonepass.studies.solution_cache import default_folder
from stonepass.studies.surrogates.store import load_surrogate
from stonepass.units import Pressure
from stonepass.web.section.grid import (
    FOLDER,
    PLACES,
    STATIONS,
    FreeTube,
    SeatedSection,
    digest,
    free_tube,
    scaled,
)

__all__ = ["build", "case_of_section", "section_of"]

MATERIALS = ("ureter", "latex")
LARGEST = 1.6  # size ratio
FRACTIONS = (0.004, 0.012, 0.035, 0.085, 0.17, 0.29, 0.43, 0.6, 0.8, 1.0)
WALLS = (1.1, 1.16, 1.25, 1.4, 1.6, 1.9, 2.3, 3.0, 4.0)
PARTS = (0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0)


def case_of_section(
    material: str, fraction: float, wall_ratio: float, confining: float
) -> tuple[Case, FreeTube]:
    """Return the case of a section, and its tube without the stone.

    Parameters
    ----------
    material : str
    fraction : float
        (ξ − ξ_lumen)/(`LARGEST` − ξ_lumen), above 0.
    wall_ratio : float
    confining : float
        Confining pressure in Pa.
    """
    case = Case(
        Stone(size_ratio=LARGEST),
        Ureter(material=material, wall_ratio=wall_ratio),
        Load(Pressure(confining)),
        numerics=Numerics(accuracy="fast"),
    )
    tube = free_tube(case)
    assert tube is not None
    size = tube.inner + fraction * (LARGEST - tube.inner)
    return replace(case, stone=Stone(size_ratio=size)), tube


def section_of(answer: Answer) -> SeatedSection:
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
    return SeatedSection(lines[0], lines[1], lines[2], lines[3], first, contact.pressure_at(theta))


def build(folder: Path, workers: int) -> None:
    """Solve all sections and write one file for each material.

    Parameters
    ----------
    folder : Path
        Where the files are written.
    workers : int
        Number of processes.
    """
    bounds = {material: _loads(material) for material in MATERIALS}
    cases = {
        (material, fraction, wall, part): case_of_section(
            material, fraction, wall, part * float(np.interp(wall, *bounds[material]))
        )
        for material in MATERIALS
        for fraction in FRACTIONS
        for wall in WALLS
        for part in PARTS
    }
    jobs = {key: PressureJob(case, wall=True) for key, (case, _) in cases.items()}
    with process_pool(workers) as pool:
        found = run_jobs(jobs.values(), pool, default_folder(), _told)
    parts = {
        key: scaled(section_of(found[jobs[key]]), case.size_ratio, tube)
        for key, (case, tube) in cases.items()
    }
    folder.mkdir(parents=True, exist_ok=True)
    shape = (len(FRACTIONS), len(WALLS), len(PARTS))
    for material in MATERIALS:
        rows = [parts[key] for key in parts if key[0] == material]
        values: dict[str, Any] = {
            name: np.array([row[name] for row in rows], np.float32).reshape(*shape, *np.shape(one))
            for name, one in rows[0].items()
        }
        walls, loads = bounds[material]
        np.savez_compressed(
            folder / f"{material}.npz",
            digest=digest(material),
            fraction=np.array(FRACTIONS),
            wall_ratio=np.array(WALLS),
            part=np.array(PARTS),
            walls=walls,
            loads=loads,
            largest=LARGEST,
            **values,
        )


def _loads(material: str) -> tuple[np.ndarray, np.ndarray]:
    """Return wall ratios, and the largest confining pressures in Pa that are covered at them."""
    surrogate = load_surrogate(material, "paper")
    stable, most = surrogate.stable, float(surrogate.case.load.confining_pressure)
    return stable.wall_ratio, most * stable.factor


def _told(done: int, total: int) -> None:
    print(f"\r{done} of {total} states", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    build(Path(__file__).parent / FOLDER, int(sys.argv[1]) if len(sys.argv) > 1 else 1)
    print(file=sys.stderr)
