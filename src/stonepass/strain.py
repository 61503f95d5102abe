"""Arguments of a strain energy: right Cauchy–Green components, and place in the wall."""

from __future__ import annotations

from typing import Any, NamedTuple

__all__ = ["COMPONENTS", "INNER_WALL", "CauchyGreen", "Place"]

# Directions of the components rr, tt, zz, rz, rt, tz, where 0, 1, 2 stand for r, t, z.
COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 2), (0, 1), (1, 2))


class CauchyGreen(NamedTuple):
    """Components of the right Cauchy–Green tensor C = FᵀF in the cylindrical reference frame.

    All components are dimensionless. Each is a number, an array or a symbol of the finite elements.

    Attributes
    ----------
    rr, tt, zz
        Diagonal components: r radial, t circumferential, z axial.
    rz, rt, tz
        Off-diagonal components. C is symmetric, so `rz` represents both C_rz and C_zr, and a
        derivative with respect to `rz` is the sum of the derivatives by C_rz and C_zr. In
        axisymmetric deformations without torsion `rt` and `tz` are the Python number 0.0.
    """

    rr: Any
    tt: Any
    zz: Any
    rz: Any = 0.0
    rt: Any = 0.0
    tz: Any = 0.0

    @property
    def I1(self) -> Any:
        """First invariant, the trace of C; its value at rest is 3."""
        return self.rr + self.tt + self.zz

    @property
    def I2(self) -> Any:
        """Second invariant, ½ (I₁² − tr C²); its value at rest is 3."""
        first = self.I1
        squares = self.rr * self.rr + self.tt * self.tt + self.zz * self.zz
        sheared = self.rz * self.rz + self.rt * self.rt + self.tz * self.tz
        return (first * first - (squares + 2.0 * sheared)) / 2.0

    @property
    def I3(self) -> Any:
        """Third invariant, det C = J²; its value is 1 if the volume is preserved."""
        return (
            self.tt * (self.rr * self.zz - self.rz * self.rz)
            - self.rr * self.tz * self.tz
            - self.zz * self.rt * self.rt
            + 2.0 * self.rz * self.rt * self.tz
        )


class Place(NamedTuple):
    """Reference coordinates of a point of the wall, in undeformed inner radii.

    Attributes
    ----------
    R
        Radial coordinate, from 1 at the inner to η at the outer surface: a number, an array or a
        symbol.
    Z
        Axial coordinate, 0 at the widest place of the stone and positive downstream.
    """

    R: Any
    Z: Any = 0.0


INNER_WALL = Place(1.0, 0.0)
