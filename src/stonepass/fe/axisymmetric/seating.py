"""The tube on a rigid stone: a scout finds the contact edge, with friction a path follows the
loading, and a fitted solve makes the edge a grid line.

The scout treats contact as an inequality on a coarse mesh. The fitted solve closes the columns up
to the edge, lets the contact force vanish beyond, and takes the edge's place as an unknown whose
condition is that the force vanishes there too: a smooth problem, with a result that is a smooth
function of the data, and with grid lines where the pressure has its square-root edge.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache

from stonepass.fe.axisymmetric.contact_predictor import Start, scout
from stonepass.fe.axisymmetric.fitted_contact import Fitted, fit, settle
from stonepass.fe.axisymmetric.loading_path import WrapAt, press
from stonepass.fe.axisymmetric.problem import Failure, Path, Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.self_intersection import self_contact
from stonepass.fe.core.threads import one_thread

__all__ = ["seat_on_stone"]

# (columns in contact, weight of the gap) of the scout, tried in turn.
SCOUTS = ((6, 8.0), (12, 30.0), (24, 3.0))


def seat_on_stone(
    tube: Tube,
    stone: Profile,
    wrap_at: WrapAt,
    resolutions: Sequence[Resolution] = (Resolution(),),
    path: Path | None = None,
) -> list[Fitted | Failure]:
    """Solve for the tube stretched over a stone (lengths in inner radii) at its middle.

    The half Z ≥ 0 of it where the stone's halves are mirror images, else the whole.

    Once for each resolution, coarse before fine: they share the scout, and without friction each
    starts from the one before. Without a path there is no friction.
    """

    @cache
    def scouted(columns: int, weight: float) -> Start | Failure:
        return scout(tube, stone, wrap_at(stone), columns, weight)

    def starts(resolution: Resolution) -> Iterator[Start | Failure]:
        """Where to start from, best first; the steps of a scout count where it is first used."""
        if found and path is None:
            yield from _after(found[-1])
        for settings in SCOUTS:
            start = scouted(*settings)
            if settings in counted:
                start = replace(start, steps=0)
            counted.add(settings)
            if isinstance(start, Start) and path is not None:
                pressed = press(tube, path, wrap_at, start, resolution)
                start = replace(pressed, steps=start.steps + pressed.steps)
            yield start

    found: list[Fitted | Failure] = []
    counted: set[tuple[int, float]] = set()
    with one_thread():
        for resolution in resolutions:
            found.append(_first(starts(resolution), tube, stone, resolution, path))
    return found


def _first(
    starts: Iterator[Start | Failure],
    tube: Tube,
    stone: Profile,
    resolution: Resolution,
    path: Path | None,
) -> Fitted | Failure:
    """The first sound solution: from each start the fitted solve, then the one that settles."""
    friction, steps, failure = 0.0 if path is None else path.friction, 0, Failure("", 0)
    for start in starts:
        steps += start.steps
        if isinstance(start, Failure):
            failure = start
            continue
        for solve in (fit, settle):
            result = _sound(solve(tube, stone, start, resolution, friction))
            steps += result.steps
            if isinstance(result, Fitted):
                return replace(result, steps=steps)
            failure = result
    return replace(failure, steps=steps)


def _sound(result: Fitted | Failure) -> Fitted | Failure:
    """A wall that has folded onto itself is no solution."""
    Z = None if isinstance(result, Failure) else self_contact(result)
    if Z is None:
        return result
    reason = (
        f"the wall found has folded onto itself near Z = {Z:.3g} (inner radii): a wall in contact "
        "with itself is not modelled"
    )
    return Failure(reason, result.steps)


def _after(solved: Fitted | Failure) -> Iterator[Start]:
    """A solution as the start of a finer one."""
    if isinstance(solved, Fitted) and solved.slack == 0.0:
        yield Start(solved.discrete, solved.layout.contact, solved.force, 0)
