"""Energy of an incompressible axisymmetric wall in displacements and pressure."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.problem import Energy
from stonepass.strain import CauchyGreen, Place

__all__ = ["PLACE", "SYMBOLS", "Strain", "cauchy_stress", "outside_work", "strain", "wall_energy"]

# The array namespace of a material law over the engine's symbols.
SYMBOLS = SimpleNamespace(
    exp=ng.exp,
    log=ng.log,
    sqrt=ng.sqrt,
    sin=ng.sin,
    cos=ng.cos,
    tan=ng.tan,
    sinh=ng.sinh,
    cosh=ng.cosh,
    tanh=lambda a: ng.sinh(a) / ng.cosh(a),
    arctan=ng.atan,
    maximum=lambda a, b: ng.IfPos(ng.CF(a) - ng.CF(b), ng.CF(a), ng.CF(b)),
    minimum=lambda a, b: ng.IfPos(ng.CF(a) - ng.CF(b), ng.CF(b), ng.CF(a)),
    abs=lambda a: ng.IfPos(a, a, -1.0 * a),
)

# Reference coordinates as symbols: those of the mesh are x = R and y = Z.
PLACE = Place(ng.x, ng.y)


@dataclass(frozen=True)
class Strain:
    """Deformation gradient and right Cauchy–Green components at a point, as symbols."""

    F_rr: Any
    F_rz: Any
    F_zr: Any
    F_zz: Any
    F_tt: Any

    @property
    def C(self) -> CauchyGreen:
        """Right Cauchy–Green components; those out of the r–z plane are zero."""
        return CauchyGreen(
            self.F_rr * self.F_rr + self.F_zr * self.F_zr,
            self.F_tt * self.F_tt,
            self.F_rz * self.F_rz + self.F_zz * self.F_zz,
            self.F_rr * self.F_rz + self.F_zr * self.F_zz,
        )

    @property
    def J(self) -> Any:
        """Volume ratio."""
        return (self.F_rr * self.F_zz - self.F_rz * self.F_zr) * self.F_tt


def strain(u: Any, w: Any) -> Strain:
    """Strain of the radial and axial displacements u and w (mesh coordinates x = R, y = Z)."""
    du, dw = ng.grad(u), ng.grad(w)
    return Strain(F_rr=1.0 + du[0], F_rz=du[1], F_zr=dw[0], F_zz=1.0 + dw[1], F_tt=1.0 + u / ng.x)


def wall_energy(energy: Energy, u: Any, w: Any, p: Any, stiffening: Any = 0.0) -> Any:
    """Lagrangian per reference area of the meridian (2π left out): (U − p (J − 1)) R.

    `stiffening` is the shear modulus of a matrix added for a homotopy, 0 for the wall itself.
    """
    s = strain(u, w)
    C = s.C
    matrix = 0.5 * stiffening * (C.rr + C.tt + C.zz - 3.0)
    return (energy(C, PLACE, SYMBOLS) + matrix - p * (s.J - 1.0)) * ng.x


def outside_work(u: Any, w: Any, pressure: Any, *, hydrostatic: bool) -> Any:
    """Potential of a pressure on the outer wall, per reference length (2π left out).

    hydrostatic: the pressure times the volume inside the outer wall, ½ r² ∂z/∂Z. Otherwise the
    radial resultant per reference length is kept (dead load, paper Eq. 10), potential R_b u.
    """
    if not hydrostatic:
        return pressure * ng.x * u
    r = ng.x + u
    return pressure * 0.5 * r * r * (1.0 + ng.grad(w).Trace()[1])


def cauchy_stress(energy: Energy, u: Any, w: Any, p: Any) -> tuple[Any, Any, Any, Any]:
    """Cauchy stress (σ_rr, σ_tt, σ_zz, σ_rz) as symbols: F S Fᵀ − p with S = 2 ∂U/∂C."""
    s = strain(u, w)
    C = CauchyGreen(*(ng.CF(c).MakeVariable() for c in s.C[:4]))
    U = ng.CF(energy(C, PLACE, SYMBOLS))
    S_rr, S_tt, S_zz = 2.0 * U.Diff(C.rr), 2.0 * U.Diff(C.tt), 2.0 * U.Diff(C.zz)
    S_rz = U.Diff(C.rz)  # C_rz stands for both off-diagonal components
    T_rr = S_rr * s.F_rr + S_rz * s.F_rz
    T_rz = S_rz * s.F_rr + S_zz * s.F_rz
    T_zr = S_rr * s.F_zr + S_rz * s.F_zz
    T_zz = S_rz * s.F_zr + S_zz * s.F_zz
    return (
        s.F_rr * T_rr + s.F_rz * T_rz - p,
        s.F_tt * s.F_tt * S_tt - p,
        s.F_zr * T_zr + s.F_zz * T_zz - p,
        s.F_zr * T_rr + s.F_zz * T_rz,
    )
