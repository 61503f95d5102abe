"""Solution of the seated contact: contact predictor, loading path with friction, fitted solve.

The contact predictor treats contact as an inequality on a coarse mesh. The fitted solve prescribes
gap = 0 between the contact edges and zero contact force outside. The stations of the edges are
additional unknowns, and the additional equations are that the contact force vanishes at the edges.
This problem is smooth, so its solution depends smoothly on the data. In addition, a grid line lies
at the edge, where the contact pressure falls to zero like a square root. See "The contact edge" in
docs/theory.md, section "Seated state".
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

# Settings of the contact predictor, tried in this order: columns in half of the contact, weight.
PREDICTORS = ((6, 8.0), (12, 30.0), (24, 3.0))


def seat_on_stone(
    tube: Tube,
    stone: Profile,
    wrap_at: WrapAt,
    resolutions: Sequence[Resolution] = (Resolution(),),
    path: LoadingPath | None = None,
) -> list[EquilibriumState | Failure]:
    """Solve for the tube that is stretched over a stone at mid-length, once for each resolution.

    All resolutions share the contact predictor. Without friction each solve starts from the
    solution of the previous resolution. If a solve fails, it is repeated with the next settings of
    the predictor.

    Parameters
    ----------
    tube : Tube
    stone : Profile
        The stone in its final position, lengths in inner radii. If its halves are mirror images,
        only the half Z ≥ 0 of the tube is solved, otherwise the whole tube.
    wrap_at : callable
        ``wrap_at(stone)`` returns a first guess of the wall round a stone in the given position.
    resolutions : sequence of Resolution
        Coarse resolutions first.
    path : LoadingPath, optional
        Motion of the stone into its final position with friction; without a path there is no
        friction.

    Returns
    -------
    list of EquilibriumState or Failure
        One result for each resolution, in the same order.
    """

    @cache
    def predicted(columns: int, weight: float) -> Start | Failure:
        return predict_contact(tube, stone, wrap_at(stone), columns, weight)

    def starts(resolution: Resolution) -> Iterator[Start | Failure]:
        """Yield starting points, the most promising first.

        The Newton steps of a prediction are counted only when it is used for the first time.
        """
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
    """Try the fitted and then the active-set solve from each start; return the first solution."""
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
    """Return a failure if the wall of the solution intersects itself, else the result unchanged."""
    Z = None if isinstance(result, Failure) else self_contact(result)
    if Z is None:
        return result
    reason = (
        f"the wall has folded onto itself near Z = {Z:.3g} (inner radii), and contact of the wall "
        "with itself is not modelled"
    )
    return Failure(reason, result.steps)


def _after(solved: EquilibriumState | Failure) -> Iterator[Start]:
    """Yield a solution as a starting point for a finer solve, if its edges were unknowns."""
    if isinstance(solved, EquilibriumState) and solved.edge_uncertainty == 0.0:
        yield Start(solved.discretisation, solved.layout.contact, solved.force, 0)
