"""Strong ellipticity: does every small shear band cost energy, in every direction of space?

Superpose a shear on the deformation F: F(ε) = (1 + ε m⊗n) F with unit vectors m ⊥ n. Its
determinant does not change, so for an incompressible law the pressure drops out, and the law is
strongly elliptic at F where the energy's second derivative in ε is positive for every m and n.
With a = Fᵀn and b = Fᵀm, C(ε) = C + ε (a⊗b + b⊗a) + ε² a⊗a; hence

    d²U/dε² = Σ U,ᵢⱼ ċᵢ ċⱼ + 2 Σ U,ᵢ c̈ᵢ,
    ċ = (2aᵣbᵣ, 2aₜbₜ, 2a_z b_z, aᵣb_z + bᵣa_z, aᵣbₜ + bᵣaₜ, aₜb_z + bₜa_z),
    c̈ = (aᵣ², aₜ², a_z², aᵣa_z, aᵣaₜ, aₜa_z),

the sums over the six components of C, which all change in a shear out of the r–z plane. For given n
this is a quadratic form in m, so its smallest value over m is an eigenvalue of a 2 × 2 matrix; n is
scanned.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.derivatives import energy_derivatives, rest_moduli
from stonepass.materials.protocol import Law
from stonepass.strain import CauchyGreen, Place

__all__ = ["Weakest", "shear_stiffness", "weakest"]

COARSE = 7  # directions per quarter turn of n in the first scan
REFINED = 24  # deformations, the weakest ones, whose direction is refined
ZOOMS = 4  # refinements, each four times finer


@dataclass(frozen=True)
class Weakest:
    """The weakest shear band: its stiffness in units of the rest r–z shear modulus, and where.

    `stiffness` 1 is that of the unloaded wall across its softest plane, 0 the loss of ellipticity,
    −∞ where the law has no energy;
    `index` says which of the given deformations it is; `normal` and `direction` are n and m, in
    (r, t, z).
    """

    stiffness: float
    index: int
    normal: tuple[float, float, float]
    direction: tuple[float, float, float]


def weakest(law: Law, F: Float[np.ndarray, "points 5"], place: Place) -> Weakest:
    """Find the weakest shear band among deformations F = (F_rr, F_rz, F_zr, F_zz, F_tt).

    `place` has the reference coordinates of the points, or one place for all. All directions are
    scanned for every deformation, and refined for the weakest of them.
    """
    angles, derivatives = _scan(), energy_derivatives(law, _right_cauchy_green(F), place)
    values, _ = shear_stiffness(F, derivatives, _normals(angles)[None])
    values = np.where(np.isnan(values), -np.inf, values)
    some = np.argsort(values.min(axis=1))[:REFINED]
    F, derivatives = F[some], (derivatives[0][some], derivatives[1][some])
    best, spacing = angles[np.argmin(values[some], axis=1)], np.pi / 2.0 / (COARSE - 1)
    for _ in range(ZOOMS):
        spacing /= 4.0
        near = best[:, None, :] + spacing * _neighbourhood()
        found, directions = shear_stiffness(F, derivatives, _normals(near))
        choice = np.argmin(found, axis=1)
        best = np.take_along_axis(near, choice[:, None, None], axis=1)[:, 0]
    least = np.where(np.isnan(found), -np.inf, found).min(axis=1)
    k = int(np.argmin(least))
    n, m = _normals(best[k]), directions[k, choice[k]]
    return Weakest(
        stiffness=float(least[k] / rest_moduli(law)[1]),
        index=int(some[k]),
        normal=(float(n[0]), float(n[1]), float(n[2])),
        direction=(float(m[0]), float(m[1]), float(m[2])),
    )


def shear_stiffness(
    F: Float[np.ndarray, "points 5"],
    derivatives: tuple[Float[np.ndarray, "points 6"], Float[np.ndarray, "points 6 6"]],
    normals: Float[np.ndarray, "any ways 3"],
) -> tuple[Float[np.ndarray, "points ways"], Float[np.ndarray, "points ways 3"]]:
    """Smallest d²U/dε² over m, in Pa, for every deformation and every n; and the m it belongs to.

    `derivatives` are U,ᵢ and U,ᵢⱼ at the points; `normals` are the same for all points (first axis
    1) or each point's own.
    """
    F_rr, F_rz, F_zr, F_zz, F_tt = F.T[:, :, None]
    slope, curvature = derivatives
    n_r, n_t, n_z = np.moveaxis(normals, -1, 0)
    a_r, a_t, a_z = F_rr * n_r + F_zr * n_z, F_tt * n_t, F_rz * n_r + F_zz * n_z  # Fᵀ n

    def rate(m: Float[np.ndarray, "any ways 3"]) -> Float[np.ndarray, "points ways 6"]:
        """ċ for one m."""
        m_r, m_t, m_z = np.moveaxis(m, -1, 0)
        b_r, b_t, b_z = F_rr * m_r + F_zr * m_z, F_tt * m_t, F_rz * m_r + F_zz * m_z
        direct = (2.0 * a_r * b_r, 2.0 * a_t * b_t, 2.0 * a_z * b_z)
        mixed = (a_r * b_z + b_r * a_z, a_r * b_t + b_r * a_t, a_t * b_z + b_t * a_z)
        return np.stack([*direct, *mixed], axis=-1)

    direct = (a_r * a_r, a_t * a_t, a_z * a_z)
    second = np.stack([*direct, a_r * a_z, a_r * a_t, a_t * a_z], axis=-1)
    constant = 2.0 * np.matmul(second, slope[:, :, None])[..., 0]
    e, f = _tangents(normals)
    along_e, along_f = rate(e), rate(f)
    bent_e, bent_f = np.matmul(along_e, curvature), np.matmul(along_f, curvature)
    A, B, D = (bent_e * along_e).sum(-1), (bent_e * along_f).sum(-1), (bent_f * along_f).sum(-1)
    smallest = (A + D) / 2.0 - np.sqrt(((A - D) / 2.0) ** 2 + B**2)
    turn = 0.5 * np.arctan2(2.0 * B, A - D) + np.pi / 2.0  # angle of the smaller eigenvector
    m = np.cos(turn)[..., None] * e + np.sin(turn)[..., None] * f
    return smallest + constant, m


def _right_cauchy_green(F: Float[np.ndarray, "points 5"]) -> CauchyGreen:
    F_rr, F_rz, F_zr, F_zz, F_tt = F.T
    zero = np.zeros_like(F_tt)
    in_plane = F_rr * F_rz + F_zr * F_zz
    return CauchyGreen(F_rr**2 + F_zr**2, F_tt**2, F_rz**2 + F_zz**2, in_plane, zero, zero)


def _scan() -> Float[np.ndarray, "ways 2"]:
    """Polar and azimuthal angles over a hemisphere of n."""
    polar = np.linspace(0.0, np.pi / 2.0, COARSE)
    around = np.linspace(0.0, np.pi, 2 * (COARSE - 1), endpoint=False)
    p, q = np.meshgrid(polar, around, indexing="ij")
    return np.column_stack([p.ravel(), q.ravel()])


def _neighbourhood() -> Float[np.ndarray, "ways 2"]:
    steps = np.arange(-4.0, 5.0)
    p, q = np.meshgrid(steps, steps, indexing="ij")
    return np.column_stack([p.ravel(), q.ravel()])


def _normals(angles: Float[np.ndarray, "*any 2"]) -> Float[np.ndarray, "*any 3"]:
    """Unit vectors (r, t, z): polar angle from the r–z plane, azimuth within it."""
    p, q = angles[..., 0], angles[..., 1]
    return np.stack([np.cos(p) * np.cos(q), np.sin(p), np.cos(p) * np.sin(q)], axis=-1)


def _tangents(
    normals: Float[np.ndarray, "any ways 3"],
) -> tuple[Float[np.ndarray, "any ways 3"], Float[np.ndarray, "any ways 3"]]:
    """Two unit vectors that complete each normal to an orthonormal frame."""
    least = np.eye(3)[np.argmin(np.abs(normals), axis=-1)]
    e = np.cross(normals, least)
    e /= np.linalg.norm(e, axis=-1)[..., None]
    return e, np.cross(normals, e)
