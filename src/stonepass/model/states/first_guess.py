"""First guess for Newton's method: the wall wrapped round the stone at constant volume.

See "First guess" in docs/theory.md, section "Seated state".
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.problem import Wrap
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.model.far_field import inflation
from stonepass.model.problem import Problem

__all__ = ["wrap_round_arc"]

REACH = 1.2  # guessed z of the contact edge, relative to the z at which the wall leaves the arc
MERIDIAN = 2001  # number of samples of the arc


def wrap_round_arc(
    case: Problem, half_length: float, lumen: float, modulus: float, place: Profile
) -> Wrap:
    """Guess the inner radius and the inner pressure along a tube with a stone inside.

    Let z₀ be the axial coordinate at which the arc, the meridian of the stone, has the radius of
    the lumen. The guessed wall lies on the arc up to z₀/2. From there its radius returns to that of
    the lumen exponentially, beginning with the slope of the arc. The inner pressure is that of a
    uniform tube of the local radius.

    Parameters
    ----------
    case : Problem
        Supplies the wall and the load.
    half_length : float
        Half the length of the tube, L/R_a, in inner radii.
    lumen : float
        Inner radius of the tube far from the stone, in undeformed inner radii; it must be less than
        the radius of the stone plus its offset.
    modulus : float
        w″(1) in Pa, the unit of pressure in the finite elements.
    place : Profile
        The stone in its current position, lengths in inner radii.

    Returns
    -------
    Wrap
        Lengths in inner radii, pressures in units of the modulus.
    """
    stretch, law = case.load.prestretch, case.ureter.material.law
    end = half_length * stretch
    z, inner, last = _side(place, lumen, end)
    first = last
    if not place.symmetric:
        upstream, radius, first = _side(place.turned(), lumen, end)
        z, inner = np.append(-upstream[:0:-1], z), np.append(radius[:0:-1], inner)
    pressure = np.asarray(inflation(inner, case.wall_ratio, law, stretch)) / modulus
    return Wrap(
        station=z / stretch,
        inner_radius=inner,
        pressure=pressure,
        contact=(-REACH * first / stretch, REACH * last / stretch),
    )


def _side(
    place: Profile, lumen: float, end: float
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"], float]:
    """Return the guess downstream of the widest place, in inner radii.

    The results are deformed z, deformed inner radius, and the z at which the wall leaves the arc.
    """
    tau = np.pi / 2 * (1.0 + np.linspace(0.0, 1.0, MERIDIAN))
    rho, along = place.meridian(tau)
    arc, axial = place.offset + place.radius * rho, place.radius * along
    leave = 0.5 * float(np.interp(-lumen, -arc, axial))
    rim = float(np.interp(leave, axial, arc))
    n_r, n_z = place.normal(rim, leave)
    rate = float(n_z / n_r) / (rim - lumen)
    z = np.concatenate(
        [
            np.linspace(0.0, leave, 200, endpoint=False),
            leave + np.geomspace(1.0, 1.0 + 40.0 / rate, 800) - 1.0,
        ]
    )
    z = np.append(z[z < end], end)
    away = lumen + (rim - lumen) * np.exp(-rate * np.maximum(z - leave, 0.0))
    return z, np.where(z < leave, np.interp(z, axial, arc), away), leave
