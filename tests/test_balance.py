"""Resistance, drive and closure against integrals done by hand."""

import numpy as np
import pytest
from options import asking

from stonepass.model.case import Case
from stonepass.model.closure import linear_closure
from stonepass.model.force_balance import drive, resistance
from stonepass.model.shape import Shape
from stonepass.model.states.seated_state import Contact
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

EDGE = np.pi / 3


def uniform(sigma=7.0, friction=0.4, as_printed=False, shape=None):
    """A seated contact with constant pressure from 60° to 120°."""
    case = Case(
        Stone(size_ratio=1.2, friction=friction, shape=shape),
        Ureter(wall_ratio=1.5),
        **asking(as_printed=as_printed),
    )
    theta = np.linspace(EDGE, np.pi - EDGE, 801)
    return Contact(case, EDGE, theta, np.full(801, sigma))


def test_friction_by_hand():
    # 2 μ σ ∫_α^{2π/3} sin²θ dθ, ∫ sin² = θ/2 − sin 2θ / 4.
    def antiderivative(t):
        return t / 2 - np.sin(2 * t) / 4

    for alpha in (EDGE, 1.2, np.pi / 2):
        expected = 2 * 0.4 * 7.0 * (antiderivative(2 * np.pi / 3) - antiderivative(alpha))
        assert float(resistance(uniform()).friction(np.array(alpha))) == pytest.approx(
            expected, rel=1e-8
        )


def test_friction_on_a_spheroid_is_that_of_its_profile():
    """F_f = 2π μ ∫ σ ρ |dz| over the meridian ρ = R_s sin τ, z = −κ R_s cos τ (model: section 4b).

    σ constant: ∫ ρ dz = κ R_s² ∫ sin² τ dτ, here by the trapezoidal rule along the profile itself.
    F_σ = −π ∫ σ d(ρ²) does not depend on the length.
    """
    tau = np.linspace(1.2, 2.0 * np.pi / 3.0, 20001)
    rho, z = np.sin(tau), -1.7 * np.cos(tau)
    expected = 2.0 * 0.4 * 7.0 * np.trapezoid(rho, z)
    found = resistance(uniform(shape=Shape(1.7)))
    assert float(found.friction(np.array(1.2))) == pytest.approx(expected, rel=1e-6)
    sphere = resistance(uniform())
    wall = float(sphere.wall(np.array(1.2)))
    assert float(found.wall(np.array(1.2))) == pytest.approx(wall, rel=1e-14)


def test_resistance_and_drive_of_a_stone_without_mirror_image():
    """σ constant: F_f = 2π μ σ ∫ ρ dz by the trapezoidal rule, F_σ = −π σ [ρ²] by its ends.

    The sharper half downstream leaves a smaller ρ at 120° than the blunter one has at 60°, so that
    F_σ is above zero before anything has opened.
    """
    shape = Shape(1.3, (1.0, 0.09, 0.0, 0.03))
    forces = resistance(uniform(shape=shape))
    for alpha in (EDGE, 1.2, np.pi / 2):
        rho, z = shape.meridian(np.linspace(alpha, np.pi - EDGE, 20001))
        friction = 2.0 * 0.4 * 7.0 * np.trapezoid(rho, z)
        wall = 7.0 * (rho[0] ** 2 - rho[-1] ** 2)
        assert float(forces.friction(np.array(alpha))) == pytest.approx(friction, rel=1e-7)
        assert float(forces.wall(np.array(alpha))) == pytest.approx(wall, rel=1e-6)
    assert float(shape.turned().width(np.array(EDGE))) == pytest.approx(rho[-1])
    assert abs(float(forces.wall(np.array(EDGE)))) > 0.1


def test_wall_force_by_hand():
    # −σ ∫_α^{2π/3} sin 2θ dθ = σ (cos 2·(2π/3) − cos 2α)/2 = σ (sin²α − sin²α₀).
    for alpha in (EDGE, 1.2, np.pi / 2):
        expected = 7.0 * (np.sin(alpha) ** 2 - 0.75)
        derived = float(resistance(uniform()).wall(np.array(alpha)))
        printed = float(resistance(uniform(), as_printed=True).wall(np.array(alpha)))
        assert derived == pytest.approx(expected, rel=1e-7, abs=1e-12)
        assert printed == -derived


def test_wall_force_resists():
    alpha = np.linspace(EDGE, np.pi / 2, 50)
    assert np.all(np.diff(resistance(uniform()).wall(alpha)) > 0.0)


def test_total_is_the_sum():
    forces, alpha = resistance(uniform()), np.array([1.1, 1.3])
    np.testing.assert_allclose(
        forces.total(alpha), forces.friction(alpha) + forces.wall(alpha), rtol=1e-15
    )


def test_drive_by_hand():
    # P_u on a disc of half the stone's width is P_u/4 on the full cross-section.
    assert float(drive(np.array(8.0), np.array(0.5))) == pytest.approx(2.0)


def test_closure_by_hand():
    # ρ₀ = 1/2, ξ = 1.3: halfway in the stone's width (0.75) is halfway in radius (1.15).
    width = np.array([0.5, 0.75, 1.0])
    np.testing.assert_allclose(linear_closure(width, 0.5, 1.3), [1.0, 1.15, 1.3], rtol=1e-14)
    np.testing.assert_allclose(
        linear_closure(width, 0.5, 1.3, start=0.9), [0.9, 1.1, 1.3], rtol=1e-14
    )


def test_closure_is_eq_15_as_printed():
    # r_a = R_s sin α + (sin α − 1)(R_a − R_s sin α₀)/(sin α₀ − 1), R_a = 1, R_s = ξ.
    alpha, first, xi = np.linspace(1.1, np.pi / 2, 9), 1.1, 1.25
    s, s0 = np.sin(alpha), np.sin(first)
    printed = xi * s + (s - 1.0) * (1.0 - xi * s0) / (s0 - 1.0)
    np.testing.assert_allclose(linear_closure(s, s0, xi), printed, rtol=1e-13)
