"""Strong ellipticity against finite differences of the energy, and the solved state's margin."""

from dataclasses import dataclass

import numpy as np
import pytest

import stonepass as sp
from stonepass.fe.axisymmetric.buckling import buckling_half_wave
from stonepass.materials.catalogue import CATALOGUE, material
from stonepass.materials.ellipticity import shear_stiffness, spatial_moduli, weakest
from stonepass.materials.fung import Fung
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.far_field import lumen_ratio
from stonepass.model.states.nondimensional import tube_of
from stonepass.model.states.stability import axisymmetric_buckling
from stonepass.model.validity import ring_buckling
from stonepass.strain import INNER_WALL, CauchyGreen, Place

REST = np.array([[1.0, 0.0, 0.0, 1.0, 1.0]])


def tensor(F):
    return np.array([[F[0], 0.0, F[1]], [0.0, F[4], 0.0], [F[2], 0.0, F[3]]])


def stiffness_across(law, F, n):
    """(smallest d²U/dε², its direction) at one deformation F for one normal n."""
    moduli = spatial_moduli(law, F[None], INNER_WALL)
    values, directions = shear_stiffness(*moduli, np.asarray(n)[None, None])
    return values[0, 0], directions[0, 0]


def second_derivative(law, F, n, m, h=1e-4):
    """d²U/dε² of U((1 + ε m⊗n) F) by central differences."""

    def energy(e):
        G = (np.eye(3) + e * np.outer(m, n)) @ tensor(F)
        C = G.T @ G
        return law.energy(
            CauchyGreen(C[0, 0], C[1, 1], C[2, 2], C[0, 2], C[0, 1], C[1, 2]), INNER_WALL, np
        )

    return (energy(h) - 2.0 * energy(0.0) + energy(-h)) / h**2


@pytest.mark.parametrize("name", CATALOGUE)
def test_shear_stiffness_against_finite_differences(name):
    law, random = CATALOGUE[name].law, np.random.default_rng(3)
    F = np.array([0.9, 0.1, -0.05, 1.05, 1.0 / (0.9 * 1.05 + 0.005)])
    for _ in range(10):
        n = random.normal(size=3)
        n /= np.linalg.norm(n)
        value, m = stiffness_across(law, F, n)
        assert m @ n == pytest.approx(0.0, abs=1e-12)
        scale = abs(value) + 1e4
        assert second_derivative(law, F, n, m) == pytest.approx(value, abs=1e-4 * scale)
        other = np.cross(n, m)
        for turn in np.linspace(0.0, np.pi, 13):
            trial = np.cos(turn) * m + np.sin(turn) * other
            assert second_derivative(law, F, n, trial) >= value - 1e-4 * scale


def test_rest_is_the_unit():
    # Unloaded, the softest plane has the shear modulus itself: rubber in all, Fung in its matrix.
    for law in (NeoHookean(1.0), material("ureter").law):
        assert weakest(law, REST, INNER_WALL).stiffness == pytest.approx(1.0, rel=1e-6)


def test_rubber_by_hand():
    # U = μ/2 tr C: d²U/dε² = μ |Fᵀn|², smallest along the shortest stretch: 0.5² = 0.25.
    F = np.array([[0.5, 0.0, 0.0, 1.0, 2.0]])
    found = weakest(NeoHookean(1.0), F, INNER_WALL)
    assert found.stiffness == pytest.approx(0.25, rel=1e-3)
    assert abs(found.normal[0]) == pytest.approx(1.0, abs=1e-2)


@dataclass(frozen=True)
class OneFamily:
    """Rubber with fibres at an angle to the circumference, on one side only."""

    angle: float

    def energy(self, C, place, xp):
        c, s = np.cos(self.angle), np.sin(self.angle)
        over = c * c * C.tt + s * s * C.zz + 2.0 * c * s * C.tz - 1.0
        return 30e3 * (C.I1 - 3.0) + 20e3 * over**2 - 40e3 * over**3


def test_mirror_images_have_the_same_margin():
    """One family of fibres has no mirror plane along the tube, so that all directions count."""
    t, z = np.meshgrid(np.linspace(1.0, 1.3, 4), np.linspace(0.95, 1.1, 4))
    t, z = t.ravel(), z.ravel()
    F = np.column_stack([1.0 / (t * z), 0.0 * t, 0.0 * t, z, t])
    place = Place(np.full(len(t), 1.2))
    found = [weakest(OneFamily(sign * np.radians(40.0)), F, place) for sign in (1.0, -1.0)]
    assert found[0].stiffness < 0.0
    assert found[1].stiffness == pytest.approx(found[0].stiffness, rel=1e-6)
    # The wall and the fibres are symmetric in r, so n_r may have either sign.
    (r, t, z), (r2, t2, z2) = (each.normal for each in found)
    assert abs(r) == pytest.approx(abs(r2), abs=1e-4)
    assert t * z == pytest.approx(-t2 * z2, abs=1e-4)
    assert t * z > 0.1


