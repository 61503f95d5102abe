"""Numbers read off a solved state: contact pressure, stress field, volume."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol, runtime_checkable

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.axisymmetric.contact import joined, lobatto, resampling
from stonepass.fe.axisymmetric.discrete import Discrete, inner_wall, smallest_volume_ratio
from stonepass.fe.axisymmetric.fitted_contact import Fitted
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.wall import SYMBOLS, cauchy_stress, strain

__all__ = [
    "ContactProfile",
    "Deformation",
    "Field",
    "Solved",
    "Volume",
    "axial_balance",
    "cone_excess",
    "contact_profile",
    "deformation",
    "field",
    "loaded_balance",
    "stored_energy",
    "volume",
]

SAMPLES_PER_COLUMN = 33
STRESSES = ("stress_rr", "stress_tt", "stress_zz", "stress_rz")
NUDGE = 1e-12  # of the mesh


@runtime_checkable
class Solved(Protocol):
    """Anything with a solved discretisation: a `Fitted` tube, or a `Slide`."""

    @property
    def discrete(self) -> Discrete:
        """Mesh and state."""

    @property
    def layout(self) -> Layout:
        """Grid lines."""


@dataclass(frozen=True)
class ContactProfile:
    """Contact pressure from the upstream edge of the contact (θ = α₀) to the downstream one.

    `theta` in rad is measured from the upstream axis, at the centre of a sphere, else parametric;
    `pressure` and `traction` (friction on the wall, positive downstream) are forces per deformed
    area, in units of the modulus; `station` is the reference coordinate Z/R_a.
    """

    theta: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    traction: Float[np.ndarray, " n"]
    station: Float[np.ndarray, " n"]


@dataclass(frozen=True)
class Field:
    """The deformed wall at the Gauss–Lobatto points of every element.

    Arrays are (elements, points) with points = (order + 1)², radial index first: reference
    coordinates `R`, `Z`, deformed `r`, `z`, and Cauchy stress components, tension positive.
    """

    R: Float[np.ndarray, "elements points"]
    Z: Float[np.ndarray, "elements points"]
    r: Float[np.ndarray, "elements points"]
    z: Float[np.ndarray, "elements points"]
    stress_rr: Float[np.ndarray, "elements points"]
    stress_tt: Float[np.ndarray, "elements points"]
    stress_zz: Float[np.ndarray, "elements points"]
    stress_rz: Float[np.ndarray, "elements points"]

    def in_units(self, modulus: float) -> Field:
        """The same wall with its stresses times `modulus`."""
        stresses = {name: modulus * getattr(self, name) for name in STRESSES}
        return replace(self, **stresses)


@dataclass(frozen=True)
class Deformation:
    """Deformation gradient at the points of `Field`: F_iJ, i deformed and J reference direction."""

    F_rr: Float[np.ndarray, "elements points"]
    F_rz: Float[np.ndarray, "elements points"]
    F_zr: Float[np.ndarray, "elements points"]
    F_zz: Float[np.ndarray, "elements points"]
    F_tt: Float[np.ndarray, "elements points"]


@dataclass(frozen=True)
class Volume:
    """How well volume is kept: relative change of the wall's volume, root mean square of J − 1,
    and the smallest J found at the integration points."""

    wall: float
    rms: float
    smallest: float


def contact_profile(solved: Fitted) -> ContactProfile:
    """Evaluate the contact forces per deformed area on a fine grid of the closed columns.

    The polynomials of each edge are rebuilt from their Gauss–Lobatto values; the area ratio is
    r ds/dZ / R_a with s the arc length of the deformed inner wall. Half a tube is mirrored.
    """
    wall = inner_wall(solved.discrete, "closed")
    values, slopes = resampling(solved.discrete.order, SAMPLES_PER_COLUMN)
    run = wall.station[:, -1:] - wall.station[:, :1]
    r, z = wall.r @ values.T, wall.z @ values.T
    area = r * np.hypot(wall.r @ slopes.T, wall.z @ slopes.T) / run

    def whole(
        samples: Float[np.ndarray, "edges points"], sign: float = 1.0, middle: float = 0.0
    ) -> Float[np.ndarray, " n"]:
        """Samples in axial order; of a half with their image, `sign` × them about the middle."""
        run = joined(samples)
        if solved.layout.whole:
            return run
        return np.concatenate([(middle + sign * (run - middle))[:0:-1], run])

    return ContactProfile(
        theta=whole(solved.discrete.arc.place.parametric(r, z), -1.0, np.pi / 2),
        pressure=whole((wall.normal @ values.T) / area),
        traction=whole((wall.tangential @ values.T) / area, -1.0),
        station=whole(wall.station @ values.T, -1.0),
    )


def field(solved: Solved) -> Field:
    """Evaluate the deformed wall and its stress."""
    u, w, p, _, _ = solved.discrete.state.components
    (R, Z), at, shape = _field_points(solved)
    # Compiled, the components share what they have in common: the slopes of the energy.
    stress = ng.CF(cauchy_stress(solved.discrete.tube.energy, u, w, p)).Compile()(at)
    return Field(
        R=R.reshape(shape),
        Z=Z.reshape(shape),
        r=(R + u(at)).reshape(shape),
        z=(Z + w(at)).reshape(shape),
        **{name: stress[:, k].reshape(shape) for k, name in enumerate(STRESSES)},
    )


def _field_points(solved: Solved) -> tuple[Any, Any, tuple[int, int]]:
    """Coordinates of, and handle on, the Gauss–Lobatto points of every element."""
    points, _ = lobatto(solved.discrete.order)
    rule = ng.IntegrationRule(
        points=[(float(a), float(b), 0.0) for a in points for b in points],
        weights=[1.0] * len(points) ** 2,
    )
    at = solved.discrete.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
    return (ng.x(at), ng.y(at)), at, (-1, len(points) ** 2)


def deformation(solved: Solved) -> Deformation:
    """Evaluate the deformation gradient where `field` evaluates the stress."""
    _, at, shape = _field_points(solved)
    u, w, _, _, _ = solved.discrete.state.components
    s = strain(u, w)
    return Deformation(
        **{name: getattr(s, name)(at).reshape(shape) for name in Deformation.__annotations__}
    )


def axial_balance(solved: Fitted) -> float:
    """Axial force left over on what the mesh covers, relative to the normal contact force.

    The stress at both sections (Z = 0, or −L, and L stay plane), the contact forces, and a
    hydrostatic pressure on the outer wall must add up to nothing; no equation of the solver says so
    directly.
    """
    d, tube = solved.discrete, solved.discrete.tube
    wall = inner_wall(d, "closed")
    n_r, n_z = d.arc.place.normal(wall.r, wall.z)
    axial = wall.normal * n_z + wall.tangential * n_r
    contact = 2.0 * np.pi * (wall.weight * axial).sum()
    scale = 2.0 * np.pi * (wall.weight * wall.normal).sum()
    sections = (_section_force(solved, float(Z)) for Z in solved.layout.axial[[0, -1]])
    (first, outer_first), (last, outer_last) = sections
    bath = np.pi * (outer_last**2 - outer_first**2) * tube.outside_pressure * tube.hydrostatic
    return float(abs(last - first + contact + bath) / scale)


def loaded_balance(solved: Solved, pressure: float, force: float) -> float:
    """Axial force left over on a loaded tube and its stone, relative to the force at its ends.

    The wall's stress at both ends, the fluid's on the upstream section, the force that holds the
    stone, a hydrostatic pressure on the outer wall and the tether must add up to nothing. `force`
    comes from the contact alone, so no equation of the solver says so directly.
    """
    tube, ends = solved.discrete.tube, solved.layout.axial[[0, -1]]
    (first, outer_first), (last, outer_last) = (_section_force(solved, float(Z)) for Z in ends)
    lumen = inner_wall(solved.discrete).r[0, 0]
    fluid = np.pi * pressure * lumen**2
    bath = np.pi * (outer_last**2 - outer_first**2) * tube.outside_pressure * tube.hydrostatic
    w = solved.discrete.state.components[1]
    away = w - (tube.axial_stretch - 1.0) * ng.y
    springs = ng.Integrate(tube.tether * away * ng.x * ng.ds("outer"), solved.discrete.mesh)
    rest = last - first + fluid - force + bath - 2.0 * np.pi * float(springs)
    return float(abs(rest) / (abs(first) + abs(last) + fluid))


def cone_excess(solved: Fitted) -> float:
    """Largest |λ_t| − μ λ_n at the nodes, where Coulomb's law is solved, over the largest λ_n."""
    wall = inner_wall(solved.discrete)
    excess = np.abs(wall.tangential) - solved.friction * np.maximum(wall.normal, 0.0)
    return float(excess.max() / wall.normal.max())


