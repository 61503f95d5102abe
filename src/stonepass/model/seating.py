"""The seating: the way in which the stone is brought into the wall in the seated state."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["SEATINGS", "Seating"]

SEATINGS = ("pressed", "frictionless", "growing")


@dataclass(frozen=True)
class Seating:
    """The way in which the stone is brought into the wall.

    See "Friction and its path" in docs/theory.md, section "Seated state".

    Attributes
    ----------
    kind : {"pressed", "frictionless", "growing"}
        ``"pressed"``: the meridian of the stone is pressed radially into the wall, as in the paper.
        ``"growing"``: the stone grows in place from the size of the lumen. ``"frictionless"``: the
        wall slides without friction, so the way of the stone has no influence.
    friction : float
        Coulomb coefficient during the seating; 0 if the seating is frictionless.
    """

    kind: str
    friction: float
