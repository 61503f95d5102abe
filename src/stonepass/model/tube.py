"""The ureter and its load in the units of the finite elements: inner radius and hoop modulus."""

from __future__ import annotations

from stonepass.fe.problem import Tube
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.protocol import Law
from stonepass.model.case import Load

__all__ = ["tube_of"]


def tube_of(law: Law, wall_ratio: float, load: Load, half_length: float) -> Tube:
    """Divide lengths by the inner radius and pressures by w″(1)."""
    modulus = hoop_modulus(law)

    def energy(C_rr, C_tt, C_zz, C_rz, xp):  # type: ignore[no-untyped-def]
        return law.energy(C_rr, C_tt, C_zz, C_rz, xp) / modulus

    return Tube(
        energy=energy,
        wall_ratio=wall_ratio,
        half_length=half_length,
        axial_stretch=load.prestretch,
        outside_pressure=load.confining_pressure / modulus,
        hydrostatic=load.hydrostatic,
    )
