"""Postprocessing: contact pressure, stress field, deformation and volume of a solved wall."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.discretisation import Discretisation, smallest_volume_ratio
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.wall import cauchy_stress, strain
from stonepass.fe.axisymmetric.wall_values import (
    STRESSES,
    ContactProfile,
    Deformation,
    Field,
    Volume,
)
from stonepass.fe.core.lobatto import joined, lobatto, resampling

__all__ = ["SolvedWall", "contact_profile", "deformation", "field", "volume"]

SAMPLES_PER_COLUMN = 33


@runtime_checkable
class SolvedWall(Protocol):
    """A solution that can be evaluated, for example an `EquilibriumState`."""

    @property
    def discretisation(self) -> Discretisation:
        """Mesh, and solution as its state."""

    @property
    def layout(self) -> Layout:
        """Grid lines of the mesh, in inner radii."""


def contact_profile(solved: EquilibriumState) -> ContactProfile:
    """Evaluate the contact forces per deformed area at many points of the contact.

    The polynomials on each edge are evaluated from their values at the Gauss–Lobatto points. The
    ratio of deformed to reference area is (r/R_a) ds/dZ, where s is the arc length of the deformed
    inner wall. A solution on the half Z ≥ 0 is completed by its mirror image.
    """
    wall = inner_wall(solved.discretisation, "closed")
    values, slopes = resampling(solved.discretisation.order, SAMPLES_PER_COLUMN)
    run = wall.station[:, -1:] - wall.station[:, :1]
    r, z = wall.r @ values.T, wall.z @ values.T
    area = r * np.hypot(wall.r @ slopes.T, wall.z @ slopes.T) / run

    def whole(
        samples: Float[np.ndarray, "edges points"], sign: float = 1.0, middle: float = 0.0
    ) -> Float[np.ndarray, " n"]:
        """Return samples in axial order; on a half mesh, prepend their mirror image.

        The mirror image of a sample x is middle + sign × (x − middle).
        """
        run = joined(samples)
        if solved.layout.whole:
            return run
        return np.concatenate([(middle + sign * (run - middle))[:0:-1], run])

    return ContactProfile(
        theta=whole(solved.discretisation.arc.place.parametric(r, z), -1.0, np.pi / 2),
        pressure=whole((wall.normal @ values.T) / area),
        traction=whole((wall.tangential @ values.T) / area, -1.0),
        station=whole(wall.station @ values.T, -1.0),
    )


def field(solved: SolvedWall) -> Field:
    """Evaluate the deformed wall (inner radii) and its Cauchy stress (units of the modulus)."""
    u, w, p, *_ = solved.discretisation.fields
    (R, Z), at, shape = _field_points(solved)
    # `Compile` evaluates the derivatives of the energy, common to all components, only once.
    stress = ng.CF(cauchy_stress(solved.discretisation.tube.energy, u, w, p)).Compile()(at)
    return Field(
        R=R.reshape(shape),
        Z=Z.reshape(shape),
        r=(R + u(at)).reshape(shape),
        z=(Z + w(at)).reshape(shape),
        **{name: stress[:, k].reshape(shape) for k, name in enumerate(STRESSES)},
    )


def _field_points(solved: SolvedWall) -> tuple[Any, Any, tuple[int, int]]:
    """Return the Gauss–Lobatto points of every element.

    The results are their reference coordinates (R, Z), the NGSolve object at which functions are
    evaluated, and the shape (elements, points) of the values.
    """
    points, _ = lobatto(solved.discretisation.order)
    rule = ng.IntegrationRule(
        points=[(float(a), float(b), 0.0) for a in points for b in points],
        weights=[1.0] * len(points) ** 2,
    )
    at = solved.discretisation.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
    return (ng.x(at), ng.y(at)), at, (-1, len(points) ** 2)


def deformation(solved: SolvedWall) -> Deformation:
    """Evaluate the deformation gradient at the points at which `field` evaluates the stress."""
    _, at, shape = _field_points(solved)
    u, w, *_ = solved.discretisation.fields
    s = strain(u, w)
    return Deformation(
        **{name: getattr(s, name)(at).reshape(shape) for name in Deformation.__annotations__}
    )


def volume(solved: SolvedWall) -> Volume:
    """Integrate the volume ratio J and its square over the reference wall."""
    u, w, *_ = solved.discretisation.fields
    J = strain(u, w).J

    def integral(density: Any) -> float:
        return float(
            ng.Integrate(density * ng.x * ng.dx(bonus_intorder=4), solved.discretisation.mesh)
        )

    reference = integral(ng.CF(1.0))
    change, square = integral(J - 1.0), integral((J - 1.0) * (J - 1.0))
    return Volume(
        wall=change / reference,
        rms=float(np.sqrt(square / reference)),
        smallest=smallest_volume_ratio(solved.discretisation),
    )
