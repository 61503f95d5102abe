"""How the stone came to its place in the seated state."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["SEATINGS", "Seating"]

SEATINGS = ("pressed", "frictionless", "growing")


@dataclass(frozen=True)
class Seating:
    """The way of the stone into the wall.

    Attributes
    ----------
    kind : {"pressed", "frictionless", "growing"}
        Its arc pressed radially into the wall as in the paper, without friction, or a sphere that
        grows in place.
    friction : float
        Coulomb coefficient on the way; 0 where the seating is frictionless.
    """

    kind: str
    friction: float
