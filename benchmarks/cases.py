"""The cases that are timed."""

from __future__ import annotations

import stonepass as sp


def tube(
    kind: str,
    material: str,
    eta: float,
    xi: float,
    friction: float = 0.5,
    model: str = "paper",
    accuracy: str = "standard",
) -> sp.Case:
    """Return the case of a sphere in a tube, given by ratios."""
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=friction),
        sp.Ureter(wall_ratio=eta, material=material),
        model=sp.PushThrough() if model == "direct" else sp.SeatedBalance(seating=kind),
        numerics=sp.Numerics(accuracy),
    )
