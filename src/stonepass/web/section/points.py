"""Lists of points of outlines, rounded for a picture."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float

__all__ = ["EXTENT", "contact_points", "outline_points"]

DIGITS = 4  # decimals of lengths in inner radii, and of pressures in kPa
EXTENT = (2.0, 1.5)  # half the drawn length: in radii of the stone, plus in inner radii


def outline_points(
    z: Float[np.ndarray, " n"], r: Float[np.ndarray, " n"]
) -> dict[str, list[float]]:
    """Return lists of places along the axis and of distances from it, in inner radii."""
    return {"z": (z.round(DIGITS) + 0.0).tolist(), "r": (r.round(DIGITS) + 0.0).tolist()}


def contact_points(
    theta: Float[np.ndarray, " n"],
    z: Float[np.ndarray, " n"],
    r: Float[np.ndarray, " n"],
    pressure: Float[np.ndarray, " n"],
) -> dict[str, dict[str, object]]:
    """Return the contact as lists, and the place of its largest pressure.

    Parameters
    ----------
    theta : array (n)
        Angles in rad.
    z, r : array (n)
        Places on the stone in inner radii.
    pressure : array (n)
        Contact pressure in Pa.
    """
    peak = int(np.argmax(pressure))
    along = {
        "theta_deg": np.degrees(theta).round(3).tolist(),
        "pressure_kPa": (pressure / 1e3).round(DIGITS).tolist(),
    }
    seal = {"z": round(float(z[peak]), DIGITS), "r": round(float(r[peak]), DIGITS)}
    return {"contact": outline_points(z, r) | along, "seal": seal}
