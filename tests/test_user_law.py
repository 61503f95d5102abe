"""A user's own law: works like a catalogue law, and every way to get it wrong is one sentence."""

import runpy

import numpy as np
import pytest
from options import asking
from scipy.integrate import quad

import stonepass as sp
from stonepass.cli import run
from stonepass.inputs.material_file import load_material
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.derivatives import hoop_energy_slope
from stonepass.materials.protocol import Material
from stonepass.materials.stability import one_sided_moduli
from stonepass.materials.user_law import UserLaw
from stonepass.model.far_field import confining_traction, lumen_ratio
from stonepass.model.states.law_trial import check_in_engine
from stonepass.strain import INNER_WALL, CauchyGreen

FAST = asking(accuracy="fast", seating="frictionless")
RUBBER = """
source = "a bench"
strain_range = (1.0, 1.6)
def energy(C, place, xp):
    return 146.5e3 * (C.rr + C.tt + C.zz - 3.0)
"""


NUMPY = """
import numpy as np
def energy(C, place, xp):
    return F
"""


def runpy_energy(tmp_path, text):
    return runpy.run_path(write(tmp_path, text).removesuffix(":energy"))["energy"]


def write(tmp_path, text, name="law.py"):
    (tmp_path / name).write_text(text)
    return f"{tmp_path / name}:energy" if name.endswith(".py") else str(tmp_path / name)


def test_a_user_law_equals_the_same_catalogue_law_end_to_end(tmp_path):
    mine = load_material(write(tmp_path, RUBBER))
    assert (mine.source, mine.strain_range) == ("a bench", (1.0, 1.6))
    stone = sp.Stone(size_ratio=1.2)
    one = sp.critical_pressure(stone, sp.Ureter(wall_ratio=1.5, material=mine), **FAST)
    two = sp.critical_pressure(stone, sp.Ureter(wall_ratio=1.5, material="latex"), **FAST)
    assert one.pressure == pytest.approx(two.pressure, rel=1e-9)


def test_a_law_may_import_what_lies_beside_it(tmp_path):
    (tmp_path / "constants_of_mine.py").write_text("MU = 146.5e3\n")
    text = RUBBER.replace("source =", "from constants_of_mine import MU\nsource =")
    mine = load_material(write(tmp_path, text.replace("146.5e3", "MU")))
    assert mine.law.energy(CauchyGreen(0.25, 4.0, 1.0), INNER_WALL, np) == 146.5e3 * 2.25


def test_every_function_of_the_namespace_may_be_used(tmp_path):
    """The same law in NumPy and in the engine: |x|, max, min and all the rest cancel out."""
    text = """
def energy(C, place, xp):
    I1 = C.rr + C.tt + C.zz - 3.0
    x = C.tt - 1.0
    odd = xp.sin(x) - xp.tan(xp.arctan(xp.sin(x)))
    odd = odd + xp.cosh(x) ** 2 - xp.sinh(x) ** 2 - 1.0
    odd = odd + xp.tanh(x) - xp.sinh(x) / xp.cosh(x)
    odd = odd + xp.cos(x) ** 2 + xp.sin(x) ** 2 - 1.0
    odd = odd + xp.log(xp.exp(x)) - x + xp.sqrt(C.tt * C.tt) - C.tt
    odd = odd + xp.maximum(x, 0.5 + 0 * x) + xp.minimum(x, 0.5 + 0 * x) - x - 0.5
    odd = odd + xp.abs(C.tt) - C.tt
    return 146.5e3 * (I1 + odd)
"""
    mine = load_material(write(tmp_path, text))
    stone = sp.Stone(size_ratio=1.2)
    state, latex = (
        sp.seat(sp.Case(stone, sp.Ureter(wall_ratio=1.5, material=each), **FAST))
        for each in (mine, "latex")
    )
    assert state.contact_angle == pytest.approx(latex.contact_angle, rel=1e-8)
    slope = hoop_energy_slope(mine.law, np.array([1.1, 1.3]))
    np.testing.assert_allclose(
        slope, hoop_energy_slope(latex.case.ureter.material.law, np.array([1.1, 1.3]))
    )


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("1 / 0", "raising ZeroDivisionError"),
        ("xp.erf(C.tt)", r"raising AttributeError.*xp\.exp"),
        ("None", "None, but must be an energy"),
        ("'text'", "one real energy in J/m³ per strain"),
        ("xp.log(C.tt - 10.0)", "nan at circumferential stretch"),
        ("3.0", "strain-dependent"),
        ("C.tt * float('inf')", "finite energy"),
        ("1e5 * C.tt * (1 + 0j)", "one real energy"),
    ],
)
def test_bad_functions_are_refused(tmp_path, body, words):
    text = f"def energy(C, place, xp):\n    return {body}\n"
    with pytest.raises(sp.BadInput, match=words) as refusal:
        load_material(write(tmp_path, text))
    assert "\n" not in str(refusal.value)


