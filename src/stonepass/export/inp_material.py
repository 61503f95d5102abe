"""The materials of wall, ground matrix and element strip in a deck for CalculiX or Abaqus.

The tables `CALCULIX` and `ABAQUS` contain the laws that each program has, with the function that
writes each law. Moduli are in kPa.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from stonepass.errors import BadInput
from stonepass.export.seating import KPA, DeckSeating, bulk_modulus
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.known_laws import KNOWN_LAWS, name_of_law
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["ABAQUS", "CALCULIX", "deck_line", "has_overlaid_matrix", "material_lines"]

# Bulk modulus of a ground matrix of its own elements, divided by G. It is small, because the hybrid
# elements of the wall on the same nodes keep the volume.
MATRIX_BULK = 20.0
A_LINE = 8  # largest number of constants in a line


def has_overlaid_matrix(law: Law) -> bool:
    """Return whether the ground matrix is a second set of elements on the nodes of the wall."""
    return isinstance(law, Fung)


def material_lines(s: DeckSeating, flavour: str) -> Iterator[str]:
    """Return the lines of the materials and sections of wall, ground matrix and strip.

    Parameters
    ----------
    s : DeckSeating
        Meshes, prescribed displacements and loads.
    flavour : {"calculix", "abaqus"}
        Program that reads the deck.

    Raises
    ------
    BadInput
        The program does not have the law of the wall.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    law = s.case.ureter.material.law
    D1 = 0.0 if flavour == "abaqus" else 2.0 / (bulk_modulus(law) / KPA)
    oriented = isinstance(law, Fung | HolzapfelGasserOgden)
    if oriented:
        yield from _orientation(law)
    yield "*MATERIAL, NAME=WALL"
    yield from _law(law, D1, flavour)
    yield "*SOLID SECTION, ELSET=WALL, MATERIAL=WALL" + ", ORIENTATION=CYLINDER" * oriented
    if isinstance(law, Fung):
        yield "*MATERIAL, NAME=MATRIX"
        yield from _neo_hookean(NeoHookean(law.G / 2.0), 2.0 / (MATRIX_BULK * law.G / KPA))
        yield "*SOLID SECTION, ELSET=MATRIX, MATERIAL=MATRIX"
    yield "** the displacements of all nodes of the strip are prescribed"
    yield "*MATERIAL, NAME=STONE"
    yield "*ELASTIC"
    yield deck_line(25.0 * hoop_modulus(law) / KPA, 0.3)
    yield "*SOLID SECTION, ELSET=STRIP, MATERIAL=STONE"


def _orientation(law: Law) -> Iterator[str]:
    """Return the lines of the local axes r, z, θ and of the fibre directions, if there are any."""
    yield "** the local directions 1, 2, 3 are radial, axial, circumferential"
    if not isinstance(law, HolzapfelGasserOgden):
        yield "*ORIENTATION, NAME=CYLINDER"
        yield "1., 0., 0., 0., 1., 0."
        return
    yield "*ORIENTATION, NAME=CYLINDER, LOCAL DIRECTIONS=2"
    yield "1., 0., 0., 0., 1., 0."
    yield "3, 0."
    for side in (1.0, -1.0):
        yield deck_line(0.0, side * math.sin(law.angle), math.cos(law.angle))


def _law(law: Law, D1: float, flavour: str) -> Iterator[str]:
    known = ABAQUS if flavour == "abaqus" else CALCULIX
    if type(law) in known:
        yield from known[type(law)](law, D1)
        return
    named = name_of_law(law) or "a user-defined law"
    *others, last = (name for name, each in KNOWN_LAWS.items() if each in known)
    program = "Abaqus" if flavour == "abaqus" else "CalculiX"
    elsewhere = "--flavour abaqus and --format feb have " if type(law) in ABAQUS else ""
    remedy = f"{elsewhere}{named} too" if elsewhere else "write its constants as one of these"
    raise BadInput("law", named, f"{', '.join(others)} or {last} in a deck for {program}", remedy)


def _neo_hookean(law: NeoHookean, D1: float) -> Iterator[str]:
    yield "*HYPERELASTIC, NEO HOOKE"
    yield deck_line(law.C10 / KPA, D1)


def _mooney_rivlin(law: MooneyRivlin, D1: float) -> Iterator[str]:
    yield "*HYPERELASTIC, MOONEY-RIVLIN"
    yield deck_line(law.C10 / KPA, law.C01 / KPA, D1)


def _yeoh(law: Yeoh, D1: float) -> Iterator[str]:
    yield "*HYPERELASTIC, YEOH"
    yield deck_line(law.C10 / KPA, law.C20 / KPA, law.C30 / KPA, D1, 0.0, 0.0)


def _ogden(law: Ogden, D1: float) -> Iterator[str]:
    """Write Σ 2 μ/α² (λ₁^α + λ₂^α + λ₃^α − 3), the convention of both programs: μ = μ_p α_p/2."""
    count = len(law.terms)
    yield f"*HYPERELASTIC, OGDEN, N={count}"
    pairs = [x for mu, alpha in law.terms for x in (mu * alpha / 2.0 / KPA, alpha)]
    constants = [*pairs, D1, *[0.0] * (count - 1)]
    for start in range(0, len(constants), A_LINE):
        yield deck_line(*constants[start : start + A_LINE])


def _fung(law: Fung, D1: float) -> Iterator[str]:
    # b1111, b1122, b2222, b1133, b2233, b3333, b1212, b1313; b2323, c, D.
    yield "*ANISOTROPIC HYPERELASTIC, FUNG-ORTHOTROPIC"
    yield deck_line(0.0, 0.0, law.a2222, 0.0, law.a1122, law.a1111, 0.0, 0.0)
    yield deck_line(0.0, law.C / KPA, D1)


def _holzapfel(law: HolzapfelGasserOgden, D1: float) -> Iterator[str]:
    # C10, D, k1, k2, kappa.
    yield "*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2"
    yield deck_line(law.mu / 2.0 / KPA, D1, law.k1 / KPA, law.k2, law.kappa)


Writer = Callable[[Any, float], Iterator[str]]

CALCULIX: Mapping[type[Any], Writer] = {
    NeoHookean: _neo_hookean,
    MooneyRivlin: _mooney_rivlin,
    Yeoh: _yeoh,
    Ogden: _ogden,
}
ABAQUS: Mapping[type[Any], Writer] = {
    **CALCULIX,
    Fung: _fung,
    HolzapfelGasserOgden: _holzapfel,
}


def deck_line(*values: str | int | float) -> str:
    """Return a line of a deck with values separated by commas."""
    return ", ".join(f"{v:.12g}" if isinstance(v, float) else str(v) for v in values)
