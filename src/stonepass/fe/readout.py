"""Numbers read off a solved state: contact pressure, stress field, volume."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.contact import lobatto, lobatto_rule
from stonepass.fe.problem import Fitted
from stonepass.fe.wall import SYMBOLS, cauchy_stress, strain

__all__ = [
    "ContactProfile",
    "Field",
    "Volume",
    "contact_profile",
    "field",
    "stored_energy",
    "volume",
]

SAMPLES_PER_COLUMN = 33


@dataclass(frozen=True)
class ContactProfile:
    """Contact pressure along the half in contact, from the contact edge (θ = α₀) to θ = π/2.

    `theta` in rad is measured at the sphere's centre from the tube axis; `pressure` is the force
    per deformed area, in units of the modulus; `station` is the reference coordinate Z/R_a.
    """

    theta: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
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


@dataclass(frozen=True)
class Volume:
    """How well volume is kept: relative change of the wall's volume, root mean square of J − 1,
    and the smallest J found at the integration points."""

    wall: float
    rms: float
    smallest: float


def contact_profile(solved: Fitted) -> ContactProfile:
    """Evaluate the multiplier per deformed area on a fine grid of the closed columns.

    The polynomials of each edge are rebuilt from their Gauss–Lobatto values; the area ratio is
    r ds/dZ / R_a with s the arc length of the deformed inner wall.
    """
    points = solved.mesh.MapToAllElements(
        {ng.SEGM: lobatto_rule(solved.order)}, solved.mesh.Boundaries("closed")
    )
    u, w, _, multiplier = solved.state.components
    per_edge = (-1, solved.order + 1)
    Z = ng.y(points).reshape(per_edge)
    order = np.argsort(Z.mean(axis=1))
    Z = Z[order]
    r = 1.0 + u(points).reshape(per_edge)[order]
    z = Z + w(points).reshape(per_edge)[order]
    force = multiplier(points).reshape(per_edge)[order]

    values, slopes = _resample(lobatto(solved.order)[0], SAMPLES_PER_COLUMN)
    if Z[0, 0] > Z[0, -1]:  # the edge runs against the axis
        values, slopes = values[::-1], slopes[::-1]
    run = Z[:, -1:] - Z[:, :1]
    arc_rate = np.hypot(r @ slopes.T, z @ slopes.T) / np.abs(run)
    pressure = (force @ values.T) / ((r @ values.T) * arc_rate)
    theta = np.arctan2(r @ values.T, z @ values.T)
    station = Z @ values.T
    keep = np.concatenate([[True], np.diff(station.ravel()) > 0.0])
    return ContactProfile(
        theta=theta.ravel()[keep][::-1],
        pressure=pressure.ravel()[keep][::-1],
        station=station.ravel()[keep][::-1],
    )


def field(solved: Fitted) -> Field:
    """Evaluate the deformed wall and its stress."""
    points, _ = lobatto(solved.order)
    rule = ng.IntegrationRule(
        points=[(float(a), float(b), 0.0) for a in points for b in points],
        weights=[1.0] * len(points) ** 2,
    )
    at = solved.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
    u, w, p, _ = solved.state.components
    shape = (-1, len(points) ** 2)
    R, Z = ng.x(at), ng.y(at)
    stress = [
        component(at).reshape(shape) for component in cauchy_stress(solved.tube.energy, u, w, p)
    ]
    return Field(
        R=R.reshape(shape),
        Z=Z.reshape(shape),
        r=(R + u(at)).reshape(shape),
        z=(Z + w(at)).reshape(shape),
        stress_rr=stress[0],
        stress_tt=stress[1],
        stress_zz=stress[2],
        stress_rz=stress[3],
    )


def stored_energy(solved: Fitted) -> float:
    """Strain energy of the half tube Z ≥ 0, in units of modulus × inner radius³.

    Its slope in the radius of the sphere is the contact force: growing the sphere by dR does the
    work ∫ σ dA dR, which is all the work there is where no other load acts (a check by energy).
    """
    u, w, _, _ = solved.state.components
    density = ng.CF(solved.tube.energy(*strain(u, w).C, SYMBOLS))
    return float(2.0 * np.pi * ng.Integrate(density * ng.x * ng.dx(bonus_intorder=8), solved.mesh))


def volume(solved: Fitted) -> Volume:
    """Integrate J over the reference wall."""
    u, w, _, _ = solved.state.components
    J = strain(u, w).J

    def integral(density: Any) -> float:
        return float(ng.Integrate(density * ng.x * ng.dx(bonus_intorder=4), solved.mesh))

    reference = integral(ng.CF(1.0))
    change, square = integral(J - 1.0), integral((J - 1.0) * (J - 1.0))
    rule = ng.IntegrationRule(ng.QUAD, 2 * solved.order)
    at = solved.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
    return Volume(
        wall=change / reference,
        rms=float(np.sqrt(square / reference)),
        smallest=float(J(at).min()),
    )


def _resample(
    nodes: Float[np.ndarray, " n"], count: int
) -> tuple[Float[np.ndarray, "count n"], Float[np.ndarray, "count n"]]:
    """Matrices that turn nodal values of a polynomial into values and slopes at `count` points."""
    fine = np.linspace(0.0, 1.0, count)
    vandermonde = np.polynomial.legendre.legvander(2.0 * nodes - 1.0, len(nodes) - 1)
    inverse = np.linalg.inv(vandermonde)
    basis = np.polynomial.legendre.legvander(2.0 * fine - 1.0, len(nodes) - 1)
    unit = np.eye(len(nodes))
    derivative = np.stack(
        [
            2.0 * np.polynomial.legendre.legval(2.0 * fine - 1.0, np.polynomial.legendre.legder(e))
            for e in unit
        ],
        axis=1,
    )
    return basis @ inverse, derivative @ inverse
