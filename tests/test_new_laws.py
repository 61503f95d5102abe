"""Ogden, Holzapfel–Gasser–Ogden and Demiray: closed forms by hand, special cases, fits, decks."""

import importlib
import os
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from strips import nominal_stress

import stonepass as sp
from stonepass.bench.law_fit import fit_law
from stonepass.bench.test_data import AXES, Tension
from stonepass.cli import run
from stonepass.export.feb_material import add_wall_material
from stonepass.export.inp import write_inp
from stonepass.export.results import read_contact
from stonepass.export.seating import bulk_modulus, seating
from stonepass.inputs.material_file import load_material, write_law
from stonepass.materials.demiray import Demiray
from stonepass.materials.derivatives import energy_derivatives, hoop_energy_slope
from stonepass.materials.ellipticity import weakest
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.known_laws import KNOWN_LAWS
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.principal_stretches import power_sum
from stonepass.materials.protocol import Material
from stonepass.materials.stability import check
from stonepass.materials.user_law import UserLaw
from stonepass.strain import INNER_WALL, CauchyGreen

OWN_LAW = f"{Path(__file__).parents[1] / 'examples' / 'own_law.py'}:energy"
STRETCH = np.linspace(0.8, 1.6, 9)
GAMMA = np.radians(40.0)


def made_of(law, high=1.4):
    return Material("mine", law, "s", "t", "v", (1.0, high))


# --- Closed forms


def test_ogden_in_uniaxial_tension():
    """λ_r = λ_z = λ^(−1/2): P = Σ μ (λ^(α−1) − λ^(−α/2−1))."""
    law = Ogden(6.3e5, 1.3, 0.012e5, 5.0, -0.1e5, -2.0)
    expected = sum(
        mu * (STRETCH ** (alpha - 1.0) - STRETCH ** (-alpha / 2.0 - 1.0)) for mu, alpha in law.terms
    )
    for axis in AXES:
        np.testing.assert_allclose(
            nominal_stress(law, STRETCH, axis), expected, rtol=1e-9, atol=1e-6
        )


def test_ogden_in_plane_strain():
    """w = Σ μ/α (λ^α + λ^(−α) − 2) at λ_z = 1: w′ = Σ μ (λ^(α−1) − λ^(−α−1))."""
    law = Ogden(1e5, 3.0, -2e4, -4.0)
    expected = sum(mu * (STRETCH ** (a - 1.0) - STRETCH ** (-a - 1.0)) for mu, a in law.terms)
    np.testing.assert_allclose(hoop_energy_slope(law, STRETCH), expected, rtol=1e-10, atol=1e-9)


def test_demiray_in_uniaxial_tension_and_simple_shear():
    """P = μ exp(b (I₁ − 3)) (λ − λ⁻²); in r–z shear γ: U = μ/(2b) (exp(b γ²) − 1)."""
    law = Demiray(5e4, 1.7)
    over = STRETCH**2 + 2.0 / STRETCH - 3.0
    expected = law.mu * np.exp(law.b * over) * (STRETCH - STRETCH**-2)
    np.testing.assert_allclose(nominal_stress(law, STRETCH, "axial"), expected, rtol=1e-9)
    g = 0.3
    sheared = law.energy(CauchyGreen(1.0, 1.0, 1.0 + g * g, g), INNER_WALL, np)
    assert sheared == pytest.approx(law.mu / (2 * law.b) * (np.exp(law.b * g * g) - 1.0))


def test_holzapfel_when_inflated():
    """λ_z = 1: E = cos²γ (λ² − 1), w′ = μ (λ − λ⁻³) + 4 k₁ E exp(k₂ E²) cos²γ λ, fibres if λ > 1."""
    law = HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA)
    E = np.cos(GAMMA) ** 2 * (STRETCH**2 - 1.0)
    fibres = 4.0 * law.k1 * E * np.exp(law.k2 * E**2) * np.cos(GAMMA) ** 2 * STRETCH
    matrix = law.mu * (STRETCH - STRETCH**-3)
    expected = matrix + np.where(E > 0.0, fibres, 0.0)
    np.testing.assert_allclose(hoop_energy_slope(law, STRETCH), expected, rtol=1e-11, atol=1e-9)


