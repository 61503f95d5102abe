"""The way to the seated state as any finite-element program can follow it: meshes and motions.

The stone is a strip of its surface whose points have a prescribed motion: of an axisymmetric arc
that moves radially no rigid body can be made.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from stonepass.about import VERSION
from stonepass.errors import BadInput, require
from stonepass.export.grid import Grid, grid
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.core.grading import growing
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.protocol import Law
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.critical import SMALLEST_OVERSIZE
from stonepass.model.far_field import stuck_lumen
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of
from stonepass.units import METRE_PER_MM, PASCAL_PER, Length

__all__ = ["CLEARANCE", "KPA", "MM", "Seating", "bulk_modulus", "seating"]

FINE = (0.002, 0.5)  # element length in the fine zone over R_a
COARSEST, PER_CONTACT = 0.025, 16  # by default: over R_a, and elements on the guessed contact
BEYOND = 1.3  # largest ratio of neighbouring elements outside it
CLEARANCE = 1e-3  # of the strip from the lumen at the start, over R_a
STRIP = 0.05  # thickness of the strip over R_a
STRIP_REACH = 1.6  # of the guessed contact, so far the strip goes
FACING_REACH = 1.5  # and so far the part of the wall that looks for it
COLUMN = np.radians(2.0)  # of an element of the strip
SMALLEST_RADIUS = 0.02  # of the strip at the start, over R_a
UNIT_RADIUS = Length(1e-3)  # R_a in m where the case has ratios only
# Penalty of the contact times the element length over w″(1), in the range that CalculiX converges
# with: contact pressure comes out within 1 %, a stiffer one chatters.
PENALTY = 2.0
POISSON = 0.499  # of programs that cannot keep volume exactly
INCREMENT, FEWEST = 0.4, 8  # of the strip over the element length, and how many at least
# Pa and m: decks are in kilopascals, millimetres, and so millinewtons.
KPA, MM = PASCAL_PER["kPa"], METRE_PER_MM
LONGEST_NAME = 60


@dataclass(frozen=True)
class Seating:
    """Wall, strip and motions; lengths in inner radii, the stone's widest place at z = 0.

    First the ends are pulled to the pre-stretch and the load is put on, while the strip closes half
    of its `CLEARANCE`; then the strip goes the rest of its `travel`, which presses the wall open.

    Attributes
    ----------
    wall : Grid
        Unloaded; rows from the inner wall outwards, columns along the tube: half of it, from the
        plane of symmetry, where the stone's halves are mirror images.
    strip : Grid
        The stone's surface at the start; its last row line faces the wall.
    travel : array
        Displacement of each point of the strip, over both steps.
    facing : slice
        Columns of the wall whose inner faces may touch.
    whole : bool
        Whether the wall is the whole tube.
    fine : float
        Length of elements in the contact.
    """

    case: Case
    wall: Grid
    strip: Grid
    travel: Float[np.ndarray, "strip_points 2"]
    facing: slice
    whole: bool
    fine: float

    @property
    def inner_radius(self) -> Length:
        """R_a in m; 1 mm where the case does not say it."""
        diameter = self.case.ureter.inner_diameter
        return UNIT_RADIUS if diameter is None else Length(diameter / 2.0)

    @property
    def penalty(self) -> float:
        """Contact pressure over penetration, in Pa per inner radius."""
        return PENALTY * hoop_modulus(self.case.ureter.material.law) / self.fine

    @property
    def loaded(self) -> bool:
        """Whether the first step does anything but move the strip."""
        return self.case.load.prestretch != 1.0 or self.case.load.confining_pressure > 0.0

    @property
    def pull(self) -> float:
        """How far an end is pulled to the pre-stretch, over R_a."""
        return (self.case.load.prestretch - 1.0) * self.case.method.half_length

    def heading(self) -> tuple[str, ...]:
        """What a file says of itself, in lines that no name of a material can end."""
        case, name = self.case, self.case.ureter.material.name
        name = "".join(c if c.isprintable() else "?" for c in name)[:LONGEST_NAME]
        return (
            f"Seated state of a stone in a ureter, stonepass {VERSION}",
            f"size ratio {case.size_ratio:.6g}, wall ratio {case.wall_ratio:.6g}, material {name}",
            f"half-length {case.method.half_length:g} R_a, R_a = {self.inner_radius / MM:.6g} mm",
        )

    @property
    def mark(self) -> str:
        """Eight letters and digits that tell the deck of one case and mesh from others."""
        case, load = self.case, self.case.load
        shape, method = case.stone.shape, case.method
        numbers = (
            case.size_ratio, case.wall_ratio, case.seating_friction, load.confining_pressure,
            load.prestretch, method.half_length, shape.aspect, *shape.outline, self.inner_radius,
            self.fine,
        )  # fmt: skip
        law = case.ureter.material.law
        told = [
            VERSION,
            method.seating,
            load.confinement,
            repr(law),
            *(f"{x:.9g}" for x in numbers),
        ]
        return hashlib.sha256("|".join(told).encode()).hexdigest()[:8].upper()

    @property
    def length(self) -> float:
        """How far the strip travels, at most."""
        return float(np.linalg.norm(self.travel, axis=1).max())

    @property
    def first_share(self) -> float:
        """Share of the travel in the first step."""
        return 0.5 * CLEARANCE / self.length

    @property
    def increment(self) -> float:
        """Way of the strip in an increment over R_a: twice that is faster where it converges."""
        return min(INCREMENT * self.fine, self.length / FEWEST)

    def dead_forces(self) -> Float[np.ndarray, " nodes"]:
        """Radial force on each node of the outer line, whole turn, in Pa × R_a², inwards positive.

        Of a dead confining pressure, 2π P_out R_b ∫ N dZ: 1/6, 4/6, 1/6 of an element's length.
        """
        nodes = self.wall.row_line(-1)
        Z = self.wall.points[nodes, 1]
        share = np.zeros(len(nodes))
        run = Z[2::2] - Z[:-2:2]
        for offset, weight in ((0, 1.0), (1, 4.0), (2, 1.0)):
            share[offset : len(nodes) - 2 + offset : 2] += weight / 6.0 * run
        pressure = self.case.load.confining_pressure
        return 2.0 * np.pi * pressure * self.case.wall_ratio * share


def seating(case: Case, fine: float | None = None) -> Seating:
    """Mesh the wall with elements of `fine` R_a where it may touch, and lay the strip to its start.

    By default at most `COARSEST`, and so that about `PER_CONTACT` are in contact on each side.

    Raises
    ------
    BadInput
        The stone is hardly larger than the lumen, the law is unstable, the case is of another model
        than the paper's, or the stone's surface would begin beyond the axis.
    """
    low, high = FINE
    require(fine is None or low <= fine <= high, "fine", fine, f"{low:g} to {high:g}, in R_a")
    if case.method.model != "paper":
        why = "a deck is of the seated state, which is the paper's model"
        raise BadInput("model", case.method.model, "'paper'", why)
    check(case.ureter.material)
    lumen = stuck_lumen(case)
    least = lumen * (1.0 + SMALLEST_OVERSIZE)
    require(case.size_ratio >= least, "size ratio", case.size_ratio, f"at least {least:.6g}, so "
            "that the stone is held by more than a touch")  # fmt: skip
    place = profile_of(case)
    first, last = wrap_round_arc(case, lumen, 1.0, place).contact
    if fine is None:
        fine = max(low, min(COARSEST, -first / PER_CONTACT, last / PER_CONTACT))
    whole = not place.symmetric
    axial, facing = _axial_lines(case, fine, first, last, whole)
    radial = 1.0 + growing(fine, case.wall_ratio - 1.0, BEYOND)
    strip, travel = _strip(case, place, min(lumen, 1.0), (first, last), whole)
    return Seating(case, grid(radial, axial), strip, travel, facing, whole, fine)


def bulk_modulus(law: Law) -> float:
    """κ in Pa of a wall that is nearly incompressible, 2 μ (1 + ν)/(3 (1 − 2ν)), μ = w″(1)/4.

    >>> from stonepass.materials.neo_hookean import NeoHookean
    >>> round(bulk_modulus(NeoHookean(0.5)), 3)
    499.667
    """
    return hoop_modulus(law) / 2.0 * (1.0 + POISSON) / (3.0 * (1.0 - 2.0 * POISSON))


def _axial_lines(
    case: Case, fine: float, first: float, last: float, whole: bool
) -> tuple[Float[np.ndarray, " lines"], slice]:
    """Grid lines along the tube, and the columns that may touch."""

    def half(edge: float) -> tuple[Float[np.ndarray, " lines"], int]:
        count = int(np.ceil(edge / fine))
        even = fine * np.arange(count + 1)
        rest = even[-1] + growing(fine, case.method.half_length - even[-1], BEYOND)
        lines = np.concatenate([even, rest[1:]])
        return lines, int(np.searchsorted(lines, FACING_REACH * edge))

    downstream, ahead = half(last)
    if not whole:
        return downstream, slice(0, ahead)
    upstream, behind = half(-first)
    middle = len(upstream) - 1
    return np.concatenate([-upstream[:0:-1], downstream]), slice(middle - behind, middle + ahead)


def _strip(
    case: Case, place: Profile, open_to: float, edges: tuple[float, float], whole: bool
) -> tuple[Grid, Float[np.ndarray, "points 2"]]:
    """The strip at its start, tangent to a lumen `open_to` but for the clearance, and its way."""
    stretch, xi = case.load.prestretch, case.size_ratio
    start = open_to - CLEARANCE
    first, last = (_angle_at(place, STRIP_REACH * stretch * edge) for edge in edges)
    if not whole:
        first = np.pi / 2.0 - 1.5 * COLUMN  # a little beyond the plane of symmetry
    count = int(np.ceil((last - first) / COLUMN))
    angles = np.linspace(first, last, count + 1)
    layers = np.array([1.0 - STRIP / xi, 1.0])

    def at_end(layer, angle):  # type: ignore[no-untyped-def]
        rho, z = case.stone.shape.meridian(angle)
        return xi * layer * rho, xi * layer * z

    end = grid(layers, angles, at_end)
    if case.method.seating == "growing":
        begin = end.points * (start / xi)
    else:
        begin = end.points - np.array([xi - start, 0.0])
    nearest = float(begin[:, 0].min())
    require(
        nearest >= SMALLEST_RADIUS,
        "size ratio",
        round(xi, 6),
        "such that the strip of the stone begins clear of the axis",
        "use --seating growing, or a smaller stone",
    )
    return Grid(begin, end.cells, end.numbers), end.points - begin


def _angle_at(place: Profile, z: float) -> float:
    """Parametric angle of the place at which the final surface has the axial coordinate z."""
    tau = np.linspace(0.0, np.pi, 2001)
    return float(np.interp(z, place.radius * place.meridian(tau)[1], tau))
