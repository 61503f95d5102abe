"""The wall as a beam on springs: the printed equations, their limits, and where it refuses."""

import json
import subprocess
import sys

import numpy as np
import pytest
from options import asking
from scipy.integrate import quad

import stonepass as sp
from stonepass.errors import BadInput, Outcome
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.secant import secant_moduli

PUBLISHED = {"circumferential_modulus": "0.465 MPa", "longitudinal_modulus": "0.02 MPa"}


def case(xi=1.2, eta=1.3, mu=0.5, load=None, shape=None, **method):
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=mu, shape=shape),
        sp.Ureter(wall_ratio=eta),
        load or sp.Load(),
        **asking(model="beam", **(method or PUBLISHED)),
    )


@pytest.mark.parametrize(
    ("xi", "kilopascal"),
    [(1.05, 2.649), (1.10, 5.597), (1.15, 8.870), (1.20, 12.495), (1.24, 15.676), (1.30, 20.996)],
)
def test_printed_equations_with_the_fourth_root(xi, kilopascal):
    # Origin: evidence.md section 5, Eqs 23-28 evaluated independently, beta with a fourth root.
    answer = sp.solve(case(xi))
    assert answer.outcome is Outcome.MOVES
    assert answer.pressure == pytest.approx(1e3 * kilopascal, rel=1e-4)


def test_the_beam_by_hand():
    # h = 0.3: k = 0.3 E1; F_n = 2 k δ/β is the load that lifts a Winkler beam by δ under it.
    beam = sp.solve(case(1.2)).contact
    assert beam.foundation == pytest.approx(0.3 * 0.465e6)
    bending = 0.02e6 * 0.3**3 / 12.0  # E I of unit width; β⁴ = k/(4 E I)
    assert beam.decay**4 == pytest.approx(beam.foundation / (4.0 * bending))
    deflection = beam.line_load * beam.decay / (2.0 * beam.foundation)
    assert deflection == pytest.approx(0.2)
    carried, _ = quad(lambda z: float(beam.pressure_at(np.array(np.arccos(z / 1.2)))), -beam.half_length,
                      beam.half_length)  # fmt: skip
    assert carried == pytest.approx(beam.line_load, rel=1e-6)  # Hertz carries the whole load
    # a β is 4.6 at the published size, which the point load does not bear out.
    at_headline = sp.solve(case(1.19)).contact
    assert at_headline.half_length * at_headline.decay == pytest.approx(4.6, abs=0.1)


def test_friction_is_the_integral_of_the_contact_pressure():
    """F_re(x) = 2π μ R_s ∫ σ dz over what is closed (Eq. 26)."""
    beam = sp.solve(case(1.2)).contact
    for share in (0.9, 0.3, -0.4):
        y = share * beam.half_length
        force, _ = quad(lambda z: float(beam.pressure_at(np.array(np.arccos(z / 1.2)))),
                        -beam.half_length, y)  # fmt: skip
        expected = 2.0 * np.pi * 0.5 * 1.2 * force
        assert float(beam.friction(y)) == pytest.approx(expected, rel=1e-6)


def test_urine_pressure_is_that_of_eq_28_as_printed():
    beam, xi = sp.solve(case(1.2)).contact, 1.2
    a = beam.half_length
    y = np.linspace(0.0, a, 7)
    root = np.sqrt(1.0 - (y / xi) ** 2) - 1.0
    first = np.sqrt(1.0 - (a / xi) ** 2) - 1.0
    r_a = np.sqrt(xi**2 - y**2) + root * (1.0 - np.sqrt(xi**2 - a**2)) / first
    np.testing.assert_allclose(beam.urine_pressure(y), beam.foundation * (r_a - 1.0), atol=1e-6)


@pytest.mark.parametrize(
    ("mu", "size"), [(0.1, 1.363), (0.3, 1.252), (0.5, 1.193), (0.8, 1.147), (1.0, 1.129)]
)
def test_critical_size_over_friction(mu, size):
    # Origin: evidence.md section 4, the same equations evaluated independently.
    method = asking(model="beam", **PUBLISHED)
    found = sp.critical_size(sp.Ureter(wall_ratio=1.3), "12 kPa", mu, **method)
    assert found.size_ratio == pytest.approx(size, abs=6e-4)


@pytest.mark.parametrize(("factor", "size"), [(0.5, 1.330), (2.0, 1.106), (4.0, 1.056)])
def test_critical_size_over_stiffness(factor, size):
    # Origin: evidence.md section 4; both moduli scaled.
    method = asking(model="beam", circumferential_modulus=f"{0.465 * factor} MPa",
                       longitudinal_modulus=f"{0.02 * factor} MPa")  # fmt: skip
    found = sp.critical_size(sp.Ureter(wall_ratio=1.3), "12 kPa", 0.5, **method)
    assert found.size_ratio == pytest.approx(size, abs=6e-4)


def test_pressure_scales_with_the_moduli_and_vanishes_without_friction():
    stiff = {"circumferential_modulus": "3.255 MPa", "longitudinal_modulus": "0.14 MPa"}
    assert sp.solve(case(**stiff)).pressure == pytest.approx(7.0 * sp.solve(case()).pressure)
    assert sp.solve(case(mu=0.0)).pressure == pytest.approx(0.0, abs=1e-9)
    assert sp.solve(case(0.99)).outcome is Outcome.LOOSE


