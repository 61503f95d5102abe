"""Far field: exact answers first."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from stonepass.materials.catalogue import material
from stonepass.materials.fung import Fung
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.far_field import (
    confining_traction,
    inflation,
    inflation_by_quadrature,
    lumen_ratio,
    urine_pressure,
)
from stonepass.model.load import Load

FUNG = material("ureter").law.fibres


@given(st.floats(0.7, 1.8), st.floats(1.02, 10.0))
@settings(max_examples=60, deadline=None)
def test_quadrature_meets_eq_20(ratio, eta):
    law = NeoHookean(1.0)
    exact = float(law.inflation_pressure(np.array(ratio), eta))
    assert float(inflation_by_quadrature(np.array(ratio), eta, law)) == pytest.approx(
        exact, rel=1e-12, abs=1e-14
    )


@given(st.floats(0.8, 1.5), st.floats(1.02, 10.0))
@settings(max_examples=60, deadline=None)
def test_quadrature_meets_corrected_eq_22(ratio, eta):
    law = Fung(1.0, 0.7091, 0.8892, 0.1856, 0.02)
    exact = float(law.inflation_pressure(np.array(ratio), eta))
    assert float(inflation_by_quadrature(np.array(ratio), eta, law)) == pytest.approx(
        exact, rel=1e-12, abs=1e-14
    )


# Origin: P_u(r_a = ξ R_a) of the corrected Eq. 22, evaluated independently of this package.
@pytest.mark.parametrize(
    ("eta", "values"),
    [
        (1.3, {1.05: 3.013, 1.11: 6.856, 1.15: 9.581, 1.2: 13.207, 1.22: 14.736, 1.3: 21.396}),
        (3.4, {1.05: 6.737, 1.11: 15.298, 1.15: 21.326, 1.2: 29.266, 1.22: 32.580, 1.3: 46.752}),
    ],
)
def test_published_wall_in_numbers(eta, values):
    for ratio, kilopascals in values.items():
        assert float(inflation(np.array(ratio), eta, FUNG)) / 1e3 == pytest.approx(
            kilopascals, abs=6e-4
        )


def test_lame_limit():
    # Incompressible plane strain: u_a/R_a = P / (2 μ (1 − 1/η²)), μ = 2 C₁₀.
    u, eta, C10 = 1e-7, 1.7, 3.0
    expected = 2.0 * (2.0 * C10) * (1.0 - 1.0 / eta**2) * u
    found = float(inflation_by_quadrature(np.array(1.0 + u), eta, NeoHookean(C10)))
    assert found == pytest.approx(expected, rel=1e-5)


def test_thin_wall_limit():
    # Laplace: P = t σ_tt / r_a with t the deformed thickness, σ_tt from w′ at λ (σ_rr ≈ 0).
    eta, ratio = 1.0 + 1e-6, 1.2
    stress = 2.0 * (ratio**2 - 1.0 / ratio**2)  # neo-Hookean, 2 C₁₀ (λ² − λ⁻²), C₁₀ = 1
    thickness = (eta - 1.0) / ratio
    found = float(inflation_by_quadrature(np.array(ratio), eta, NeoHookean(1.0)))
    assert found == pytest.approx(stress * thickness / ratio, rel=1e-5)


@pytest.mark.parametrize("axial", [0.9, 1.1, 1.3])
def test_stretched_rubber_rests_at_the_isochoric_radius(axial):
    # Isotropic and incompressible: at no pressure every radius shrinks by 1/√λ_z.
    rest = np.array(1.0 / np.sqrt(axial))
    assert float(inflation(rest, 1.5, NeoHookean(1.0), axial)) == pytest.approx(0.0, abs=1e-13)
    load = Load(prestretch=axial)
    assert lumen_ratio(1.5, NeoHookean(1.0), load) == pytest.approx(float(rest), rel=1e-12)


def test_stretched_rubber_by_an_independent_integral():
    # dP = (σ_tt − σ_rr) dr/r over the deformed wall, trapezoidal rule on 2·10⁵ intervals.
    law, eta, axial, ratio = NeoHookean(1.0), 2.0, 1.2, 1.1
    r = np.linspace(ratio, np.sqrt(ratio**2 + (eta**2 - 1.0) / axial), 200_001)
    R = np.sqrt(1.0 + axial * (r**2 - ratio**2))
    hoop = r / R
    integrand = 2.0 * (hoop**2 - 1.0 / (hoop * axial) ** 2) / r
    expected = float(((integrand[1:] + integrand[:-1]) / 2.0 * np.diff(r)).sum())
    assert float(inflation(np.array(ratio), eta, law, axial)) == pytest.approx(expected, rel=1e-9)


def test_dead_load_keeps_its_resultant():
    # p_out r_b λ_z = P_out R_b at every radius (Eq. 10); hydrostatic keeps p_out = P_out.
    eta, load = 1.6, Load("8 kPa", "dead", 1.1)
    for ratio in (0.95, 1.0, 1.2):
        outer = np.sqrt(ratio**2 + (eta**2 - 1.0) / 1.1)
        traction = float(confining_traction(np.array(ratio), eta, load))
        assert traction * outer * 1.1 == pytest.approx(8e3 * eta, rel=1e-14)
    bath = Load("8 kPa", "hydrostatic")
    assert float(confining_traction(np.array(1.2), eta, bath)) == 8e3


@pytest.mark.parametrize("confinement", ["dead", "hydrostatic"])
def test_the_lumen_is_where_no_urine_pressure_is_needed(confinement):
    load = Load("6 kPa", confinement)
    lumen = lumen_ratio(1.3, FUNG, load)
    assert lumen is not None
    assert 0.5 < lumen < 1.0
    assert float(urine_pressure(np.array(lumen), 1.3, FUNG, load)) == pytest.approx(0.0, abs=1e-6)


def test_a_load_that_closes_the_lumen_is_told():
    # Rubber of 1 Pa under 100 kPa has no open lumen.
    assert lumen_ratio(1.3, NeoHookean(1.0), Load("100 kPa", "hydrostatic")) is None


@given(st.floats(1e-3, 1e9))
@settings(max_examples=20, deadline=None)
def test_pressure_scales_with_stiffness(factor):
    one = float(inflation_by_quadrature(np.array(1.2), 1.5, NeoHookean(1.0)))
    many = float(inflation_by_quadrature(np.array(1.2), 1.5, NeoHookean(factor)))
    assert many == pytest.approx(factor * one, rel=1e-13)
