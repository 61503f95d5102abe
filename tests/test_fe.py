"""Finite elements: meshes, quadrature, tangents, stresses, without any ureter."""

import ngsolve as ng
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import ellipeinc

from stonepass.fe.axisymmetric.buckling import unstable_motions
from stonepass.fe.axisymmetric.contact import Arc, unilateral
from stonepass.fe.axisymmetric.discretisation import discretise, free_unknowns, wall_form
from stonepass.fe.axisymmetric.friction import open_contact
from stonepass.fe.axisymmetric.inner_wall import inner_wall, set_at_nodes
from stonepass.fe.axisymmetric.mesh import Layout, place, structured_mesh
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS, cauchy_stress, rounded_symbols, wall_energy
from stonepass.fe.core.grading import graded, growing, intervals
from stonepass.fe.core.lobatto import lobatto
from stonepass.fe.core.newton import newton
from stonepass.fe.core.systems import FormSystem
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.protocol import NAMESPACE
from stonepass.model.load import Load
from stonepass.model.states.nondimensional import tube_of
from stonepass.strain import INNER_WALL, CauchyGreen

LAYOUT = Layout(np.array([1.0, 1.2, 1.5]), np.array([0.0, 0.4, 1.0, 2.0]), closed=1)


def test_graded_by_hand():
    np.testing.assert_allclose(graded(2, 1.0, 3.0), [0.0, 1.0, 3.0], rtol=1e-12)
    np.testing.assert_allclose(graded(3, 1.0, 7.0), [0.0, 1.0, 3.0, 7.0], rtol=1e-12)
    np.testing.assert_allclose(graded(2, 9.0, 3.0), [0.0, 1.5, 3.0])
    np.testing.assert_allclose(graded(2, 1.5, 3.0), [0.0, 1.5, 3.0])


@given(st.floats(1e-5, 1.0), st.floats(0.5, 100.0), st.floats(1.2, 3.0))
def test_growing_keeps_first_interval_total_and_growth(first, total, growth):
    points = growing(first, total, growth)
    steps = np.diff(points)
    assert points[0] == 0.0
    assert points[-1] == pytest.approx(total)
    assert steps.min() > 0.0
    if first * 2 < total:
        assert steps[0] == pytest.approx(min(first, total / len(steps)), rel=1e-6)
    assert (steps[1:] / steps[:-1]).max() <= growth * (1.0 + 1e-9)
    assert len(steps) == intervals(first, total, growth)


def test_lobatto_by_hand():
    points, weights = lobatto(2)
    np.testing.assert_allclose(points, [0.0, 0.5, 1.0], atol=1e-15)
    np.testing.assert_allclose(weights, [1 / 6, 4 / 6, 1 / 6])


@pytest.mark.parametrize("order", [2, 3, 4, 5, 6])
def test_lobatto_is_exact_to_twice_its_order_minus_one(order):
    points, weights = lobatto(order)
    for degree in range(2 * order):
        assert weights @ points**degree == pytest.approx(1.0 / (degree + 1.0), rel=1e-13)


def test_mesh_has_its_boundaries_and_moves():
    mesh = structured_mesh(LAYOUT)
    lengths = {"closed": 0.4, "open": 1.6, "outer": 2.0, "middle": 0.5, "end": 0.5}
    for name, expected in lengths.items():
        assert ng.Integrate(ng.CF(1.0) * ng.ds(name), mesh) == pytest.approx(expected)
    place(mesh, Layout(LAYOUT.radial, 2.0 * LAYOUT.axial, closed=1))
    assert ng.Integrate(ng.CF(1.0), mesh) == pytest.approx(0.5 * 4.0)
    # ∫ R dR dZ = ½ (1.5² − 1) · 4: coordinates move with the nodes.
    assert ng.Integrate(ng.x, mesh) == pytest.approx(0.5 * 1.25 * 4.0)


@pytest.mark.parametrize("order", [3, 4])
@pytest.mark.parametrize("name", ["latex", "ureter"])
def test_coarse_long_columns_do_not_make_an_unloaded_wall_unstable(name, order):
    """Every motion that keeps volume costs energy.

    A motion may keep volume on average over the pressure's polynomials but not in between; at
    rest p is twice the neo-Hookean constant, and −p (div v)² must not win.
    """
    tube = tube_of(CATALOGUE[name].law, 1.5, Load(), 12.0)
    layout = Layout(np.array([1.0, 1.12, 1.28, 1.5]), np.linspace(0.0, 12.0, 9), closed=1)
    wall = discretise(tube, Arc.at(Profile(1.0)), layout, order)
    free = free_unknowns(wall, "")
    assert newton(FormSystem(wall_form(wall), wall.state, free), 1e-12).converged
    assert unstable_motions(wall, free) == 0


