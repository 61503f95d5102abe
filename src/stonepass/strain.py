"""The arguments of a strain energy: right Cauchy–Green components and the place in the wall."""

from __future__ import annotations

from typing import Any, NamedTuple

__all__ = ["INNER_WALL", "CauchyGreen", "Place"]


class CauchyGreen(NamedTuple):
    """Components of C = FᵀF in the cylindrical reference frame (r radial, t around, z axial).

    Each component is a number, an array or a symbol of the finite elements. C is symmetric, so
    `rz` stands for C_rz and C_zr alike, and a derivative with respect to it counts both. In
    axisymmetry without torsion `rt` and `tz` are the plain number 0.0.
    """

    rr: Any
    tt: Any
    zz: Any
    rz: Any = 0.0
    rt: Any = 0.0
    tz: Any = 0.0

    @property
    def I1(self) -> Any:
        """First invariant, the trace of C; 3 at rest."""
        return self.rr + self.tt + self.zz

    @property
    def I2(self) -> Any:
        """Second invariant, ½ (I₁² − tr C²); 3 at rest."""
        first = self.I1
        squares = self.rr * self.rr + self.tt * self.tt + self.zz * self.zz
        sheared = self.rz * self.rz + self.rt * self.rt + self.tz * self.tz
        return (first * first - (squares + 2.0 * sheared)) / 2.0

    @property
    def I3(self) -> Any:
        """Third invariant, det C = J²; 1 where volume is kept."""
        return (
            self.tt * (self.rr * self.zz - self.rz * self.rz)
            - self.rr * self.tz * self.tz
            - self.zz * self.rt * self.rt
            + 2.0 * self.rz * self.rt * self.tz
        )


class Place(NamedTuple):
    """Reference coordinates in inner radii at rest: R from 1 to η, Z along the axis."""

    R: Any
    Z: Any = 0.0


INNER_WALL = Place(1.0, 0.0)