def test_a_law_that_only_numpy_can_evaluate_is_refused_by_the_engine(tmp_path):
    text = NUMPY.replace("F", "5e4 * (np.exp(C.I1 - 3.0) - 1.0)")
    law = UserLaw(runpy_energy(tmp_path, text), "energy")
    mine = Material("mine", law, "", "", "", (1.0, 1.5))
    with pytest.raises(sp.BadInput, match=r"it may use .*xp\.exp"):
        sp.seat(sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=mine)))
    with pytest.raises(sp.BadInput, match=r"it may use .*xp\.exp"):
        check_in_engine(mine)


@pytest.mark.parametrize(
    "formula",
    [
        "1e5 * (C.I1 - 3.0) + np.where(C.I1 > 3.1, (C.I1 - 3.1) ** 2, 0.0)",
        "1e5 * (C.I1 - 3.0) * (1.0 + C.I1 // 3.5)",
        "1e5 * xp.logaddexp(C.I1 - 3.0, 0.0)",  # NumPy has it, the finite elements do not
        "1e5 * np.sum([C.I1, -3.0])",
    ],
)
def test_what_cannot_be_differentiated_is_the_laws_fault(tmp_path, formula):
    with pytest.raises(sp.BadInput, match=r"law 'energy' is raising .*it may use \+"):
        load_material(write(tmp_path, NUMPY.replace("F", formula)))


def test_a_comparison_passes_in_numpy_and_is_found_by_the_check(tmp_path, capsys):
    text = NUMPY.replace("F", "1e5 * (C.I1 - 3.0) + (C.I1 > 3.1) * 1e4 * (C.I1 - 3.1) ** 2")
    assert run(["material", "check", write(tmp_path, text)]) == 2
    said = capsys.readouterr().err
    assert "TypeError: '>' not supported" in said
    assert "no comparisons" in said


def test_another_energy_in_the_finite_elements_is_found_by_the_check(tmp_path):
    text = NUMPY.replace("F", "(1e5 if isinstance(C.rr, np.ndarray) else 1.1e5) * (C.I1 - 3.0)")
    mine = Material("mine", UserLaw(runpy_energy(tmp_path, text), "energy"), "", "", "", (1.0, 1.5))
    with pytest.raises(sp.BadInput, match=r"in the finite elements and .* in NumPy at circumf"):
        check_in_engine(mine)


@pytest.mark.parametrize("law", [*CATALOGUE])
def test_the_finite_elements_find_what_numpy_finds(law):
    check_in_engine(CATALOGUE[law])


GENT = """
strain_range = (1.0, {high})
def energy(C, place, xp):
    return -0.5 * 293e3 * {limit} * xp.log(1.0 - (C.I1 - 3.0) / {limit})
"""
LOADS = [
    sp.Load("2 kPa"),
    sp.Load("30 kPa", "hydrostatic"),
    sp.Load(prestretch=1.3),
    sp.Load("20 kPa", prestretch=1.2),
]


