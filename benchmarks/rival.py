"""Tuned decks of CalculiX: the settings of a deck are searched on a grid for each case.

The exported deck is designed to converge for every case; a deck that is tuned to one case is
several times faster. Here element, length of elements, rows, stiffness of the contact and
increments are searched for each seating of one case, and the best settings are tried on the others.
"""

from __future__ import annotations

import itertools
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from cases import tube
from measure import Decks

import stonepass as sp
from stonepass.errors import BadInput
from stonepass.export.element_strip import element_strip
from stonepass.export.grid import grid
from stonepass.export.inp import write_inp
from stonepass.export.results import read_contact
from stonepass.export.seating import DeckSeating, seating, seating_of
from stonepass.model.states.nondimensional import profile_of
from stonepass.model.states.seated_state import Contact

GROWTH = 1.15  # largest ratio of neighbouring elements along the tube, beyond the contact
LONGEST = 0.4  # longest element along the tube in inner radii
REACH = 0.85  # extent of the elements of equal length over the guessed contact
FACING_REACH = 1.5  # extent of the faces that may touch over the guessed contact, as exported
COLUMN = 2.0  # length of an element of the stone over that of one of the wall
SETTINGS = {
    "element": ("CAX8R", "CAX8"),
    "fine": (0.025, 0.04),  # length of elements in the contact, over R_a
    "rows": (3, 4),
    "stiffness": (2.0, 10.0),  # penalty × length of an element over w''(1)
    "increments": (10, 20),  # smallest number in the second step
}
CASES = {
    "latex, η 1.5, ξ 1.2": ("latex", 1.5, 1.2, 0.475),
    "latex, η 1.25, ξ 1.3": ("latex", 1.25, 1.3, 0.3),
    "latex, η 2.5, ξ 1.1": ("latex", 2.5, 1.1, 0.5),
}
KINDS = ("frictionless", "pressed")
TRIED = 4  # number of the fastest settings of the first case with which the others are solved
SECONDS = 120.0  # time after which a run is stopped


@dataclass(frozen=True)
class Settings:
    """One deck of the grid."""

    element: str
    fine: float
    rows: int
    stiffness: float
    increments: int

    def __str__(self) -> str:
        return (
            f"{self.element}, {self.fine:g} R_a, {self.rows} rows, stiffness {self.stiffness:g}, "
            f"{self.increments} increments"
        )


@dataclass(frozen=True)
class Run:
    """A deck that was run: processor time in s and the contact, or None without a result."""

    settings: Settings
    cpu: float
    contact: Contact | None


Usable = Callable[[str, str, Run], bool]


def case(name: str, kind: str, accuracy: str = "standard") -> sp.Case:
    """Return one of `CASES` with a seating."""
    material, eta, xi, friction = CASES[name]
    return tube(kind, material, eta, xi, friction, accuracy=accuracy)


def all_settings() -> list[Settings]:
    """Return every point of the grid."""
    return [Settings(*point) for point in itertools.product(*SETTINGS.values())]  # type: ignore[arg-type]


def tuned(asked: sp.Case, settings: Settings) -> DeckSeating:
    """Return the exported seating with the mesh and the contact of the settings."""
    plain = seating(asked, settings.fine)
    guess = settings.fine * plain.facing.stop / FACING_REACH  # position of the contact edge
    axial = _axial(REACH * guess, settings.fine, asked.numerics.half_length)
    strip, travel = element_strip(
        asked, seating_of(asked), profile_of(asked), 1.0, (-guess, guess), False,
        COLUMN * settings.fine / asked.size_ratio,
    )  # fmt: skip
    return replace(
        plain,
        wall=grid(np.linspace(1.0, asked.wall_ratio, settings.rows + 1), axial),
        element_strip=strip,
        travel=travel,
        facing=slice(0, int(np.searchsorted(axial, FACING_REACH * guess))),
        stiffness=settings.stiffness,
    )


def _axial(even: float, fine: float, end: float) -> np.ndarray:
    """Return positions of grid lines: elements of equal length, then growing ones to the end."""
    count = int(np.ceil(even / fine))
    lines = [fine * k for k in range(count + 1)]
    while lines[-1] < end:
        lines.append(lines[-1] + min(GROWTH * (lines[-1] - lines[-2]), LONGEST))
    beyond = np.array(lines[count:]) - lines[count]
    beyond *= (end - lines[count]) / beyond[-1]
    return np.concatenate([lines[:count], lines[count] + beyond])


def run(name: str, kind: str, settings: Settings, decks: Decks) -> Run:
    """Write a deck, run it on one thread and read its contact."""
    model = tuned(case(name, kind), settings)
    job = f"{list(CASES).index(name)}_{kind}_{'_'.join(map(str, vars(settings).values()))}"
    deck = write_inp(model, settings.element, increment=model.length / settings.increments)
    spent = decks.run(job, deck, SECONDS)
    contact = None
    if spent.code == 0:
        with suppress(BadInput):  # it ended early, with an increment too small
            contact = read_contact(model, decks.folder / f"{job}.dat")
    print(f"  {job}: {spent.cpu:.1f} s, {'ended' if contact else 'no result'}", file=sys.stderr)
    return Run(settings, spent.cpu, contact)


def search(decks: Decks, usable: Usable) -> Iterator[tuple[str, str, list[Run]]]:
    """Yield case, seating and runs: the whole grid for the first case, the best for the others.

    Parameters
    ----------
    decks : Decks
        Runs the decks.
    usable : callable
        Whether the run of a case with a seating is near enough to the solution.
    """
    first, *others = CASES
    for kind in KINDS:
        runs = [run(first, kind, settings, decks) for settings in all_settings()]
        yield first, kind, runs
        good = sorted((each for each in runs if usable(first, kind, each)), key=lambda r: r.cpu)
        for name in others:
            yield name, kind, [run(name, kind, each.settings, decks) for each in good[:TRIED]]
