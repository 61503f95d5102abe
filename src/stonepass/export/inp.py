"""Writer of input decks for CalculiX and Abaqus, in millimetres, kilopascals and millinewtons.

Both programs read the same format; the flavours of the deck differ in a few lines. CalculiX has no
hybrid elements, so that the wall is nearly incompressible there (ν = 0.499). Abaqus has hybrid
elements, which keep the volume exactly.

At the beginning of a calculation CalculiX treats gaps below 1/penalty, in the units of the deck, as
closed contact, and pulls the wall towards the stone. For this reason the element strip touches the
wall in the second step only, and the units are chosen such that 1/penalty is far smaller than the
initial clearance.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from stonepass.about import DISCLAIMER
from stonepass.errors import refuse_unknown
from stonepass.export.grid import Grid
from stonepass.export.inp_material import deck_line, has_overlaid_matrix, material_lines
from stonepass.export.input_options import ELEMENT, FLAVOUR
from stonepass.export.seating import KPA, MM, DeckSeating

__all__ = ["write_inp"]

A_LINE = 12  # largest number of node numbers in a line
# Largest elastic slip in inner radii, and as a fraction of the displacement of the element strip.
ELASTIC_SLIP, SLIP_FRACTION = 1e-3, 5e-3
ONLY_LAST = 1_000_000  # increments between outputs, so that only the end of a step is written


def write_inp(
    seating: DeckSeating,
    element: str = "CAX8",
    flavour: str = "calculix",
    increment: float | None = None,
) -> str:
    """Return the text of the input deck.

    Parameters
    ----------
    seating : DeckSeating
        Meshes, prescribed displacements and loads.
    element : {"CAX8", "CAX8R"}
        Element type of the wall.
    flavour : {"calculix", "abaqus"}
        Program that reads the deck.
    increment : float, optional
        Largest displacement of the element strip in one increment of the second step, in inner
        radii; `DeckSeating.increment` by default.

    Raises
    ------
    BadInput
        The element type or the flavour is unknown, or the program does not have the law of the
        wall.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    for option, value in ((ELEMENT, element), (FLAVOUR, flavour)):
        if value not in option.choices:
            refuse_unknown(option.name, value, list(option.choices))
    parts = (
        _header(seating, element, flavour),
        _mesh(seating, element, flavour),
        _sets(seating),
        material_lines(seating, flavour),
        _contact(seating, flavour),
        _steps(seating, flavour, increment or seating.increment),
    )
    return "\n".join(line for part in parts for line in part) + "\n"


def _header(s: DeckSeating, element: str, flavour: str) -> Iterator[str]:
    yield from (f"** {line}" for line in s.heading())
    yield f"** {element} for {flavour}; mm, mN, kPa; r along x, the tube's axis along y"
    yield f"** {DISCLAIMER}"
    yield "*HEADING"
    yield "Stone pressed into a ureter"


def _mesh(s: DeckSeating, element: str, flavour: str) -> Iterator[str]:
    hybrid = "H" if flavour == "abaqus" else ""
    points = np.vstack([s.wall.points, s.element_strip.points]) * s.inner_radius / MM
    yield "*NODE, NSET=ALL"
    for number, (r, z) in enumerate(points, start=1):
        yield deck_line(number, float(r), float(z))
    yield f"*ELEMENT, TYPE={element}{hybrid}, ELSET=WALL"
    yield from _elements(s.wall, 1, 1)
    first = len(s.wall.cells) + 1
    if has_overlaid_matrix(s.case.ureter.material.law):
        yield "** ground matrix: copies of the wall elements; only the originals keep the volume"
        yield f"*ELEMENT, TYPE={element}, ELSET=MATRIX"
        yield from _elements(s.wall, first, 1)
        first += len(s.wall.cells)
    yield "*ELEMENT, TYPE=CAX8, ELSET=STRIP"
    yield from _elements(s.element_strip, first, len(s.wall.points) + 1)


def _elements(grid: Grid, first: int, first_node: int) -> Iterator[str]:
    for number, nodes in enumerate(grid.cells + first_node, start=first):
        yield deck_line(number, *nodes.tolist())


def _sets(s: DeckSeating) -> Iterator[str]:
    count = len(s.wall.points)
    inner = s.wall.row_line(0)
    yield from _set("FIRST", s.wall.column_line(0))
    yield from _set("LAST", s.wall.column_line(-1))
    yield from _set(f"INNER_{s.fingerprint}", inner)
    yield from _set("STONE", count + np.arange(len(s.element_strip.points)))
    yield "*SURFACE, NAME=LUMEN, TYPE=ELEMENT"
    for column in range(s.facing.start, s.facing.stop):
        yield deck_line(column + 1, "S4")
    yield "*SURFACE, NAME=STONE, TYPE=ELEMENT"
    copies = 2 if has_overlaid_matrix(s.case.ureter.material.law) else 1
    before = copies * len(s.wall.cells) + (s.element_strip.rows - 1) * s.element_strip.columns
    for column in range(s.element_strip.columns):
        yield deck_line(before + column + 1, "S2")


