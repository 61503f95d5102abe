"""The seated state: energy balance, agreement of two stresses, scaling, symmetry of the readout."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.fe.axisymmetric.balances import stored_energy
from stonepass.fe.axisymmetric.postprocessing import contact_profile
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.case import Case
from stonepass.model.case_states import seat
from stonepass.model.far_field import lumen_ratio
from stonepass.model.load import Load
from stonepass.model.numerics import Numerics
from stonepass.model.shape import Shape
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of, tube_of
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

FRICTIONLESS = asking(seating="frictionless")
LATEX = Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.5, material="latex"), **FRICTIONLESS)


@pytest.fixture(scope="module")
def latex():
    state = seat(LATEX)
    assert isinstance(state, SeatedState)
    return state


BLUNT, EGG = Shape(1.2, (0.95, 0.0, 0.0, 0.0, 0.05)), Shape(1.3, (1.01, 0.12, 0.01, 0.04))


def fitted(case):
    law = case.ureter.material.law
    tube = tube_of(law, case.wall_ratio, case.load, case.numerics.half_length)
    guess = partial(wrap_round_arc, case, case.numerics.half_length, 1.0, hoop_modulus(law))
    return seat_on_stone(tube, profile_of(case), guess)[0]


@pytest.mark.parametrize(
    ("material", "eta", "xi", "shape"),
    [
        ("latex", 1.5, 1.2, Shape()),
        ("ureter", 1.3, 1.2, Shape()),
        ("ureter", 3.4, 1.1, Shape()),
        ("latex", 1.5, 1.2, Shape(0.6)),
        ("latex", 1.5, 1.2, Shape(1.8)),
        ("latex", 1.5, 1.2, BLUNT),
        ("latex", 1.5, 1.2, EGG),
    ],
)
def test_contact_force_is_the_slope_of_the_energy(material, eta, xi, shape):
    """Growing the stone by dR does the work ∫ σ x·n dA dR/R; nothing else moves (ends held).

    On the meridian x·n ds = ρ dz − z dρ; of a sphere ∫ σ dA = 2π ξ² ∫ σ sin θ dθ. A half is solved
    where the stone has a mirror image. An error in the contact pressure or its area would show
    here, since the energy does not know of the multiplier.
    """
    case = Case(Stone(size_ratio=xi, shape=shape), Ureter(wall_ratio=eta, material=material))
    h = 2e-3
    up, down = (stored_energy(fitted(case.with_size_ratio(xi + s * h))) for s in (1, -1))
    profile = contact_profile(fitted(case))
    (rho, z), (rho_slope, z_slope) = shape.meridian(profile.theta), shape.slopes(profile.theta)
    integrand = profile.pressure * rho * (rho * z_slope - z * rho_slope)
    force = 2 * np.pi * xi**2 * np.trapezoid(integrand, profile.theta)
    halves = 2.0 if shape.symmetric else 1.0
    assert halves * (up - down) / (2 * h) == pytest.approx(force, rel=2e-4)


def test_multiplier_and_wall_stress_agree_at_the_equator(latex):
    at = np.argmin(np.abs(latex.wall.R - 1.0) + np.abs(latex.wall.Z))
    assert (latex.wall.R.flat[at], latex.wall.Z.flat[at]) == (1.0, 0.0)
    compression = -latex.wall.stress_rr.flat[at]
    assert compression == pytest.approx(latex.equator_contact_pressure, rel=1e-4)


def test_volume_is_kept(latex):
    assert abs(latex.solver.volume.wall) <= 1e-8
    assert latex.solver.volume.rms <= 2e-4


def test_latex_reference(latex):
    # Origin: limit of the refinement table in docs/verification.md (order 6, 29,521 unknowns).
    assert np.degrees(latex.contact_angle) == pytest.approx(71.93295, abs=0.05)
    assert latex.equator_contact_pressure == pytest.approx(91620.4, rel=2e-3)


def test_wall_lies_on_the_stone_and_never_inside(latex):
    inner = latex.wall.R == 1.0
    distance = np.hypot(latex.wall.r[inner], latex.wall.z[inner])
    assert distance.min() >= 1.2 - 1e-7
    angle = np.arctan2(latex.wall.r[inner], latex.wall.z[inner])
    touching = angle >= latex.contact_angle
    assert touching.sum() > 30
    np.testing.assert_allclose(distance[touching], 1.2, rtol=1e-9)


def test_traction_vanishes_on_the_outer_wall(latex):
    """At Z = 0 the outer wall's normal is radial, so σ_rr itself vanishes there."""
    at = np.argmin(np.abs(latex.wall.R - 1.5) + np.abs(latex.wall.Z))
    assert np.abs(latex.wall.stress_rr.flat[at]) < 1e-3 * latex.equator_contact_pressure


def test_profile_is_symmetric_and_zero_outside_contact(latex):
    theta = np.linspace(0.0, np.pi, 1801)
    sigma = latex.pressure_at(theta)
    np.testing.assert_allclose(sigma, sigma[::-1], atol=1e-8 * sigma.max())
    assert np.all(sigma[theta < latex.contact_angle] == 0.0)
    equator = latex.pressure_at(np.array([np.pi / 2]))[0]
    assert equator == pytest.approx(latex.equator_contact_pressure, rel=1e-9)