def test_axial_compression_of_the_fibres_loses_ellipticity_at_minus_g():
    """Uniform axial stretch: ∂U/∂E_zz + G is the stiffness of the kinking shear m = r, n = z."""
    G = 1e4
    law = Fung(0.4056e6, 0.7091, 0.8892, 0.1856, G)
    stiffness = []
    for axial in (1.0, 0.99, 0.97, 0.95):
        radial = 1.0 / np.sqrt(axial)
        F = np.array([radial, 0.0, 0.0, axial, radial])
        value, _ = stiffness_across(law, F, [0.0, 0.0, 1.0])
        E_zz, E_tt = (axial**2 - 1.0) / 2.0, (radial**2 - 1.0) / 2.0
        Q = law.a1111 * E_tt**2 + law.a2222 * E_zz**2 + 2.0 * law.a1122 * E_tt * E_zz
        fibre = law.C * np.exp(Q) * (law.a2222 * E_zz + law.a1122 * E_tt)
        assert value == pytest.approx((fibre + G) * axial**2, rel=1e-9)
        stiffness.append(value)
    assert stiffness[0] > 0.0 > stiffness[-1]  # lost between strains 0 and −0.05


def test_the_solved_state_reports_its_margin_and_where():
    thin = sp.seat(sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3)))
    assert 0.0 < thin.stability.margin < 1.0
    R, Z = thin.stability.weakest_at
    assert 1.0 <= R <= 1.3
    assert 0.0 <= Z <= 3.0
    assert thin.warnings() == []


def test_confining_pressure_brings_warnings_that_say_where():
    case = sp.Case(
        sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3), sp.Load("5 kPa"),
        model=sp.SeatedBalance("frictionless"), numerics=sp.Numerics("fast"),
    )  # fmt: skip
    sentences = [str(each) for each in sp.solve(case).warnings]
    unstable = next(s for s in sentences if "not stable" in s)
    folding = next(s for s in sentences if "may fold" in s)
    for sentence in (unstable, folding):
        assert "R = " in sentence
        assert "Z = " in sentence
    assert "margin -" in unstable


def test_folding_is_told_by_hand():
    # Latex η 1.15: h/R_m = 0.15/1.075, w″(1) = 8 · 0.1465 MPa: 1.172e6 · 0.13953³/4 = 796 Pa.
    def sentences(kilopascals):
        ureter = sp.Ureter(wall_ratio=1.15, material="latex")
        load = sp.Load(f"{kilopascals} kPa", "hydrostatic")
        return ring_buckling(sp.Case(sp.Stone(size_ratio=1.1), ureter, load))

    assert sentences(0.79) == []
    assert "0.8 kPa" in str(sentences(0.81)[0])


def test_a_thin_shell_wrinkles_where_shell_theory_says():
    """Axial shortening e of a thin neo-Hookean tube: waves from e = (2/3) h/R_m on.

    A strip of the shell is a beam of stiffness D = E h³/9 on a foundation k = E h/R_m², so the
    axial stress is 2 √(k D)/h = (2/3) E h/R_m, and the half-wave π (D/k)^¼ = π √(h R_m/3).
    Incompressible, E = 6 C₁₀; at η = 1.02 that is e = 1.32 %, half-wave 0.258.
    """
    e = 2.0 / 3.0 * 0.02 / 1.01

    def wave(shortening):
        load = sp.Load(prestretch=1.0 - shortening)
        law = NeoHookean(1e5)
        return buckling_half_wave(tube_of(law, 1.02, load, 10.0), lumen_ratio(1.02, law, load))

    assert wave(0.93 * e) is None
    length = wave(1.1 * e)
    assert 0.258 / 1.3 < length < 0.258 * 1.3  # lengths are tried in steps


def test_a_tube_that_wrinkles_by_itself_has_no_seated_state():
    ureter = sp.Ureter(wall_ratio=1.07, material="latex")
    answer = sp.solve(sp.Case(sp.Stone(size_ratio=1.1), ureter, sp.Load("9.8 kPa", "hydrostatic")))
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "even without a stone it buckles axisymmetrically" in answer.message
    held = sp.Case(sp.Stone(size_ratio=1.1), ureter, sp.Load("2 kPa", "hydrostatic"))
    assert axisymmetric_buckling(held, 10.0) == ""
    assert axisymmetric_buckling(sp.Case(sp.Stone(size_ratio=1.1), ureter), 10.0) == ""
