"""Warnings as data: a code and its values; the sentence is made where a person reads it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["SENTENCES", "Caution", "caution"]

# Every code, and its sentence without the period. Lengths are in inner radii.
SENTENCES = {
    "wall_beyond_range": (
        "the stone stretches the wall to {stretch:.3g} times its circumference, but the constants "
        "of material '{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "lumen_below_range": (
        "the load shrinks the lumen to {lumen:.3g} times its width, but the constants of material "
        "'{material}' were used for stretches {low:g} to {high:g} only"
    ),
    "ring_buckling": (
        "a confining pressure of {pressure_kPa:.3g} kPa would fold this tube where neither stone "
        "nor urine holds it open (ring buckling at about {buckling_kPa:.2g} kPa), which no "
        "axisymmetric model sees"
    ),
    "shape_deviation": (
        "the stone's shape follows its points to {deviation:.1%} of its radius only: the nearest "
        "smooth convex one is taken"
    ),
    "not_elliptic": (
        "the wall is not stable at R = {R:.3g}, Z = {Z:.3g} (inner radii): a shear band lowers its "
        "energy (stability margin {margin:.2g})"
    ),
    "hoop_compression": (
        "the wall is under hoop compression of {compression:.2g} times its shear modulus at "
        "R = {R:.3g}, Z = {Z:.3g} (inner radii): a real tube may fold, which no axisymmetric model "
        "sees"
    ),
    "microbuckling": (
        "the wall microbuckles at R = {R:.3g}, Z = {Z:.3g} (inner radii, downstream positive), "
        "where its axial fibres are compressed: it is solved with the energy that it has in the "
        "limit of fine buckles"
    ),
    "seated_imbalance": (
        "the axial forces on the tube miss their balance by {imbalance:.1%} of the contact force"
    ),
    "loaded_imbalance": (
        "the axial forces on tube and stone miss their balance by {imbalance:.1%}"
    ),
    "friction_cone": "friction exceeds its coefficient somewhere: Coulomb's law is violated",
    "error_not_estimated": "the error is not estimated: no coarser solve stands beside this one",
    "contact_angle_uncertain": (
        "the contact angle is known to {uncertainty_deg:.2f}° only, because no smooth contact edge "
        "was found"
    ),
    "closure_undecided": (
        "a coarser solve ends otherwise: whether the stone moves before the closure ends is within "
        "the discretisation error"
    ),
    "leak_undecided": (
        "a coarser solve ends otherwise: whether the stone moves before urine passes is within the "
        "discretisation error"
    ),
    "moves_at_contact_angle": (
        "the drive outweighs the resistance as soon as the stone is seated: the paper's closure "
        "starts at the unloaded inner radius although the load has narrowed the lumen; the "
        "critical pressure is taken from the seated contact angle, and closure_start = 'lumen' is "
        "the alternative"
    ),
    "long_beam_contact": (
        "half the contact is {decay_lengths:.2g} decay lengths of the beam long, which takes the "
        "stone's push as a point load"
    ),
    "thick_beam": (
        "the wall is {thickness:.2g} inner radii thick and widened by {widening:.2g} of them, "
        "which the beam takes as small"
    ),
    "no_closed_answer": "{outcome} by Eq. 15: {message}",
}


@dataclass(frozen=True)
class Caution:
    """What a reader of a result must know.

    Attributes
    ----------
    code : str
        One of `SENTENCES`; it stays the same when the sentence is reworded.
    values : tuple of (str, value)
        What the sentence says with numbers and names.
    """

    code: str
    values: tuple[tuple[str, Any], ...] = ()

    def __str__(self) -> str:
        """The sentence, without a period."""
        return SENTENCES[self.code].format(**dict(self.values))


def caution(code: str, **values: Any) -> Caution:
    """Make a caution; a code without a sentence, or with other values than it says, is a fault."""
    made = Caution(code, tuple(values.items()))
    str(made)
    return made