def test_holzapfel_sheared_in_the_surface_tightens_one_family():
    """t–z shear γ: I₄ − 1 = γ² c² ± 2 c s γ with c, s of the fibres; the slack family is left out."""
    law, g = HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA), 0.2
    c, s = np.cos(GAMMA), np.sin(GAMMA)
    # x_z = Z + γ·(around): C_tt = 1 + γ², C_tz = γ.
    found = law.energy(CauchyGreen(1.0, 1.0 + g * g, 1.0, 0.0, 0.0, g), INNER_WALL, np)
    tight, slack = (g * g * c * c + side * 2.0 * c * s * g for side in (1.0, -1.0))
    assert slack < 0.0 < tight
    expected = law.mu / 2 * g * g + law.k1 / (2 * law.k2) * (np.exp(law.k2 * tight**2) - 1.0)
    assert found == pytest.approx(expected, rel=1e-12)


def test_isotropic_dispersion_is_a_law_of_the_first_invariant():
    law = HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA, 1.0 / 3.0)
    C = CauchyGreen(0.9, 1.3, 1.1, 0.1, 0.05, -0.2)
    E = (C.I1 - 3.0) / 3.0
    expected = law.mu / 2 * (C.I1 - 3.0) + law.k1 / law.k2 * (np.exp(law.k2 * E**2) - 1.0)
    assert law.energy(C, INNER_WALL, np) == pytest.approx(expected, rel=1e-12)


# --- Principal stretches


@pytest.mark.parametrize("a", [0.65, 1.0, -2.0, 4.75, -1.0, 10.0, -10.0])
def test_sums_of_powers_by_series_root_and_eigenvalues(a):
    """Both formulas against eigenvalues, over differences from none to large."""
    for apart in (0.0, 1e-9, 1e-5, 9e-4, 1.1e-3, 9e-3, 0.1, 0.6):
        for shear in (0.0, 0.3 * apart):
            C = CauchyGreen(1.1 * (1 + apart), 0.9, 1.1 * (1 - apart), shear)
            matrix = np.array([[C.rr, 0.0, C.rz], [0.0, C.tt, 0.0], [C.rz, 0.0, C.zz]])
            exact = (np.linalg.eigvalsh(matrix) ** a).sum()
            assert power_sum(C, a, np) == pytest.approx(exact, rel=3e-14)
            arrays = CauchyGreen(*(np.array([each]) for each in C))
            assert power_sum(arrays, a, np)[0] == pytest.approx(exact, rel=3e-14)


@pytest.mark.parametrize("apart", [0.0, 1e-8, 1e-4, 0.00099, 0.00101, 0.3])
def test_second_derivatives_where_stretches_are_nearly_equal(apart):
    """μ/α Σ λ^α with α = 4 is μ/4 tr C², whose derivatives are polynomials."""

    def squares(C, place, xp):
        sheared = C.rz * C.rz + C.rt * C.rt + C.tz * C.tz
        return 25e3 * (C.rr * C.rr + C.tt * C.tt + C.zz * C.zz + 2.0 * sheared - 3.0)

    C = CauchyGreen(*(np.array([x]) for x in (1 + apart, 1.0, 1 - apart, 0.2 * apart, 0.0, 0.0)))
    for found, exact in zip(
        energy_derivatives(Ogden(1e5, 4.0), C, INNER_WALL),
        energy_derivatives(UserLaw(squares, "tr C²"), C, INNER_WALL),
        strict=True,
    ):
        np.testing.assert_allclose(found, exact, rtol=1e-11, atol=1e-6)


# --- Strong ellipticity out of the r–z plane


@pytest.mark.parametrize(
    ("law", "stretch", "margin"),
    [
        (MooneyRivlin(20e3, -11e3), 1.0, 1.0),
        (MooneyRivlin(20e3, -11e3), 1.3, 0.0927),
        (MooneyRivlin(5e3, 25e3), 1.3, 1.3**-2),
        (NeoHookean(1e5), 1.3, 1.3**-2),
        (Ogden(-30e3, -4.0), 1.3, 0.4709),
    ],
)
def test_margins_of_the_uniform_tube(law, stretch, margin):
    F = np.array([[1.0 / stretch, 0.0, 0.0, 1.0, stretch]])
    assert weakest(law, F, INNER_WALL).stiffness == pytest.approx(margin, rel=1e-3)


