"""Energy and stress of an incompressible axisymmetric wall, from displacements and pressure.

u and w are the radial and the axial displacement in inner radii, p is the pressure that enforces
incompressibility, in units of the modulus. All are NGSolve coefficient functions or trial functions
of the mesh coordinates x = R and y = Z. See "Seated state" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.problem import Energy
from stonepass.strain import CauchyGreen, Place

__all__ = [
    "PLACE",
    "SYMBOLS",
    "Strain",
    "cauchy_stress",
    "outside_work",
    "rounded_symbols",
    "strain",
    "wall_energy",
]

# The array namespace `xp` with which a material law is evaluated on NGSolve coefficient functions.
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


def rounded_symbols(width: Any) -> SimpleNamespace:
    """Return the namespace `SYMBOLS` with a larger and a smaller value that have no kink.

    The larger of a and b is (a + b + √((a − b)² + width²))/2, which differs from it by half the
    width at most, where a = b.

    Parameters
    ----------
    width : ngsolve.Parameter
        Width of the rounded kink; the kink is not rounded while it is zero.
    """

    def maximum(a: Any, b: Any) -> Any:
        a, b = ng.CF(a), ng.CF(b)
        away = a - b
        rounded = 0.5 * (a + b + ng.sqrt(away * away + width * width))
        return ng.IfPos(width, rounded, SYMBOLS.maximum(a, b))

    def minimum(a: Any, b: Any) -> Any:
        return -1.0 * maximum(-1.0 * ng.CF(a), -1.0 * ng.CF(b))

    return SimpleNamespace(**vars(SYMBOLS) | {"maximum": maximum, "minimum": minimum})


# Reference coordinates as NGSolve coefficient functions; the mesh coordinates are x = R and y = Z.
PLACE = Place(ng.x, ng.y)


@dataclass(frozen=True)
class Strain:
    """Deformation gradient F_iJ as NGSolve coefficient functions, all dimensionless.

    The first index is the deformed direction, the second one the reference direction: r radial, z
    axial, t circumferential.
    """

    F_rr: Any
    F_rz: Any
    F_zr: Any
    F_zz: Any
    F_tt: Any

    @property
    def C(self) -> CauchyGreen:
        """Components of the right Cauchy–Green tensor; C_rt and C_tz are zero."""
        return CauchyGreen(
            self.F_rr * self.F_rr + self.F_zr * self.F_zr,
            self.F_tt * self.F_tt,
            self.F_rz * self.F_rz + self.F_zz * self.F_zz,
            self.F_rr * self.F_rz + self.F_zr * self.F_zz,
        )

    @property
    def J(self) -> Any:
        """Volume ratio, the determinant of F."""
        return (self.F_rr * self.F_zz - self.F_rz * self.F_zr) * self.F_tt


def strain(u: Any, w: Any) -> Strain:
    """Return the strain of the displacements u (radial) and w (axial), in inner radii."""
    du, dw = ng.grad(u), ng.grad(w)
    return Strain(F_rr=1.0 + du[0], F_rz=du[1], F_zr=dw[0], F_zz=1.0 + dw[1], F_tt=1.0 + u / ng.x)


def wall_energy(
    energy: Energy, u: Any, w: Any, p: Any, stiffening: Any = 0.0, symbols: Any = SYMBOLS
) -> Any:
    """Return the Lagrangian (U − p (J − 1)) R per reference area of the meridian section.

    The factor 2π is omitted. See Π in docs/theory.md, section "Seated state".

    Parameters
    ----------
    energy : Energy
        Energy density U of the wall law, in units of the modulus.
    u, w : symbols
        Displacements in inner radii.
    p : symbol
        Pressure in units of the modulus.
    stiffening : float or symbol
        Shear modulus of a neo-Hookean matrix that the homotopy adds, in units of the modulus; 0 for
        the wall itself.
    symbols : namespace
        Array namespace with which the energy is evaluated.
    """
    s = strain(u, w)
    C = s.C
    matrix = 0.5 * stiffening * (C.rr + C.tt + C.zz - 3.0)
    return (energy(C, PLACE, symbols) + matrix - p * (s.J - 1.0)) * ng.x


def outside_work(u: Any, w: Any, pressure: Any, *, hydrostatic: bool) -> Any:
    """Return the potential of a pressure on the outer wall, per reference length.

    The factor 2π is omitted. For a hydrostatic pressure P the potential is P ½ r² ∂z/∂Z, the
    pressure times the volume inside the outer wall. For a dead load (paper, Eq. 10) it is P R_b u,
    because the radial resultant per reference length is kept.

    Parameters
    ----------
    u, w : symbols
        Displacements in inner radii.
    pressure : float or symbol
        Pressure P on the outer wall, compression positive, in units of the modulus.
    hydrostatic : bool
        True for a hydrostatic pressure, false for a dead load.
    """
    if not hydrostatic:
        return pressure * ng.x * u
    r = ng.x + u
    return pressure * 0.5 * r * r * (1.0 + ng.grad(w).Trace()[1])


def cauchy_stress(energy: Energy, u: Any, w: Any, p: Any) -> tuple[Any, Any, Any, Any]:
    """Return the Cauchy stress (σ_rr, σ_tt, σ_zz, σ_rz) = F S Fᵀ − p 1, with S = 2 ∂U/∂C.

    Tension is positive. F S Fᵀ is not divided by J, because J = 1.

    Parameters
    ----------
    energy : Energy
        Energy density U of the wall law, in units of the modulus.
    u, w : symbols
        Displacements in inner radii.
    p : symbol
        Pressure in units of the modulus.

    Returns
    -------
    tuple of ngsolve.CoefficientFunction
        In units of the modulus.
    """
    s = strain(u, w)
    C = CauchyGreen(*(ng.CF(c).MakeVariable() for c in s.C[:4]))
    U = ng.CF(energy(C, PLACE, SYMBOLS))
    S_rr, S_tt, S_zz = 2.0 * U.Diff(C.rr), 2.0 * U.Diff(C.tt), 2.0 * U.Diff(C.zz)
    # U depends on C_rz and C_zr through one symbol, so its derivative is already twice ∂U/∂C_rz.
    S_rz = U.Diff(C.rz)
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
