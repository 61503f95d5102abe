"""The loaded tube: a fluid pushes from upstream, and the wall slides on the held stone.

The whole tube, upstream first. Up to the first contact edge the inner wall carries the fluid's
pressure P as a follower load, beyond the last one nothing; between them it lies on the arc. There
the total contact pressure is

    λ = P φ(Z) + λ_n,    φ falling linearly from 1 at the first edge to 0 at the last,

so that the multiplier λ_n vanishes at both edges, λ goes on without a step, and λ ≥ P holds where
fluid stands before the contact. The slide is imminent everywhere, so friction is known: a traction
μ λ on the wall, downstream. Nothing sticks, and there is no path. Both edges are grid lines whose
places are unknowns, and so may be P: then the axial force on the stone is the condition for it.

The seal is where λ is largest. With `wetted` the fluid carries its share of the contact up to the
seal: there the traction is μ (λ − P). That makes a dip in λ where it ends, so the place of the seal
is taken from the state without it; the seal is a grid line.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float
from ngsolve.comp import IntegrationRuleSpace

from stonepass.fe.axisymmetric.contact import Arc, lobatto_slopes, resampling
from stonepass.fe.axisymmetric.discrete import (
    NORMAL,
    Discrete,
    InnerWall,
    discretise,
    edge_unknown,
    free_unknowns,
    inner_wall,
    set_at_nodes,
    smallest_volume_ratio,
    wall_form,
)
from stonepass.fe.axisymmetric.fitted_contact import (
    FIT_TOLERANCE,
    INSIDE_OUT,
    POLISH,
    ROUNDING,
    Fitted,
)
from stonepass.fe.axisymmetric.loading_path import along_wall
from stonepass.fe.axisymmetric.mesh import Layout, place
from stonepass.fe.axisymmetric.problem import Failure, Resolution, Tube
from stonepass.fe.core.grading import graded, growing, intervals
from stonepass.fe.core.newton import Bordered, Report, newton

__all__ = ["Slid", "Slide"]

PRESSURE = 2  # of the scalars, after the two edges
MOST_STEPS = 16  # of Newton's method, before the way there is halved
MOST_HALVINGS = 3
CONTACT = "wetted|closed"
SEAL_SAMPLES = 65  # of each column
FAR = (0.5, 0.9)  # from the stone to the ends
PENETRATION = 1e-3  # of the radius, at a step of friction
NEAREST_SEAL = 0.05  # to an edge, as a share of the contact


@dataclass(frozen=True)
class Slid:
    """One solved state of the loaded tube, in units of the modulus and the inner radius.

    Arrays are (edges, points) over the contact, from upstream: reference `station` Z, deformed `r`
    and `z`, total contact pressure per deformed area. `force` is the axial force on the stone,
    positive downstream; `pressure` P; `steps` the Newton steps with a tangent of their own since
    the state before; `penetration` how far the open wall passes through the stone, in its radii;
    `friction_work` what friction takes per length of reference wall that the stone goes on.
    """

    pressure: float
    force: float
    friction: float
    station: Float[np.ndarray, "edges points"]
    r: Float[np.ndarray, "edges points"]
    z: Float[np.ndarray, "edges points"]
    contact_pressure: Float[np.ndarray, "edges points"]
    steps: int
    residual: float
    penetration: float
    friction_work: float


@dataclass(frozen=True)
class FarField:
    """The tube far from the stone: r_a/R_a upstream, axial stretches of both sides."""

    radius: float
    upstream: float
    downstream: float


class Slide:
    """A discretisation of the loaded tube that goes from state to state.

    It starts from the tube `seated` without friction, a half of it mirrored; pressure and friction
    are 0. The stone is held `offset` downstream of mid-length, in the reference state.
    """

    def __init__(
        self,
        tube: Tube,
        seated: Fitted,
        resolution: Resolution,
        *,
        wetted: bool = False,
        offset: float = 0.0,
    ) -> None:
        first, last = seated.layout.contact
        self.tube, self.wetted, self.stone = tube, wetted, seated.discrete.arc.place
        self._resolution, self._seal = resolution, 0.5
        self._start, self._contact = (first, last), (last - first) / 2.0
        self._upstream, self._downstream = tube.half_length + offset, tube.half_length - offset
        self.layout = self._layout(first, last)
        self.discrete = discretise(tube, Arc.at(self.stone), self.layout, resolution.order)
        self._values = np.array([first, last, 0.0])
        self._first, self._last = ng.Parameter(first), ng.Parameter(last)
        self._pressure, self._friction = ng.Parameter(0.0), ng.Parameter(0.0)
        self._wet = ng.Parameter(0.0)  # 1 while the fluid takes its share of the friction
        self._free = free_unknowns(self.discrete, CONTACT)
        self._tolerance = max(2.0 * FIT_TOLERANCE * seated.force, ROUNDING)
        begins = self.layout.wet
        ends = begins + self.layout.wetted + self.layout.closed
        self._edges = [edge_unknown(self.discrete, column) for column in (begins, ends)]
        _take_over(seated, self.discrete)
        self._form = self._make_form()

    @property
    def dofs(self) -> int:
        """Number of unknowns solved for."""
        return int(sum(self._free))

    def held(self, pressure: float, friction: float) -> Slid | Failure:
        """The stone held while the fluid's pressure is P: by steps where one jump fails."""
        return self._go(np.array([pressure, friction]))

    def moving(self, pressure: float, friction: float) -> Slid | Failure:
        """The pressure at which no force is left on the stone; `pressure` is the first guess."""
        return self._go(np.array([pressure, friction]), self.force)

    def sealing(self, excess: float, pressure: float, friction: float) -> Slid | Failure:
        """The pressure that leaves the seal `excess` × P above P; `pressure` is the first guess."""

        def beyond() -> float:
            P = self._pressure.Get()
            return self._seal_pressure()[1] - (1.0 + excess) * P

        return self._go(np.array([pressure, friction]), beyond)

    def _go(
        self, target: Float[np.ndarray, " two"], condition: Callable[[], float] | None = None
    ) -> Slid | Failure:
        """Jump to a pressure and friction, or halve the way until a step converges.

        With a `condition`, to vanish at the end, the pressure of the target is a guess.
        """
        self._wet.Set(0.0)
        start = np.array([self._values[PRESSURE], self._friction.Get()])

        def jump(share: float) -> Report:
            pressure, friction = start + share * (target - start)
            last = condition if share == 1.0 else None
            return self._solve(float(pressure), float(friction), last)

        report = _by_shares(jump)
        steps = report.steps
        if report.converged and self.wetted:
            report = self._wet_contact(condition)
            steps += report.steps
        if not report.converged:
            return Failure(report.reason, steps)
        flaw = self._flaw()
        return Failure(flaw, steps) if flaw else self._read(steps, report.residual)

    def _wet_contact(self, condition: Callable[[], float] | None) -> Report:
        """Let the fluid take its share of the friction up to the seal.

        Where that fails the state is again the dry one.
        """
        seal, pressure, friction = self._seal, float(self._values[PRESSURE]), self._friction.Get()
        self._move_seal()

        def wet(share: float) -> Report:
            before = self._wet.Get()
            self._wet.Set(share)
            report = self._solve(float(self._values[PRESSURE]), friction, condition)
            if not report.converged:
                self._wet.Set(before)
            return report

        report = _by_shares(wet)
        if not report.converged:  # the way back is dry, and ends where it began
            self._wet.Set(0.0)
            self._seal = seal
            self._place(self._values)
            self._solve(pressure, friction, None)
        return report

    def _flaw(self) -> str:
        """Empty where the contact is pressed all over, and closed nowhere else, and J > 0.

        At the first edge friction begins with a step, μ P, which tilts the wall on both sides: the
        open wall may pass through the stone a little, and λ fall below P within the first node.
        Fluid would enter there, without friction, and the step move on with it; so it has no place
        of its own. What it does to the force is of the order of the penetration, and that is held
        below `PENETRATION`.
        """
        if not smallest_volume_ratio(self.discrete) > 0.0:  # NaN too
            return INSIDE_OUT
        _, total, _ = self._contact_forces()
        if total.min() < -1e-6 * total.max():
            return "the contact is not one closed band: the wall would lift off inside it"
        if self._penetration() > PENETRATION:
            return "the wall would touch the stone again beyond the contact"
        return ""

    def _move_seal(self) -> None:
        """Put the seal's grid line where the contact pressure is largest."""
        first, last, _ = self._values
        share = (self._seal_pressure()[0] - first) / (last - first)
        self._seal = min(max(share, NEAREST_SEAL), 1.0 - NEAREST_SEAL)
        self._place(self._values)

    def friction_work(self) -> float:
        """What friction takes per length that the stone goes on along the reference wall.

        ∫ λ_t λ_s dA, λ_t the traction and λ_s the wall's meridional stretch: so much wall slides.
        """
        wall, total, area = self._contact_forces()
        stretch = area / wall.r
        traction = self._traction(total, area)
        return float(2.0 * np.pi * (wall.weight * traction * stretch).sum())

    def _traction(self, total: Any, area: Any) -> Any:
        """Friction per reference area."""
        rubbed, wetted = total.copy(), slice(self.layout.wetted)
        rubbed[wetted] -= self._wet.Get() * self._pressure.Get() * area[wetted]
        return self._friction.Get() * rubbed

    def _seal_pressure(self) -> tuple[float, float]:
        """Station and size of the largest contact pressure."""
        wall, total, area = self._contact_forces()
        fine = resampling(self.discrete.order, SEAL_SAMPLES)[0].T
        pressure = (total / area) @ fine
        at = int(np.argmax(pressure))
        return float((wall.station @ fine).flat[at]), float(pressure.flat[at])

    def _solve(
        self, pressure: float, friction: float, condition: Callable[[], float] | None
    ) -> Report:
        """Newton's method at one pressure, or for it; back to the state before where it fails."""
        d, before, mu = self.discrete, self._values.copy(), self._friction.Get()
        self._friction.Set(friction)
        unknown = 2 if condition is None else 3
        rest = np.array([pressure])[: 3 - unknown]

        def apply(values: Float[np.ndarray, " n"]) -> bool:
            return self._place(np.concatenate([values, rest]))

        def conditions() -> Float[np.ndarray, " n"]:
            at_edges = [d.state.vec[index] for index in self._edges]
            return np.array(at_edges if condition is None else [*at_edges, condition()])

        scale = np.array([self._contact, self._contact, max(pressure, 0.05)])
        values = np.array([*self._values[:PRESSURE], pressure])
        system = Bordered(
            self._form,
            d.state,
            self._free,
            values=values[:unknown],
            scale=scale[:unknown],
            apply=apply,
            conditions=conditions,
        )
        state = system.remember()
        report = newton(system, self._tolerance, most=MOST_STEPS, polish=POLISH)
        if not report.converged:
            system.recall(state)
            self._friction.Set(mu)
            self._place(before)
        return report

    def _place(self, values: Float[np.ndarray, " three"]) -> bool:
        """Move edges and pressure; False where the edges are in the wrong order or off the tube."""
        first, last, pressure = (float(value) for value in values)
        if not -self._upstream < first < last < self._downstream:
            return False
        self._values = np.array([first, last, pressure])
        self.layout = self._layout(first, last)
        place(self.discrete.mesh, self.layout)
        self._first.Set(first)
        self._last.Set(last)
        self._pressure.Set(pressure)
        return True

    def _make_form(self) -> Any:
        d, P = self.discrete, self._pressure
        (u, w, _, normal, _), (du, dw, _, d_normal, _) = d.state.space.TnT()
        form = wall_form(d)
        r, r_slope, z_slope = _meridian(u, w)
        fluid = P * r * (z_slope * du - r_slope * dw)  # P n dA for a virtual displacement
        form += (-1.0 * fluid).Compile() * ng.ds("wet", bonus_intorder=4)
        force = normal + P * self._ramp() * _area(u, w)
        slip = d.arc.virtual_slip(u, w, du, dw)
        rubbed = force - self._wet * P * _area(u, w)
        gap = d.arc.virtual_gap(u, w, du, dw)
        rows = d.arc.gap(u, w) * d_normal
        for part, pressed in (("wetted", rubbed), ("closed", force)):
            work = force * gap + self._friction * pressed * slip
            where = ng.ds(part, intrules={ng.SEGM: d.rule})
            form += (-1.0 * (work + rows) * ng.x).Compile() * where
        return form

    def _ramp(self) -> Any:
        return (self._last - ng.y) / (self._last - self._first)

    def _layout(self, first: float, last: float) -> Layout:
        """Grid lines for contact from `first` to `last`; counts and rows are those of the start."""
        resolution, contact = self._resolution, self._contact
        n, fraction = resolution.closed, resolution.edge / 2.0
        length, size = last - first, fraction * (last - first)

        def beyond(room: float) -> int:
            return intervals(2.0 * fraction * contact, room, resolution.growth)

        up, down = (
            beyond(self._upstream + self._start[0]),
            beyond(self._downstream - self._start[1]),
        )
        upstream = first - graded(up, size, self._upstream + first)[::-1]
        downstream = last + graded(down, size, self._downstream - last)
        wetted = first + length * graded(n, fraction, self._seal)
        dry = last - length * graded(n, fraction, 1.0 - self._seal)[::-1]
        first_row = min(8.0 * fraction, 0.5) * contact
        return Layout(
            radial=1.0 + growing(first_row, self.tube.wall_ratio - 1.0, 1.5 * resolution.growth),
            axial=np.concatenate([upstream[:-1], wetted, dry[1:], downstream[1:]]),
            closed=n,
            wet=up,
            wetted=n,
        )

    def _penetration(self) -> float:
        """How far the open wall passes through the stone, in half-widths of the stone."""
        opened = inner_wall(self.discrete, "wet|open")
        gap = float(self.stone.gap(opened.r, opened.z).min())
        return max(0.0, -gap / self.stone.radius)

    def far_field(self) -> FarField:
        """Inner radius and axial stretch, between halfway to the ends and nearly there."""
        wall = inner_wall(self.discrete)
        station, r, z = wall.station.ravel(), wall.r.ravel(), wall.z.ravel()

        def stretch(end: float) -> float:
            near, far = np.interp([share * end for share in FAR], station, z)
            return float((far - near) / ((FAR[1] - FAR[0]) * end))

        radius = float(np.interp(-sum(FAR) / 2.0 * self._upstream, station, r))
        return FarField(radius, stretch(-self._upstream), stretch(self._downstream))

    def force(self) -> float:
        """Axial force on the stone, positive downstream.

        The fluid's on the disc that the first edge encloses, less that of the stone on the wall,
        in the quadrature of the form.
        """
        wall, total, area = self._contact_forces()
        pressure, traction = self._pressure.Get(), self._traction(total, area)
        n_r, n_z = self.stone.normal(wall.r, wall.z)
        axial = total * n_z + traction * n_r
        on_wall = 2.0 * np.pi * (wall.weight * axial).sum()
        return float(np.pi * pressure * wall.r[0, 0] ** 2 - on_wall)

    def _contact_forces(self) -> tuple[InnerWall, Any, Any]:
        """Contact wall, contact force per reference area, and deformed over reference area."""
        wall = inner_wall(self.discrete, CONTACT)
        run = wall.station[:, -1:] - wall.station[:, :1]
        slopes = lobatto_slopes(self.discrete.order).T
        area = wall.r * np.hypot(wall.r @ slopes, wall.z @ slopes) / run
        first, last, pressure = self._values
        ramp = (last - wall.station) / (last - first)
        return wall, wall.normal + pressure * ramp * area, area

    def _read(self, steps: int, residual: float) -> Slid:
        wall, total, area = self._contact_forces()
        return Slid(
            pressure=float(self._values[PRESSURE]),
            force=self.force(),
            friction=self._friction.Get(),
            station=wall.station,
            r=wall.r,
            z=wall.z,
            contact_pressure=total / area,
            steps=steps,
            residual=residual / self._tolerance * FIT_TOLERANCE,
            penetration=self._penetration(),
            friction_work=self.friction_work(),
        )


