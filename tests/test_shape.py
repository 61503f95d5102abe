"""Stones that are no spheres: their meridian, their files, and what the model makes of them."""

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.errors import BadInput, Outcome
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.inputs.case_file import read_case, write_case
from stonepass.model.accuracy import LEVELS
from stonepass.model.case_states import push_through
from stonepass.model.energy_balance import advance_force, strained_force
from stonepass.model.shape import Shape
from stonepass.model.states.loaded_state import PushedState

FAST = LEVELS["fast"].resolution
TAU = np.linspace(0.0, np.pi, 41)
# Blunt: a fifth of the curvature at the poles and the equator that a spheroid has there.
BLUNT = Shape(1.2, (0.95, 0.0, 0.0, 0.0, 0.05))
EGG = Shape(1.3, (1.01, 0.12, 0.01, 0.04))  # sharper upstream


def egg(points=41, sharp=0.3):
    """z² /1.69 + ρ² (1 + sharp z/1.3) = 1."""
    tau = np.linspace(0.0, np.pi, points)
    z = -np.cos(tau)
    return 1.3 * z, np.sin(tau) / np.sqrt(1.0 + sharp * z)


def case(shape, material="latex", eta=1.5, xi=1.2, mu=0.0, load=None, **method):
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=mu, shape=shape),
        sp.Ureter(wall_ratio=eta, material=material),
        load or sp.Load(),
        **asking(**method),
    )


def from_pole(shape, theta):
    """ρ at equal distances from the upstream pole, over half the length."""
    rho, z = shape.meridian(theta)
    share = (z - z[0]) / (z[-1] - z[0])
    return np.interp(np.linspace(0.05, 0.95, 91), share, rho) / shape.aspect


