"""The tube on a stone: predict the contact, follow the loading path with friction, fit the edges.

The contact predictor treats contact as an inequality on a coarse mesh. The fitted solve closes the
columns up to the edge, lets the contact force vanish beyond, and takes the station of the edge as
an unknown whose condition is that the force vanishes there too. That is a smooth problem: its
result is a smooth function of the data, and grid lines lie where the pressure has its square-root
edge.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache

from stonepass.fe.axisymmetric.active_set import solve_active_set
from stonepass.fe.axisymmetric.contact_predictor import predict_contact
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.fitted_contact import solve_fitted_contact
from stonepass.fe.axisymmetric.loading_path import WrapAt, follow_loading_path
from stonepass.fe.axisymmetric.problem import Failure, LoadingPath, Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.self_intersection import self_contact
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.core.threads import one_thread

__all__ = ["seat_on_stone"]

# (columns in contact, weight of the gap) of the contact predictor, tried in this order.
PREDICTORS = ((6, 8.0), (12, 30.0), (24, 3.0))


def seat_on_stone(
    tube: Tube,
    stone: Profile,
    wrap_at: WrapAt,
    resolutions: Sequence[Resolution] = (Resolution(),),
    path: LoadingPath | None = None,
) -> list[EquilibriumState | Failure]:
    """Solve for the tube stretched over a stone at its middle, once for each resolution.

    The resolutions share the contact predictor; without friction each solve starts from the one
    before. If a solve fails, the next settings of the predictor are tried.

    Parameters
    ----------
    tube : Tube
    stone : Profile
        The rigid body at its last place, lengths in inner radii. Where its halves are mirror images
        only the half Z ≥ 0 is solved, else the whole tube.
    wrap_at : callable
        From a place of the stone to a first guess of the wall round it.
    resolutions : sequence of Resolution
        Coarse before fine.
    path : LoadingPath, optional
        How the stone comes to its place with friction; without a path there is no friction.

    Returns
    -------
    list of EquilibriumState or Failure
        One for each resolution.
    """

    @cache
    def predicted(columns: int, weight: float) -> Start | Failure:
        return predict_contact(tube, stone, wrap_at(stone), columns, weight)

    def starts(resolution: Resolution) -> Iterator[Start | Failure]:
        """Starting points, best first; the steps of a prediction count at its first use only."""
        if found and path is None:
            yield from _after(found[-1])
        for settings in PREDICTORS:
            start = predicted(*settings)
            if settings in counted:
                start = replace(start, steps=0)
            counted.add(settings)
            if isinstance(start, Start) and path is not None:
                loaded = follow_loading_path(tube, path, wrap_at, start, resolution)
                start = replace(loaded, steps=start.steps + loaded.steps)
            yield start

    found: list[EquilibriumState | Failure] = []
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
    path: LoadingPath | None,
) -> EquilibriumState | Failure:
    """The first valid solution: from each start the fitted solve, then the active-set solve."""
    friction, steps, failure = 0.0 if path is None else path.friction, 0, Failure("", 0)
    for start in starts:
        steps += start.steps
        if isinstance(start, Failure):
            failure = start
            continue
        for solve in (solve_fitted_contact, solve_active_set):
            result = _without_self_contact(solve(tube, stone, start, resolution, friction))
            steps += result.steps
            if isinstance(result, EquilibriumState):
                return replace(result, steps=steps)
            failure = result
    return replace(failure, steps=steps)


def _without_self_contact(result: EquilibriumState | Failure) -> EquilibriumState | Failure:
    """Turn a wall that has folded onto itself into a failure."""
    Z = None if isinstance(result, Failure) else self_contact(result)
    if Z is None:
        return result
    reason = (
        f"the wall found has folded onto itself near Z = {Z:.3g} (inner radii): a wall in contact "
        "with itself is not modelled"
    )
    return Failure(reason, result.steps)


def _after(solved: EquilibriumState | Failure) -> Iterator[Start]:
    """A solution as the starting point of a finer one, if its edges are known exactly."""
    if isinstance(solved, EquilibriumState) and solved.edge_uncertainty == 0.0:
        yield Start(solved.discretisation, solved.layout.contact, solved.force, 0)
