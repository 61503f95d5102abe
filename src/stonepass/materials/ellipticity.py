"""Strong ellipticity of a law: the stiffness against small shear bands in all directions of space.

Superpose a simple shear on the deformation F: F(ε) = (1 + ε m⊗n) F with unit vectors m ⊥ n. The
determinant of F does not change, so the pressure of an incompressible law drops out. The law is
strongly elliptic at F if d²U/dε² is positive at ε = 0 for all m and n. With a = Fᵀn and b = Fᵀm the
right Cauchy–Green tensor is C(ε) = C + ε (a⊗b + b⊗a) + ε² a⊗a. Let i and j count the six components
rr, tt, zz, rz, rt, tz, and let v(m, n) = (mᵣnᵣ, mₜnₜ, m_z n_z, mᵣn_z + m_z nᵣ, mᵣnₜ + mₜnᵣ,
mₜn_z + m_z nₜ). Then Ċᵢ = Σ Gᵢⱼ vⱼ(m, n) with a matrix G that depends on F alone, and half of C̈ is
a⊗a = ½ Σ Gᵢⱼ vⱼ(n, n). Hence

    d²U/dε² = v(m, n)ᵀ K v(m, n) + t · v(n, n),   K = Gᵀ U″ G,   t = Gᵀ U′,

with the first and second derivatives U′ and U″ of the energy by the six components of C. All six
are needed, because a shear out of the r–z plane changes all of them. The vector t holds the
components of the Cauchy stress, without the pressure, and K is the tangent in the deformed wall.
For a given n this is a quadratic form in m, so its smallest value is the smaller eigenvalue of a
2 × 2 matrix. The directions n are scanned. See "Stability" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.derivatives import energy_derivatives, rest_moduli
from stonepass.materials.protocol import Law
from stonepass.strain import COMPONENTS, CauchyGreen, Place

__all__ = ["Weakest", "shear_stiffness", "spatial_moduli", "weakest"]

COARSE = 7  # number of directions n per quarter turn in the first scan
REFINED = 24  # number of deformations, those of least stiffness, for which n is refined
ZOOMS = 4  # number of refinements of n; each reduces the spacing to a quarter
FIRST, SECOND = np.array(COMPONENTS).T  # the two directions of each component


@dataclass(frozen=True)
class Weakest:
    """The shear band of least stiffness among several deformations.

    Attributes
    ----------
    stiffness : float
        d²U/dε² of the shear band, divided by the r–z shear modulus at rest. It is at most 1 in the
        unloaded wall. Strong ellipticity is lost if it is zero or negative. It is −∞ if the energy
        of the law is not finite at one of the deformations.
    index : int
        Index of the deformation.
    normal, direction : (float, float, float)
        Unit vectors n and m of the shear band in the deformed wall, in the directions (r, t, z).
    """

    stiffness: float
    index: int
    normal: tuple[float, float, float]
    direction: tuple[float, float, float]


def weakest(law: Law, F: Float[np.ndarray, "points 5"], place: Place) -> Weakest:
    """Find the shear band of least stiffness among several deformations.

    A coarse grid of directions n is scanned for every deformation. The directions are then refined
    for the `REFINED` deformations with the least stiffness.

    Parameters
    ----------
    law : Law
    F : array (points, 5)
        Components F_rr, F_rz, F_zr, F_zz, F_tt of the deformation gradient, with det F = 1.
    place : Place
        Reference coordinates in inner radii, as arrays (points,) or as numbers for all points.
    """
    angles, (stress, tangent) = _scan(), spatial_moduli(law, F, place)
    values, _ = shear_stiffness(stress, tangent, _normals(angles)[None])
    values = np.where(np.isnan(values), -np.inf, values)
    some = np.argsort(values.min(axis=1))[:REFINED]
    stress, tangent = stress[some], tangent[some]
    best, spacing = angles[np.argmin(values[some], axis=1)], np.pi / 2.0 / (COARSE - 1)
    for _ in range(ZOOMS):
        spacing /= 4.0
        near = best[:, None, :] + spacing * _neighbourhood()
        found, directions = shear_stiffness(stress, tangent, _normals(near))
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


def spatial_moduli(
    law: Law, F: Float[np.ndarray, "points 5"], place: Place
) -> tuple[Float[np.ndarray, "points 6"], Float[np.ndarray, "points 6 6"]]:
    """Return the stress t and the tangent K in the deformed wall (see the module's docstring).

    Parameters
    ----------
    law : Law
    F : array (points, 5)
        Components F_rr, F_rz, F_zr, F_zz, F_tt of the deformation gradient.
    place : Place
        Reference coordinates in inner radii, as arrays (points,) or as numbers for all points.

    Returns
    -------
    stress, tangent : array (points, 6), array (points, 6, 6)
        In Pa, for the components rr, tt, zz, rz, rt, tz.
    """
    slope, curvature = energy_derivatives(law, _right_cauchy_green(F), place)
    gradient = np.zeros((len(F), 3, 3))  # in the directions r, t, z
    for column, (row, across) in enumerate([(0, 0), (0, 2), (2, 0), (2, 2), (1, 1)]):
        gradient[:, row, across] = F[:, column]
    alpha, beta = FIRST[:, None], SECOND[:, None]
    G = (
        gradient[:, FIRST, alpha] * gradient[:, SECOND, beta]
        + gradient[:, SECOND, alpha] * gradient[:, FIRST, beta]
    )
    turned = G.transpose(0, 2, 1)
    return np.matmul(turned, slope[:, :, None])[..., 0], turned @ curvature @ G


def shear_stiffness(
    stress: Float[np.ndarray, "points 6"],
    tangent: Float[np.ndarray, "points 6 6"],
    normals: Float[np.ndarray, "any ways 3"],
) -> tuple[Float[np.ndarray, "points ways"], Float[np.ndarray, "points ways 3"]]:
    """Minimise d²U/dε² over m for every deformation and every n.

    Parameters
    ----------
    stress, tangent : array (points, 6), array (points, 6, 6)
        Stress and tangent in Pa, see `spatial_moduli`.
    normals : array (1 or points, ways, 3)
        Unit vectors n; a first axis of length 1 means the same directions for all points.

    Returns
    -------
    stiffness : array (points, ways)
        Smallest d²U/dε² in Pa.
    directions : array (points, ways, 3)
        The unit vectors m for which it is attained.
    """
    e, f = _tangents(normals)
    flat = tangent.reshape(len(tangent), 36, 1)

    def form(
        first: Float[np.ndarray, "any ways 6"], second: Float[np.ndarray, "any ways 6"]
    ) -> Float[np.ndarray, "points ways"]:
        """Return firstᵀ K second. The points enter one matrix product for all directions."""
        outer = first[..., :, None] * second[..., None, :]
        return np.matmul(outer.reshape(*first.shape[:-1], 36), flat)[..., 0]

    along_e, along_f = _sheared(e, normals), _sheared(f, normals)
    A, B, D = form(along_e, along_e), form(along_e, along_f), form(along_f, along_f)
    constant = np.matmul(_sheared(normals, normals), stress[:, :, None])[..., 0]
    smallest = (A + D) / 2.0 - np.sqrt(((A - D) / 2.0) ** 2 + B**2)
    turn = 0.5 * np.arctan2(2.0 * B, A - D) + np.pi / 2.0  # angle of the smaller eigenvector
    m = np.cos(turn)[..., None] * e + np.sin(turn)[..., None] * f
    return smallest + constant, m


def _sheared(
    m: Float[np.ndarray, "any ways 3"], n: Float[np.ndarray, "any ways 3"]
) -> Float[np.ndarray, "any ways 6"]:
    """Return the vectors v(m, n) of the module's docstring."""
    sheared: Float[np.ndarray, "any ways 6"] = m[..., FIRST] * n[..., SECOND]
    sheared[..., 3:] += m[..., SECOND[3:]] * n[..., FIRST[3:]]
    return sheared


def _right_cauchy_green(F: Float[np.ndarray, "points 5"]) -> CauchyGreen:
    F_rr, F_rz, F_zr, F_zz, F_tt = F.T
    zero = np.zeros_like(F_tt)
    in_plane = F_rr * F_rz + F_zr * F_zz
    return CauchyGreen(F_rr**2 + F_zr**2, F_tt**2, F_rz**2 + F_zz**2, in_plane, zero, zero)


def _scan() -> Float[np.ndarray, "ways 2"]:
    """Return polar and azimuthal angles of directions n that cover a hemisphere.

    A law may have fibres on one side of the axis only, so that (n_r, n_t, n_z) and (n_r, n_t, −n_z)
    differ.
    """
    polar = np.linspace(0.0, np.pi / 2.0, COARSE)
    around = np.linspace(0.0, 2.0 * np.pi, 4 * (COARSE - 1), endpoint=False)
    p, q = np.meshgrid(polar, around, indexing="ij")
    return np.column_stack([p.ravel(), q.ravel()])


def _neighbourhood() -> Float[np.ndarray, "ways 2"]:
    steps = np.arange(-4.0, 5.0)
    p, q = np.meshgrid(steps, steps, indexing="ij")
    return np.column_stack([p.ravel(), q.ravel()])


def _normals(angles: Float[np.ndarray, "*any 2"]) -> Float[np.ndarray, "*any 3"]:
    """Return unit vectors (r, t, z), given the angle from the r–z plane and the azimuth in it."""
    p, q = angles[..., 0], angles[..., 1]
    return np.stack([np.cos(p) * np.cos(q), np.sin(p), np.cos(p) * np.sin(q)], axis=-1)


def _tangents(
    normals: Float[np.ndarray, "any ways 3"],
) -> tuple[Float[np.ndarray, "any ways 3"], Float[np.ndarray, "any ways 3"]]:
    """Return two unit vectors that complete each normal to an orthonormal frame."""
    least = np.eye(3)[np.argmin(np.abs(normals), axis=-1)]
    e = np.cross(normals, least)
    e /= np.linalg.norm(e, axis=-1)[..., None]
    return e, np.cross(normals, e)