def test_contact_pressure_scales_with_stiffness():
    soft = seat(LATEX)
    wall = sp.Material("stiff", NeoHookean(37.0 * 0.1465e6), "", "", "", (1.0, 1.5))
    stiff = seat(Case(LATEX.stone, Ureter(wall_ratio=1.5, material=wall), **FRICTIONLESS))
    np.testing.assert_allclose(
        stiff.contact_pressure, 37.0 * soft.contact_pressure, rtol=1e-9, atol=1e-3
    )
    assert stiff.contact_angle == pytest.approx(soft.contact_angle, rel=1e-12)


def test_error_of_the_contact_angle_falls_with_the_edge_elements():
    # The edge condition is exact up to the size of the elements beside it: first order in `edge`.
    angles = [
        seat(LATEX, Resolution(edge=edge)).contact_angle for edge in (0.08, 0.04, 0.02, 0.0025)
    ]
    errors = np.abs(np.array(angles[:3]) - angles[3])
    rates = np.log2(errors[:-1] / errors[1:])
    assert np.all(rates > 0.8), rates


def test_far_from_the_stone_the_wall_is_the_far_field():
    """Under load and pre-stretch the lumen far away is that of section 3 at the local stretch."""
    load = Load("6 kPa", "hydrostatic", prestretch=1.05)
    method = asking(half_length=20.0, seating="frictionless")
    case = Case(Stone(size_ratio=1.1), Ureter(wall_ratio=1.5, material="latex"), load, **method)
    wall = seat(case).wall
    inner = (wall.R == 1.0) & (wall.Z > 8.0) & (wall.Z < 19.0)
    order = np.argsort(wall.Z[inner])
    Z, z, r = (values[inner][order] for values in (wall.Z, wall.z, wall.r))
    stretch = (z[-1] - z[0]) / (Z[-1] - Z[0])
    local = Load("6 kPa", "hydrostatic", prestretch=float(stretch))
    expected = lumen_ratio(1.5, case.ureter.material.law, local)
    np.testing.assert_allclose(r, expected, rtol=5e-5)


def test_a_loaded_tube_is_solved_in_a_few_steps_at_every_level():
    """A coarse mesh of a stable wall must not be unstable: neither detours nor a lost estimate."""
    load = Load("1 kPa")
    answer = sp.solve(replace(LATEX, load=load))
    assert answer.newton_steps < 20
    assert answer.error.critical_pressure < 1e-3 * answer.pressure


def test_axial_compression_of_the_ureter_is_named_not_hidden():
    case = Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.3), Load(prestretch=0.85))
    state = seat(case)
    assert isinstance(state, NoSeat)
    assert state.reason


def test_a_loose_stone_is_not_seated():
    with pytest.raises(sp.BadInput, match="larger than the lumen"):
        seat(LATEX.with_size_ratio(0.99))


@pytest.mark.parametrize("seating", ["frictionless", "pressed", "growing"])
def test_a_spheroid_of_aspect_one_is_the_sphere(seating):
    """The general formulas at aspect 1 + 1e-9 against the sphere's own."""

    def solved(aspect):
        stone = Stone(size_ratio=1.2, friction=0.4, aspect=aspect)
        return sp.solve(Case(stone, Ureter(wall_ratio=1.5, material="latex"),
                          **asking(seating=seating, accuracy="fast")))  # fmt: skip

    sphere, nearly = solved(1.0), solved(1.0 + 1e-9)
    assert nearly.pressure == pytest.approx(sphere.pressure, rel=1e-7)
    assert nearly.contact.contact_angle == pytest.approx(sphere.contact.contact_angle, abs=1e-7)
    np.testing.assert_allclose(
        nearly.contact.contact_pressure, sphere.contact.contact_pressure, rtol=1e-5, atol=1.0
    )


@pytest.mark.parametrize("aspect", [0.5, 1.4, 2.0])
def test_a_spheroid_is_seated_in_balance_and_its_wall_lies_on_it(aspect):
    stone = Stone(size_ratio=1.2, friction=0.4, aspect=aspect)
    state = seat(Case(stone, Ureter(wall_ratio=1.3)), Numerics().resolution)
    assert isinstance(state, SeatedState)
    assert state.solver.axial_balance < 5e-3
    assert state.solver.cone_excess < 1e-6
    inner = state.wall.R == 1.0
    r, z = state.wall.r[inner] / 1.2, state.wall.z[inner] / (1.2 * aspect)
    closed = z < np.cos(state.contact_angle) * (1.0 - 1e-9)
    np.testing.assert_allclose(np.hypot(r, z)[closed], 1.0, atol=1e-6)
    assert np.hypot(r, z)[~closed].min() > 1.0 - 1e-6


def test_stone_barely_larger_than_a_stretched_lumen():
    """The internal forces of the stretched wall are far larger than the contact force.

    Their rounding exceeds 1e-9 of the contact force, which alone was the tolerance once. The
    contact is narrow against the wall's thickness, so by Hertz its pressure is proportional to its
    width, and thus to the square root of the opening.
    """
    load, coarse = Load(prestretch=1.155), Numerics(half_length=17.0, accuracy="fast")
    tube = Ureter(wall_ratio=2.109, material="latex")
    lumen = lumen_ratio(tube.wall_ratio, tube.material.law, load)
    assert lumen is not None
    pressures = []
    for opening in (5e-4, 1e-3):
        stone = Stone(size_ratio=lumen * (1.0 + opening), friction=0.18)
        state = seat(Case(stone, tube, load, FRICTIONLESS["model"], coarse))
        assert isinstance(state, SeatedState)
        pressures.append(state.equator_contact_pressure)
    assert pressures[1] / pressures[0] == pytest.approx(2.0**0.5, rel=0.05)