def test_a_law_of_the_volume_preserving_invariant_is_not_refused():
    """J^(−2/3) I₁ − 3 is the neo-Hookean law wherever volume is kept, in every shear."""
    law = UserLaw(lambda C, place, xp: 30e3 * (C.I3 ** (-1.0 / 3.0) * C.I1 - 3.0), "J")
    assert check(made_of(law)).shear == pytest.approx(60e3, rel=1e-9)


# --- Solved walls


def seated(law):
    stone, ureter = sp.Stone(size_ratio=1.15), sp.Ureter(wall_ratio=1.4, material=law)
    numerics = sp.Numerics("fast")
    model = sp.SeatedBalance("frictionless")
    return sp.seat(sp.Case(stone, ureter, model=model, numerics=numerics))


def fast(law, friction=0.3):
    stone, ureter = sp.Stone(size_ratio=1.15, friction=friction), sp.Ureter(wall_ratio=1.4,
                                                                          material=law)  # fmt: skip
    return sp.critical_pressure(stone, ureter, numerics=sp.Numerics("fast"))


@pytest.mark.parametrize(
    ("law", "other"),
    [
        (made_of(Ogden(2e5, 2.0)), made_of(NeoHookean(1e5))),
        (made_of(HolzapfelGasserOgden(2e5, 0.0, 2.0, GAMMA)), made_of(NeoHookean(1e5))),
        (made_of(Demiray(60e3, 2.0)), load_material(OWN_LAW)),
    ],
    ids=["ogden 2", "no fibres", "demiray"],
)
def test_special_cases_are_solved_alike(law, other):
    one, two = seated(law), seated(other)
    assert one.contact_angle == pytest.approx(two.contact_angle, rel=1e-9)
    assert one.stability.margin == pytest.approx(two.stability.margin, rel=1e-9)
    np.testing.assert_allclose(one.contact_pressure, two.contact_pressure, rtol=1e-8)


def test_ogden_2_and_minus_2_is_mooney_rivlin():
    """λ₁⁻² + λ₂⁻² + λ₃⁻² is I₂/I₃: alike where volume is kept, which elements do on average."""
    one, two = seated(made_of(Ogden(2e5, 2.0, -6e4, -2.0))), seated(made_of(MooneyRivlin(1e5, 3e4)))
    assert one.contact_angle == pytest.approx(two.contact_angle, rel=1e-4)
    assert one.equator_contact_pressure == pytest.approx(two.equator_contact_pressure, rel=1e-4)


@pytest.mark.parametrize(
    "law",
    [
        Ogden(6e4, 1.3, 2e3, 5.0, -1e4, -2.0),
        HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA),
        HolzapfelGasserOgden(2e4, 6e4, 2.0, np.radians(55.0), 0.15),
        Demiray(4e4, 3.0),
    ],
    ids=["ogden", "holzapfel", "dispersed", "demiray"],
)
def test_walls_of_the_new_laws_are_solved(law):
    """Stiffer fibres need more pressure; the state is in balance and stable."""
    found = fast(made_of(law))
    assert found.outcome is sp.Outcome.MOVES
    assert found.contact.stability.margin > 0.0
    softer = fast(made_of(NeoHookean(law.mu / 2))) if hasattr(law, "k1") else None
    assert softer is None or found.pressure > softer.pressure


# --- Fits, files, decks