def homogeneous(law, a, b, c, d):
    """A discrete wall with u = a R + c Z (so not quite a tube) and w = b Z + d R."""
    scale = hoop_modulus(law)
    tube = Tube(lambda *at: law.energy(*at) / scale, 1.5, 2.0)
    wall = discretise(tube, Arc.at(Profile(1.2)), LAYOUT, 3)
    u, w, p, *_ = wall.fields
    u.Set(a * ng.x + c * ng.y)
    w.Set(b * ng.y + d * ng.x)
    p.Set(ng.CF(0.3))
    return tube, wall


@pytest.mark.parametrize("name", CATALOGUE)
def test_cauchy_stress_is_the_slope_of_the_energy(name):
    """σ = ∂U/∂F Fᵀ − p, the slope by central differences of the NumPy energy."""
    law = CATALOGUE[name].law
    a, b, c, d = 0.12, -0.05, 0.07, 0.04
    tube, wall = homogeneous(law, a, b, c, d)
    u, w, p, *_ = wall.fields
    at = wall.mesh(1.3, 0.7)
    F = np.array([[1 + a, 0.0, c], [0.0, 1 + a + c * 0.7 / 1.3, 0.0], [d, 0.0, 1 + b]])

    def energy(F):
        C = F.T @ F
        at = CauchyGreen(C[0, 0], C[1, 1], C[2, 2], C[0, 2])
        return float(law.energy(at, INNER_WALL, np)) / hoop_modulus(law)

    h, P = 1e-6, np.zeros((3, 3))
    for i, j in ((0, 0), (0, 2), (1, 1), (2, 0), (2, 2)):
        step = np.zeros((3, 3))
        step[i, j] = h
        P[i, j] = (energy(F + step) - energy(F - step)) / (2 * h)
    expected = P @ F.T - 0.3 * np.eye(3)
    assert expected[0, 2] == pytest.approx(expected[2, 0], abs=1e-8)  # objectivity of the law
    found = [float(s(at)) for s in cauchy_stress(tube.energy, u, w, p)]
    wanted = [expected[0, 0], expected[1, 1], expected[2, 2], expected[0, 2]]
    np.testing.assert_allclose(found, wanted, rtol=1e-7, atol=1e-8)


def touching_wall():
    """A deformed wall with contact forces; some points inside the arc, some outside."""
    _, wall = homogeneous(CATALOGUE["ureter"].law, 0.15, -0.02, 0.01, 0.0)
    boundary = wall.mesh.Boundaries("closed|open")
    wall.fields.normal.Set(0.2 + 0.1 * ng.y, definedon=boundary)
    wall.fields.tangential.Set(0.05 * ng.y - 0.02, definedon=boundary)
    return wall


def frictionless_form(wall, *, condense):
    trial = wall.trial
    form = wall_form(wall) if condense else ng.BilinearForm(wall.state.space)
    if not condense:
        form += ng.Variation(
            wall_energy(wall.tube.energy, *trial[:3]).Compile() * ng.dx(bonus_intorder=2)
        )
    contact = unilateral(trial.normal, wall.arc.gap(trial.u, trial.w), ng.Parameter(5.0))
    form += ng.Variation(contact.Compile() * ng.ds("closed|open", intrules={ng.SEGM: wall.rule}))
    return form


def frictional_form(wall):
    form = ng.BilinearForm(wall.state.space)
    residual = open_contact(wall.trial, wall.test, wall.arc, ng.CF(0.01) * ng.y, 0.4, 5.0)
    form += residual.Compile() * ng.ds("closed|open", intrules={ng.SEGM: wall.rule})
    return form


def random_direction(wall):
    direction = wall.state.vec.CreateVector()
    direction.FV().NumPy()[:] = np.random.default_rng(1).normal(size=len(direction))
    ng.Projector(wall.state.space.FreeDofs(), True).Project(direction)
    return direction


