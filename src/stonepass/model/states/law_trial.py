"""Check of a law before any solve: the finite elements and NumPy must compute the same values."""

from __future__ import annotations

import numpy as np

from stonepass.errors import BadInput, StonepassError
from stonepass.fe.axisymmetric.energy_values import energy_values
from stonepass.materials.derivatives import energy_derivatives
from stonepass.materials.protocol import Material
from stonepass.strain import CauchyGreen, Place

__all__ = ["check_in_engine"]

AGREES = 1e-9  # largest allowed difference, relative to the largest value
R = 1.25  # reference radius of the place in the wall, in inner radii
POINTS = 7  # number of deformations


def check_in_engine(material: Material) -> None:
    """Compare energy and derivatives in NGSolve with those in NumPy, over the strain range.

    Raises
    ------
    BadInput
        The law uses an operation that NGSolve cannot differentiate, or its values differ there.
    """
    name, law = f"law of material '{material.name}'", material.law
    hoop = np.linspace(*material.strain_range, POINTS)
    axial, shear = np.linspace(0.95, 1.05, POINTS)[::-1], np.linspace(-0.05, 0.05, POINTS)
    none = np.zeros(POINTS)
    C = CauchyGreen(
        1.0 / (hoop * axial) ** 2 + shear**2, hoop**2, axial**2, shear * axial, none, none
    )
    place = Place(R, 0.0)
    try:
        found = energy_values(law.energy, C, R)
    except StonepassError:
        raise
    except Exception as problem:  # NGSolve's exception types have no public names
        what = f"raising {type(problem).__name__}: {problem}"
        raise BadInput(
            name, what, "such that the finite elements can differentiate it"
        ) from problem
    slopes = energy_derivatives(law, C, place)[0][:, :4]
    energies = np.broadcast_to(law.energy(C, place, np), POINTS)
    expected = np.column_stack([energies, slopes])
    off = np.abs(found - expected).max(axis=1)
    worst = int(np.argmax(off))
    if not off[worst] <= AGREES * np.abs(expected).max():  # also true for NaN
        raise BadInput(
            name,
            f"{found[worst, 0]:.6g} J/m³ in the finite elements and {expected[worst, 0]:.6g} J/m³ "
            f"in NumPy at circumferential stretch {hoop[worst]:.3g}",
            "the same in both, with the same derivatives",
            "use only the functions of xp",
        )
