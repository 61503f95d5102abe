"""The seating of a stone as meshes and prescribed displacements for finite-element programs.

The model consists of the mesh of the wall, the element strip that represents the stone, and the
prescribed displacements of the strip and of the ends of the wall.
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
from stonepass.model.seating import Seating
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of
from stonepass.units import METRE_PER_MM, PASCAL_PER, Length

__all__ = ["KPA", "MM", "DeckSeating", "bulk_modulus", "seating"]

COARSEST = 0.025  # largest default length of the elements in the contact, in inner radii
PER_CONTACT = 16  # least default number of elements on each side of the guessed contact
BEYOND = 1.3  # largest ratio of the lengths of neighbouring elements outside the contact
# Length of the part of the wall that may touch the stone, divided by the guessed contact length.
FACING_REACH = 1.5
UNIT_RADIUS = Length(1e-3)  # R_a in m for a case that has only ratios
# Dimensionless stiffness of the contact: penalty × element length in the contact/w″(1). With this
# value the contact pressure of CalculiX is accurate to 1 %; with a larger one the contact state
# oscillates.
PENALTY = 2.0
POISSON = 0.499  # Poisson's ratio for programs that cannot keep the volume exactly
INCREMENT = 0.4  # largest displacement per increment, in element lengths
FEWEST = 8  # smallest number of increments
# Kilopascal in Pa and millimetre in m, the units of the input files; forces are in millinewtons.
KPA, MM = PASCAL_PER["kPa"], METRE_PER_MM
LONGEST_NAME = 60  # largest number of characters of a material name in a file


@array_dataclass
@dataclass(frozen=True)
class DeckSeating:
    """Meshes and prescribed displacements; all lengths are in inner radii.

    The widest cross-section of the stone lies at z = 0. The loading has two steps. In the first
    step the ends are pulled to the pre-stretch and the confining pressure is applied, while the
    element strip closes half of its clearance. In the second step the strip completes its
    displacement `travel` and presses the wall open.

    Attributes
    ----------
    case : Case
        Stone, ureter and load.
    wall : Grid
        The unloaded wall. Rows run from the inner wall outwards, columns along the tube. It is half
        the tube, from the plane of symmetry, if the halves of the stone are mirror images.
    element_strip : Grid
        The surface of the stone in its initial position; the last line of its first index faces the
        wall.
    travel : array (strip_points, 2)
        Displacement r, z of each node of the element strip over both steps.
    facing : slice
        Columns of the wall whose inner faces may touch the stone.
    whole : bool
        True if the wall is the whole tube.
    fine : float
        Length of the elements in the contact.
    stiffness : float
        Penalty of the contact times `fine` divided by w″(1), dimensionless.

    References
    ----------
    docs/export.md, "What is in an input deck".
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
        """Coulomb friction coefficient while the stone is being seated."""
        return seating_of(self.case).friction

    @property
    def inner_radius(self) -> Length:
        """Inner radius R_a in m; 1 mm if the case has only ratios."""
        diameter = self.case.ureter.inner_diameter
        return UNIT_RADIUS if diameter is None else Length(diameter / 2.0)

    @property
    def penalty(self) -> float:
        """Contact pressure divided by penetration, in Pa per inner radius."""
        return self.stiffness * hoop_modulus(self.case.ureter.material.law) / self.fine

    @property
    def loaded(self) -> bool:
        """True if there is a pre-stretch or a confining pressure to apply in the first step."""
        return self.case.load.prestretch != 1.0 or self.case.load.confining_pressure > 0.0

    @property
    def pull(self) -> float:
        """Axial displacement of an end of the tube for the pre-stretch, in inner radii."""
        return (self.case.load.prestretch - 1.0) * self.case.numerics.half_length

    def heading(self) -> tuple[str, ...]:
        """Return the lines that describe the case at the head of a file."""
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
        """Eight letters and digits that identify the case and the mesh of a file."""
        return fingerprint(self.case, self.inner_radius, self.fine)

    @property
    def length(self) -> float:
        """Largest displacement of a node of the element strip, in inner radii."""
        return float(np.linalg.norm(self.travel, axis=1).max())

    @property
    def first_fraction(self) -> float:
        """Fraction of the displacement of the strip that belongs to the first step."""
        return 0.5 * CLEARANCE / self.length

    @property
    def increment(self) -> float:
        """Largest displacement of the element strip in one increment, in inner radii.

        Twice this value is faster if the program still converges.
        """
        return min(INCREMENT * self.fine, self.length / FEWEST)

    def dead_forces(self) -> Float[np.ndarray, " nodes"]:
        """Return the radial forces of a dead confining pressure on the nodes of the outer line.

        The force on a node over the whole circumference is 2π P_out R_b ∫ N dZ with the shape
        function N of the node. The integrals of an element are 1/6, 4/6 and 1/6 of its length.

        Returns
        -------
        array (nodes)
            Forces in Pa × R_a², positive inwards.
        """
        nodes = self.wall.row_line(-1)
        Z = self.wall.points[nodes, 1]
        tributary = np.zeros(len(nodes))  # ∫ N dZ of each node
        run = Z[2::2] - Z[:-2:2]
        for offset, weight in ((0, 1.0), (1, 4.0), (2, 1.0)):
            tributary[offset : len(nodes) - 2 + offset : 2] += weight / 6.0 * run
        pressure = self.case.load.confining_pressure
        return 2.0 * np.pi * pressure * self.case.wall_ratio * tributary


