"""The wall's law in FEBio's words: an uncoupled material of the 4.0 file format.

FEBio writes an energy in C̃ = J^(−2/3) C and adds ½ k (ln J)², so at J = 1 it has the energy here.
"""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement

from stonepass.errors import BadInput, require
from stonepass.export.seating import KPA, bulk_modulus
from stonepass.materials.fung import Fung
from stonepass.materials.known_laws import name_of_law
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["VANISHING", "add_wall_material", "fung_constants"]

# Stiffness of a Fung law along r over that around, which FEBio wants above zero.
VANISHING = 1e-6


def fung_constants(law: Fung) -> dict[str, float]:
    """Constants of FEBio's "Fung orthotropic", directions 1, 2, 3 along r, θ, z; moduli in Pa.

    FEBio's Ψ = c/2 (exp Q̃ − 1), c Q̃ = Σ λ_ab E_aa E_bb + Σ 2 μ_a (E²)_aa, takes λ + 2μ as the
    inverse of the compliance 1/E_a, −ν_ab/E_a (its manual, "Fung orthotropic"). Every μ_a is zero
    with no G_ab. So the block of θ and z is inverted by hand, c λ⁻¹ = [a2222, −a1122; −a1122,
    a1111]/D with D = a1111 a2222 − a1122². That leaves E1 = c ε a1111, ε = `VANISHING`: Q̃ is too
    large by ε a1111 E_rr², and the energy by less than C/2 exp(Q) times that, to first order.

    Raises
    ------
    BadInput
        D is not positive: there is no such compliance.

    >>> fung_constants(Fung(2.0, 1.0, 4.0, 0.0))["E3"]
    8.0
    """
    D = law.a1111 * law.a2222 - law.a1122**2
    require(D > 0.0, "a1122", law.a1122, "such that a1122² is below a1111 a2222, for FEBio")
    return {
        "E1": law.C * VANISHING * law.a1111,
        "E2": law.C * D / law.a2222,
        "E3": law.C * D / law.a1111,
        "G12": 0.0,
        "G23": 0.0,
        "G31": 0.0,
        "v12": 0.0,
        "v23": law.a1122 / law.a2222,
        "v31": 0.0,
        "c": law.C,
    }


def add_wall_material(parent: Element, law: Law, **attributes: str) -> None:
    """Add the material of `law`, moduli in kPa.

    Raises
    ------
    BadInput
        FEBio has no such law.
    """
    k = {"k": bulk_modulus(law)}
    if isinstance(law, NeoHookean):
        _solid(parent, "Mooney-Rivlin", {"c1": law.C10, "c2": 0.0} | k, attributes)
    elif isinstance(law, MooneyRivlin):
        _solid(parent, "Mooney-Rivlin", {"c1": law.C10, "c2": law.C01} | k, attributes)
    elif isinstance(law, Yeoh):
        _solid(parent, "Yeoh", {"c1": law.C10, "c2": law.C20, "c3": law.C30} | k, attributes)
    elif isinstance(law, Fung):  # without a ground matrix it is no solid, and no deck is made
        # FEBio takes the bulk modulus of a mixture from the mixture alone.
        mixture = _solid(parent, "uncoupled solid mixture", k, attributes)
        _along_cylinder(_solid(mixture, "Fung orthotropic", fung_constants(law)))
        _solid(mixture, "Mooney-Rivlin", {"c1": law.G / 2.0, "c2": 0.0})
    else:
        named = name_of_law(law) or "a law of one's own"
        allowed = "neo-hookean, mooney-rivlin, yeoh or fung in a file for FEBio"
        raise BadInput("law", named, allowed, "write its constants as one of these")


def _solid(
    parent: Element,
    kind: str,
    constants: Mapping[str, float],
    attributes: Mapping[str, str] | None = None,
) -> Element:
    tag = "solid" if attributes is None else "material"
    solid = SubElement(parent, tag, {**(attributes or {}), "type": kind})
    for name, value in constants.items():
        unit = 1.0 if name.startswith("v") else KPA
        SubElement(solid, name).text = f"{value / unit:.12g}"
    return solid


def _along_cylinder(solid: Element) -> None:
    """Turn the axes 1, 2, 3 to r, θ, z at each integration point."""
    axes = SubElement(solid, "mat_axis", type="cylindrical")
    SubElement(axes, "center").text = "0,0,0"
    SubElement(axes, "axis").text = "0,0,1"
    SubElement(axes, "vector").text = "1,0,0"