def test_an_outline_by_hand():
    # g = 1 + 0.1 cos 2τ + 0.1: at the pole 1.2, at the equator 1, so the half-length is 1.5/1.2.
    shape = Shape(1.5, (1.1, 0.0, 0.1))
    rho, z = shape.meridian(np.array([0.0, np.pi / 2, np.pi]))
    np.testing.assert_allclose(rho, [0.0, 1.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(z, [-1.25, 0.0, 1.25], atol=1e-15)
    assert shape.reach == shape.length == pytest.approx(1.25)
    assert shape.symmetric
    assert not shape.spheroidal
    assert Shape(1.5).spheroidal
    assert not EGG.symmetric
    assert EGG.turned().turned() == EGG
    there, back = EGG.meridian(TAU), EGG.turned().meridian(np.pi - TAU)
    np.testing.assert_allclose(there, [back[0], -back[1]], atol=1e-14)


@pytest.mark.parametrize("shape", [Shape(0.6), BLUNT, EGG])
def test_a_meridian_and_its_slopes(shape):
    tau, h = TAU[1:-1], 1e-6
    ahead, behind = (np.array(shape.meridian(tau + s * h)) for s in (1.0, -1.0))
    np.testing.assert_allclose(shape.slopes(tau), (ahead - behind) / (2 * h), atol=1e-8)
    stone = Profile(1.3, shape.aspect, -0.2, shape.outline)
    rho, z = (1.3 * x for x in shape.meridian(tau))
    np.testing.assert_allclose(stone.gap(rho - 0.2, z), 0.0, atol=1e-14)
    normal = np.array(stone.normal(rho - 0.2, z))
    np.testing.assert_allclose((normal * shape.slopes(tau)).sum(axis=0), 0.0, atol=1e-13)
    # Arc length: its slope along the meridian is the speed.
    along = stone.along(rho - 0.2, z)
    middle = np.hypot(*shape.slopes((tau[1:] + tau[:-1]) / 2.0))
    np.testing.assert_allclose(np.diff(along) / np.diff(tau), middle, rtol=2e-3)
    assert stone.along(1.1, 0.0) == 0.0


@pytest.mark.parametrize(
    ("aspect", "outline", "sentence"),
    [
        (3.0, (1.0,), "aspect is 3.0, but must be a number from 0.5 to 2"),
        (1.8, (0.9, 0.0, -0.1), "aspect is 2.25, but must be a number from 0.5 to 2"),
        (1.0, (), "outline of the stone is empty"),
        (0.0, (1.0,), "aspect is 0.0, but must be a number above zero"),
        (1.0, (0.9,), "outline of the stone is g = 0.9 with slope 0 at θ = 90°"),
        (1.0, (1.0, 0.2), "outline of the stone is g = 1 with slope -0.2 at θ = 90°"),
        (1.0, (float("nan"),), "outline of the stone is g = nan"),
        (1.0, (0.8, 0.0, 0.0, 0.0, 0.2), "shape of the stone is dented at θ = 0°"),
    ],
)
def test_what_is_no_convex_outline_is_refused(aspect, outline, sentence):
    with pytest.raises(BadInput) as refused:
        Shape(aspect, outline)
    assert sentence in str(refused.value)


def test_a_shape_through_points_is_the_one_they_are_of():
    """Points of a known outline give it back, in any unit; those of a spheroid a spheroid."""
    rho, z = EGG.meridian(TAU)
    found = sp.shape_through(2.7 * z, 2.7 * rho)
    np.testing.assert_allclose(found.meridian(TAU)[0], found.width(TAU))
    there = np.interp(z, *found.meridian(np.linspace(0.0, np.pi, 20001))[::-1])
    np.testing.assert_allclose(there[1:-1], rho[1:-1], atol=1e-6)
    assert found.deviation < 1e-6
    spheroid = sp.shape_through(3.5 * 1.4 * -np.cos(TAU), 3.5 * np.sin(TAU))
    assert spheroid.spheroidal
    assert spheroid.aspect == pytest.approx(1.4, abs=1e-12)


def test_points_of_a_formula_and_with_noise():
    exact = sp.shape_through(*egg())
    assert exact.deviation < 1e-6
    assert not exact.symmetric
    z, rho = egg()
    rho[1:-1] += 0.01 * np.random.default_rng(3).standard_normal(39)
    noisy = sp.shape_through(z, rho)
    assert 0.005 < noisy.deviation < 0.04
    # Smoother than its points: nearer to the egg than they are.
    fine = np.linspace(0.0, np.pi, 4001)
    ours, wanted = (from_pole(shape, fine) for shape in (noisy, exact))
    assert np.abs(ours - wanted).max() < 0.012


def capsule(length, points=61):
    """A cylinder with round caps, `length` diameters long."""
    tau = np.linspace(0.0, np.pi, points)
    return np.where(tau < np.pi / 2, 1.0 - length, length - 1.0) - np.cos(tau), np.sin(tau)


def superellipse(power, points=61):
    """|z/1.2|ᵖ + ρᵖ = 1: flat at the equator and the poles where p is above 2."""
    tau = np.linspace(0.0, np.pi, points)
    z = np.sign(np.cos(tau)) * np.abs(np.cos(tau)) ** (2.0 / power)
    return -1.2 * z, np.abs(np.sin(tau)) ** (2.0 / power)


@pytest.mark.parametrize(
    ("points", "length", "near"),
    [
        (capsule(1.2), 1.2, 3e-3),
        (capsule(1.5), 1.5, 3e-3),
        (capsule(1.9), 1.9, 3e-3),
        (superellipse(2.5), 1.2, 1e-3),
        (superellipse(5.0), 1.2, 1e-3),
        (superellipse(6.0), 1.2, 1e-3),
    ],
)
def test_stones_with_flat_sides_are_convex_stones(points, length, near):
    """No curvature at the equator: held convex, and with the mirror image that they have."""
    shape = sp.shape_through(*points)
    assert shape.symmetric
    assert shape.deviation < near
    assert shape.length == pytest.approx(length, rel=1e-2)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda z, r: (z[:5], r[:5]), "5 points, but must be at least 9 points"),
        (lambda z, r: (z, r[1:]), "but must be two columns of equal length"),
        (lambda z, r: (z[1:], r[1:]), "on the axis"),
        (lambda z, r: (z[:-1], r[:-1]), "being the last point"),
        (lambda z, r: (z, -r), "but must be zero or positive"),
        (lambda z, r: (z * np.nan, r), "but must be finite"),
        (lambda z, r: (z[::-1], r[::-1]), "in order from the upstream to the downstream pole"),
        (lambda z, r: (4.0 * z, r), "aspect of the stone is"),
        (lambda z, r: (z, r * (1.0 - 0.5 * np.exp(-20.0 * z**2))), "smooth convex meridian"),
    ],
)
def test_points_that_are_no_stone_are_refused(change, sentence):
    with pytest.raises(BadInput) as refused:
        sp.shape_through(*change(*egg()))
    assert sentence in str(refused.value)


def test_a_shape_file_and_a_case_file_with_it(tmp_path):
    table = "\n".join(f"{r:.8f},{z:.8f}" for z, r in zip(*egg(), strict=True))
    (tmp_path / "egg.csv").write_text("# micrometres\nrho,z\n" + table)
    shape = sp.read_shape(tmp_path / "egg.csv")
    assert shape.reference.endswith("egg.csv")
    np.testing.assert_allclose(
        shape.meridian(TAU), sp.shape_through(*egg()).meridian(TAU), atol=1e-6
    )
    question = case(shape)
    write_case(question, tmp_path / "case.toml")
    assert 'shape = "egg.csv"' in (tmp_path / "case.toml").read_text()
    assert read_case(tmp_path / "case.toml") == question
    write_case(case(EGG), tmp_path / "other.toml")  # made in Python, written by its values
    assert read_case(tmp_path / "other.toml") == case(EGG)
    (tmp_path / "egg.csv").write_text("rho,z\n1,2\n")
    with pytest.raises(BadInput, match=r"in egg\.csv, shape of the stone is 1 points"):
        read_case(tmp_path / "case.toml")