def seating(case: Case, fine: float | None = None) -> DeckSeating:
    """Make the meshes and the prescribed displacements for the seating of a stone.

    Parameters
    ----------
    case : Case
        A case of the paper's model.
    fine : float, optional
        Length of the elements in the contact in inner radii, 0.002 to 0.5. By default it is at most
        0.025, and small enough for about 16 elements in contact on each side.

    Returns
    -------
    DeckSeating

    Raises
    ------
    BadInput
        The stone is not larger than the lumen or only hardly so, the law is unstable, the model of
        the case is not the paper's, `fine` is out of bounds, or the element strip would begin too
        close to the axis.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    fine = None if fine is None else checked_value(FINE, fine, as_keyword)
    way = seating_of(case)
    check(case.ureter.material)
    lumen = stuck_lumen(case)
    least = lumen * (1.0 + SMALLEST_RESOLVED_OVERSIZE)
    require(case.size_ratio >= least, "size ratio", case.size_ratio, f"at least {least:.6g}, since "
            "the mesh cannot resolve a shorter contact")  # fmt: skip
    place = profile_of(case)
    first, last = wrap_round_arc(case, case.numerics.half_length, lumen, 1.0, place).contact
    if fine is None:
        fine = max(LENGTHS[0], min(COARSEST, -first / PER_CONTACT, last / PER_CONTACT))
    whole = not place.symmetric
    axial, facing = _axial_lines(case, fine, first, last, whole)
    radial = 1.0 + growing(fine, case.wall_ratio - 1.0, BEYOND)
    strip, travel = element_strip(case, way, place, min(lumen, 1.0), (first, last), whole)
    return DeckSeating(case, grid(radial, axial), strip, travel, facing, whole, fine)


def seating_of(case: Case) -> Seating:
    """Return how the stone of a case is seated in the wall.

    Raises
    ------
    BadInput
        The model of the case has no seated state.
    """
    model = case.model
    if not isinstance(model, SeatedBalance):
        why = "the file describes the seated state, which is the paper's model"
        raise BadInput("model", model.NAME, "'paper'", why)
    return model.seating_of(case)


def bulk_modulus(law: Law) -> float:
    """Return the bulk modulus in Pa of a nearly incompressible wall.

    κ = 2 μ (1 + ν)/(3 (1 − 2ν)) with the shear modulus μ = w″(1)/4 and Poisson's ratio ν = 0.499.

    Examples
    --------
    >>> from stonepass.materials.neo_hookean import NeoHookean
    >>> round(bulk_modulus(NeoHookean(0.5)), 3)
    499.667
    """
    return hoop_modulus(law) / 2.0 * (1.0 + POISSON) / (3.0 * (1.0 - 2.0 * POISSON))


def _axial_lines(
    case: Case, fine: float, first: float, last: float, whole: bool
) -> tuple[Float[np.ndarray, " lines"], slice]:
    """Return the grid lines along the tube, and the columns that may touch the stone."""

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