@pytest.mark.parametrize(
    ("law", "name", "given", "free"),
    [
        (Ogden(8e4, 3.5), "ogden", {}, ()),
        (Ogden(8e4, 1.5, 3e3, 6.0), "ogden", {"alpha1": 1.5, "alpha2": 6.0}, ("mu2",)),
        (Demiray(6e4, 2.0), "demiray", {}, ()),
        (HolzapfelGasserOgden(2e4, 6e4, 2.0, np.radians(35.0)), "holzapfel-gasser-ogden", {}, ()),
    ],
)
def test_constants_are_recovered(law, name, given, free):
    stretch = np.tile(np.linspace(1.03, 1.4, 14), 2)
    axis = tuple(each for each in AXES for _ in range(14))
    data = Tension(stretch, Tension(stretch, np.ones(28), axis).predicted(law), axis)
    found = fit_law(data, name, given, free=free)
    for constant in found.constants:
        assert constant.value == pytest.approx(getattr(law, constant.name), rel=1e-4, abs=1e-9)
    assert found.r_squared == pytest.approx(1.0, abs=1e-9)
    held = {each.name for each in found.constants if each.given}
    assert held >= ({"mu3", "alpha3"} if name == "ogden" else set())


def test_an_unknown_constant_cannot_be_freed():
    data = Tension(np.linspace(1.1, 1.4, 6), np.ones(6), ("axial",) * 6)
    with pytest.raises(sp.BadInput, match="did you mean 'mu2'"):
        fit_law(data, "ogden", free=("mu22",))


def test_angles_in_law_files_have_their_unit(tmp_path):
    text = (
        'law = "holzapfel-gasser-ogden"\nmu = "20 kPa"\nk1 = "60 kPa"\nk2 = 2.0\n'
        'angle = "40 deg"\nsource = "x"\nstrain_range = [1, 1.3]\n'
    )
    path = tmp_path / "law.toml"
    for angle, expected in (('"40 deg"', GAMMA), ('"40°"', GAMMA), ('"0.5 rad"', 0.5)):
        path.write_text(text.replace('"40 deg"', angle), encoding="utf-8")
        assert load_material(str(path)).law.angle == expected
    for angle, words in (('"40"', "an angle with its unit"), ('"95 deg"', "from 0° to 90°")):
        path.write_text(text.replace('"40 deg"', angle), encoding="utf-8")
        with pytest.raises(sp.BadInput, match=words):
            load_material(str(path))


def test_the_command_shows_every_constant_with_its_unit(tmp_path, capsys):
    path = tmp_path / "law.toml"
    head = 'source = "x"\nstrain_range = [1, 1.3]\n'
    path.write_text('law = "yeoh"\nC10 = "50 kPa"\nC20 = "10 kPa"\nC30 = "0 kPa"\n' + head)
    assert run(["material", "show", str(path)]) == 0
    shown = capsys.readouterr().out
    for line in ("C10        0.05 MPa", "C20        0.01 MPa", "C30        0 MPa"):
        assert line in shown
    path.write_text(
        'law = "holzapfel-gasser-ogden"\nmu = "20 kPa"\nk1 = "60 kPa"\nk2 = 2.0\n'
        'angle = "40 deg"\n' + head
    )
    assert run(["material", "show", str(path)]) == 0
    assert "angle      40 deg" in capsys.readouterr().out
    assert run(["material", "laws"]) == 0
    listed = capsys.readouterr().out
    for name in ("neo-hookean", "ogden", "demiray", "alpha3", "kappa"):
        assert name in listed


def deck_of(law, flavour):
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=made_of(law)))
    return write_inp(seating(case), "CAX8", flavour).splitlines()


@pytest.mark.parametrize("flavour", ["calculix", "abaqus"])
def test_ogden_in_a_deck(flavour):
    """Abaqus and CalculiX: Σ 2 μ_i/α_i² (…), so that their μ_i is μ_p α_p/2."""
    law = Ogden(6e4, 1.3, 2e3, 5.0, -1e4, -2.0)
    lines = deck_of(law, flavour)
    at = lines.index("*HYPERELASTIC, OGDEN, N=3")
    row = [float(x) for x in ", ".join(lines[at + 1 : at + 3]).split(",")]
    assert lines[at + 1].count(",") == 7  # eight constants in the first line
    assert row[:6] == pytest.approx([39.0, 1.3, 5.0, 5.0, 10.0, -2.0], rel=1e-12)
    assert row[6] == (0.0 if flavour == "abaqus" else pytest.approx(2e3 / bulk_modulus(law)))
    assert row[7:] == [0.0, 0.0]


