"""Options and limits that all input files for other finite-element programs have in common.

This module loads no numerical library, because the declarations of the formats use it.
"""

from __future__ import annotations

from stonepass.export.contract import Limit, Option

__all__ = [
    "ELEMENT", "FINE", "FLAVOUR", "FROM_CONTACT", "LENGTHS", "SEATED_IGNORES", "SEATED_LIMITS",
    "WRITE_AS",
]  # fmt: skip

LENGTHS = (0.002, 0.5)  # smallest and largest length of the elements in the contact, inner radii
FINE = Option(
    "fine",
    "length of the elements in the contact, in inner radii",
    float,
    default_text="0.025 or less",
    bounds=LENGTHS,
    unit="in inner radii R_a",
)
FLAVOUR = Option(
    "flavour",
    "program that reads the input deck",
    str,
    default="calculix",
    choices=("calculix", "abaqus"),
)
ELEMENT = Option(
    "element", "element type of the wall", str, default="CAX8", choices=("CAX8", "CAX8R")
)
WRITE_AS = "write its constants as one of these"
SEATED_LIMITS = {
    "model": Limit(("paper",), "the file describes the seated state, which is the paper's model"),
    "seating": Limit(("pressed", "frictionless", "growing")),
    "load": Limit(("prestretch", "dead", "hydrostatic")),
    "shape": Limit(("sphere", "spheroid", "outline")),
}
# Inputs of calculations that use the contact; they change neither the wall nor its contact.
FROM_CONTACT = (
    "as_printed", "closure_start", "closure", "series_order", "opening_curve", "far_field_ground",
)  # fmt: skip
# The input files have the mesh of `FINE`, and describe the seated state of the paper's model alone.
SEATED_IGNORES = ("accuracy", *FROM_CONTACT, "wetted")
