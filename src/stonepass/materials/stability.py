"""Checks of a law before any solve: stress-free rest state, stability at rest, strong ellipticity.

See "Stability" in docs/theory.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, UnstableLaw
from stonepass.materials.derivatives import rest_gradient, rest_moduli
from stonepass.materials.ellipticity import weakest
from stonepass.materials.protocol import Law, Material, MayBeDefective
from stonepass.strain import INNER_WALL

__all__ = ["SOFTEST_WALL", "RestState", "check", "one_sided_moduli", "rest_state"]

TINY = 1e-7  # strain that selects tension or compression in the limit of zero strain
MOST_SIDES = 12  # largest number of iterations of the lateral contraction
SOFTEST_WALL = 1e3  # Pa; the constants of a law with a smaller shear modulus are probably in kPa
_SMOOTH = (
    "the energy needs two derivatives at C = 1: terms that vanish there, such as C.I1 - 3, may not "
    "be under a root or have a power below 2 other than 1"
)
MODULUS_RANGE = (1.0, 1e11)  # Pa, from softer than any tissue to far stiffer than any elastomer


@dataclass(frozen=True)
class RestState:
    """Small-strain behaviour of a law at rest.

    Attributes
    ----------
    hoop, axial : float
        Moduli in Pa for uniaxial stress along the circumference and along the axis.
    plane_hoop : float
        Circumferential modulus in Pa at constant axial length, w″(1).
    shear : float
        r–z shear modulus in Pa.
    softest : float
        Smallest eigenvalue in Pa of the matrix of `rest_moduli`; if it is negative, the law is
        unstable.
    softest_direction : (float, float)
        Eigenvector (hoop strain, axial strain) of this eigenvalue, scaled so that its larger
        component is 1.
    """

    hoop: float
    axial: float
    plane_hoop: float
    shear: float
    softest: float
    softest_direction: tuple[float, float]


def rest_state(law: Law) -> RestState:
    """Return the small-strain moduli of a law, computed from its energy."""
    matrix, shear = rest_moduli(law)
    values, vectors = np.linalg.eigh(matrix)
    direction = _normalised(vectors[:, 0])
    determinant = matrix[0, 0] * matrix[1, 1] - matrix[0, 1] ** 2
    return RestState(
        hoop=float(determinant / matrix[1, 1]),
        axial=float(determinant / matrix[0, 0]),
        plane_hoop=float(matrix[0, 0]),
        shear=shear,
        softest=float(values[0]),
        softest_direction=direction,
    )


def one_sided_moduli(law: Law, sign: float) -> tuple[float, float, float]:
    """Return the small-strain moduli of a law in tension or in compression.

    The two sets differ for a law with tension-only fibres.

    Parameters
    ----------
    law : Law
    sign : float
        1 for tension, −1 for compression.

    Returns
    -------
    (float, float, float)
        `hoop`, `axial` and `plane_hoop` of `RestState`, in Pa.
    """
    small = sign * TINY

    def uniaxial(along: int) -> float:
        """Return the modulus for uniaxial stress along one direction (0 hoop, 1 axial)."""
        across, contraction = 1 - along, 0.5
        # The lateral contraction decides which fibres are in tension, and depends on them.
        for _ in range(MOST_SIDES):
            strains = [small, small]
            strains[across] *= -contraction
            matrix, _ = rest_moduli(law, (strains[0], strains[1]))
            before, contraction = contraction, matrix[0, 1] / matrix[across, across]
            if abs(contraction - before) <= TINY:
                break
        return float(matrix[along, along] - matrix[0, 1] * contraction)

    return uniaxial(0), uniaxial(1), float(rest_moduli(law, (small, 0.0))[0][0, 0])


@lru_cache(maxsize=32)
def check(material: Material) -> RestState:
    """Check the law of a material and return its small-strain behaviour.

    A law that depends on the place in the wall is checked at the inner wall, R = 1, only.

    Raises
    ------
    UnstableLaw
        The law is unstable for one of these reasons: a small strain from rest lowers its energy;
        it has no stiffness in r–z shear at rest; its constants are defective (`MayBeDefective`); or
        it loses strong ellipticity in the uniform tube within its strain range.
    BadInput
        The law is not stress-free or not finite at rest, or its modulus is outside
        `MODULUS_RANGE`.
    """
    law, name = material.law, f"material '{material.name}'"
    _check_rest_stress(law, name)
    state = rest_state(law)
    if isinstance(law, MayBeDefective) and law.defect is not None:
        raise UnstableLaw("law", material.name, *law.defect)
    if state.softest < 0.0:
        hoop, axial = state.softest_direction
        raise UnstableLaw(
            "law",
            material.name,
            f"straining the circumference by {hoop:+.2f} % and the axis by {axial:+.2f} % "
            f"from rest lowers the energy (modulus {state.softest / 1e6:.3g} MPa)",
            "use other constants",
        )
    if state.shear <= 1e-9 * state.plane_hoop:
        raise UnstableLaw(
            "law",
            material.name,
            f"it has no stiffness in r-z shear at rest (modulus {state.shear / 1e6:.3g} MPa)",
            "give it a ground matrix, G > 0",
        )
    _check_ellipticity(material)
    low, high = MODULUS_RANGE
    if not low <= state.plane_hoop <= high:
        raise BadInput(
            f"circumferential modulus of {name}",
            f"{state.plane_hoop:.3g} Pa",
            f"between {low:g} and {high:g} Pa",
            "check the unit of its constants: energies are in J/m³ = Pa",
        )
    return state


def _check_rest_stress(law: Law, name: str) -> None:
    gradient = rest_gradient(law)
    if not np.all(np.isfinite(gradient)):
        raise BadInput(f"energy of {name} at rest", "without finite slopes", "smooth", _SMOOTH)
    moduli, shear = rest_moduli(law)
    if not (np.all(np.isfinite(moduli)) and math.isfinite(shear)):
        raise BadInput(f"stiffness of {name} at rest", "undefined", "finite", _SMOOTH)
    uneven = max(np.ptp(gradient[:3]), np.abs(gradient[3:]).max())
    scale = max(float(np.abs(moduli).max()), abs(shear))
    if uneven > 1e-9 * scale:
        raise BadInput(
            f"stress of {name} at rest",
            f"{2.0 * uneven / 1e3:.3g} kPa",
            "zero apart from a pressure: dU/dC_rr = dU/dC_tt = dU/dC_zz, other slopes 0, at C = 1",
            "residual stress is not part of this model",
        )


def _check_ellipticity(material: Material) -> None:
    """Check that the law is strongly elliptic in the uniform tube over the whole strain range."""
    low, high = material.strain_range
    hoop = np.linspace(low, high, 9)
    zero, one = np.zeros_like(hoop), np.ones_like(hoop)
    worst = weakest(material.law, np.column_stack([1.0 / hoop, zero, zero, one, hoop]), INNER_WALL)
    if worst.stiffness == -math.inf:
        raise BadInput(
            f"energy of material '{material.name}'",
            f"not finite at circumferential stretch {hoop[worst.index]:.3g}",
            "finite over the strain range of the law",
            f"narrow its strain range, {low:g} to {high:g}",
        )
    if worst.stiffness <= 0.0:
        n, m = (_vector(v) for v in (worst.normal, worst.direction))
        raise UnstableLaw(
            "law",
            material.name,
            f"at circumferential stretch {hoop[worst.index]:.3g} a shear band with normal {n} and "
            f"direction {m} in (r, t, z) lowers the energy, {worst.stiffness:.3g} in units of the "
            "rest shear modulus",
            "narrow the strain range or use other constants",
        )


def _vector(v: tuple[float, float, float]) -> str:
    return "(" + ", ".join(f"{x:.2f}" for x in v) + ")"


def _normalised(vector: Float[np.ndarray, 2]) -> tuple[float, float]:
    unit = vector / vector[np.argmax(np.abs(vector))]
    return float(unit[0]), float(unit[1])
