"""The wall's law and the strip's stiffness in a deck for CalculiX or Abaqus."""

from __future__ import annotations

from collections.abc import Iterator

from stonepass.errors import BadInput
from stonepass.export.seating import KPA, Seating, bulk_modulus
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.fung import Fung
from stonepass.materials.known_laws import name_of_law
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["deck_line", "has_overlaid_matrix", "material_lines"]

# Bulk modulus over G of a ground matrix that is laid over a hybrid wall: the wall keeps the volume.
MATRIX_BULK = 20.0


def has_overlaid_matrix(law: Law) -> bool:
    """Whether the ground matrix is a second set of elements on the nodes of the wall."""
    return isinstance(law, Fung)


def material_lines(s: Seating, flavour: str) -> Iterator[str]:
    """Lines of the materials and sections of wall, ground matrix and strip, moduli in kPa."""
    law = s.case.ureter.material.law
    D1 = 0.0 if flavour == "abaqus" else 2.0 / (bulk_modulus(law) / KPA)
    oriented = has_overlaid_matrix(law)
    if oriented:
        yield "** directions 1, 2, 3 are r, z and around"
        yield "*ORIENTATION, NAME=CYLINDER"
        yield "1., 0., 0., 0., 1., 0."
    yield "*MATERIAL, NAME=WALL"
    yield from _law(law, D1, flavour)
    yield "*SOLID SECTION, ELSET=WALL, MATERIAL=WALL" + ", ORIENTATION=CYLINDER" * oriented
    if isinstance(law, Fung):
        yield "*MATERIAL, NAME=MATRIX"
        yield from _law(NeoHookean(law.G / 2.0), 2.0 / (MATRIX_BULK * law.G / KPA), flavour)
        yield "*SOLID SECTION, ELSET=MATRIX, MATERIAL=MATRIX"
    yield "** its nodes all have prescribed motions"
    yield "*MATERIAL, NAME=STONE"
    yield "*ELASTIC"
    yield deck_line(25.0 * hoop_modulus(law) / KPA, 0.3)
    yield "*SOLID SECTION, ELSET=STRIP, MATERIAL=STONE"


def _law(law: Law, D1: float, flavour: str) -> Iterator[str]:
    if isinstance(law, NeoHookean):
        yield "*HYPERELASTIC, NEO HOOKE"
        yield deck_line(law.C10 / KPA, D1)
    elif isinstance(law, MooneyRivlin):
        yield "*HYPERELASTIC, MOONEY-RIVLIN"
        yield deck_line(law.C10 / KPA, law.C01 / KPA, D1)
    elif isinstance(law, Yeoh):
        yield "*HYPERELASTIC, YEOH"
        yield deck_line(law.C10 / KPA, law.C20 / KPA, law.C30 / KPA, D1, 0.0, 0.0)
    elif isinstance(law, Fung) and flavour == "abaqus":
        # b1111, b1122, b2222, b1133, b2233, b3333, b1212, b1313; b2323, c, D.
        yield "*ANISOTROPIC HYPERELASTIC, FUNG-ORTHOTROPIC"
        yield deck_line(0.0, 0.0, law.a2222, 0.0, law.a1122, law.a1111, 0.0, 0.0)
        yield deck_line(0.0, law.C / KPA, D1)
    else:
        named = name_of_law(law) or "a law of one's own"
        allowed = "neo-hookean, mooney-rivlin or yeoh in a deck for CalculiX"
        remedy = "--flavour abaqus and --format feb have fung too"
        raise BadInput("law", named, allowed, remedy)


def deck_line(*values: str | int | float) -> str:
    """Write one line of a deck, numbers separated by commas."""
    return ", ".join(f"{v:.12g}" if isinstance(v, float) else str(v) for v in values)