def test_a_shape_beside_an_aspect_is_refused():
    with pytest.raises(BadInput, match="aspect cannot be used with a shape"):
        sp.Stone(size_ratio=1.2, aspect=1.4, shape=EGG)
    with pytest.raises(BadInput, match="a Shape, as read_shape gives it"):
        sp.Stone(size_ratio=1.2, shape="egg.csv")
    with pytest.raises(BadInput, match="largest extent from its widest place"):
        case(EGG, half_length=3.0)


@pytest.mark.parametrize("seating", ["frictionless", "pressed", "growing"])
def test_a_whole_tube_is_two_halves(seating):
    """A sphere that is told to have no mirror image is solved on the whole tube."""
    bent = Shape(1.0, (1.0, 3e-12, 0.0, 1e-12))
    assert not bent.symmetric
    whole, half = (sp.seat(case(s, mu=0.4, seating=seating), FAST) for s in (bent, Shape()))
    assert whole.contact_angle == pytest.approx(half.contact_angle, abs=1e-6)
    assert whole.downstream_angle == pytest.approx(half.downstream_angle, abs=1e-6)
    theta = np.radians(np.linspace(76.0, 104.0, 15))
    np.testing.assert_allclose(whole.pressure_at(theta), half.pressure_at(theta), rtol=2e-4)
    assert whole.solver.dissipated == pytest.approx(half.solver.dissipated, rel=1e-4, abs=1e-9)
    assert whole.solver.dofs > 1.9 * half.solver.dofs


def test_turned_round_it_is_the_mirror_image():
    for seating in ("frictionless", "pressed"):
        one, other = (sp.seat(case(s, mu=0.4, seating=seating), FAST) for s in (EGG, EGG.turned()))
        assert one.contact_angle == pytest.approx(np.pi - other.downstream_angle, abs=1e-6)
        assert one.downstream_angle == pytest.approx(np.pi - other.contact_angle, abs=1e-6)
        theta = np.linspace(one.contact_angle + 0.02, one.downstream_angle - 0.02, 20)
        mirrored = other.pressure_at(np.pi - theta)
        np.testing.assert_allclose(one.pressure_at(theta), mirrored, rtol=1e-4)
        assert one.solver.axial_balance < 5e-3


@pytest.mark.parametrize("shape", [BLUNT, EGG])
def test_the_wall_lies_on_the_stone_and_never_inside(shape):
    state = sp.seat(case(shape, mu=0.4), FAST)
    inner = state.wall.R == 1.0
    stone = Profile(1.2, shape.aspect, 0.0, shape.outline)
    r, z = state.wall.r[inner], state.wall.z[inner]
    gap = stone.gap(r, z)
    assert gap.min() >= -1e-7
    theta = stone.parametric(r, z)
    touching = (theta >= state.contact_angle) & (theta <= state.downstream_angle)
    assert touching.sum() > 30
    np.testing.assert_allclose(gap[touching], 0.0, atol=1e-8)


@pytest.mark.parametrize(
    ("question", "kilopascal"),
    [
        (case(BLUNT), 24.0),
        (case(EGG), 24.0),
        (case(EGG.turned(), load=sp.Load("5 kPa", "hydrostatic", 1.05)), 24.0),
        (case(EGG, "ureter", 1.3, 1.2), 7.0),
        (case(BLUNT, "ureter", 3.4, 1.1), 9.0),
    ],
    ids=["blunt", "egg", "egg turned, loaded", "egg, thin ureter", "blunt, thick ureter"],
)
def test_without_friction_the_force_does_not_know_the_shape(question, kilopascal):
    """N(P) = I(P) for any stone (model: section 7): the far field has never heard of it."""
    pushed = push_through(question, f"{kilopascal} kPa", FAST, tether=0.1)
    assert isinstance(pushed, PushedState)
    assert pushed.net_force == pytest.approx(advance_force(question, kilopascal * 1e3), rel=1e-4)


def test_held_ends_leave_the_force_of_the_stretches_that_they_make():
    question = case(EGG)
    pushed = push_through(question, "24 kPa", FAST)
    exact = strained_force(question, 24e3, pushed.upstream_stretch, pushed.downstream_stretch)
    assert pushed.net_force == pytest.approx(exact, rel=3e-4)


@pytest.mark.parametrize("model", ["paper", pytest.param("direct", marks=pytest.mark.slow)])
def test_a_spheroid_through_points_answers_as_one_by_its_aspect(model):
    shape = sp.shape_through(-1.4 * np.cos(TAU), np.sin(TAU))
    near = Shape(1.4, (1.0 - 1e-9, 0.0, -1e-9))  # the general formulas
    answers = [sp.solve(case(s, mu=0.4, model=model), FAST) for s in (Shape(1.4), shape, near)]
    assert all(answer.outcome is Outcome.MOVES for answer in answers)
    for answer in answers[1:]:
        assert answer.pressure == pytest.approx(answers[0].pressure, rel=1e-6)


def test_the_sharper_end_first_moves_at_another_pressure():
    one, other = (sp.solve(case(s, mu=0.4, model="direct"), FAST) for s in (EGG, EGG.turned()))
    assert abs(one.pressure / other.pressure - 1.0) > 0.005
    assert one.contact.microbuckled is False
