"""The laws that a file may give constants for, by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from stonepass.materials.fung import Fung
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["KNOWN_LAWS", "KnownLaw", "name_of_law"]


@dataclass(frozen=True)
class KnownLaw:
    """A law and its constants.

    Attributes
    ----------
    make : callable
        Makes the law of its constants, in SI.
    moduli, numbers : tuple of str
        Constants in Pa, and those without unit.
    optional : dict of str to float
        Those that may be left out, and their value then.
    """

    make: Callable[..., Law]
    moduli: tuple[str, ...]
    numbers: tuple[str, ...] = ()
    optional: tuple[tuple[str, float], ...] = ()

    @property
    def constants(self) -> tuple[str, ...]:
        """All of them."""
        return (*self.moduli, *self.numbers)


KNOWN_LAWS = {
    "neo-hookean": KnownLaw(NeoHookean, ("C10",)),
    "mooney-rivlin": KnownLaw(MooneyRivlin, ("C10", "C01")),
    "yeoh": KnownLaw(Yeoh, ("C10", "C20", "C30")),
    "fung": KnownLaw(Fung, ("C", "G"), ("a1111", "a2222", "a1122"), (("G", 0.0),)),
}


def name_of_law(law: Law) -> str:
    """Its name here; empty for a law that is not known."""
    return next((name for name, known in KNOWN_LAWS.items() if type(law) is known.make), "")