def test_holzapfel_in_a_deck_for_abaqus():
    law = HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA, 0.1)
    lines = deck_of(law, "abaqus")
    at = lines.index("*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2")
    assert [float(x) for x in lines[at + 1].split(",")] == [10.0, 0.0, 60.0, 2.0, 0.1]
    at = lines.index("*ORIENTATION, NAME=CYLINDER, LOCAL DIRECTIONS=2")
    # Axes r, z, around: γ is from the circumference.
    fibres = [[float(x) for x in line.split(",")] for line in lines[at + 3 : at + 5]]
    np.testing.assert_allclose(
        fibres, [[0.0, side * np.sin(GAMMA), np.cos(GAMMA)] for side in (1, -1)], rtol=1e-11
    )
    assert "*SOLID SECTION, ELSET=WALL, MATERIAL=WALL, ORIENTATION=CYLINDER" in lines


def test_ogden_and_holzapfel_in_a_file_for_febio():
    """FEBio: Σ c/m² (λ^m …) in its Ogden law; fibres at ±gamma to axis 1, which is θ."""
    parent = ET.Element("Material")
    law = Ogden(6e4, 1.3, 2e3, 5.0)
    add_wall_material(parent, law)
    add_wall_material(parent, HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA, 0.1))
    ogden, holzapfel = parent
    values = {child.tag: float(child.text) for child in ogden}
    assert values == pytest.approx(
        {"c1": 78.0, "m1": 1.3, "c2": 10.0, "m2": 5.0, "k": bulk_modulus(law) / 1e3}, rel=1e-11
    )
    axes = holzapfel.find("mat_axis")
    assert (axes.find("vector").text, axes.find("axis").text) == ("0,1,0", "0,0,1")
    values = {child.tag: float(child.text) for child in holzapfel if child is not axes}
    values.pop("k")
    assert values == pytest.approx(
        {"c": 20.0, "k1": 60.0, "k2": 2.0, "gamma": 40.0, "kappa": 0.1}, rel=1e-11
    )


def test_the_programs_have_the_energy_of_the_law():
    """Their formulas with the constants of the deck: Abaqus' and CalculiX', and FEBio's, in kPa."""
    C = CauchyGreen(0.8, 1.4, 1.0, 0.3, 0.1, -0.2)
    rows = np.array([[C.rr, C.rt, C.rz], [C.rt, C.tt, C.tz], [C.rz, C.tz, C.zz]])
    rows /= np.cbrt(np.linalg.det(rows))  # axes r, t, z
    C = CauchyGreen(*(rows[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 2), (0, 1), (1, 2))))
    stretches = np.sqrt(np.linalg.eigvalsh(rows))
    ogden, hgo = Ogden(6e4, 1.3, 2e3, 5.0), HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA, 0.1)
    lines, parent = deck_of(ogden, "calculix"), ET.Element("Material")
    row = [float(x) for x in lines[lines.index("*HYPERELASTIC, OGDEN, N=2") + 1].split(",")]
    pairs = ((row[0], row[1]), (row[2], row[3]))
    found = sum(2.0 * mu / a**2 * ((stretches**a).sum() - 3.0) for mu, a in pairs)
    assert 1e3 * found == pytest.approx(ogden.energy(C, INNER_WALL, np), rel=1e-10)
    add_wall_material(parent, ogden)
    add_wall_material(parent, hgo)
    c = {child.tag: float(child.text) for child in parent[0]}
    pairs = ((c["c1"], c["m1"]), (c["c2"], c["m2"]))
    found = sum(c / m**2 * ((stretches**m).sum() - 3.0) for c, m in pairs)
    assert 1e3 * found == pytest.approx(ogden.energy(C, INNER_WALL, np), rel=1e-10)
    c = {child.tag: float(child.text) for child in parent[1] if child.tag != "mat_axis"}
    angle = np.radians(c["gamma"])
    found = c["c"] / 2.0 * (np.trace(rows) - 3.0)
    for side in (1.0, -1.0):
        fibre = np.array([0.0, np.cos(angle), side * np.sin(angle)])  # axis 1 is θ, axis 2 is z
        E = c["kappa"] * (np.trace(rows) - 3.0) + (1.0 - 3.0 * c["kappa"]) * (
            fibre @ rows @ fibre - 1.0
        )
        found += c["k1"] / (2.0 * c["k2"]) * (np.exp(c["k2"] * max(E, 0.0) ** 2) - 1.0)
    assert 1e3 * found == pytest.approx(hgo.energy(C, INNER_WALL, np), rel=1e-10)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_calculix_takes_ogdens_constants_as_we_do(tmp_path):
    """The Ogden law with powers 2 and −2 is the Mooney–Rivlin law, in CalculiX too."""
    found = []
    for name, law in (("ogden", Ogden(2e5, 2.0, -8e4, -2.0)), ("rivlin", MooneyRivlin(1e5, 4e4))):
        case = sp.Case(
            sp.Stone(size_ratio=1.05),
            sp.Ureter(wall_ratio=1.5, material=made_of(law)),
            model=sp.SeatedBalance("frictionless"),
        )
        s = seating(case, 0.1)
        folder = tmp_path / name
        folder.mkdir()
        (folder / "job.inp").write_text(write_inp(s, "CAX8R"), encoding="utf-8")
        subprocess.run(
            ["ccx", "job"], cwd=folder, capture_output=True, check=True, timeout=300,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
        )  # fmt: skip
        found.append(read_contact(s, folder / "job.dat"))
    ogden, rivlin = found
    assert ogden.contact_angle == pytest.approx(rivlin.contact_angle, rel=1e-5)
    theta = np.linspace(ogden.contact_angle + 0.03, np.pi / 2, 9)
    np.testing.assert_allclose(ogden.pressure_at(theta), rivlin.pressure_at(theta), rtol=1e-4)


