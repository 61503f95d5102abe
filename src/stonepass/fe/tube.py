"""The tube on a rigid sphere, frictionless: a scout solve finds the contact edge, a fitted one
makes it a grid line.

The scout treats contact as an inequality on a coarse mesh. The fitted solve closes the columns up
to the edge, lets the multiplier vanish beyond, and takes the edge's place as an unknown whose
condition is that the multiplier vanishes there too: a smooth problem, with a result that is a
smooth function of the data, and with grid lines where the pressure has its square-root edge.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.contact import bilateral, lobatto_rule, sphere_gap, unilateral
from stonepass.fe.mesh import Layout, graded, place, structured_mesh
from stonepass.fe.newton import Bordered, Plain, Report, newton
from stonepass.fe.wall import SYMBOLS, Energy, outside_work, wall_energy

__all__ = ["Failure", "Fitted", "Resolution", "Tube", "Wrap", "seat_on_sphere"]

ng.ngsglobals.msg_level = 0


@dataclass(frozen=True)
class Tube:
    """A tube in units of its inner radius and of a modulus of its law.

    `wall_ratio` R_b/R_a, `half_length` L/R_a in the reference state, `axial_stretch` imposed at
    the ends, `outside_pressure` dead (radial resultant kept) or `hydrostatic`.
    """

    energy: Energy
    wall_ratio: float
    half_length: float
    axial_stretch: float = 1.0
    outside_pressure: float = 0.0
    hydrostatic: bool = False


@dataclass(frozen=True)
class Wrap:
    """First guess: inner radius and inner pressure along the tube, at reference stations Z/R_a.

    `reach` is the station up to which the wall is taken to touch the sphere.
    """

    station: Float[np.ndarray, " n"]
    inner_radius: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    reach: float


@dataclass(frozen=True)
class Resolution:
    """How fine the fitted mesh is; the defaults meet 0.05° in the contact edge.

    Attributes
    ----------
    order : int
        Polynomial order of the displacements; the pressure has one less.
    closed : int
        Columns in contact, graded towards the edge.
    edge : float
        Length of the columns next to the edge, as a fraction of the contact length.
    growth : float
        Largest ratio of neighbouring columns beyond the edge and of rows through the wall.
    """

    order: int = 4
    closed: int = 10
    edge: float = 0.02
    growth: float = 1.6

    def refined(self, factor: float = 2.0) -> Resolution:
        """Return a finer mesh of the same kind: more columns, a finer edge, gentler growth."""
        return replace(
            self,
            closed=round(self.closed * factor),
            edge=self.edge / factor,
            growth=self.growth ** (1.0 / factor),
        )


@dataclass(frozen=True)
class Failure:
    """No equilibrium was found, and why."""

    reason: str
    steps: int


@dataclass(frozen=True)
class Fitted:
    """A solved state: the engine's objects, for reading values off (see `fe.readout`)."""

    tube: Tube
    radius: float
    layout: Layout
    mesh: Any
    state: Any
    order: int
    report: Report
    dofs: int
    relative_residual: float


@dataclass(frozen=True)
class _Discrete:
    """Mesh, unknowns and symbols of one discretisation."""

    mesh: Any
    state: Any
    energy: Any
    gap: Any
    multiplier: Any
    work: Any
    rule: Any


def seat_on_sphere(
    tube: Tube, radius: float, wrap: Wrap, resolution: Resolution = Resolution()
) -> Fitted | Failure:
    """Solve for the tube stretched over a sphere of `radius` (in inner radii) at its middle."""
    steps = 0
    reasons = []
    for columns, stiffness in ((6, 8.0), (12, 30.0), (24, 3.0)):
        scout = _scout(tube, radius, wrap, columns, stiffness)
        steps += scout.steps
        if isinstance(scout, Failure):
            reasons.append(scout.reason)
            continue
        fitted = _fit(tube, radius, scout, resolution, steps)
        if isinstance(fitted, Fitted):
            return fitted
        steps = fitted.steps
        reasons.append(fitted.reason)
    return Failure(reasons[-1], steps)


@dataclass(frozen=True)
class _Scouted:
    discrete: _Discrete
    edge: float
    force: float
    steps: int


