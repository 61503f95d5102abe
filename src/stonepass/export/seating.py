"""The loading path to the seated state as any finite-element program can follow it.

It consists of the mesh of the wall, the element strip that stands for the stone, and the prescribed
displacements of both.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.about import VERSION
from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import BadInput, require
from stonepass.export.checks import checked_value
from stonepass.export.element_strip import CLEARANCE, element_strip
from stonepass.export.fingerprint import fingerprint
from stonepass.export.grid import Grid, grid
from stonepass.export.input_options import FINE, LENGTHS
from stonepass.export.words import as_keyword
from stonepass.fe.core.grading import growing
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.protocol import Law
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.critical import SMALLEST_RESOLVED_OVERSIZE
from stonepass.model.far_field import stuck_lumen
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.seating import Seating as ModelSeating
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of
from stonepass.units import METRE_PER_MM, PASCAL_PER, Length

__all__ = ["KPA", "MM", "Seating", "bulk_modulus", "seating"]

COARSEST, PER_CONTACT = 0.025, 16  # by default: over R_a, and elements on the guessed contact
BEYOND = 1.3  # largest ratio of neighbouring elements outside it
FACING_REACH = 1.5  # how far the part of the wall goes that may touch, over the guessed contact
UNIT_RADIUS = Length(1e-3)  # R_a in m where the case has ratios only
# Penalty of the contact times the element length over w″(1), in the range that CalculiX converges
# with: contact pressure comes out within 1 %, a stiffer one chatters.
PENALTY = 2.0
POISSON = 0.499  # of programs that cannot keep volume exactly
INCREMENT, FEWEST = 0.4, 8  # travel in one over the element length, and the fewest
# In Pa and m. Input files are in kilopascals and millimetres, and so in millinewtons.
KPA, MM = PASCAL_PER["kPa"], METRE_PER_MM
LONGEST_NAME = 60


@array_dataclass
@dataclass(frozen=True)
class Seating:
    """Meshes and motions; lengths in inner radii, the stone's widest place at z = 0.

    There are two steps. In the first the ends are pulled to the pre-stretch and the confining
    pressure is applied, while the element strip closes half of its clearance. In the second the
    strip moves through the rest of its `travel` and presses the wall open.

    Attributes
    ----------
    wall : Grid
        Unloaded; rows from the inner wall outwards, columns along the tube: half of it, from the
        plane of symmetry, where the stone's halves are mirror images.
    element_strip : Grid
        The stone's surface at the start; its last row line faces the wall.
    travel : array
        Displacement r, z of each point of the element strip, over both steps.
    facing : slice
        Columns of the wall whose inner faces may touch.
    whole : bool
        Whether the wall is the whole tube.
    fine : float
        Length of elements in the contact.
    stiffness : float
        Penalty of the contact times `fine` over w″(1).
    """

    case: Case
    wall: Grid
    element_strip: Grid
    travel: Float[np.ndarray, "strip_points 2"]
    facing: slice
    whole: bool
    fine: float
    stiffness: float = PENALTY

    @property
    def friction(self) -> float:
        """Coulomb coefficient while the stone is seated."""
        return seating_of(self.case).friction

    @property
    def inner_radius(self) -> Length:
        """R_a in m; 1 mm where the case does not say it."""
        diameter = self.case.ureter.inner_diameter
        return UNIT_RADIUS if diameter is None else Length(diameter / 2.0)

    @property
    def penalty(self) -> float:
        """Contact pressure over penetration, in Pa per inner radius."""
        return self.stiffness * hoop_modulus(self.case.ureter.material.law) / self.fine

    @property
    def loaded(self) -> bool:
        """Whether there is a pre-stretch or a confining pressure to apply in the first step."""
        return self.case.load.prestretch != 1.0 or self.case.load.confining_pressure > 0.0

    @property
    def pull(self) -> float:
        """How far an end is pulled to the pre-stretch, over R_a."""
        return (self.case.load.prestretch - 1.0) * self.case.numerics.half_length

    def heading(self) -> tuple[str, ...]:
        """Lines that describe the case at the head of a file, without control characters."""
        case, name = self.case, self.case.ureter.material.name
        name = "".join(c if c.isprintable() else "?" for c in name)[:LONGEST_NAME]
        return (
            f"Seated state of a stone in a ureter, stonepass {VERSION}",
            f"size ratio {case.size_ratio:.6g}, wall ratio {case.wall_ratio:.6g}, material {name}",
            f"half-length {case.numerics.half_length:g} R_a, R_a = {self.inner_radius / MM:.6g} mm",
        )

    @property
    def summary(self) -> str:
        """Number of wall elements and travel of the element strip, as a phrase."""
        return f"{len(self.wall.cells)} elements, {self.length:.4g} R_a of travel"

    @property
    def fingerprint(self) -> str:
        """Eight letters and digits that tell the file of one case and mesh from others."""
        return fingerprint(self.case, self.inner_radius, self.fine)

    @property
    def length(self) -> float:
        """Largest displacement of a point of the element strip, over R_a."""
        return float(np.linalg.norm(self.travel, axis=1).max())

    @property
    def first_fraction(self) -> float:
        """Fraction of the travel in the first step."""
        return 0.5 * CLEARANCE / self.length

    @property
    def increment(self) -> float:
        """Travel of the element strip in one increment, over R_a.

        Twice this value is faster in the cases in which it converges.
        """
        return min(INCREMENT * self.fine, self.length / FEWEST)

    def dead_forces(self) -> Float[np.ndarray, " nodes"]:
        """Return the radial forces of a dead confining pressure on the nodes of the outer line.

        The force on a node is 2π P_out R_b ∫ N dZ over the whole turn, in Pa × R_a², inwards
        positive; an element gives 1/6, 4/6 and 1/6 of its length to its three nodes.
        """
        nodes = self.wall.row_line(-1)
        Z = self.wall.points[nodes, 1]
        tributary = np.zeros(len(nodes))  # length of wall that a node carries
        run = Z[2::2] - Z[:-2:2]
        for offset, weight in ((0, 1.0), (1, 4.0), (2, 1.0)):
            tributary[offset : len(nodes) - 2 + offset : 2] += weight / 6.0 * run
        pressure = self.case.load.confining_pressure
        return 2.0 * np.pi * pressure * self.case.wall_ratio * tributary


def seating(case: Case, fine: float | None = None) -> Seating:
    """Mesh the wall and the element strip of a case.

    Parameters
    ----------
    case : Case
        A case of the paper's model.
    fine : float, optional
        Length of the elements in the contact over R_a, 0.002 to 0.5; by default at most 0.025, and
        short enough for about 16 elements in contact on each side.

    Returns
    -------
    Seating

    Raises
    ------
    BadInput
        The stone is hardly larger than the lumen, the law is unstable, the case is of another model
        than the paper's, or the element strip would begin beyond the axis.
    """
    fine = None if fine is None else checked_value(FINE, fine, as_keyword)
    way = seating_of(case)
    check(case.ureter.material)
    lumen = stuck_lumen(case)
    least = lumen * (1.0 + SMALLEST_RESOLVED_OVERSIZE)
    require(case.size_ratio >= least, "size ratio", case.size_ratio, f"at least {least:.6g}, so "
            "that the stone is held by more than a touch")  # fmt: skip
    place = profile_of(case)
    first, last = wrap_round_arc(case, case.numerics.half_length, lumen, 1.0, place).contact
    if fine is None:
        fine = max(LENGTHS[0], min(COARSEST, -first / PER_CONTACT, last / PER_CONTACT))
    whole = not place.symmetric
    axial, facing = _axial_lines(case, fine, first, last, whole)
    radial = 1.0 + growing(fine, case.wall_ratio - 1.0, BEYOND)
    strip, travel = element_strip(case, way, place, min(lumen, 1.0), (first, last), whole)
    return Seating(case, grid(radial, axial), strip, travel, facing, whole, fine)


def seating_of(case: Case) -> ModelSeating:
    """Return the way of the stone into the wall; refused for a model without a seated state."""
    model = case.model
    if not isinstance(model, SeatedBalance):
        why = "the file describes the seated state, which is the paper's model"
        raise BadInput("model", model.NAME, "'paper'", why)
    return model.seating_of(case)


def bulk_modulus(law: Law) -> float:
    """Return the bulk modulus in Pa of a nearly incompressible wall.

    κ = 2 μ (1 + ν)/(3 (1 − 2ν)) with μ = w″(1)/4 and ν = 0.499.

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
        rest = even[-1] + growing(fine, case.numerics.half_length - even[-1], BEYOND)
        lines = np.concatenate([even, rest[1:]])
        return lines, int(np.searchsorted(lines, FACING_REACH * edge))

    downstream, ahead = half(last)
    if not whole:
        return downstream, slice(0, ahead)
    upstream, behind = half(-first)
    middle = len(upstream) - 1
    return np.concatenate([-upstream[:0:-1], downstream]), slice(middle - behind, middle + ahead)