def _set(name: str, nodes: Any) -> Iterator[str]:
    kept = [int(node) + 1 for node in nodes if node >= 0]
    yield f"*NSET, NSET={name}"
    for start in range(0, len(kept), A_LINE):
        yield deck_line(*kept[start : start + A_LINE])


def _contact(s: DeckSeating, flavour: str) -> Iterator[str]:
    stiffness = s.penalty / KPA / (s.inner_radius / MM)
    yield "*SURFACE INTERACTION, NAME=TOUCH"
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield deck_line(stiffness)
    friction = s.friction
    if friction > 0.0 and flavour == "calculix":
        yield "*FRICTION"
        yield deck_line(friction, stiffness)
    elif friction > 0.0:
        slip = min(ELASTIC_SLIP, SLIP_FRACTION * s.length) * s.inner_radius / MM
        yield f"*FRICTION, ELASTIC SLIP={slip:.12g}"
        yield deck_line(friction)
    yield "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE"
    yield "LUMEN, STONE"


def _steps(s: DeckSeating, flavour: str, increment: float) -> Iterator[str]:
    pull = s.pull * s.inner_radius / MM
    yield "*BOUNDARY"
    yield from ("FIRST, 2, 2", "LAST, 2, 2")
    if _radial(s):
        yield "STONE, 2, 2"
    size = increment / s.length  # first and largest time increment of the second step
    unsymmetric = ", UNSYMM=YES" if flavour == "abaqus" else ""
    step = f"*STEP, NLGEOM, INC={max(1000, 20 * int(np.ceil(1.0 / size)))}{unsymmetric}"
    yield "** step 1: ends and load are applied; the strip does not touch the wall yet"
    yield step
    yield "*STATIC"
    yield deck_line(*((0.1, 1.0, 1e-4, 0.2) if s.loaded else (1.0, 1.0)))
    if pull:
        yield "*BOUNDARY"
        yield deck_line("LAST", 2, 2, pull)
        if s.whole:
            yield deck_line("FIRST", 2, 2, -pull)
    yield from _motion(s, s.first_fraction)
    yield from _load(s)
    yield "*END STEP"
    yield "** step 2: the strip presses the wall open"
    yield step
    yield "*STATIC"
    yield deck_line(min(size, 1.0), 1.0, 1e-6, min(size, 1.0))
    yield from _motion(s, 1.0)
    yield from _output(s, flavour)
    yield "*END STEP"


def _radial(s: DeckSeating) -> bool:
    return not s.travel[:, 1].any()


def _motion(s: DeckSeating, fraction: float) -> Iterator[str]:
    yield "*BOUNDARY"
    moved = fraction * s.travel * s.inner_radius / MM
    if _radial(s):
        yield deck_line("STONE", 1, 1, float(moved[0, 0]))
        return
    first = len(s.wall.points) + 1
    for number, (r, z) in enumerate(moved, start=first):
        yield deck_line(number, 1, 1, float(r))
        yield deck_line(number, 2, 2, float(z))


def _load(s: DeckSeating) -> Iterator[str]:
    load = s.case.load
    if load.confining_pressure == 0.0:
        return
    if load.hydrostatic:
        yield "*DLOAD"
        last_row = (s.wall.rows - 1) * s.wall.columns
        for column in range(s.wall.columns):
            yield deck_line(last_row + column + 1, "P2", load.confining_pressure / KPA)
        return
    yield "** dead load: the radial nodal forces stay constant"
    yield "*CLOAD"
    forces = s.dead_forces() / KPA * (s.inner_radius / MM) ** 2
    for node, force in zip(s.wall.row_line(-1), forces, strict=True):
        yield deck_line(int(node) + 1, 1, -float(force))


def _output(s: DeckSeating, flavour: str) -> Iterator[str]:
    if flavour == "abaqus":
        yield "*OUTPUT, FIELD"
        yield "*NODE OUTPUT"
        yield "U, RF"
        yield "*ELEMENT OUTPUT"
        yield "S, LE"
        yield "*CONTACT OUTPUT"
        yield "CSTRESS, CDISP"
        return
    yield "** output for: stonepass compare"
    yield f"*NODE PRINT, NSET=INNER_{s.fingerprint}, FREQUENCY={ONLY_LAST}"
    yield "U"
    yield f"*CONTACT PRINT, FREQUENCY={ONLY_LAST}"
    yield "CSTR"
    yield "** output for display with: cgx"
    yield f"*NODE FILE, FREQUENCY={ONLY_LAST}"
    yield "U"
    yield f"*EL FILE, FREQUENCY={ONLY_LAST}"
    yield "S"
    yield f"*CONTACT FILE, FREQUENCY={ONLY_LAST}"
    yield "CDIS, CSTR"