def test_residual_is_the_slope_of_the_energy():
    """Contact included: one random direction, central difference of the energy."""
    wall = touching_wall()
    form, vec, direction, h = frictionless_form(wall, condense=True), wall.state.vec, None, 1e-6
    direction = random_direction(wall)
    origin, force = vec.CreateVector(), vec.CreateVector()
    origin.data = vec
    form.Apply(vec, force)
    energies = []
    for sign in (1.0, -1.0):
        vec.data = origin + sign * h * direction
        energies.append(form.Energy(vec))
    slope = ng.InnerProduct(force, direction)
    assert (energies[0] - energies[1]) / (2 * h) == pytest.approx(slope, rel=1e-7)


@pytest.mark.parametrize("friction", [False, True])
def test_tangent_is_the_slope_of_the_residual(friction):
    wall = touching_wall()
    form = frictional_form(wall) if friction else frictionless_form(wall, condense=False)
    vec, direction, h = wall.state.vec, random_direction(wall), 1e-6
    origin, up, down, product = (vec.CreateVector() for _ in range(4))
    origin.data = vec
    for sign, into in ((1.0, up), (-1.0, down)):
        vec.data = origin + sign * h * direction
        form.Apply(vec, into)
    vec.data = origin
    form.AssembleLinearization(vec)
    up.data = (0.5 / h) * (up - down)
    product.data = form.mat * direction
    product.data -= up
    assert ng.Norm(up) > 0.1
    assert ng.Norm(product) <= 1e-6 * ng.Norm(up)


@pytest.mark.parametrize("aspect", [0.5, 1.0, 1.4, 2.0])
def test_contact_does_the_work_of_its_forces(aspect):
    """Virtual gap and slip are the slopes of gap and arc length, at a wall point on the arc."""
    mesh = structured_mesh(LAYOUT)
    stone = Profile(1.2, aspect, -0.1)
    arc, at, h = Arc.at(stone), mesh(1.0, 0.5), 1e-6
    u = -0.1 + 1.2 * np.cos(0.4) - 1.0  # r = offset + radius cos t, z = κ radius sin t
    w = 1.2 * aspect * np.sin(0.4) - 0.5
    assert ng.CF(arc.gap(ng.CF(u), ng.CF(w)))(at) == pytest.approx(0.0, abs=1e-12)
    n_r, n_z = stone.normal(1.0 + u, 0.5 + w)
    for exact, function, (du, dw) in (
        (arc.virtual_gap, arc.gap, (0.7, -0.4)),
        # Along the arc: off it, the place on it is not that of the nearest point.
        (arc.virtual_slip, lambda a, b: arc.profile.radius * arc.along(a, b), (-n_z, n_r)),
    ):
        up, down = (ng.CF(function(u + s * h * du, w + s * h * dw))(at) for s in (1.0, -1.0))
        slope = (up - down) / (2 * h)
        assert ng.CF(exact(u, w, du, dw))(at) == pytest.approx(slope, rel=1e-7)
    # Numbers and symbols go by the same formula.
    off = ng.CF(arc.gap(ng.CF(u), ng.CF(w + 0.1)))(at)
    assert off == pytest.approx(stone.gap(1.0 + u, 0.6 + w), rel=1e-12)


@pytest.mark.parametrize("aspect", [0.5, 0.8, 1.4, 2.0])
def test_a_spheroid_by_its_meridian(aspect):
    stone, t = Profile(1.3, aspect), np.linspace(-1.3, 1.3, 14)
    r, z = 1.3 * np.cos(t), 1.3 * aspect * np.sin(t)
    np.testing.assert_allclose(stone.gap(r, z), 0.0, atol=1e-14)
    n_r, n_z = stone.normal(r, z)
    np.testing.assert_allclose(np.hypot(n_r, n_z), 1.0)
    # Normal to the chord between near neighbours, and the gap grows by the way along it.
    np.testing.assert_allclose(
        n_r * -1.3 * np.sin(t) + n_z * 1.3 * aspect * np.cos(t), 0.0, atol=1e-14
    )
    np.testing.assert_allclose(stone.gap(r + 1e-5 * n_r, z + 1e-5 * n_z), 1e-5, rtol=1e-4)
    # Arc length of an ellipse by its incomplete elliptic integral E(t | 1 − κ⁻²) × κ radius.
    expected = aspect * ellipeinc(t, 1.0 - 1.0 / aspect**2)
    np.testing.assert_allclose(stone.along(r, z), expected, atol=1e-11)
    np.testing.assert_allclose(stone.parametric(r, z), np.pi / 2.0 + t)


