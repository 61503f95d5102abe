"""Reader of the contact that CalculiX computed from an input deck of stonepass."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.export.seating import KPA, MM, DeckSeating
from stonepass.io.text_file import read_text
from stonepass.model.states.nondimensional import profile_of
from stonepass.model.states.seated_state import Contact

__all__ = ["read_contact"]

DISPLACEMENTS, STRESSES = "displacements (vx,vy,vz) for set INNER", "contact stress (slave"
COLUMNS = {DISPLACEMENTS: 4, STRESSES: 5}
HEADER = re.compile(r"^ \S.* and time\s+(\S+)$")
KIND = "a .dat file of CalculiX"
END = 2.0  # time at the end of the two steps, which take a time of 1 each
OF_THIS = "export and compare with the same options and version"
SAMPLES = 9  # number of points on each side of an element, both ends included
ANGLES = 1001  # number of angles of the returned contact
MOST = 200_000_000  # largest size of the file in bytes


def read_contact(seating: DeckSeating, path: Path) -> Contact:
    """Read the contact at the end of the last step from a ``.dat`` file of CalculiX.

    The contact pressure is that of CalculiX, averaged over each element of the wall. The edges of
    the contact are the points at which the deformed wall leaves the stone. Because of the penalty
    in the contact the wall penetrates the stone slightly.

    Parameters
    ----------
    seating : DeckSeating
        The meshes from which the input deck was written.
    path : Path
        The ``.dat`` file, at most 200 MB.

    Returns
    -------
    Contact
        Angles in rad; contact pressures in Pa, compression positive.

    Raises
    ------
    BadInput
        The file does not contain the results at the end of the last step, it contains results of
        another input deck, or the wall in it does not touch the stone.

    References
    ----------
    docs/export.md, "CalculiX and back".
    """
    blocks = _last_blocks(path, seating.fingerprint)
    r, z = _inner_wall(seating, blocks[DISPLACEMENTS], path).T
    stone = profile_of(seating.case)
    overlap, angle = -stone.gap(r, z), stone.parametric(r, z)
    touching = np.flatnonzero(overlap > 0.0)
    first = 1 if seating.whole else 0
    sound = len(touching) > 0 and first <= touching[0] and touching[-1] < len(angle) - 1
    sound = sound and bool(np.all(np.diff(angle[touching[0] : touching[-1] + 2]) > 0.0))
    require(sound, "results file", path.name, "that of a wall that touches the stone of this case "
            "between the ends of the tube")  # fmt: skip
    low = _crossing(angle, overlap, int(touching[0])) if seating.whole else angle[0]
    high = _crossing(angle, overlap, int(touching[-1]) + 1)
    theta, pressure = _means(seating, blocks[STRESSES], angle, (low, high), path)
    if not seating.whole:
        theta = np.concatenate([np.pi - theta[::-1], theta])
        pressure = np.concatenate([pressure[::-1], pressure])
        low = np.pi - high
    fitted = PchipInterpolator(
        np.concatenate([[low], theta, [high]]), np.concatenate([[0.0], pressure, [0.0]])
    )
    fine = np.linspace(low, high, ANGLES)
    return Contact(seating.case, float(low), fine, np.maximum(fitted(fine), 0.0))


def _last_blocks(path: Path, fingerprint: str) -> dict[str, list[list[float]]]:
    """Return the rows of the last block of displacements and of contact stresses in the file."""
    found: dict[str, list[list[float]]] = {}
    kind = None
    text = read_text(path, MOST, KIND, "results file")
    for number, line in enumerate(text.splitlines(), start=1):
        header = HEADER.match(line)
        if header is not None:
            kind = next((kind for kind in COLUMNS if kind in line), None)
            if kind == DISPLACEMENTS:
                ours = f"INNER_{fingerprint} " in line
                require(
                    ours,
                    "results file",
                    path.name,
                    f"that of this case's input deck, {fingerprint}",
                    OF_THIS,
                )
            # The file of an interrupted run ends before the end of the last step.
            require(_is(header[1], END), "results file", path.name, "one with results at time "
                    f"{END:g} only, not at {header[1]}",
                    "let CalculiX complete both steps of the input deck")  # fmt: skip
            if kind is not None:
                found[kind] = []
        elif line.strip() and kind is not None:
            found[kind].append(_numbers(line, COLUMNS[kind], f"{path.name}, line {number}"))
    for kind, what in ((DISPLACEMENTS, "displacements of INNER"), (STRESSES, "contact stresses")):
        require(bool(found.get(kind)), "results file", path.name, f"{KIND} with {what}",
                "let CalculiX complete both steps of the input deck")  # fmt: skip
    return found


def _is(text: str, number: float) -> bool:
    try:
        return float(text) == number
    except ValueError:
        return False


def _numbers(line: str, count: int, where: str) -> list[float]:
    """Return the numbers of one row, which must be finite and of the given count."""
    try:
        row = [float(word) for word in line.split()]
    except ValueError:
        row = []
    good = len(row) == count and all(math.isfinite(value) for value in row)
    require(good, f"in {where}, row of results", line.strip(), f"{count} numbers")
    return row


def _inner_wall(
    seating: DeckSeating, rows: list[list[float]], path: Path
) -> Float[np.ndarray, "samples 2"]:
    """Return points r, z on the deformed inner wall in inner radii, SAMPLES per element side."""
    nodes = seating.wall.row_line(0)
    moved = {int(number): (u, w) for number, u, w, _ in rows}
    require(
        sorted(int(row[0]) for row in rows) == sorted((nodes + 1).tolist()),
        "results file",
        path.name,
        f"that of this case's input deck, with {len(nodes)} nodes on the inner wall",
        OF_THIS,
    )
    shift = np.array([moved[int(node) + 1] for node in nodes]) * MM / seating.inner_radius
    at = seating.wall.points[nodes] + shift
    t = np.linspace(-1.0, 1.0, SAMPLES)[:-1]
    shape = np.column_stack([t * (t - 1.0) / 2.0, 1.0 - t * t, t * (t + 1.0) / 2.0])
    sides = np.stack([at[:-2:2], at[1:-1:2], at[2::2]], axis=1)
    return np.vstack([(shape @ sides).reshape(-1, 2), at[-1:]])


def _crossing(
    angle: Float[np.ndarray, " n"], overlap: Float[np.ndarray, " n"], after: int
) -> float:
    """Return the angle at which the overlap vanishes between two neighbouring samples."""
    a, b = overlap[after - 1], overlap[after]
    return float(angle[after - 1] + a / (a - b) * (angle[after] - angle[after - 1]))


def _means(
    seating: DeckSeating,
    rows: list[list[float]],
    angle: Float[np.ndarray, " samples"],
    edges: tuple[float, float],
    path: Path,
) -> tuple[Float[np.ndarray, " m"], Float[np.ndarray, " m"]]:
    """Return angle and mean pressure in Pa of each wall element that touches the stone.

    The angle is that of the middle of the part in contact; the pressure is averaged over the
    integration points of the element.
    """
    columns = np.array([int(row[0]) - 1 for row in rows])
    pressures = np.array([row[2] for row in rows]) * KPA
    corners = angle[:: SAMPLES - 1]
    touched = np.flatnonzero((corners[1:] > edges[0]) & (corners[:-1] < edges[1]))
    full = [c for c in touched if edges[0] <= corners[c] and corners[c + 1] <= edges[1]]
    whole = set(full) <= set(columns) <= set(range(seating.facing.start, seating.facing.stop))
    require(whole, "results file", path.name, "one with contact stresses on all elements of the "
            "wall that touch the stone, and only on these")  # fmt: skip
    kept = np.array([c for c in touched if c in columns])
    low, high = np.maximum(corners[kept], edges[0]), np.minimum(corners[kept + 1], edges[1])
    return (low + high) / 2.0, np.array([pressures[columns == c].mean() for c in kept])
