"""Fit of a convex, smooth shape to points of the meridian of a stone.

The shape is the cosine series g of `model.shape`. A *symmetric* fit is restricted to stones whose
halves are mirror images. See "Stones that are not spheres" in docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev

from stonepass.array_types import Float
from stonepass.errors import BadInput, require
from stonepass.fe.axisymmetric.profile import ROUND
from stonepass.fe.core.roots import bracketed_root
from stonepass.model.shape import ASPECT, Shape

__all__ = ["shape_through"]

FEWEST_POINTS, MOST_POINTS = 9, 2000
MOST_TERMS = 24
NOTHING = 1e-12  # the last terms of a series are dropped if they are smaller than this
EXACT = 1e-7  # deviation, in radii, below which no further terms are added
# An asymmetric or a constrained fit is chosen only if its deviation is smaller by this factor.
CLEARLY = 2.0
# Angles at which the constrained fit requires g + g″ to be at least `LEAST`.
GRID, LEAST = np.linspace(0.0, np.pi, 721), 1e-3
SAME = 1.2  # the fit with the fewest terms within this factor of the least deviation is chosen
# As fractions of the radius: largest deviation of an accepted fit, deviation below which a
# symmetric fit is accepted at once, and largest ρ of a point that counts as lying on the axis.
FARTHEST, MIRRORED, ON_AXIS = 0.05, 1e-3, 1e-4

Outline = Float[np.ndarray, " coefficients"]
Points = tuple[Float[np.ndarray, " points"], Float[np.ndarray, " points"]]
_SMOOTHER = "smooth the points, or leave out those of a dent"


def shape_through(
    z: Float[np.ndarray, "..."],
    rho: Float[np.ndarray, "..."],
    place: Callable[[int, str], str] | None = None,
) -> Shape:
    """Fit a smooth convex shape to points of a meridian.

    Parameters
    ----------
    z, rho : arrays (points,)
        Axial coordinate (positive downstream) and half-width of 9 to 2000 points, in any one unit
        of length. The points are ordered from the upstream to the downstream pole; both poles are
        given and lie on the axis, ρ = 0.
    place : callable, optional
        ``place(index, column)`` returns the name of a number in an error message, for example its
        row in a file.

    Raises
    ------
    BadInput
        The points are not a meridian from pole to pole, or no smooth convex shape comes within 5 %
        of the radius of all of them.
    """
    return _through(*_meridian(z, rho, place or (lambda k, name: f"point {k + 1}, {name}")))


def _through(z: Float[np.ndarray, " points"], rho: Float[np.ndarray, " points"]) -> Shape:
    mirrored = _fit(z, rho, symmetric=True)
    found = mirrored
    if mirrored is None or mirrored.deviation > MIRRORED:
        found = _fit(z, rho, symmetric=False)
        # Noise must not make a stone asymmetric, so the deviation must decrease considerably.
        nearer = np.inf if found is None else found.deviation
        if mirrored is not None and mirrored.deviation <= CLEARLY * nearer:
            found = mirrored
    if found is None or found.deviation > FARTHEST:
        raise BadInput(
            "shape of the stone",
            f"{len(z)} points",
            f"within {FARTHEST:.0%} of the radius of a smooth convex meridian",
            _SMOOTHER,
        )
    return found


def _meridian(
    z: Float[np.ndarray, "..."],
    rho: Float[np.ndarray, "..."],
    place: Callable[[int, str], str],
) -> Points:
    """Check that the points are a meridian from pole to pole; return them as arrays of floats."""
    z, rho = np.asarray(z, dtype=float), np.asarray(rho, dtype=float)
    name = "shape of the stone"
    require(z.ndim == 1 and z.shape == rho.shape, name, f"z and rho with shapes {z.shape} and "
            f"{rho.shape}", "two columns of equal length")  # fmt: skip
    require(FEWEST_POINTS <= len(z) <= MOST_POINTS, name, f"{len(z)} points",
            f"at least {FEWEST_POINTS} points and at most {MOST_POINTS}")  # fmt: skip
    require(bool(np.isfinite([z, rho]).all()), name, "a number that is not finite", "finite")
    least, most = float(rho.min()), float(rho.max())
    require(least >= 0.0 and most > 0.0, name, f"rho = {least:g}", "zero or positive")
    for which, at in (("first", 0), ("last", len(rho) - 1)):
        allowed = f"on the axis (rho = 0), being the {which} point"
        require(rho[at] <= ON_AXIS * most, place(at, "rho"), f"{rho[at]:g}", allowed)
    falls = np.flatnonzero(np.diff(z) < 0.0)
    if falls.size:
        at = int(falls[0])
        raise BadInput(
            place(at + 1, "z"),
            f"{z[at + 1]:g} after {z[at]:g}",
            "in order from the upstream to the downstream pole, with z never falling",
        )
    low, high = ASPECT
    aspect = float(z[-1] - z[0]) / (2.0 * most)
    require(low <= aspect <= high, "aspect of the stone", f"{aspect:.3g}", f"{low} to {high}")
    return z, rho


def _fit(
    z: Float[np.ndarray, " points"], rho: Float[np.ndarray, " points"], *, symmetric: bool
) -> Shape | None:
    """Fit a convex shape with few terms; return None if none is found.

    First, series of increasing length are fitted by least squares of the distance along rays, with
    each point weighted by the angle between its neighbours. If none of these is convex and close to
    the points, as for stones with flat sides, a long series is fitted that minimises the largest
    distance under the constraint of convexity.
    """
    middle = float(z[0] + z[-1]) / 2.0

    def nearest(terms: int, find: Callable[..., Outline | None], most: int) -> Shape | None:
        origin = middle if symmetric else _widest(z, rho, min(terms, most))
        return _nearest(z, rho, origin, _basis(terms, symmetric), find)

    found: list[Shape] = []
    most = min(MOST_TERMS, len(z) // 2)
    for terms in range(2, most + 1):
        shape = nearest(terms, _series, terms)
        if shape is not None:
            found.append(shape)
            if shape.deviation <= EXACT:
                break
    best = min((shape.deviation for shape in found), default=np.inf)
    if best > MIRRORED:
        held = nearest(MOST_TERMS, _held_convex, min(8, len(z) // 2))
        # A long series follows noise, so its deviation must be considerably smaller.
        if held is not None and CLEARLY * held.deviation < best:
            found.append(held)
    if not found:
        return None
    enough = max(EXACT, SAME * min(shape.deviation for shape in found))
    return next(shape for shape in found if shape.deviation <= enough)


def _widest(
    z: Float[np.ndarray, " points"], rho: Float[np.ndarray, " points"], terms: int
) -> float:
    """Return the z at which the least-squares series is widest.

    It is sought between the neighbours of the widest point.
    """
    at, free = int(np.argmax(rho)), np.eye(terms + 1)

    def slope(origin: float) -> float:
        outline = _series(*_polar(z, rho, origin, float(rho.max())), free)
        return float(chebyshev.chebval(0.0, chebyshev.chebder(outline)))

    low, high = float(z[at - 1]), float(z[at + 1])
    if not slope(low) * slope(high) < 0.0:
        return float(z[at])
    return bracketed_root(slope, low, high, xtol=1e-13 * float(z[-1] - z[0]))


def _nearest(
    z: Float[np.ndarray, " points"],
    rho: Float[np.ndarray, " points"],
    origin: float,
    basis: Float[np.ndarray, "unknowns coefficients"],
    find: Callable[..., Outline | None],
) -> Shape | None:
    """Return the shape whose g the function `find` fits; None if it is not admissible."""
    radius, widest = float(rho.max()), 1.0
    for _ in range(3):  # the radius is corrected, since the widest place may lie between two points
        radius = radius / widest
        size, tau = _polar(z, rho, origin, radius)
        found = find(size, tau, basis)
        if found is None:
            return None
        outline, widest = found, float(chebyshev.chebval(0.0, found))
        if not widest > 0.0:
            return None
    deviation = float(np.abs(size * chebyshev.chebval(np.cos(tau), outline) - 1.0).max())
    trimmed = chebyshev.chebtrim(outline / widest, NOTHING)
    kept = ROUND if len(trimmed) == 1 else tuple(trimmed.tolist())
    aspect = float(z[-1] - z[0]) / (2.0 * radius)
    try:
        return Shape(aspect, kept, deviation)
    except BadInput:
        return None


def _polar(
    z: Float[np.ndarray, " points"],
    rho: Float[np.ndarray, " points"],
    origin: float,
    radius: float,
) -> Points:
    """Return polar coordinates about `origin`: distance divided by the radius, and angle τ.

    z is scaled first so that the length of the stone equals its diameter.
    """
    s = (z - origin) * 2.0 * radius / float(z[-1] - z[0])
    return np.hypot(rho, s) / radius, np.arctan2(rho, -s)


def _series(
    size: Float[np.ndarray, " points"],
    tau: Float[np.ndarray, " points"],
    basis: Float[np.ndarray, "unknowns coefficients"],
) -> Float[np.ndarray, " coefficients"]:
    """Fit g in the span of the basis so that size × g(τ) is closest to 1, by least squares."""
    weight = size * np.sqrt(np.abs(np.gradient(tau)))
    rows = basis @ chebyshev.chebvander(np.cos(tau), basis.shape[1] - 1).T * size * weight
    solved: Float[np.ndarray, " unknowns"] = np.linalg.lstsq(rows.T, weight, rcond=None)[0]
    return solved @ basis


def _held_convex(
    size: Float[np.ndarray, " points"],
    tau: Float[np.ndarray, " points"],
    basis: Float[np.ndarray, "unknowns coefficients"],
) -> Outline | None:
    """Fit a convex g whose largest distance from the points along rays is smallest.

    This is a linear programme with the distance as an additional unknown. The result is None if it
    fails.
    """
    # Imported here because it takes long to load and is rarely needed.
    from scipy.optimize import linprog

    k = np.arange(basis.shape[1])
    curvature = np.cos(GRID[:, None] * k) @ (basis * (1.0 - k**2)).T
    rays = (basis @ chebyshev.chebvander(np.cos(tau), len(k) - 1).T * size).T
    one, none = np.ones((len(size), 1)), np.zeros((len(GRID), 1))
    bounds = np.block([[rays, -one], [-rays, -one], [-curvature, none]])
    limits = np.concatenate([np.ones(len(size)), -np.ones(len(size)), np.full(len(GRID), -LEAST)])
    solved = linprog(np.append(np.zeros(len(basis)), 1.0), bounds, limits, bounds=(None, None))
    return solved.x[:-1] @ basis if solved.success else None


def _basis(terms: int, symmetric: bool) -> Float[np.ndarray, "unknowns coefficients"]:
    """Return basis functions of g with g′(π/2) = 0, as rows of Chebyshev coefficients.

    For even k the basis function is cos kτ. For odd k the derivative of cos kτ at π/2 is
    −k sin(kπ/2); a multiple of cos τ is added to make it zero. A symmetric basis has even k only.
    """
    rows = []
    for k in range(terms + 1):
        row = np.zeros(terms + 1)
        row[k] = 1.0
        if k % 2:
            if symmetric or k == 1:
                continue
            row[1] = -k * np.sin(k * np.pi / 2)
        rows.append(row)
    return np.array(rows)
