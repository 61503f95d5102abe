"""Where Newton's method starts: the wall wrapped round the arc, a uniform tube at every station."""

from __future__ import annotations

import numpy as np

from stonepass.fe.problem import Wrap
from stonepass.fe.profile import Profile
from stonepass.model.case import Case
from stonepass.model.far_field import inflation

__all__ = ["wrap_round_arc"]


def wrap_round_arc(case: Case, lumen: float, modulus: float, place: Profile) -> Wrap:
    """Inner radius and pressure along the tube round an arc at a place.

    The wall is taken to leave the arc where the axial coordinate is half that of the place at
    which the arc has the radius of the lumen, with the slope it has there, and to return to the
    lumen exponentially. The inner pressure is that of a uniform tube of the local radius.
    """
    stretch, law = case.load.prestretch, case.ureter.material.law
    end = case.method.half_length * stretch
    radius, offset, aspect = place.radius, place.offset, place.aspect
    leave = 0.5 * aspect * np.sqrt(radius**2 - (lumen - offset) ** 2)
    height = np.sqrt(radius**2 - (leave / aspect) ** 2)
    rim = offset + height
    rate = leave / aspect**2 / (height * (rim - lumen))
    z = np.concatenate(
        [
            np.linspace(0.0, leave, 200, endpoint=False),
            leave + np.geomspace(1.0, 1.0 + 40.0 / rate, 800) - 1.0,
        ]
    )
    z = np.append(z[z < end], end)
    inner = np.where(
        z < leave,
        offset + np.sqrt(np.maximum(radius**2 - (z / aspect) ** 2, 0.0)),
        lumen + (rim - lumen) * np.exp(-rate * np.maximum(z - leave, 0.0)),
    )
    pressure = np.asarray(inflation(inner, case.wall_ratio, law, stretch)) / modulus
    return Wrap(
        station=z / stretch, inner_radius=inner, pressure=pressure, reach=1.2 * leave / stretch
    )
