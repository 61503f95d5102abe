"""Measured convergence rates of the finite elements, on cheap meshes."""

from functools import partial

import ngsolve as ng
import numpy as np
import pytest

import stonepass as sp
from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discretisation import discretise, free_unknowns, wall_form
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.postprocessing import contact_profile
from stonepass.fe.axisymmetric.problem import Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.fe.core.newton import newton
from stonepass.fe.core.systems import FormSystem
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of, tube_of

LAW = NeoHookean(1.0 / 8.0)  # hoop modulus 1 Pa: units of the elements and SI coincide
WALL, STRETCH, LUMEN = 1.5, 1.1, 1.3


def radius(R, xp):
    """Deformed radius of the inflated tube: volume is kept."""
    return xp.sqrt(LUMEN**2 + (R * R - 1.0) / STRETCH)


def radial_stress(R, xp):
    """σ_rr − σ_rr(inner) of the inflated neo-Hookean tube, U = C (I₁ − 3).

    ∂σ_rr/∂r = 2 C (λ_θ² − λ_r²)/r with λ_θ = r/R, λ_r = R/(r λ_z), integrated by hand.
    """

    def antiderivative(R):
        r = radius(R, xp)
        rest = (1.0 - STRETCH * LUMEN**2) / (2.0 * STRETCH**2 * r * r)
        return (xp.log(R) - xp.log(r)) / STRETCH + rest

    one = 1.0 + 0.0 * R
    return 2.0 * LAW.C10 * (antiderivative(R) - antiderivative(one))


def errors_of_the_inflated_tube(rows, order):
    """L² errors of radial displacement and pressure for a number of element rows."""
    pulled = -float(radial_stress(np.array(WALL), np))  # the outside pressure, here a tension
    tube = Tube(LAW.energy, WALL, 1.0, STRETCH, pulled, hydrostatic=True)
    layout = Layout(np.linspace(1.0, WALL, rows + 1), np.array([0.0, 1.0]), closed=1)
    d = discretise(tube, Arc.at(Profile(0.5)), layout, order)
    d.fields.u.Set(radius(ng.x, ng) - ng.x)
    d.fields.w.Set((STRETCH - 1.0) * ng.y)
    report = newton(FormSystem(wall_form(d), d.state, free_unknowns(d, "")), 1e-13)
    assert report.converged, report.reason
    r = radius(ng.x, ng)
    pressure = 2.0 * LAW.C10 * (ng.x / (r * STRETCH)) ** 2 - radial_stress(ng.x, ng)

    def norm(error):
        return np.sqrt(ng.Integrate(error * error * ng.x * ng.dx(bonus_intorder=8), d.mesh))

    return norm(d.fields.u - (r - ng.x)), norm(d.fields.p - pressure)


@pytest.mark.parametrize("order", [2, 3, 4])
def test_an_inflated_tube_converges_with_the_order_of_its_elements(order):
    """Displacement with order + 1, pressure, of one order less, with order."""
    coarse, fine = (np.array(errors_of_the_inflated_tube(rows, order)) for rows in (4, 8))
    displacement, pressure = np.log2(coarse / fine)
    assert displacement > order + 0.5
    assert pressure > order - 0.2


def test_the_seated_contact_pressure_converges_with_the_mesh():
    """Frictionless; three meshes, each twice as fine as the one before; displacements of order 3."""
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"))
    law = case.ureter.material.law
    tube = tube_of(law, case.wall_ratio, case.load, case.numerics.half_length)
    guess = partial(wrap_round_arc, case, case.numerics.half_length, 1.0, hoop_modulus(law))
    mesh = Resolution(order=3, closed=4, edge=0.2, growth=2.0)
    meshes = [mesh.refined(factor) for factor in (1.0, 2.0, 4.0)]
    profiles = map(contact_profile, seat_on_stone(tube, profile_of(case), guess, meshes))
    equator = np.array([each.pressure[len(each.pressure) // 2] for each in profiles])
    first, second = np.abs(np.diff(equator))
    assert np.log2(first / second) > 3.0
    assert second < 1e-4 * equator[-1]
