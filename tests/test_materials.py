"""Laws: exact values, energy slope = stress, rest state, stability."""

from dataclasses import dataclass

import autograd.numpy as anp
import numpy as np
import pytest

from stonepass.errors import BadInput, UnstableLaw
from stonepass.materials.catalogue import CATALOGUE, material
from stonepass.materials.derivatives import hoop_energy_slope, hoop_modulus, rest_moduli
from stonepass.materials.fung import Fung
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Material
from stonepass.materials.stability import check, rest_state
from stonepass.strain import INNER_WALL, CauchyGreen

LAWS = list(CATALOGUE.values())


def named(entries):
    return pytest.mark.parametrize("entry", entries, ids=lambda entry: entry.name)


def as_material(law):
    return Material("test", law, "", "", "", (1.0, 1.5))


def test_neo_hookean_by_hand():
    # λ_t = 2, λ_z = 1, λ_r = 1/2: I₁ = 1/4 + 4 + 1 = 5.25, U = C₁₀ · 2.25.
    assert NeoHookean(4.0).energy(CauchyGreen(0.25, 4.0, 1.0), INNER_WALL, np) == 9.0


def test_fung_by_hand():
    # C_tt = 3, C_zz = 1: E_tt = 1, Q = a1111 = ln 2, U = C/2 (2 − 1); ground G/2 (5 − 3) = G.
    law = Fung(C=2.0, a1111=float(np.log(2.0)), a2222=1.0, a1122=0.1, G=0.25)
    assert law.energy(CauchyGreen(1.0, 3.0, 1.0), INNER_WALL, np) == pytest.approx(1.25, rel=1e-15)


@named(LAWS)
def test_energy_slope_is_stress(entry):
    """σ_tt − σ_rr = λ w′(λ), with the stress taken from ∂U/∂C by central differences."""
    law, h = entry.law, 1e-6
    for stretch in (0.9, 1.0, 1.1, 1.3, 1.5):
        C = np.array([1.0 / stretch**2, stretch**2, 1.0, 0.0])

        def slope(i, C=C):
            up, down = C.copy(), C.copy()
            up[i] += h
            down[i] -= h
            above, below = (law.energy(CauchyGreen(*c), INNER_WALL, np) for c in (up, down))
            return (above - below) / (2.0 * h)

        stress = 2.0 * C[1] * slope(1) - 2.0 * C[0] * slope(0)
        exact = stretch * hoop_energy_slope(law, np.array(stretch))
        assert stress == pytest.approx(exact, rel=1e-6, abs=1e-6 * hoop_modulus(law))


@named(LAWS)
def test_energy_is_zero_at_rest(entry):
    assert entry.law.energy(CauchyGreen(1.0, 1.0, 1.0), INNER_WALL, anp) == 0.0


def test_rest_moduli_of_rubber():
    # Shear modulus μ = 2 C₁₀; Young's 3 μ; plane strain 4 μ; Hessian in (e_tt, e_zz): 4μ, 2μ.
    moduli, shear = rest_moduli(NeoHookean(0.5))
    np.testing.assert_allclose(moduli, [[4.0, 2.0], [2.0, 4.0]], rtol=1e-14)
    assert shear == pytest.approx(1.0)
    assert rest_state(NeoHookean(0.5)).hoop == pytest.approx(3.0)


def test_rest_moduli_of_fung():
    # U ≈ C/2 (a1 e_t² + a2 e_z² + 2 a12 e_t e_z) at small strain: Hessian C (a1, a12; a12, a2).
    moduli, shear = rest_moduli(Fung(C=2.0, a1111=0.5, a2222=0.75, a1122=0.1))
    np.testing.assert_allclose(moduli, [[1.0, 0.2], [0.2, 1.5]], rtol=1e-12)
    assert shear == pytest.approx(0.0, abs=1e-12)


@named([entry for entry in LAWS if entry.name != "ureter-printed"])
def test_catalogue_laws_are_stable(entry):
    assert check(entry).softest > 0.0


def test_the_printed_fung_set_is_refused_with_the_reason():
    with pytest.raises(UnstableLaw) as refusal:
        check(material("ureter-printed"))
    sentence = str(refusal.value)
    # a2222 − a1122²/a1111 = 0.1856 − 0.8892²/0.7091 = −0.9294; times C = 0.4056 MPa: −0.377 MPa.
    for part in ("indefinite", "-0.38 MPa", "circumference", "axis", "'ureter'"):
        assert part in sentence
    assert sentence.count("\n") == 0


def test_any_law_that_softens_a_strain_is_refused():
    class Softening:
        def energy(self, C, place, xp):
            return 1e5 * ((C.tt - 1.0) ** 2 - 0.5 * (C.zz - 1.0) ** 2)

    with pytest.raises(UnstableLaw, match="lowers the energy"):
        check(as_material(Softening()))


def test_a_law_that_couples_stretch_and_shear_into_instability_is_refused():
    """U = I₁ term + 30 C_rz (C_zz − 1): each block of the Hessian is sound, together they are not."""

    class Coupled(NeoHookean):
        def energy(self, C, place, xp):
            return self.C10 * (C.I1 - 3.0 + 30.0 * C.rz * (C.zz - 1.0))

    with pytest.raises(UnstableLaw, match="shear band"):
        check(as_material(Coupled(1e5)))


def test_a_law_without_shear_stiffness_is_refused():
    with pytest.raises(UnstableLaw, match="ground matrix"):
        check(as_material(Fung(4e5, 0.7091, 0.8892, 0.1856, G=0.0)))


def test_the_ground_matrix_is_the_calibrated_one():
    # docs/theory.md, "The wall": one G for both published critical sizes.
    for name in ("ureter", "ureter-printed", "ureter-soft-cross"):
        assert material(name).law.G == 12e3


def test_a_law_stressed_at_rest_is_refused():
    class Stressed(NeoHookean):
        def energy(self, C, place, xp):
            return self.C10 * (C.rr + 1.1 * C.tt + C.zz - 3.1)

    with pytest.raises(BadInput, match="zero apart from a pressure"):
        check(as_material(Stressed(1e5)))


def test_an_absurd_modulus_is_refused():
    with pytest.raises(BadInput, match="check the unit"):
        check(as_material(NeoHookean(1e-9)))


def test_unknown_names_get_the_nearest_one():
    with pytest.raises(BadInput, match="did you mean 'ureter-printed'"):
        material("uretr-printed")


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan"), float("inf")])
def test_bad_constants_are_refused(bad):
    with pytest.raises(BadInput, match="C10"):
        NeoHookean(bad)
    with pytest.raises(BadInput, match="C is"):
        Fung(bad, 1.0, 1.0, 0.0)


@named(LAWS)
def test_catalogue_entries_say_where_they_come_from(entry):
    assert "10.1016/j.jmbbm.2022.105432" in entry.source
    assert entry.test
    assert entry.verified
    assert entry.reference == entry.name


def test_a_law_that_cannot_be_kept_by_its_constants_is_refused():
    @dataclass
    class Changing:
        C: float

        def energy(self, C, place, xp):
            return self.C * (C.I1 - 3.0)

    with pytest.raises(BadInput, match="law is Changing, but must be hashable by its constants"):
        Material("mine", Changing(1e5), "", "", "", (1.0, 1.3))