@pytest.mark.parametrize(
    ("law", "flavour", "words"),
    [
        (Demiray(6e4, 2.0), "abaqus", "in a deck for Abaqus"),
        (Demiray(6e4, 2.0), "calculix", "neo-hookean, mooney-rivlin, yeoh or ogden in a deck"),
        (HolzapfelGasserOgden(2e4, 6e4, 2.0, GAMMA), "calculix", "--flavour abaqus"),
        (Fung(4e5, 0.7, 0.9, 0.2, 1e4), "calculix", "--flavour abaqus"),
    ],
)
def test_laws_that_a_program_does_not_have_are_refused(law, flavour, words):
    with pytest.raises(sp.BadInput, match=words):
        deck_of(law, flavour)


def test_the_old_form_of_a_users_function_is_refused_with_the_new_one(tmp_path):
    path = tmp_path / "law.py"
    path.write_text(
        "def energy(C_rr, C_tt, C_zz, C_rz, xp):\n    return 1e5 * (C_rr + C_tt + C_zz - 3.0)\n"
    )
    with pytest.raises(sp.BadInput, match=r"energy\(C, place, xp\)") as refusal:
        load_material(f"{path}:energy")
    assert "\n" not in str(refusal.value)
    assert str(refusal.value).count(". ") == 0
    path.write_text(
        "def energy(C, place, xp, mu=1e5, more=0.0):\n    return mu * (C.I1 - 3.0) + more\n"
    )
    assert load_material(f"{path}:energy").law.label == "energy"


def test_the_recipe_for_a_law_works(tmp_path, monkeypatch, capsys):
    """The law of docs/laws.md: written to a file, read, shown, fitted and solved once registered."""
    page = (Path(__file__).parents[1] / "docs" / "laws.md").read_text(encoding="utf-8")
    code = page.split("```python\n")[1].split("```")[0]
    (tmp_path / "gent.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    Gent = importlib.import_module("gent").Gent
    monkeypatch.setitem(KNOWN_LAWS, "gent", Gent)
    law = Gent(6e4, 5.0)
    data = Tension(STRETCH, nominal_stress(law, STRETCH, "axial"), ("axial",) * len(STRETCH))
    found = fit_law(data, "gent")
    assert pytest.approx(5.0, rel=1e-4) == found.material.law.Jm
    path = tmp_path / "law.toml"
    write_law(made_of(law), path)
    assert load_material(str(path)).law == law
    assert run(["material", "laws"]) == 0
    assert "gent" in capsys.readouterr().out
    assert seated(made_of(law)).stability.margin > 0.0