@pytest.mark.parametrize("load", LOADS)
def test_a_locking_law_has_a_lumen_under_load(tmp_path, load):
    """The bracket of the lumen begins where the law has an energy; Gent (1996)."""
    law = load_material(write(tmp_path, GENT.format(limit=1.5, high=1.5))).law
    lumen = lumen_ratio(1.5, law, load)
    assert 0.5 < lumen < 1.0

    def traction(R):  # dP/dR = w'(λ)/(λ_z λ R) with the slope of Gent's law by hand
        axial = load.prestretch
        hoop = np.sqrt(lumen**2 + (R**2 - 1.0) / axial) / R
        excess = hoop**2 + axial**2 + 1.0 / (hoop * axial) ** 2 - 3.0
        slope = 293e3 * 1.5 / (1.5 - excess) * (hoop - 1.0 / (hoop**3 * axial**2))
        return slope / (axial * hoop * R)

    outside = float(confining_traction(np.array(lumen), 1.5, load))
    assert quad(traction, 1.0, 1.5)[0] + outside == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("load", LOADS)
def test_a_law_that_locks_far_away_is_neo_hookean(tmp_path, load):
    law = load_material(write(tmp_path, GENT.format(limit=1e7, high=1.5))).law
    latex = CATALOGUE["latex"].law
    assert lumen_ratio(1.5, law, load) == pytest.approx(lumen_ratio(1.5, latex, load), rel=1e-5)


def test_a_stone_beyond_the_locking_stretch_has_no_answer(tmp_path):
    """Its energy has no value there, but the derivative of the logarithm has."""
    mine = load_material(write(tmp_path, GENT.format(limit=1.5, high=1.5)))
    stone, ureter = sp.Stone(size_ratio=1.9), sp.Ureter(wall_ratio=1.5, material=mine)
    answer = sp.critical_pressure(stone, ureter, **FAST)
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    with np.errstate(invalid="raise"):
        assert np.isnan(hoop_energy_slope(mine.law, np.array([1.9]))[0])


def test_the_strain_range_of_a_locking_law_ends_before_it_locks(tmp_path):
    load_material(write(tmp_path, GENT.format(limit=0.3, high=1.2)))
    with pytest.raises(sp.BadInput, match=r"at circumferential stretch 1\.5.*strain_range = "):
        load_material(write(tmp_path, GENT.format(limit=0.3, high=1.5)))


def test_fibres_that_bear_tension_only_have_two_moduli(tmp_path, capsys):
    """μ 40 kPa and fibres along the axis, k (C_zz − 1)² with k 50 kPa, stiffness 8 k = 400 kPa.

    Uniaxial: 3 μ + 8 k along the axis in tension, 3 μ in compression. Around, the axis contracts in
    tension (3 μ); in compression it would lengthen, 4 μ − (2 μ)²/(4 μ + 8 k).
    """
    text = """
def energy(C, place, xp):
    return 20e3 * (C.I1 - 3.0) + 50e3 * xp.maximum(C.zz - 1.0, 0.0) ** 2
"""
    assert run(["material", "check", write(tmp_path, text)]) == 0
    shown = capsys.readouterr().out
    assert "0.12 MPa in tension, 0.1486 MPa in compression" in shown
    assert "0.52 MPa in tension, 0.12 MPa in compression" in shown
    assert shown.count("in compression") == 2
    law = load_material(f"{tmp_path / 'law.py'}:energy").law
    tension, compression = one_sided_moduli(law, 1.0), one_sided_moduli(law, -1.0)
    np.testing.assert_allclose(tension, (120e3, 520e3, 160e3), rtol=1e-5)
    np.testing.assert_allclose(compression, (160e3 - 80e3**2 / 560e3, 120e3, 160e3), rtol=1e-5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("def energy(:\n", "SyntaxError"),
        ("raise SystemExit(3)\n", "SystemExit"),
        ("def enrgy(*a): pass\n", "did you mean 'enrgy'"),
        ("energy = 3\n", "'energy' in law.py is 3, but must be a function"),
        (RUBBER.replace("(1.0, 1.6)", "'wide'"), "two circumferential stretches"),
        (RUBBER.replace("(1.0, 1.6)", "(2.0, 1.6)"), "low <= 1 < high"),
    ],
)
def test_bad_modules_are_refused(tmp_path, text, words):
    with pytest.raises(sp.BadInput, match=words):
        load_material(write(tmp_path, text))


