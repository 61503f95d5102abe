"""Is the solved wall one that a real wall of this law could be: stable, and not about to fold."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Int

from stonepass.fe.axisymmetric.buckling import unstable_wave
from stonepass.fe.axisymmetric.postprocessing import Field, Solved, deformation
from stonepass.materials.derivatives import hoop_modulus, rest_moduli
from stonepass.materials.ellipticity import weakest
from stonepass.materials.protocol import Law
from stonepass.model.case import Case, Load
from stonepass.model.far_field import lumen_ratio
from stonepass.model.states.nondimensional import tube_of

__all__ = [
    "StabilityReport",
    "far_field_hint",
    "folding_warning",
    "oversize_hint",
    "stability_of",
    "waves",
]


@dataclass(frozen=True)
class StabilityReport:
    """Stability of the solved wall; places are reference coordinates R/R_a, Z/R_a.

    Attributes
    ----------
    margin : float
        Stiffness of the weakest shear band in units of the rest r–z shear modulus (the ground
        matrix G of a Fung wall): 1 unloaded, 0 where strong ellipticity is lost.
    weakest_at : (float, float)
        Where that is.
    hoop_compression : float
        Largest σ_rr − σ_tt in the same units.
    compressed_at : (float, float)
        Where that is.
    """

    margin: float
    weakest_at: tuple[float, float]
    hoop_compression: float
    compressed_at: tuple[float, float]

    def warnings(self) -> list[str]:
        """One sentence for each thing that a real wall would not do."""
        found = []
        if self.margin <= 0.0:
            R, Z = self.weakest_at
            found.append(
                f"the wall is not stable at R = {R:.3g}, Z = {Z:.3g} (inner radii): a shear band "
                f"lowers its energy (stability margin {self.margin:.2g})"
            )
        return [*found, *self.folding()]

    def folding(self) -> list[str]:
        """A sentence where hoop compression may fold the wall."""
        if self.hoop_compression <= 1.0:
            return []
        R, Z = self.compressed_at
        return [
            f"the wall is under hoop compression of {self.hoop_compression:.2g} times its "
            f"shear modulus at R = {R:.3g}, Z = {Z:.3g} (inner radii): a real tube may "
            "fold, which no axisymmetric model sees"
        ]


def folding_warning(case: Case) -> list[str]:
    """A sentence where the confining pressure alone would fold the tube into two lobes.

    The ring buckles under an outside pressure of w″(1) h³/(4 R_m³) (Lévy; plane strain, wall
    thickness h, mean radius R_m), which no axisymmetric model sees.
    """
    eta, pressure = case.wall_ratio, case.load.confining_pressure
    slenderness = (eta - 1.0) / ((eta + 1.0) / 2.0)
    folding = hoop_modulus(case.ureter.material.law) * slenderness**3 / 4.0
    if pressure <= folding:
        return []
    return [
        f"a confining pressure of {pressure / 1e3:.3g} kPa would fold this tube where neither "
        f"stone nor urine holds it open (ring buckling at about {folding / 1e3:.2g} kPa), which no "
        "axisymmetric model sees"
    ]


def stability_of(case: Case, solved: Solved, wall: Field) -> StabilityReport:
    """Check strong ellipticity and hoop compression at points of every element."""
    law = case.ureter.material.law
    F, some = deformation(solved), _some_points(wall)
    columns = [getattr(F, name)[:, some].ravel() for name in ("F_rr", "F_rz", "F_zr", "F_zz")]
    worst = weakest(law, np.column_stack([*columns, F.F_tt[:, some].ravel()]))
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


def waves(case: Case) -> str:
    """Why the loaded tube does not stay straight, or nothing where it does."""
    load = case.load
    if load.confining_pressure == 0.0 and load.prestretch >= 1.0:
        return ""
    length = _wave(case.ureter.material.law, case.wall_ratio, load, case.method.half_length)
    if length is None:
        return ""
    return (
        "the tube itself is not stable under this load: far from the stone axisymmetric waves of "
        f"half-length {length:.2g} inner radii lower its energy, so it wrinkles or kinks all along"
    )


def far_field_hint(case: Case) -> str:
    """What to think of first where no state was found: the loaded tube has lost its ellipticity.

    In all directions of space, so it tells more than `waves`, which are axisymmetric.
    """
    law, eta, stretch = case.ureter.material.law, case.wall_ratio, case.load.prestretch
    lumen = lumen_ratio(eta, law, case.load)
    if lumen is None:
        return ""
    R = np.linspace(1.0, eta, 9)
    hoop = np.sqrt(lumen**2 + (R**2 - 1.0) / stretch) / R
    zero, axial = np.zeros_like(R), np.full_like(R, stretch)
    margin = weakest(law, np.column_stack([1 / (hoop * axial), zero, zero, axial, hoop])).stiffness
    if margin > 0.0:
        return ""
    return (
        "; under this load the tube itself has lost its stability far from the stone "
        f"(margin {margin:.2g}; 1 unloaded, 0 lost)"
    )


def oversize_hint(case: Case) -> str:
    """What to think of first where a stone is too large to be solved for."""
    material = case.ureter.material
    if case.size_ratio <= material.strain_range[1]:
        return ""
    return (
        f"; the stone stretches the wall to {case.size_ratio:.3g} times its circumference, while "
        f"the constants of '{material.name}' were used to {material.strain_range[1]:g}"
    )


@lru_cache(maxsize=64)
def _wave(law: Law, wall_ratio: float, load: Load, half_length: float) -> float | None:
    lumen = lumen_ratio(wall_ratio, law, load)
    assert lumen is not None, "asked before a case without a lumen is answered"
    return unstable_wave(tube_of(law, wall_ratio, load, half_length), lumen)


def _some_points(wall: Field) -> Int[np.ndarray, " some"]:
    """First, middle and last Gauss–Lobatto point of each direction: nine of every element."""
    count = round(np.sqrt(wall.R.shape[1]))
    lines = np.array([0, count // 2, count - 1])
    return (lines[:, None] * count + lines[None, :]).ravel()