def _section_force(solved: Solved, Z: float) -> tuple[float, float]:
    """2π ∫ σ_zz r dr over a plane section, and the outer radius there."""
    d = solved.discrete
    u, w, p, _, _ = d.state.components
    stress_zz = cauchy_stress(d.tube.energy, u, w, p)[2]
    stretch_rr = strain(u, w).F_rr
    points, weights = np.polynomial.legendre.leggauss(d.order + 3)
    lines = solved.layout.radial
    run = np.diff(lines)[:, None]
    R = (lines[:-1, None] + run * (points + 1.0) / 2.0).ravel()
    # A hair inside the mesh: a point on its boundary may not be found in it.
    middle = solved.layout.axial.mean()
    Z += NUDGE * (middle - Z)
    outer = lines[-1] - NUDGE * (lines[-1] - lines[0])
    at = d.mesh(R, np.full_like(R, Z))
    density = stress_zz(at).ravel() * (R + u(at).ravel()) * stretch_rr(at).ravel()
    force = 2.0 * np.pi * float(((run * weights / 2.0).ravel() * density).sum())
    return force, float(lines[-1] + u(d.mesh(float(outer), float(Z))))


def stored_energy(solved: Fitted) -> float:
    """Strain energy of what the mesh covers, in units of modulus × inner radius³.

    Its slope in the radius of the sphere is the contact force: growing the sphere by dR does the
    work ∫ σ dA dR, which is all the work there is where no other load acts (a check by energy).
    """
    u, w, _, _, _ = solved.discrete.state.components
    density = ng.CF(solved.discrete.tube.energy(*strain(u, w).C, SYMBOLS))
    return float(
        2.0 * np.pi * ng.Integrate(density * ng.x * ng.dx(bonus_intorder=8), solved.discrete.mesh)
    )


def volume(solved: Solved) -> Volume:
    """Integrate J over the reference wall."""
    u, w, _, _, _ = solved.discrete.state.components
    J = strain(u, w).J

    def integral(density: Any) -> float:
        return float(ng.Integrate(density * ng.x * ng.dx(bonus_intorder=4), solved.discrete.mesh))

    reference = integral(ng.CF(1.0))
    change, square = integral(J - 1.0), integral((J - 1.0) * (J - 1.0))
    return Volume(
        wall=change / reference,
        rms=float(np.sqrt(square / reference)),
        smallest=smallest_volume_ratio(solved.discrete),
    )
