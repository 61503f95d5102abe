"""What CalculiX found for a deck, as a contact like that of our own seated state."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from scipy.interpolate import PchipInterpolator

from stonepass.errors import require
from stonepass.export.seating import KPA, MM, Seating
from stonepass.model.seated import Contact
from stonepass.model.tube import profile_of
from stonepass.text_file import read_text

__all__ = ["read_contact"]

DISPLACEMENTS, STRESSES = "displacements (vx,vy,vz) for set INNER", "contact stress (slave"
COLUMNS = {DISPLACEMENTS: 4, STRESSES: 5}
KIND = "a .dat of CalculiX"
END_TIME = "0.2000000E+01"  # two steps, each of one
SAMPLES = 9  # of each side of an element
ANGLES = 1001
SAME_CONTACT = 0.2  # of the pressure, median over elements
MOST = 200_000_000  # bytes


def read_contact(seating: Seating, path: Path) -> Contact:
    """Contact angle and pressure of the deck's last increment, from CalculiX's ``.dat``.

    The pressure is CalculiX's own, averaged over each element of the wall; the edges are where the
    deformed wall leaves the stone. Both are of a penalty contact, so the wall sinks in a little.

    Raises
    ------
    BadInput
        No such results in the file, or results of another deck.
    """
    blocks = _last_blocks(path)
    r, z = _inner_wall(seating, blocks[DISPLACEMENTS], path).T
    stone = profile_of(seating.case)
    overlap, angle = -stone.gap(r, z), stone.parametric(r, z)
    touching = np.flatnonzero(overlap > 0.0)
    sound = len(touching) > 0 and touching[-1] < len(angle) - 1
    sound = sound and bool(np.all(np.diff(angle[touching[0] : touching[-1] + 2]) > 0.0))
    require(
        sound, "results", path.name, "of a wall that touches this case's stone, and not its ends"
    )
    low = angle[0] if touching[0] == 0 else _crossing(angle, overlap, touching[0])
    high = _crossing(angle, overlap, touching[-1] + 1)
    columns, theta, pressure = _means(seating, blocks[STRESSES], angle, (low, high), path)
    _check_penalty(seating, columns, pressure, overlap, path)
    if not seating.whole:
        theta = np.concatenate([np.pi - theta[::-1], theta])
        pressure = np.concatenate([pressure[::-1], pressure])
        low = np.pi - high
    fitted = PchipInterpolator(
        np.concatenate([[low], theta, [high]]), np.concatenate([[0.0], pressure, [0.0]])
    )
    fine = np.linspace(low, high, ANGLES)
    return Contact(seating.case, float(low), fine, np.maximum(fitted(fine), 0.0))


def _last_blocks(path: Path) -> dict[str, list[list[float]]]:
    """Rows of the last block of each kind."""
    found: dict[str, list[list[float]]] = {}
    kind = None
    for number, line in enumerate(read_text(path, MOST, KIND, "results").splitlines(), start=1):
        words = line.split()
        if any(word[0].isalpha() for word in words):
            # A run that broke off leaves what it had: only the end of the second step counts.
            ended = words[-1].startswith(END_TIME)
            kind = next((kind for kind in COLUMNS if ended and kind in line), None)
            if kind is not None:
                found[kind] = []
        elif words and kind is not None:
            found[kind].append(_numbers(words, COLUMNS[kind], f"{path.name}, line {number}"))
    for kind, what in ((DISPLACEMENTS, "displacements of INNER"), (STRESSES, "contact stresses")):
        require(bool(found.get(kind)), "results", path.name, f"{KIND} with {what} at time 2",
                "the deck has to run to its end")  # fmt: skip
    return found


def _numbers(words: list[str], count: int, where: str) -> list[float]:
    """The numbers of one row."""
    try:
        row = [float(word) for word in words]
    except ValueError:
        row = []
    good = len(row) == count and all(math.isfinite(value) for value in row)
    require(good, "results", " ".join(words), f"{count} numbers", f"in {where}")
    return row


def _inner_wall(
    seating: Seating, rows: list[list[float]], path: Path
) -> Float[np.ndarray, "samples 2"]:
    """Deformed inner wall in inner radii, `SAMPLES` − 1 steps along each element's side."""
    nodes = seating.wall.row_line(0)
    moved = {int(number): (u, w) for number, u, w, _ in rows}
    require(
        sorted(moved) == sorted((nodes + 1).tolist()),
        "results",
        path.name,
        f"those of this case's deck, {len(nodes)} nodes on the inner wall",
        "export and compare with the same options",
    )
    way = np.array([moved[int(node) + 1] for node in nodes]) * MM / seating.inner_radius
    at = seating.wall.points[nodes] + way
    t = np.linspace(-1.0, 1.0, SAMPLES)[:-1]
    shape = np.column_stack([t * (t - 1.0) / 2.0, 1.0 - t * t, t * (t + 1.0) / 2.0])
    sides = np.stack([at[:-2:2], at[1:-1:2], at[2::2]], axis=1)
    return np.vstack([(shape @ sides).reshape(-1, 2), at[-1:]])


def _crossing(
    angle: Float[np.ndarray, " n"], overlap: Float[np.ndarray, " n"], after: int
) -> float:
    """The angle at which the overlap vanishes, between two neighbouring samples."""
    a, b = overlap[after - 1], overlap[after]
    return float(angle[after - 1] + a / (a - b) * (angle[after] - angle[after - 1]))


def _check_penalty(
    seating: Seating,
    columns: Int[np.ndarray, " m"],
    pressure: Float[np.ndarray, " m"],
    overlap: Float[np.ndarray, " samples"],
    path: Path,
) -> None:
    """Refuse a contact that is not pressure = penalty × overlap with this stone and this wall."""
    steps = SAMPLES - 1
    law = [seating.penalty * overlap[c * steps : (c + 1) * steps + 1].mean() for c in columns]
    off = float(np.median(np.abs(np.array(law) / np.maximum(pressure, 1.0) - 1.0)))
    require(
        off <= SAME_CONTACT,
        "results",
        path.name,
        "those of this case's deck: pressures and overlaps do not fit this stone and this wall",
        "export and compare with the same options",
    )


def _means(
    seating: Seating,
    rows: list[list[float]],
    angle: Float[np.ndarray, " samples"],
    edges: tuple[float, float],
    path: Path,
) -> tuple[Int[np.ndarray, " m"], Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
    """Elements that touch, the middle of their part in contact, and their mean pressure in Pa."""
    columns = np.array([int(row[0]) - 1 for row in rows])
    pressures = np.array([row[2] for row in rows]) * KPA
    known = range(seating.facing.start, seating.facing.stop)
    inside = bool(known.start <= columns.min() and columns.max() < known.stop)
    require(inside, "results", path.name, "contact stresses on the inner wall of this case's deck")
    corners = angle[:: SAMPLES - 1]
    touching = np.unique(columns)
    low = np.maximum(corners[touching], edges[0])
    high = np.minimum(corners[touching + 1], edges[1])
    mean = np.array([pressures[columns == column].mean() for column in touching])
    kept = low < high
    return touching[kept], ((low + high) / 2.0)[kept], mean[kept]
