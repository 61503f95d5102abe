"""A user's own law: works like a catalogue law, and every way to get it wrong is one sentence."""

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.inputs.material_file import load_material
from stonepass.materials.derivatives import hoop_energy_slope
from stonepass.strain import INNER_WALL, CauchyGreen

FAST = asking(accuracy="fast", seating="frictionless")
RUBBER = """
source = "a bench"
strain_range = (1.0, 1.6)
def energy(C, place, xp):
    return 146.5e3 * (C.rr + C.tt + C.zz - 3.0)
"""


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
    text = """
import numpy as np
def energy(C, place, xp):
    if xp.__name__.startswith("autograd"):
        return 1e5 * (C.rr + C.tt + C.zz - 3.0)
    return np.exp(C.tt)
"""
    mine = load_material(write(tmp_path, text))
    with pytest.raises(sp.BadInput, match=r"it may use .*xp\.exp"):
        sp.seat(sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=mine)))


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
        (GOOD + 'C10 = "1 kPa"\n', "absent for law 'fung'"),
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
