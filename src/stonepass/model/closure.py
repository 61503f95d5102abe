"""The closure: radius of the tube upstream of the stone as a function of the opened angle.

When the wall has opened up to the angle α, the paper assumes a relation between α and the inner
radius r_a of the tube upstream of the stone (Eqs 13–15). The functions here do not take α itself
but the *width* ρ_α/R_s, where ρ_α is the half-width of the stone at α; for a sphere it is sin α.
See "Closure and critical state" in docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.polynomial import Polynomial

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.materials.protocol import Law
from stonepass.model.far_field import urine_pressure
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.states.seated_state import Contact
from stonepass.units import Values

__all__ = [
    "ORDER",
    "Closure",
    "Series",
    "first_radius",
    "fit_series",
    "linear_closure",
    "series_through",
]

ORDER = (1, 8)


def linear_closure(
    width: Values, first_width: float, size_ratio: float, start: float = 1.0
) -> Values:
    """Return r_a/R_a by the paper's closure (Eq. 15), which is linear in ρ_α.

    The radius grows from `start` R_a at α₀ to R_s at α = π/2. This closure is an assumption that
    does not follow from the paper's condition of tangency. Only the value at α₀ is exact. The value
    R_s at π/2 is that of a membrane, and finite-element solutions of the loaded tube have smaller
    radii in between. The closure is defined for α ≤ π/2 only, because ρ_α decreases beyond.

    Parameters
    ----------
    width : float or array
        ρ_α/R_s, from `first_width` to 1.
    first_width : float
        ρ/R_s at α₀, below 1.
    size_ratio : float
        ξ = R_s/R_a.
    start : float
        r_a/R_a at α₀; the paper's value is 1.

    Returns
    -------
    float or array
        r_a/R_a.
    """
    return start + (size_ratio - start) * _opening(width, first_width)


def first_radius(size_ratio: float) -> float:
    """Return r_a/R_a at α₀ for the closure of Eq. 15: 1 if ξ ≥ 1, else ξ.

    A load that narrows the lumen also holds stones with ξ < 1. For these, a closure from R_a at α₀
    to R_s < R_a at π/2 would narrow the tube as the wall opens. Instead, r_a = R_s is used at every
    α, so that P_u is the pressure at which the far field is as wide as the stone. At ξ = 1 both
    closures agree.
    """
    return min(1.0, size_ratio)


@dataclass(frozen=True)
class Series:
    """The series closure r_a/R_a = s + (ξ − s) (c₁ t + c₂ t² + …) (paper, Eqs 13–14).

    The variable is t = (ρ_α − ρ₀)/(R_s − ρ₀), where ρ₀ is the half-width of the stone at α₀. The
    paper writes the series in powers of sin α, which is ρ_α/R_s for a sphere. In t the value at α₀
    is s for all coefficients, and the least-squares problem of the coefficients is well
    conditioned, which it is not in powers of ρ_α. With the single coefficient c₁ = 1 the series is
    Eq. 15.

    Attributes
    ----------
    coefficients : tuple of float
        Dimensionless coefficients c₁, c₂, ….
    start : float
        s = r_a/R_a at α₀.
    """

    coefficients: tuple[float, ...]
    start: float = 1.0

    def __call__(self, width: Values, first_width: float, size_ratio: float) -> Values:
        """Return r_a/R_a; for the parameters see `linear_closure`."""
        t = _opening(width, first_width)
        powers = np.stack([t**k for k in range(1, len(self.coefficients) + 1)], axis=-1)
        return self.start + (size_ratio - self.start) * (powers @ np.array(self.coefficients))

    def printed(self, first_width: float, size_ratio: float) -> tuple[float, ...]:
        """Return the coefficients a₀, a₁, … of the series as printed in Eq. 14, in inner radii.

        They satisfy R_s x − r_a = Σ aᵢ xⁱ with x = ρ_α/R_s, which is sin α for a sphere.

        Parameters
        ----------
        first_width : float
            ρ/R_s at α₀, below 1.
        size_ratio : float
            ξ = R_s/R_a.
        """
        t = Polynomial([-first_width, 1.0]) / (1.0 - first_width)
        opened = Polynomial([0.0, *self.coefficients])(t) * (size_ratio - self.start)
        return tuple((Polynomial([-self.start, size_ratio]) - opened).coef.tolist())


def fit_series(
    width: Float[np.ndarray, " pairs"],
    radius: Float[np.ndarray, " pairs"],
    first_width: float,
    size_ratio: float,
    order: int,
    start: float = 1.0,
) -> Series:
    """Fit the series closure to pairs of width and radius by least squares.

    Parameters
    ----------
    width, radius : arrays (pairs,)
        ρ_α/R_s and r_a/R_a at angles α₀ < α ≤ π/2.
    first_width : float
        ρ/R_s at α₀, below 1.
    size_ratio : float
        ξ = R_s/R_a.
    order : int
        Number of coefficients, 1 to 8.
    start : float
        r_a/R_a at α₀.

    Raises
    ------
    BadInput
        The order is out of bounds, or there are fewer pairs than coefficients.
    """
    low, high = ORDER
    require(low <= order <= high, "order", order, f"{low} to {high}")
    require(
        len(width) >= order,
        "number of opened states",
        len(width),
        f"at least {order}, the order of the series",
    )
    t = _opening(width, first_width)
    powers = np.stack([t**k for k in range(1, order + 1)], axis=-1)
    found = np.linalg.lstsq(powers, (radius - start) / (size_ratio - start), rcond=None)[0]
    return Series(tuple(found.tolist()), start)


def series_through(case: Problem, curve: OpeningCurve, order: int) -> Series | None:
    """Fit the series closure to an opening curve whose first point is the seated state.

    Parameters
    ----------
    case : Problem
        Supplies the shape of the stone and the size ratio.
    curve : OpeningCurve
        Angles α in rad and radii r_a/R_a.
    order : int
        Number of coefficients, 1 to 8.

    Returns
    -------
    Series or None
        None if the curve has too few points for the order.

    Raises
    ------
    BadInput
        The order is out of bounds.
    """
    alpha, radius = curve.arrays
    if len(alpha) <= order:
        return None
    first, *widths = case.stone.shape.width(alpha)
    start = float(radius[0])
    return fit_series(np.array(widths), radius[1:], float(first), case.size_ratio, order, start)


def _opening(width: Values, first_width: float) -> Values:
    return (width - first_width) / (1.0 - first_width)


@dataclass(frozen=True)
class Closure:
    """The urine pressure as a function of the angle up to which the contact has opened.

    Attributes
    ----------
    law : Law
        The law of the far field.
    start : float
        r_a/R_a at α₀ in Eq. 15.
    series : Series or None
        Fitted series that replaces Eq. 15; None for Eq. 15.
    """

    law: Law
    start: float = 1.0
    series: Series | None = None

    def pressure(self, contact: Contact, alpha: Values) -> Values:
        """Return the urine pressure P_u(α) in Pa of the far field at the radius r_a(α) (Eq. 16).

        Parameters
        ----------
        contact : Contact
            The seated contact; it supplies α₀ and the case.
        alpha : float or array
            Angle in rad up to which the contact has opened, from α₀ to π/2.
        """
        case, width = contact.case, contact.case.stone.shape.width
        shape: Callable[[Values, float, float], Values]
        shape = self.series or partial(linear_closure, start=self.start)
        first = float(width(np.array(contact.contact_angle)))
        radius = shape(width(np.asarray(alpha)), first, case.size_ratio)
        return urine_pressure(radius, case.wall_ratio, self.law, case.load)

    def end_pressure(self, contact: Contact) -> float:
        """Return P_u(π/2) in Pa, at which the closure ends; this is not a physical bound."""
        return float(self.pressure(contact, np.array(np.pi / 2)))