def _scout(
    tube: Tube, radius: float, wrap: Wrap, columns: int, stiffness: float
) -> _Scouted | Failure:
    """Solve the contact inequality on a coarse mesh and read off the contact edge."""
    first = wrap.reach / columns
    layout = Layout(
        radial=1.0 + _growing(first, tube.wall_ratio - 1.0, 3.0, least=2),
        axial=np.concatenate(
            [
                np.linspace(0.0, wrap.reach, columns + 1),
                wrap.reach + _growing(first, tube.half_length - wrap.reach, 2.0)[1:],
            ]
        ),
        closed=columns,
    )
    d = _discretise(tube, radius, layout, order=4)
    form = _form(d)
    c = ng.Parameter(stiffness)
    form += ng.Variation(
        unilateral(d.multiplier, d.gap, c).Compile()
        * ng.ds("closed|open", intrules={ng.SEGM: d.rule})
    )
    _first_guess(d, tube, wrap)
    system = Plain(form, d.state, d.state.space.FreeDofs())
    force = _contact_force(d, system)
    report = newton(system, 1e-6 * force, most=30)
    if not report.converged:
        return Failure(report.reason, report.steps)
    station, multiplier = _inner_wall(d, 4)
    touching = multiplier > 1e-6 * multiplier.max()
    if not touching.any():
        return Failure("the wall left the stone", report.steps)
    return _Scouted(d, float(station[touching].max()), force, report.steps)


def _fit(
    tube: Tube, radius: float, scout: _Scouted, resolution: Resolution, steps: int
) -> Fitted | Failure:
    """Solve with the contact edge as a grid line whose place is an unknown."""
    order = resolution.order

    def layout(edge: float) -> Layout:
        return _fitted_layout(edge, scout.edge, tube, resolution)

    d = _discretise(tube, radius, layout(scout.edge), order)
    for ours, theirs in zip(d.state.components[:3], scout.discrete.state.components, strict=False):
        ours.Set(theirs)
    contact, touched = d.state.components[3], scout.discrete.state.components[3]
    contact.Set(touched, definedon=d.mesh.Boundaries("closed"))
    form = _form(d)
    form += ng.Variation(
        bilateral(d.multiplier, d.gap).Compile() * ng.ds("closed", intrules={ng.SEGM: d.rule})
    )
    system = Bordered(
        form,
        d.state,
        _free_with_closed_contact(d),
        value=scout.edge,
        apply=lambda edge: place(d.mesh, layout(edge)),
        index=_edge_unknown(d, resolution.closed),
    )
    report = newton(system, max(1e-9 * scout.force, 1e-14), most=30)
    steps += report.steps
    if not report.converged:
        return Failure(report.reason, steps)
    flaw = _complementarity_flaw(d, order)
    if flaw:
        return Failure(flaw, steps)
    return Fitted(
        tube=tube,
        radius=radius,
        layout=layout(system.value),
        mesh=d.mesh,
        state=d.state,
        order=order,
        report=replace(report, steps=steps),
        dofs=int(sum(d.state.space.FreeDofs())),
        relative_residual=report.residual / _contact_force(d, system),
    )


def _fitted_layout(edge: float, reference: float, tube: Tube, resolution: Resolution) -> Layout:
    """Grid lines for a contact edge at `edge`; counts and rows are fixed by `reference`."""
    n, fraction = resolution.closed, resolution.edge
    inside = 1.0 - graded(n, fraction, 1.0)[::-1]
    beyond = _count(fraction * reference, tube.half_length - reference, resolution.growth)
    return Layout(
        radial=1.0
        + _growing(
            min(4.0 * fraction, 0.5) * reference, tube.wall_ratio - 1.0, 1.5 * resolution.growth
        ),
        axial=np.concatenate(
            [
                edge * inside,
                edge + graded(beyond, fraction * edge, tube.half_length - edge)[1:],
            ]
        ),
        closed=n,
    )


def _count(first: float, total: float, growth: float, least: int = 2) -> int:
    """Fewest geometric intervals from `first` to `total` whose ratio stays below `growth`."""
    if first >= total:
        return least
    return max(least, int(np.ceil(np.log1p(total / first * (growth - 1.0)) / np.log(growth))))


def _growing(
    first: float, total: float, growth: float, least: int = 2
) -> Float[np.ndarray, " points"]:
    return graded(_count(first, total, growth, least), first, total)


def _discretise(tube: Tube, radius: float, layout: Layout, order: int) -> _Discrete:
    mesh = structured_mesh(layout)
    inner = mesh.Boundaries("closed|open")
    space = ng.FESpace(
        [
            ng.H1(mesh, order=order),
            ng.H1(mesh, order=order, dirichlet="middle|end"),
            ng.H1(mesh, order=order - 1),
            ng.H1(mesh, order=order, definedon=inner),
        ]
    )
    u, w, p, multiplier = space.TrialFunction()
    work = outside_work(u, w, tube.outside_pressure, hydrostatic=tube.hydrostatic)
    return _Discrete(
        mesh=mesh,
        state=ng.GridFunction(space),
        energy=wall_energy(tube.energy, u, w, p),
        gap=sphere_gap(u, w, radius),
        multiplier=multiplier,
        work=work if tube.outside_pressure else None,
        rule=lobatto_rule(order),
    )


