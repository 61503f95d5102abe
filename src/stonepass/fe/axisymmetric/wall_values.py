"""Results of the finite elements as arrays, without references to NGSolve objects."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float

__all__ = ["STRESSES", "ContactProfile", "Deformation", "Field", "Volume"]

STRESSES = ("stress_rr", "stress_tt", "stress_zz", "stress_rz")


@array_dataclass
@dataclass(frozen=True)
class ContactProfile:
    """Contact pressure along the contact, from its upstream edge (θ = α₀) to its downstream edge.

    Attributes
    ----------
    theta : array (n,)
        Angle from the upstream axis in rad, increasing. It is the angle at the centre of a sphere,
        and the parametric angle τ of `Profile` for other stones.
    pressure : array (n,)
        Normal force per deformed area (true stress, compression positive), in units of the modulus.
    traction : array (n,)
        Friction force on the wall per deformed area, positive downstream, in units of the modulus.
    station : array (n,)
        Reference coordinate Z, in inner radii.
    """

    theta: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    traction: Float[np.ndarray, " n"]
    station: Float[np.ndarray, " n"]


@array_dataclass
@dataclass(frozen=True)
class Field:
    """The deformed wall at the Gauss–Lobatto points of every element.

    Each element has (order + 1)² points; the axial index varies fastest.

    Attributes
    ----------
    R, Z : arrays (elements, points)
        Reference coordinates, in inner radii.
    r, z : arrays (elements, points)
        Deformed coordinates, in inner radii.
    stress_rr, stress_tt, stress_zz, stress_rz : arrays (elements, points)
        Cauchy stress, tension positive, in units of the modulus, or in Pa after `in_units`.
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
        """Return the same field with the stresses multiplied by `modulus` (in Pa)."""
        stresses = {name: modulus * getattr(self, name) for name in STRESSES}
        return replace(self, **stresses)


@array_dataclass
@dataclass(frozen=True)
class Deformation:
    """Deformation gradient F_iJ at the points of a `Field`.

    The first index is the deformed direction, the second one the reference direction: r radial, z
    axial, t circumferential. All components are dimensionless arrays (elements, points).
    """

    F_rr: Float[np.ndarray, "elements points"]
    F_rz: Float[np.ndarray, "elements points"]
    F_zr: Float[np.ndarray, "elements points"]
    F_zz: Float[np.ndarray, "elements points"]
    F_tt: Float[np.ndarray, "elements points"]


@dataclass(frozen=True)
class Volume:
    """Error of the volume of a wall, which is exactly preserved in theory.

    Attributes
    ----------
    wall : float
        Relative change of the total volume of the wall.
    rms : float
        Root mean square of J − 1 over the reference wall, where J is the volume ratio.
    smallest : float
        Smallest J at the integration points.
    """

    wall: float
    rms: float
    smallest: float