def _by_shares(attempt: Callable[[float], Report]) -> Report:
    """Go a way at once, or by halves of it where that fails; `attempt` goes back where it fails."""
    share, step, steps = 0.0, 1.0, 0
    while True:
        ahead = min(share + step, 1.0)
        report = attempt(ahead)
        steps += report.steps
        if report.converged:
            share, step = ahead, 2.0 * step
        else:
            step /= 2.0
        if share == 1.0 or step < 0.9 / 2.0**MOST_HALVINGS:
            return replace(report, steps=steps)


def _meridian(u: Any, w: Any) -> tuple[Any, Any, Any]:
    """Deformed radius of the inner wall, and the slopes of r and z along Z."""
    return ng.x + u, ng.grad(u).Trace()[1], 1.0 + ng.grad(w).Trace()[1]


def _area(u: Any, w: Any) -> Any:
    """Deformed area of the inner wall per reference area (R_a = 1)."""
    r, r_slope, z_slope = _meridian(u, w)
    return r * ng.sqrt(r_slope * r_slope + z_slope * z_slope)


def _take_over(seated: Fitted, d: Discrete) -> None:
    """Interpolate a tube, a half and its mirror image; forces at nodes, the rest by projection."""
    space = IntegrationRuleSpace(d.mesh, order=2 * d.order)
    rules = space.GetIntegrationRules()
    at = d.mesh.MapToAllElements(rules, ng.VOL)
    R, Z = ng.x(at).ravel(), ng.y(at).ravel()
    whole, end = seated.layout.whole, seated.layout.axial[-1]
    there = seated.discrete.mesh(R, np.clip(Z if whole else np.abs(Z), -end, end))
    samples, where = ng.GridFunction(space), ng.dx(intrules=rules)
    for k, sign in enumerate((1.0, 1.0 if whole else np.sign(Z), 1.0)):
        values = seated.discrete.state.components[k](there).ravel()
        samples.vec.FV().NumPy()[:] = sign * values
        target = d.state.components[k]
        trial, test = target.space.TnT()
        mass = ng.BilinearForm(trial * test * where).Assemble().mat
        rhs = ng.LinearForm(samples * test * where).Assemble().vec
        target.vec.data = mass.Inverse(inverse="umfpack") * rhs
    _hold_ends(d)
    wall = inner_wall(seated.discrete)
    station, normal = wall.station.ravel(), wall.normal.ravel()
    if not whole:
        station = np.concatenate([-station[::-1], station])
        normal = np.concatenate([normal[::-1], normal])
    set_at_nodes(d.state.components[NORMAL], along_wall(station, normal), d)


def _hold_ends(d: Discrete) -> None:
    """Put the ends where the pre-stretch has them."""
    w, ends = d.state.components[1], d.mesh.Boundaries("end")
    held = ng.GridFunction(w.space)
    held.Set((d.tube.axial_stretch - 1.0) * ng.y, definedon=ends)
    for index, on in enumerate(w.space.GetDofs(ends)):
        if on:
            w.vec[index] = held.vec[index]
