"""What is read of a solved wall, as values that know nothing of the engine."""

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
    """Contact pressure from the upstream edge of the contact (θ = α₀) to the downstream one.

    Attributes
    ----------
    theta : array (n,)
        Angle from the upstream axis in rad, at the centre of a sphere, else parametric
        (`Profile`); increasing.
    pressure : array (n,)
        Normal force per deformed area (true stress, compression positive), in units of the modulus.
    traction : array (n,)
        Friction on the wall per deformed area, positive downstream, in units of the modulus.
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

    There are points = (order + 1)² in each element, the radial index first.

    Attributes
    ----------
    R, Z : arrays (elements, points)
        Reference coordinates, in inner radii.
    r, z : arrays (elements, points)
        Deformed coordinates, in inner radii.
    stress_rr, stress_tt, stress_zz, stress_rz : arrays (elements, points)
        Cauchy stress, tension positive, in units of the modulus (of Pa after `in_units`).
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
        """Return the wall with its stresses multiplied by `modulus`."""
        stresses = {name: modulus * getattr(self, name) for name in STRESSES}
        return replace(self, **stresses)


@array_dataclass
@dataclass(frozen=True)
class Deformation:
    """Deformation gradient F_iJ at the points of `Field`; i deformed, J reference direction."""

    F_rr: Float[np.ndarray, "elements points"]
    F_rz: Float[np.ndarray, "elements points"]
    F_zr: Float[np.ndarray, "elements points"]
    F_zz: Float[np.ndarray, "elements points"]
    F_tt: Float[np.ndarray, "elements points"]


@dataclass(frozen=True)
class Volume:
    """How well volume is preserved.

    Attributes
    ----------
    wall : float
        Relative change of the volume of the wall.
    rms : float
        Root mean square of J − 1 over the reference wall.
    smallest : float
        Smallest J at the integration points.
    """

    wall: float
    rms: float
    smallest: float