def test_values_set_at_nodes_are_read_there():
    _, wall = homogeneous(CATALOGUE["latex"].law, 0.1, 0.0, 0.0, 0.0)
    set_at_nodes(wall.fields.normal, ng.sin(3.0 * ng.y), wall)
    read = inner_wall(wall)
    np.testing.assert_allclose(read.normal, np.sin(3.0 * read.station), atol=1e-13)
    assert np.all(np.diff(read.station.ravel()) >= 0.0)
    assert read.weight.sum() == pytest.approx(2.0)


def test_a_free_tube_under_load_is_the_far_field():
    """No contact: a finite-element tube under P_out and axial stretch is exactly uniform."""
    from stonepass.materials.neo_hookean import NeoHookean
    from stonepass.model.far_field import lumen_ratio
    from stonepass.model.load import Load

    law = NeoHookean(1.0 / 8.0)  # hoop modulus 1 Pa: units and SI coincide
    for confinement in ("dead", "hydrostatic"):
        load = Load(prestretch=1.1)
        object.__setattr__(load, "confining_pressure", type(load.confining_pressure)(0.04))
        object.__setattr__(load, "confinement", confinement)
        tube = Tube(law.energy, 1.5, 2.0, 1.1, 0.04, hydrostatic=load.hydrostatic)
        wall = discretise(tube, Arc.at(Profile(1.2)), LAYOUT, 4)
        form = wall_form(wall)
        free = free_unknowns(wall, "closed")
        for index in wall.state.space.Range(3):
            free[index] = False
        wall.fields.w.Set(0.1 * ng.y)
        wall.fields.p.Set(ng.CF(0.25))
        report = newton(FormSystem(form, wall.state, free), 1e-13)
        assert report.converged, report.reason
        radius = 1.0 + float(wall.fields.u(wall.mesh(1.0, 1.0)))
        assert radius == pytest.approx(lumen_ratio(1.5, law, load), rel=1e-7)


def test_the_gap_is_the_distance_from_the_arc():
    # At R = 1.5, Z = 2, centre at r = 0: distance 2.5, radius 1, gap 1.5. Centre at r = −0.5 and
    # Z = 2, R = 1: a = 1.5, again 2.5; the angle from the equator is atan(2/1.5).
    mesh = structured_mesh(LAYOUT)
    zero = ng.CF(0.0)
    assert Arc.at(Profile(1.0)).gap(zero, zero)(mesh(1.5, 2.0)) == pytest.approx(1.5)
    arc = Arc.at(Profile(1.0, 1.0, -0.5))
    assert arc.gap(zero, zero)(mesh(1.0, 2.0)) == pytest.approx(1.5)
    assert arc.along(zero, zero)(mesh(1.0, 2.0)) == pytest.approx(np.arctan2(2.0, 1.5))


def test_the_engine_knows_every_function_a_law_may_use():
    assert sorted(vars(SYMBOLS)) == sorted(NAMESPACE)
    values = {
        "maximum": (SYMBOLS.maximum(ng.CF(0.3), 0.7), 0.7),
        "minimum": (SYMBOLS.minimum(ng.CF(0.3), 0.7), 0.3),
        "abs": (SYMBOLS.abs(ng.CF(-0.3)), 0.3),
        "tanh": (SYMBOLS.tanh(ng.CF(0.3)), np.tanh(0.3)),
        "arctan": (SYMBOLS.arctan(ng.CF(0.3)), np.arctan(0.3)),
    }
    mesh = structured_mesh(LAYOUT)
    for found, expected in values.values():
        assert ng.CF(found)(mesh(1.1, 0.1)) == pytest.approx(expected)


def test_a_rounded_kink_is_sharp_while_its_width_is_zero():
    width, mesh = ng.Parameter(0.0), structured_mesh(LAYOUT)
    symbols, x = rounded_symbols(width), ng.x - 1.1  # 0 at the place of the evaluation
    larger, smaller = symbols.maximum(x, -0.3), symbols.minimum(0.2, x)
    at = mesh(1.1, 0.1)
    assert ng.CF(larger)(at) == pytest.approx(0.0, abs=1e-15)
    assert ng.CF(smaller)(at) == pytest.approx(0.0, abs=1e-15)
    width.Set(0.4)
    assert ng.CF(larger)(at) == pytest.approx((-0.3 + 0.5) / 2.0)
    assert ng.CF(smaller)(at) == pytest.approx((0.2 - np.hypot(0.2, 0.4)) / 2.0)


