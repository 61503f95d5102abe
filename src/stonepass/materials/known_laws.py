"""The laws that a file may give constants for, by name: one line for each."""

from __future__ import annotations

from typing import Any

from stonepass.errors import refuse_unknown
from stonepass.materials.constants import ConstantDeclaration, constants_of
from stonepass.materials.demiray import Demiray
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["KNOWN_LAWS", "ONES_OWN", "constants_by_name", "known_law", "name_of_law"]

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
    """Look up a law; an unknown name is refused, naming the nearest one.

    Raises
    ------
    BadInput
        No law has this name; `argument` is how the caller calls it.
    """
    if name not in KNOWN_LAWS:
        refuse_unknown(argument, name, list(KNOWN_LAWS), ONES_OWN)
    return KNOWN_LAWS[name]


def constants_by_name(law: str) -> dict[str, ConstantDeclaration]:
    """Declarations of the constants of a known law, moduli first."""
    declared = sorted(constants_of(known_law(law)), key=lambda each: each.unit != "Pa")
    return {each.name: each for each in declared}


def name_of_law(law: Law) -> str:
    """Name of a known law; empty for any other."""
    return next((name for name, known in KNOWN_LAWS.items() if type(law) is known), "")
