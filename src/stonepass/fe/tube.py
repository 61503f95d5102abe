"""The tube on a rigid sphere: a scout finds the contact edge, with friction a path follows the
loading, and a fitted solve makes the edge a grid line.

The scout treats contact as an inequality on a coarse mesh. The fitted solve closes the columns up
to the edge, lets the contact force vanish beyond, and takes the edge's place as an unknown whose
condition is that the force vanishes there too: a smooth problem, with a result that is a smooth
function of the data, and with grid lines where the pressure has its square-root edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache, lru_cache

from threadpoolctl import ThreadpoolController

from stonepass.fe.fit import Fitted, fit, settle
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
    resolutions: Sequence[Resolution] = (Resolution(),),
    path: Path | None = None,
) -> list[Fitted | Failure]:
    """Solve for the tube stretched over a sphere of `radius` (in inner radii) at its middle.

    Once for each resolution, coarse before fine: they share the scout, and without friction each
    starts from the one before. Without a path there is no friction. The matrices are too small for
    threads: BLAS runs on one, which halves the processor time.
    """

    @cache
    def scouted(columns: int, weight: float) -> Start | Failure:
        return scout(tube, radius, wrap_at(radius, 0.0), columns, weight)

    found: list[Fitted | Failure] = []
    with _blas().limit(limits=1, user_api="blas"):
        for resolution in resolutions:
            before = _after(found[-1]) if found and path is None else None
            start = before or _start(tube, wrap_at, path, resolution, scouted)
            found.append(_settled(tube, radius, start, resolution, path))
    return found


def _settled(
    tube: Tube, radius: float, start: Start | Failure, resolution: Resolution, path: Path | None
) -> Fitted | Failure:
    """The fitted solve, or where it fails the one that lets the mesh settle on the edge."""
    if isinstance(start, Failure):
        return start
    friction, steps = 0.0 if path is None else path.friction, start.steps
    for solve in (fit, settle):
        result = solve(tube, radius, start, resolution, friction)
        steps += result.steps
        if isinstance(result, Fitted):
            break
    return replace(result, steps=steps)


def _after(solved: Fitted | Failure) -> Start | None:
    """A solution as the start of a finer one."""
    if isinstance(solved, Failure) or solved.slack > 0.0:
        return None
    edge = float(solved.layout.axial[solved.layout.closed])
    return Start(solved.discrete, edge, solved.force, 0)


def _start(
    tube: Tube,
    wrap_at: WrapAt,
    path: Path | None,
    resolution: Resolution,
    scouted: Callable[[int, float], Start | Failure],
) -> Start | Failure:
    """Scout, and with friction follow the path; once more with other settings where it fails."""
    steps, failure = 0, Failure("", 0)
    for columns, weight in SCOUTS:
        found = scouted(columns, weight)
        steps += found.steps
        if isinstance(found, Start) and path is not None:
            found = press(tube, path, wrap_at, found, resolution)
            steps += found.steps
        if isinstance(found, Start):
            return replace(found, steps=steps)
        failure = found
    return replace(failure, steps=steps)


@lru_cache(maxsize=1)
def _blas() -> ThreadpoolController:
    return ThreadpoolController()