def _form(d: _Discrete) -> Any:
    """The wall's own part of the form; contact is added by the caller."""
    form = ng.BilinearForm(d.state.space, condense=True)
    form += ng.Variation(d.energy.Compile() * ng.dx(bonus_intorder=2))
    if d.work is not None:
        form += ng.Variation(d.work.Compile() * ng.ds("outer", bonus_intorder=2))
    return form


def _first_guess(d: _Discrete, tube: Tube, wrap: Wrap) -> None:
    """Wrap the wall isochorically round the sphere, with plane-strain pressures."""
    stretch = tube.axial_stretch

    def along(values: Float[np.ndarray, " n"]) -> Any:
        knots = [wrap.station[0], *wrap.station, wrap.station[-1]]
        return ng.BSpline(2, [float(k) for k in knots], [float(v) for v in values])(ng.y)

    inner = along(wrap.inner_radius)
    r = ng.sqrt((ng.x * ng.x - 1.0) / stretch + inner * inner)
    u, w, p, multiplier = d.state.components
    u.Set(r - ng.x)
    w.Set((stretch - 1.0) * ng.y)
    hoop = r / ng.x
    c_rr = (1.0 / (hoop * hoop * stretch**2)).MakeVariable()
    zero, axial = ng.CF(0.0), ng.CF(stretch**2)
    U = ng.CF(tube.energy(c_rr, hoop * hoop, axial, zero, SYMBOLS))
    pressure = along(wrap.pressure)
    depth = (ng.x - 1.0) / (tube.wall_ratio - 1.0)
    p.Set(2.0 * c_rr * U.Diff(c_rr) + pressure * (1.0 - depth) + tube.outside_pressure * depth)
    multiplier.Set(
        ng.IfPos(wrap.reach - ng.y, pressure * inner * stretch, 0.0),
        definedon=d.mesh.Boundaries("closed|open"),
    )


def _free_with_closed_contact(d: _Discrete) -> Any:
    """Free unknowns, the multiplier only where the wall is closed on the sphere."""
    space = d.state.space
    free = ng.BitArray(space.FreeDofs())
    contact = space.Range(3)
    closed = space.components[3].GetDofs(d.mesh.Boundaries("closed"))
    for local, index in enumerate(contact):
        free[index] = bool(free[index] and closed[local])
    return free


def _edge_unknown(d: _Discrete, closed: int) -> int:
    """Index of the multiplier at the contact edge: inner-wall vertex number `closed`.

    Vertices were added row by row, so the inner wall has the first ones, in axial order; the
    vertex unknowns of H1 come first and in that order.
    """
    return int(d.state.space.Range(3).start) + closed


def _contact_force(d: _Discrete, system: Plain) -> float:
    """Norm of the nodal contact forces, the scale of every residual."""
    full, without = d.state.vec.CreateVector(), d.state.vec.CreateVector()
    kept = d.state.vec.CreateVector()
    system.evaluate(full)
    kept.data = d.state.vec
    d.state.components[3].vec[:] = 0.0
    system.evaluate(without)
    d.state.vec.data = kept
    full.data -= without
    displacement = d.state.space.Range(1).stop
    return float(np.linalg.norm(full.FV().NumPy()[:displacement]))


def _inner_wall(
    d: _Discrete, order: int
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Stations Z and multiplier values at the Gauss–Lobatto points of the inner wall."""
    points = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("closed|open"))
    return ng.y(points).ravel(), d.state.components[3](points).ravel()


def _complementarity_flaw(d: _Discrete, order: int) -> str:
    """Empty where λ ≥ 0 on the closed and gap ≥ 0 on the open part of the inner wall."""
    u, w, _, multiplier = d.state.components
    closed = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("closed"))
    force = multiplier(closed)
    if force.min() < -1e-6 * force.max():
        return "the contact is not one closed band: the wall would lift off inside it"
    opened = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("open"))
    r, z = ng.x(opened) + u(opened), ng.y(opened) + w(opened)
    radius = np.hypot(ng.x(closed) + u(closed), ng.y(closed) + w(closed)).mean()
    if (np.hypot(r, z) - radius).min() < -1e-7 * radius:
        return "the wall would touch the stone again beyond the contact edge"
    return ""