GOOD = 'law = "fung"\nC = "0.4 MPa"\na1111 = 0.7\na2222 = 0.9\na1122 = 0.2\nsource = "x"\nstrain_range = [1, 1.3]\n'


def test_constants_from_a_file(tmp_path):
    entry = load_material(write(tmp_path, GOOD + 'G = "10 kPa"\nname = "pig"\n', "law.toml"))
    assert (entry.law.C, entry.law.G, entry.name) == (0.4e6, 1e4, "pig")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (GOOD.replace("fung", "fungg"), "did you mean 'fung'"),
        (GOOD.replace("a1111", "a111"), "did you mean 'a1111'"),
        (GOOD.replace('C = "0.4 MPa"\n', ""), "in law.toml, 'C' is missing"),
        (GOOD.replace('source = "x"\n', ""), "in law.toml, 'source' is missing"),
        (GOOD.replace('"0.4 MPa"', "0.4"), "in law.toml, 'C' is 0.4"),
        (GOOD.replace("0.4 MPa", "0.4 mm"), "must be a pressure"),
        (GOOD.replace("0.4 MPa", "-0.4 MPa"), "a positive modulus"),
        (GOOD.replace("0.7", '"0.7"'), "in law.toml, 'a1111' is 0.7"),
        (GOOD + 'C10 = "1 kPa"\n', "left out for law 'fung'"),
        (GOOD.replace("[1, 1.3]", "[1.3, 1]"), "low <= 1 < high"),
        ("law = \n", "valid TOML"),
    ],
)
def test_bad_constant_files_are_refused(tmp_path, text, words):
    with pytest.raises(sp.BadInput, match=words) as refusal:
        load_material(write(tmp_path, text, "law.toml"))
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("text", ["none.toml", "none.py:energy", "law.py", "law.py:", "law.py:1x"])
def test_bad_names_are_refused(text):
    with pytest.raises(sp.BadInput, match="material is"):
        load_material(text)


def test_constants_in_kilopascals_are_asked_about(tmp_path):
    """A latex tube whose C10 is given as 146.5 instead of 146.5e3."""
    mine = load_material(write(tmp_path, RUBBER.replace("146.5e3", "146.5")))
    answer = sp.critical_pressure(
        sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=mine), **FAST
    )
    (asked,) = [each for each in answer.warnings if each.code == "soft_law"]
    assert "is 293 Pa, which is softer than any ureter: check whether its constants" in str(asked)


def test_a_wall_that_varies_along_the_tube_is_told(tmp_path, capsys):
    """Its far field and its stability are those of the middle; a wall in layers is no such wall."""
    along = "def energy(C, place, xp):\n    return 5e4*(1 + 0.1*place.Z**2)*(C.I1 - 3.0)\n"
    layers = along.replace("place.Z**2", "place.R")
    for law, told in ((along, True), (layers, False)):
        name = write(tmp_path, law)
        answer = sp.critical_pressure(
            sp.Stone(size_ratio=1.1),
            sp.Ureter(wall_ratio=1.5, material=load_material(name)),
            **FAST,
        )
        assert ("varies_along" in {each.code for each in answer.warnings}) is told
        assert run(["material", "check", name]) == 0
        assert ("varies along the tube" in capsys.readouterr().err) is told


@pytest.mark.parametrize("term", ["(C.I1 - 3.0)**1.5", "xp.sqrt(C.I1 - 3.0)"])
def test_an_energy_without_derivatives_at_rest_is_told_why(tmp_path, capsys, term):
    name = write(tmp_path, f"def energy(C, place, xp):\n    return 1e5*{term} + 1e4*(C.I1 - 3.0)\n")
    assert run(["material", "check", name]) == 2
    told = capsys.readouterr().err
    assert "the energy needs two derivatives at C = 1" in told
    assert "nan" not in told
    assert "inf" not in told.replace("infl", "")