def test_a_contact_as_long_as_the_stone_is_no_contact_of_this_model():
    question = case()
    bound = question.model.largest_size(question)
    assert bound == pytest.approx(1.4226, abs=1e-3)  # c (ξ - 1) = ξ, c = 3.366
    assert sp.solve(case(bound - 1e-6)).outcome is Outcome.MOVES
    answer = sp.solve(case(bound + 1e-6))
    assert answer.outcome is Outcome.NO_SOLUTION
    assert "not less than the radius of the stone" in answer.message
    method = asking(model="beam", **PUBLISHED)
    never = sp.critical_size(sp.Ureter(wall_ratio=1.3), "60 kPa", 0.5, **method)
    assert never.outcome is Outcome.BEYOND_RANGE
    assert "the range of sizes of the model 'beam'" in never.message


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"shape": sp.Shape(1.2)}, "shape of the stone is not a sphere, but must be a sphere"),
        ({"eta": 1.6}, "wall ratio is 1.6, but must be at most 1.5"),
        ({"load": sp.Load("2 kPa")}, "confining pressure is 2 kPa, but must be none"),
        ({"load": sp.Load(prestretch=1.1)}, "prestretch is 1.1, but must be 1"),
    ],
)
def test_it_refuses_where_it_does_not_hold(given, sentence):
    with pytest.raises(BadInput) as refused:
        sp.solve(case(**given))
    assert sentence in str(refused.value)
    assert "use the paper's or the direct model" in str(refused.value)


@pytest.mark.parametrize(
    ("method", "sentence"),
    [
        ({"model": "beam"}, "circumferential_modulus is missing, but must be given; or give a"),
        (
            {"model": "beam", "circumferential_modulus": "1 MPa"},
            "longitudinal_modulus is missing",
        ),
        (
            {"model": "beam", **PUBLISHED, "secant_stretch": 1.2},
            "secant_stretch cannot be used with a modulus; give both moduli, or the stretch",
        ),
        ({"model": "beam", "secant_stretch": 3.0}, "secant_stretch is 3.0, but must be a number"),
        (
            {"model": "beam", **PUBLISHED, "longitudinal_modulus": "1 mm"},
            "longitudinal_modulus is 1 mm, but must be a pressure",
        ),
        (
            {"model": "beam", **PUBLISHED, "longitudinal_modulus": "1 Pa"},
            "longitudinal_modulus is 1 Pa, but must be 0.1 kPa to 10 GPa",
        ),
    ],
)
def test_moduli_are_asked_for_where_they_are_needed(method, sentence):
    with pytest.raises(BadInput) as refused:
        asking(**method)
    assert sentence in str(refused.value)


def test_secants_of_a_law():
    # Neo-Hookean, plane strain, both directions alike: 2 C₁₀ (λ − λ⁻³)/(λ − 1), 8 C₁₀ at rest.
    latex = CATALOGUE["latex"].law
    expected = 2.0 * 0.1465e6 * (1.3 - 1.3**-3) / 0.3
    assert secant_moduli(latex, 1.3) == pytest.approx((expected, expected), rel=1e-12)
    assert secant_moduli(latex, 1.001)[0] == pytest.approx(8 * 0.1465e6, rel=5e-3)
    # The published E1 is that of the Fung law near the end of the paper's range of sizes.
    fibres = CATALOGUE["ureter"].law.fibres
    assert secant_moduli(fibres, 1.297)[0] == pytest.approx(0.465e6, rel=1e-3)
    with pytest.raises(BadInput, match="secant stretch"):
        secant_moduli(latex, 1.0)
    by_law = sp.solve(case(1.1, secant_stretch=1.297))
    hoop, axial = secant_moduli(fibres, 1.297)
    assert (by_law.contact.circumferential_modulus, by_law.contact.longitudinal_modulus) == (
        hoop,
        axial,
    )


def test_the_command_loads_no_finite_elements(tmp_path):
    """pressure, size and curve, as a real process; pictures too."""
    common = "--eta 1.3 --model beam --E1 0.465MPa --E2 0.02MPa"
    probe = (
        "import sys; from stonepass.cli import run\n"
        f"codes = [run('pressure --xi 1.2 {common} --json'.split()),\n"
        f"run('pressure --xi 1.2 {common} --figure {tmp_path}/b.png --save {tmp_path}/b.toml "
        f"--profile {tmp_path}/b.csv'.split()),\n"
        f"run('pressure {tmp_path}/b.toml --json'.split()),\n"
        f"run('size {common} --limit 12kPa --json'.split()),\n"
        f"run('curve {common} --xi 1:1.3:0.1 --json'.split())]\n"
        "print(codes, 'ngsolve' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[0, 0, 0, 0, 0] False"
    record = json.loads(done.stdout[: done.stdout.index("\n}") + 2])
    assert record["model"] == "beam"
    assert record["critical_pressure_kPa"] == pytest.approx(12.495, rel=1e-4)
    assert record["detail"]["half_contact_length"] == pytest.approx(0.8988, rel=1e-3)
    assert record["stability_margin"] is None
    assert (tmp_path / "b.png").stat().st_size > 10_000
    assert "circumferential_modulus" in (tmp_path / "b.toml").read_text()


@pytest.mark.parametrize("over", [2.2e-16, 1e-14, 1e-8])
@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_a_contact_too_narrow_to_be_resolved_has_no_answer(over, friction):
    """The closure divides by 1 − sin α₀, which rounds to 0 for a stone hardly above the lumen."""
    stone = sp.Stone(size_ratio=1.0 + over, friction=friction)
    model = sp.ElasticFoundation(circumferential_modulus="100 Pa", longitudinal_modulus="10 GPa")
    found = sp.solve(sp.Case(stone, sp.Ureter(wall_ratio=1.02), model=model))
    assert found.outcome is Outcome.NO_SOLUTION
    assert "too small beside the radius of the stone" in found.reason