def test_the_width_of_a_kink_changes_the_tangent_alone():
    """A wall of springs that resist tension alone: max(C_zz − 1, 0)²."""

    def energy(C, place, xp):
        part = xp.maximum(C.zz - 1.0, 0.0)
        return 0.5 * (C.rr + C.tt + C.zz - 3.0) + part * part

    tube = Tube(energy=energy, wall_ratio=1.5, half_length=4.0)
    d = discretise(tube, Arc.at(Profile(1.2)), LAYOUT, 2)
    d.fields.w.Set(1e-3 * ng.y * (ng.y - 1.0))
    system = FormSystem(wall_form(d), d.state, free_unknowns(d, ""), d.kink_width)
    before = system.residual()
    tangents = []
    for width in (0.0, 0.1, 0.0):
        system.factorise(width)
        tangents.append(system.form.mat.AsVector().FV().NumPy().copy())
        assert d.kink_width.Get() == 0.0
    assert system.residual() == before
    assert np.array_equal(tangents[0], tangents[2])
    assert np.abs(tangents[1] - tangents[0]).max() > 0.01 * np.abs(tangents[0]).max()


class Scalar:
    """x² = 2 as a system: Newton's own test."""

    def __init__(self, start):
        self.x, self.solves = start, 0

    def residual(self):
        return abs(self.x**2 - 2.0)

    def direction(self, *, again=False, width=0.0):
        if not again:
            self.slope = 2.0 * self.x
        self.solves += 1
        self.origin, self.change = self.x, (self.x**2 - 2.0) / self.slope

    def move(self, step):
        self.x = self.origin - step * self.change


def test_newton_finds_a_root_and_counts():
    system = Scalar(1.0)
    report = newton(system, 1e-14)
    assert report.converged
    # 1 → 1.5 → 1.4167 cuts the residual from 0.25 to 0.0069; the slope 3 of that step then serves
    # to the end, each further step leaving 1 − 2√2/3 = 0.057 of the residual.
    assert report.steps == 2
    assert 10 <= system.solves <= 15
    assert system.x == pytest.approx(np.sqrt(2.0), rel=1e-14)


def test_a_used_factorisation_that_does_not_serve_is_taken_back():
    class Jumpy(Scalar):
        def direction(self, *, again=False, width=0.0):
            super().direction(again=again)
            if again:
                self.change = -1e3  # away from the root

    system = Jumpy(1.0)
    report = newton(system, 1e-14)
    assert report.converged
    assert report.steps == 5  # Newton's own count, from 1: 1.5, 1.417, 1.414216, …
    assert system.x == pytest.approx(np.sqrt(2.0), rel=1e-14)


def test_kinks_are_rounded_after_a_short_step_until_a_full_one():
    class Scripted(Scalar):
        """The directions allow steps of 1/8, 1/2 and 1 in turn; each cuts the norm to four fifths."""

        def __init__(self):
            self.norm, self.widths = 1.0, []

        def residual(self):
            return self.norm

        def direction(self, *, again=False, width=0.0):
            assert not again
            self.widths.append(width)
            self.before = self.norm

        def move(self, step):
            largest = (
                1.0 if len(self.widths) % 3 == 0 else 0.125 if len(self.widths) % 3 == 1 else 0.5
            )
            self.norm = 0.8 * self.before if step <= largest else 2.0 * self.before

    system = Scripted()
    newton(system, 1e-8, most=7)
    # The steps are 1/8, 1/2 and 1, again and again.
    assert [width > 0.0 for width in system.widths] == [False, True, True] * 2 + [False]
    assert system.widths[1] == pytest.approx(1e-5 * np.sqrt(0.8 / 1e-8))


def test_newton_ends_on_what_is_not_finite():
    class Broken(Scalar):
        def residual(self):
            return 1.0 if self.x == 1.0 else float("nan")

    report = newton(Broken(1.0), 1e-14)
    assert not report.converged
    assert "no finite residual" in report.reason


def test_newton_gives_up_in_bounded_steps():
    class Stuck(Scalar):
        def residual(self):
            return 1.0

    report = newton(Stuck(1.0), 1e-14, most=7)
    assert (report.steps, report.converged) == (7, False)
