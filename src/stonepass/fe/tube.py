"""The tube on a rigid sphere: a scout finds the contact edge, with friction a path follows the
loading, and a fitted solve makes the edge a grid line.

The scout treats contact as an inequality on a coarse mesh. The fitted solve closes the columns up
to the edge, lets the contact force vanish beyond, and takes the edge's place as an unknown whose
condition is that the force vanishes there too: a smooth problem, with a result that is a smooth
function of the data, and with grid lines where the pressure has its square-root edge.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from threadpoolctl import ThreadpoolController

from stonepass.fe.fit import Fitted, fit
from stonepass.fe.press import WrapAt, press
from stonepass.fe.problem import Failure, Path, Resolution, Tube
from stonepass.fe.scout import Start, scout

__all__ = ["seat_on_sphere"]

# (columns in contact, weight of the gap) of the scout, tried in turn.
SCOUTS = ((6, 8.0), (12, 30.0), (24, 3.0))


def seat_on_sphere(
    tube: Tube,
    radius: float,
    wrap_at: WrapAt,
    resolution: Resolution = Resolution(),
    path: Path | None = None,
) -> Fitted | Failure:
    """Solve for the tube stretched over a sphere of `radius` (in inner radii) at its middle.

    Without a path there is no friction. The matrices are too small for threads: BLAS runs on one,
    which halves the processor time.
    """
    with _blas().limit(limits=1, user_api="blas"):
        steps, reasons = 0, []
        for columns, weight in SCOUTS:
            result = _attempt(tube, radius, wrap_at, resolution, path, columns, weight)
            steps += result.steps
            if isinstance(result, Fitted):
                return replace(result, steps=steps)
            reasons.append(result.reason)
        return Failure(reasons[-1], steps)


def _attempt(
    tube: Tube,
    radius: float,
    wrap_at: WrapAt,
    resolution: Resolution,
    path: Path | None,
    columns: int,
    weight: float,
) -> Fitted | Failure:
    start: Start | Failure = scout(tube, radius, wrap_at(radius, 0.0), columns, weight)
    steps = start.steps
    if isinstance(start, Start) and path is not None:
        start = press(tube, path, wrap_at, start)
        steps += start.steps
    if isinstance(start, Failure):
        return replace(start, steps=steps)
    friction = 0.0 if path is None else path.friction
    result = fit(tube, radius, start, resolution, friction)
    return replace(result, steps=steps + result.steps)


@lru_cache(maxsize=1)
def _blas() -> ThreadpoolController:
    return ThreadpoolController()
