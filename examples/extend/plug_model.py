"""An additional model: the stone as a plug that a uniform pressure holds along its whole length.

The example shows the contract of a model; its physics is too simple for use. The wall presses on
the stone with the pressure p that opens a uniform tube to the radius R_s of the stone, over the
length L = `length` R_s. The balance P_ucr π R_s² = μ p 2π R_s L gives P_ucr = 2 μ p L/R_s.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from stonepass.declaration import Kind, check_inputs, declared
from stonepass.errors import Outcome
from stonepass.model.answer import Answer, NamedQuantity
from stonepass.model.far_field import far_field_law, urine_pressure
from stonepass.model.models.shared_options import far_field_ground


@dataclass(frozen=True)
class Plug:
    """The stone as a plug."""

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "plug"
    MEANING: ClassVar[str] = "a plug under uniform pressure"
    NEEDS_ELEMENTS: ClassVar[bool] = False

    length: float = declared(
        Kind.NUMBER,
        "--plug-length",
        "Length of the plug in radii of the stone.",
        default=2.0,
        bounds=(0.1, 10.0),
    )
    far_field_ground: bool = far_field_ground()

    def __post_init__(self):
        check_inputs(self)

    def require_any_size(self):
        """Accept every model: no option belongs to one stone only."""

    def largest_size(self, case):
        """Return the largest stretch of the strain range of the material."""
        return case.ureter.material.strain_range[1]

    def solve(self, case, numerics, states, resolution=None):
        """Return the answer for a stuck stone; a plug needs no finite elements."""
        law = far_field_law(case, ground=self.far_field_ground)
        opening = float(urine_pressure(np.array(case.size_ratio), case.wall_ratio, law, case.load))
        return Answer(
            case,
            self,
            numerics,
            Outcome.MOVES,
            pressure=2.0 * case.stone.friction * opening * self.length,
            contact=PlugContact(opening),
            detail=PlugDetail(opening),
        )


@dataclass(frozen=True)
class PlugContact:
    """Uniform pressure over the whole stone."""

    pressure: float
    contact_angle: float = 0.0
    downstream_angle: float = np.pi

    @property
    def equator_contact_pressure(self):
        """σ(π/2) in Pa."""
        return self.pressure

    @property
    def peak_contact_pressure(self):
        """Largest σ in Pa."""
        return self.pressure

    def pressure_at(self, theta):
        """σ(θ) in Pa."""
        return np.full_like(theta, self.pressure)

    def without_wall(self):
        """Return itself: a plug has no stress field."""
        return self


@dataclass(frozen=True)
class PlugDetail:
    """Numbers that only this model has."""

    opening: float

    def quantities(self):
        """Return the pressure that opens the tube to the radius of the stone."""
        return (NamedQuantity("opening_pressure", self.opening / 1e3, "kPa", "opening pressure"),)
