"""The fitted solve: the contact edges are grid lines, and their stations are unknowns."""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.contact import AUGMENTATION, Arc, bilateral
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    discretise,
    edge_unknown,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.equilibrium import (
    POLISH,
    EquilibriumState,
    contact_flaw,
    equilibrium_state,
    residual_tolerance,
)
from stonepass.fe.axisymmetric.friction import closed_contact
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.layouts import graded_layout
from stonepass.fe.axisymmetric.mesh import Layout, place
from stonepass.fe.axisymmetric.problem import Failure, Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.slip import slip_origin
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.axisymmetric.transfer import interpolate_start
from stonepass.fe.core.newton import newton_or_homotopy
from stonepass.fe.core.systems import BorderedSystem

__all__ = ["solve_fitted_contact"]

ROUNDED_PENETRATION = 1e-7  # penetration attributed to rounding, in radii of the stone


def solve_fitted_contact(
    tube: Tube, stone: Profile, start: Start, resolution: Resolution, friction: float
) -> EquilibriumState | Failure:
    """Solve with the contact edges as grid lines whose stations are unknowns.

    The equation for each edge is that the normal contact force vanishes there. With friction the
    solve repeats the last increment of the loading path on the fitted mesh, so the slip is measured
    from `start.origin`. See "The contact edge" in docs/theory.md, section "Seated state".

    Parameters
    ----------
    tube : Tube
    stone : Profile
        The stone in its final position, lengths in inner radii.
    start : Start
        First guess of the state and of the contact edges.
    resolution : Resolution
    friction : float
        Coulomb coefficient, zero or positive. It has no effect if `start` has no slip origins,
        which the module `friction` explains.

    Returns
    -------
    EquilibriumState or Failure
        A failure is also returned if the solution is not an admissible contact (`contact_flaw`).
    """

    whole = start.discretisation.whole

    def layout(values: Float[np.ndarray, " edges"]) -> Layout:
        first, last = values if whole else (-values[0], values[0])
        edges = float(first), float(last)
        return graded_layout(tube, resolution, edges, start.contact, whole=whole)

    edges = np.array(start.contact if whole else start.contact[1:])
    at_start = layout(edges)
    d = discretise(tube, Arc.at(stone), at_start, resolution.order)
    interpolate_start(d, start)
    free = free_unknowns(d, "closed", friction=start.origin is not None)
    columns = [at_start.wet, at_start.wet + at_start.closed] if whole else [at_start.closed]
    at_edges = [edge_unknown(d, column) for column in columns]

    def move_edges(values: Float[np.ndarray, " edges"]) -> bool:
        first, last = (values[0], values[-1]) if whole else (0.0, values[0])
        if not -tube.half_length < first < last < tube.half_length:
            return False
        place(d.mesh, layout(values))
        return True

    system = BorderedSystem(
        _form(d, start, friction),
        d.state,
        free,
        values=edges,
        scale=np.full(len(edges), (start.contact[1] - start.contact[0]) / 2.0),
        apply=move_edges,
        conditions=lambda: np.array([d.state.vec[index] for index in at_edges]),
        kink_width=d.kink_width,
    )
    tolerance = residual_tolerance(system, start.force)
    report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
    if not report.converged:
        return Failure(report.reason, report.steps)
    flaw = contact_flaw(d, inner_wall(d, "closed").normal, ROUNDED_PENETRATION)
    if flaw:
        return Failure(flaw, report.steps)
    return equilibrium_state(d, layout(system.values), system, report, start, friction)


def _form(d: Discretisation, start: Start, friction: float) -> Any:
    """Return the form of the wall, with gap = 0 between the contact edges."""
    where = ng.ds("closed", intrules={ng.SEGM: d.rule})
    form, trial = wall_form(d), d.trial
    if start.origin is None:
        gap = d.arc.gap(trial.u, trial.w)
        form += ng.Variation(bilateral(trial.normal, gap).Compile() * where)
        return form
    contact = closed_contact(trial, d.test, d.arc, slip_origin(start), friction, AUGMENTATION)
    form += contact.Compile() * where
    return form
