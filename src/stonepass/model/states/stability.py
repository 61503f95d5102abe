"""Strong-ellipticity and buckling checks of a loaded tube and of a solved wall.

See "Stability" in docs/theory.md.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stonepass.array_types import Int
from stonepass.fe.axisymmetric.buckling import buckling_half_wave
from stonepass.fe.axisymmetric.wall_values import Deformation, Field
from stonepass.materials.derivatives import rest_moduli
from stonepass.materials.ellipticity import weakest
from stonepass.materials.protocol import Law
from stonepass.model.far_field import lumen_ratio
from stonepass.model.load import Load
from stonepass.model.problem import Problem
from stonepass.model.states.nondimensional import tube_of
from stonepass.model.states.stability_report import StabilityReport
from stonepass.strain import Place

__all__ = [
    "axisymmetric_buckling",
    "far_field_hint",
    "oversize_hint",
    "stability_of",
]


def stability_of(case: Problem, F: Deformation, wall: Field) -> StabilityReport:
    """Evaluate strong ellipticity and hoop compression of a solved wall.

    Strong ellipticity is checked at nine points of every element, hoop compression at all points.

    Parameters
    ----------
    case : Problem
    F : Deformation
        Deformation gradient at the points of `wall`.
    wall : Field
        The solved wall, lengths in inner radii and stresses in Pa.
    """
    law, some = case.ureter.material.law, _some_points(wall)
    columns = [getattr(F, name)[:, some].ravel() for name in ("F_rr", "F_rz", "F_zr", "F_zz")]
    place = Place(wall.R[:, some].ravel(), wall.Z[:, some].ravel())
    worst = weakest(law, np.column_stack([*columns, F.F_tt[:, some].ravel()]), place)
    compression = wall.stress_rr - wall.stress_tt
    most = int(np.argmax(compression))
    return StabilityReport(
        margin=worst.stiffness,
        weakest_at=(
            float(wall.R[:, some].flat[worst.index]),
            float(wall.Z[:, some].flat[worst.index]),
        ),
        hoop_compression=float(compression.flat[most] / rest_moduli(law)[1]),
        compressed_at=(float(wall.R.flat[most]), float(wall.Z.flat[most])),
    )


def axisymmetric_buckling(case: Problem, half_length: float) -> str:
    """Check whether the uniform tube under the load alone buckles axisymmetrically.

    Parameters
    ----------
    case : Problem
    half_length : float
        Half the length of the tube, L/R_a, in inner radii.

    Returns
    -------
    str
        The reason why the case cannot be solved, as part of a sentence; empty if the tube is
        stable. A tube that is neither compressed from outside nor shortened is not checked.
    """
    load = case.load
    if load.confining_pressure == 0.0 and load.prestretch >= 1.0:
        return ""
    length = _half_wave(case.ureter.material.law, case.wall_ratio, load, half_length)
    if length is None:
        return ""
    return (
        "the tube itself is not stable under this load: even without a stone it buckles "
        f"axisymmetrically, with half-waves of {length:.2g} inner radii"
    )


def far_field_hint(case: Problem) -> str:
    """Return a hint for a failed solve if the uniform tube under the load is not strongly elliptic.

    Shear bands in all directions of space are checked, so the hint may apply to a tube that passes
    `axisymmetric_buckling`. The result is empty if the tube is strongly elliptic.
    """
    law, eta, stretch = case.ureter.material.law, case.wall_ratio, case.load.prestretch
    lumen = lumen_ratio(eta, law, case.load)
    if lumen is None:
        return ""
    R = np.linspace(1.0, eta, 9)
    hoop = np.sqrt(lumen**2 + (R**2 - 1.0) / stretch) / R
    zero, axial = np.zeros_like(R), np.full_like(R, stretch)
    F = np.column_stack([1 / (hoop * axial), zero, zero, axial, hoop])
    margin = weakest(law, F, Place(R)).stiffness
    if margin > 0.0:
        return ""
    return (
        "; under this load the tube itself has lost its stability far from the stone "
        f"(margin {margin:.2g}; 1 unloaded, 0 lost)"
    )


def oversize_hint(case: Problem) -> str:
    """Return a hint for a failed solve if the stone exceeds the strain range of the material."""
    material = case.ureter.material
    if case.size_ratio <= material.strain_range[1]:
        return ""
    return (
        f"; the stone stretches the wall to {case.size_ratio:.3g} times its circumference, while "
        f"the constants of '{material.name}' were used up to {material.strain_range[1]:g} only"
    )


@lru_cache(maxsize=64)
def _half_wave(law: Law, wall_ratio: float, load: Load, half_length: float) -> float | None:
    lumen = lumen_ratio(wall_ratio, law, load)
    assert lumen is not None, "callers must reject a case without a lumen first"
    return buckling_half_wave(tube_of(law, wall_ratio, load, half_length), lumen)


def _some_points(wall: Field) -> Int[np.ndarray, " some"]:
    """Return the indices of nine points of an element: first, middle and last in each direction."""
    count = round(np.sqrt(wall.R.shape[1]))
    lines = np.array([0, count // 2, count - 1])
    return (lines[:, None] * count + lines[None, :]).ravel()
