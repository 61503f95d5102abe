"""The registry of the laws that can be named in a material file."""

from __future__ import annotations

from typing import Any

from stonepass.errors import refuse_unknown
from stonepass.materials.composition import Composed
from stonepass.materials.constants import ConstantDeclaration, constants_of
from stonepass.materials.demiray import Demiray
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["COMPOSED", "KNOWN_LAWS", "ONES_OWN", "constants_by_name", "known_law", "name_of_law"]

COMPOSED = "composed"  # name of a law whose parts, fibres and matrix, are laws themselves

ONES_OWN = "another law is a Python function, FILE.py:energy, as docs/laws.md shows"

KNOWN_LAWS: dict[str, type[Any]] = {
    "neo-hookean": NeoHookean,
    "mooney-rivlin": MooneyRivlin,
    "yeoh": Yeoh,
    "fung": Fung,
    "ogden": Ogden,
    "holzapfel-gasser-ogden": HolzapfelGasserOgden,
    "demiray": Demiray,
}


def known_law(name: str, argument: str = "law") -> type[Any]:
    """Look up the class of a law.

    Parameters
    ----------
    name : str
        A key of `KNOWN_LAWS`.
    argument : str
        Name of the input in the error message.

    Raises
    ------
    BadInput
        No law has this name; the message suggests the most similar name.
    """
    if name not in KNOWN_LAWS:
        refuse_unknown(argument, name, list(KNOWN_LAWS), ONES_OWN)
    return KNOWN_LAWS[name]


def constants_by_name(law: str) -> dict[str, ConstantDeclaration]:
    """Return the declarations of the constants of a known law by name, moduli first."""
    declared = sorted(constants_of(known_law(law)), key=lambda each: each.unit != "Pa")
    return {each.name: each for each in declared}


def name_of_law(law: Law) -> str:
    """Return the name of a known or composed law; an empty string for any other law."""
    if isinstance(law, Composed):
        return COMPOSED
    return next((name for name, known in KNOWN_LAWS.items() if type(law) is known), "")
