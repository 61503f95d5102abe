"""A wall whose moduli are a multiple of those of its material."""

from __future__ import annotations

from dataclasses import replace

from stonepass.errors import BadInput
from stonepass.materials.constants import constants_of
from stonepass.model.case import Case

__all__ = ["stiffened"]


def stiffened(case: Case, stiffness: float) -> Case:
    """Return a case with all moduli of its wall multiplied by a factor.

    Parameters
    ----------
    case : Case
        A case whose material has declared constants.
    stiffness : float
        The factor; 1 returns the same case.

    Raises
    ------
    BadInput
        A multiplied modulus is out of its bounds.
    """
    if stiffness == 1.0:
        return case
    material = case.ureter.material
    moduli = {
        each.name: stiffness * getattr(material.law, each.name)
        for each in constants_of(material.law)
        if each.unit == "Pa"
    }
    if not moduli:
        raise BadInput("stiffness", stiffness, f"1 for the law of the material '{material.name}'")
    law = replace(material.law, **moduli)  # type: ignore[type-var]
    scaled = replace(
        material, law=law, name=f"{material.name}, {stiffness:g} times as stiff", reference=""
    )
    ureter = case.ureter
    return replace(case, ureter=replace(ureter, material=scaled))
