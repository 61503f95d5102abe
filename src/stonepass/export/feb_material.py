"""The wall law as an uncoupled material of the FEBio 4.0 file format.

The energy of an uncoupled material is a function of C̃ = J^(−2/3) C plus ½ k (ln J)². At J = 1 it
is equal to the energy of the law in stonepass.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from stonepass.errors import BadInput, require
from stonepass.export.seating import KPA, bulk_modulus
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.known_laws import KNOWN_LAWS, name_of_law
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Law
from stonepass.materials.yeoh import Yeoh

__all__ = ["FEBIO", "VANISHING", "add_wall_material", "fung_constants"]

# Radial over circumferential stiffness of a Fung law; FEBio requires a positive value.
VANISHING = 1e-6
RADIAL, AROUND = "1,0,0", "0,1,0"  # first material axis: radial or circumferential

Constants = dict[str, float]
Attributes = Mapping[str, str]


def fung_constants(law: Fung) -> dict[str, float]:
    """Return the constants of FEBio's "Fung orthotropic" with the directions 1, 2, 3 = r, θ, z.

    FEBio's energy is Ψ = c/2 (exp Q̃ − 1) with c Q̃ = Σ λ_ab E_aa E_bb + Σ 2 μ_a (E²)_aa. The matrix
    λ + 2μ is the inverse of the compliance matrix with the elements 1/E_a and −ν_ab/E_a (FEBio
    manual, "Fung orthotropic"). All G_ab are 0 here, so that all μ_a are 0. The 2 × 2 block of λ
    for the directions θ and z must be c [a1111, a1122; a1122, a2222], written row by row. The
    inverse of this block is [a2222, −a1122; −a1122, a1111]/(c D) with D = a1111 a2222 − a1122². Its
    elements are 1/E2, −v23/E2 and 1/E3.

    The law has no radial stiffness, but FEBio requires E1 > 0. The value E1 = c ε a1111 with
    ε = `VANISHING` adds ΔQ = ε a1111 E_rr² to the exponent. To first order it adds C/2 exp(Q) ΔQ
    to the energy.

    Parameters
    ----------
    law : Fung
        Law with constants C and G in Pa.

    Returns
    -------
    dict of str to float
        FEBio's constants by name; moduli in Pa.

    Raises
    ------
    BadInput
        D is not positive, so that the compliance matrix does not exist.

    Examples
    --------
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
    """Add the material of a law to an XML element.

    Parameters
    ----------
    parent : Element
        The element ``Material`` of the input file.
    law : Law
        Law of the wall; its moduli are written in kPa.
    **attributes : str
        Attributes of the new element, such as ``id`` and ``name``.

    Raises
    ------
    BadInput
        FEBio does not have this law.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    if type(law) not in FEBIO:
        *others, last = (name for name, each in KNOWN_LAWS.items() if each in FEBIO)
        named = name_of_law(law) or "a user-defined law"
        allowed = f"{', '.join(others)} or {last} in a file for FEBio"
        raise BadInput("law", named, allowed, "write its constants as one of these")
    FEBIO[type(law)](parent, law, {"k": bulk_modulus(law)}, attributes)


def _neo_hookean(parent: Element, law: NeoHookean, k: Constants, attributes: Attributes) -> None:
    _solid(parent, "Mooney-Rivlin", {"c1": law.C10, "c2": 0.0} | k, attributes)


def _mooney_rivlin(
    parent: Element, law: MooneyRivlin, k: Constants, attributes: Attributes
) -> None:
    _solid(parent, "Mooney-Rivlin", {"c1": law.C10, "c2": law.C01} | k, attributes)


def _yeoh(parent: Element, law: Yeoh, k: Constants, attributes: Attributes) -> None:
    _solid(parent, "Yeoh", {"c1": law.C10, "c2": law.C20, "c3": law.C30} | k, attributes)


def _ogden(parent: Element, law: Ogden, k: Constants, attributes: Attributes) -> None:
    """Write FEBio's Σ c/m² (λ₁^m + λ₂^m + λ₃^m − 3) with c = μ_p α_p and m = α_p."""
    constants: Constants = {}
    for number, (mu, alpha) in enumerate(law.terms, start=1):
        constants |= {f"c{number}": mu * alpha, f"m{number}": alpha}
    _solid(parent, "Ogden", constants | k, attributes)


def _fung(parent: Element, law: Fung, k: Constants, attributes: Attributes) -> None:
    # A law without a ground matrix is unstable and has been refused before. FEBio uses only the
    # bulk modulus of the mixture itself, not those of its components.
    mixture = _solid(parent, "uncoupled solid mixture", k, attributes)
    _along_cylinder(_solid(mixture, "Fung orthotropic", fung_constants(law)))
    _solid(mixture, "Mooney-Rivlin", {"c1": law.G / 2.0, "c2": 0.0})


def _holzapfel(
    parent: Element, law: HolzapfelGasserOgden, k: Constants, attributes: Attributes
) -> None:
    """Write the law; the fibres lie in the plane of axes 1 and 2, at ±gamma (degrees) to axis 1."""
    constants = {
        "c": law.mu, "k1": law.k1, "k2": law.k2, "gamma": math.degrees(law.angle),
        "kappa": law.kappa,
    }  # fmt: skip
    _along_cylinder(_solid(parent, "Holzapfel-Gasser-Ogden", constants | k, attributes), AROUND)


FEBIO: Mapping[type[Any], Callable[..., None]] = {
    NeoHookean: _neo_hookean,
    MooneyRivlin: _mooney_rivlin,
    Yeoh: _yeoh,
    Fung: _fung,
    Ogden: _ogden,
    HolzapfelGasserOgden: _holzapfel,
}


def _solid(
    parent: Element,
    kind: str,
    constants: Mapping[str, float],
    attributes: Mapping[str, str] | None = None,
) -> Element:
    tag = "solid" if attributes is None else "material"
    solid = SubElement(parent, tag, {**(attributes or {}), "type": kind})
    for name, value in constants.items():
        unit = KPA if _is_modulus(name) else 1.0
        SubElement(solid, name).text = f"{value / unit:.12g}"
    return solid


def _is_modulus(name: str) -> bool:
    """Return whether a constant is a pressure, not a Poisson's ratio, an exponent or an angle."""
    return name[0] not in "vmg" and name not in ("k2", "kappa")


def _along_cylinder(solid: Element, first: str = RADIAL) -> None:
    """Set cylindrical material axes 1, 2, 3 at each integration point.

    They are r, θ, z for the first axis `RADIAL`, and θ, z, r for `AROUND`. FEBio's ``vector`` is
    the first axis at a point on the x axis; FEBio rotates it with the angular position of the
    integration point.
    """
    axes = SubElement(solid, "mat_axis", type="cylindrical")
    SubElement(axes, "center").text = "0,0,0"
    SubElement(axes, "axis").text = "0,0,1"
    SubElement(axes, "vector").text = first
