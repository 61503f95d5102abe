"""The tube on a rigid sphere, frictionless: a scout solve finds the contact edge, a fitted one
makes it a grid line.

The scout treats contact as an inequality on a coarse mesh. The fitted solve closes the columns up
to the edge, lets the multiplier vanish beyond, and takes the edge's place as an unknown whose
condition is that the multiplier vanishes there too: a smooth problem, with a result that is a
smooth function of the data, and with grid lines where the pressure has its square-root edge.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from threadpoolctl import ThreadpoolController

from stonepass.fe.fit import fit
from stonepass.fe.problem import Failure, Fitted, Resolution, Tube, Wrap
from stonepass.fe.scout import scout

__all__ = ["seat_on_sphere"]

# (columns in contact, weight of the gap) of the scout, tried in turn.
SCOUTS = ((6, 8.0), (12, 30.0), (24, 3.0))


def seat_on_sphere(
    tube: Tube, radius: float, wrap: Wrap, resolution: Resolution = Resolution()
) -> Fitted | Failure:
    """Solve for the tube stretched over a sphere of `radius` (in inner radii) at its middle.

    The matrices are too small for threads: BLAS runs on one, which halves the processor time.
    """
    with _blas().limit(limits=1, user_api="blas"):
        return _attempt(tube, radius, wrap, resolution)


@lru_cache(maxsize=1)
def _blas() -> ThreadpoolController:
    return ThreadpoolController()


def _attempt(tube: Tube, radius: float, wrap: Wrap, resolution: Resolution) -> Fitted | Failure:
    """Try again with a finer scout and another weight of the gap before giving up."""
    steps, reasons = 0, []
    for columns, weight in SCOUTS:
        scouted = scout(tube, radius, wrap, columns, weight)
        steps += scouted.steps
        if isinstance(scouted, Failure):
            reasons.append(scouted.reason)
            continue
        fitted = fit(tube, radius, scouted, resolution)
        if isinstance(fitted, Fitted):
            return replace(fitted, steps=steps + fitted.steps)
        steps += fitted.steps
        reasons.append(fitted.reason)
    return Failure(reasons[-1], steps)
