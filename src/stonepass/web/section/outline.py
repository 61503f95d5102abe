"""Outlines of stone and wall, and the contact pressure, of a solved answer."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.model.answer import Answer
from stonepass.model.contact_state import SolvedState
from stonepass.model.shape import Shape
from stonepass.model.states.loaded_state import PushedState
from stonepass.report.section import wall_surface

__all__ = ["solved_section", "stone_outline"]

REACH = 2.0  # half the length of the drawn tube, in radii of the stone, in addition to LENGTH
LENGTH = 1.5  # in inner radii
DIGITS = 5  # decimals of lengths in inner radii
ANGLES = 61  # number of points of the outline of the stone and of the contact


def solved_section(answer: Answer) -> dict[str, Any] | None:
    """Return the section of a solved answer; None if the answer has no finite-element state.

    Parameters
    ----------
    answer : Answer
        An answer whose contact has its stress field.

    Returns
    -------
    dict
        Lengths are in inner radii, with z = 0 at the widest place of the stone and z positive
        downstream; r is the distance from the axis. ``stone``, ``inner`` and ``outer`` are lists
        of z and r. ``contact`` has angles in degrees, places and pressures in kPa along the
        contact. ``seal`` is the place of the largest contact pressure. ``exact`` is True.
    """
    contact = answer.contact
    if not isinstance(contact, SolvedState) or contact.wall is None:
        return None
    wall, case = contact.wall, answer.case
    mirrored = not isinstance(contact, PushedState) and case.stone.shape.symmetric
    surfaces = {}
    for name, radius in (("inner", wall.R.min()), ("outer", wall.R.max())):
        z, r = wall_surface(wall, float(radius))
        if mirrored:
            z, r = np.concatenate([-z[:0:-1], z]), np.concatenate([r[:0:-1], r])
        shown = np.abs(z) <= REACH * case.extent + LENGTH
        surfaces[name] = _points(z[shown], r[shown])
    theta = np.linspace(contact.contact_angle, contact.downstream_angle, ANGLES)
    rho, z = (case.size_ratio * each for each in case.stone.shape.meridian(theta))
    pressure = contact.pressure_at(theta)
    peak = int(np.argmax(pressure))
    return {
        "exact": True,
        "stone": stone_outline(answer.case.size_ratio, case.stone.shape),
        **surfaces,
        "contact": _points(z, rho)
        | {
            "theta_deg": np.degrees(theta).round(3).tolist(),
            "pressure_kPa": (pressure / 1e3).round(DIGITS).tolist(),
        },
        "seal": {"z": round(float(z[peak]), DIGITS), "r": round(float(rho[peak]), DIGITS)},
        "urine_pressure_kPa": getattr(contact, "urine_pressure", 0.0) / 1e3,
    }


def stone_outline(size_ratio: float, shape: Shape) -> dict[str, list[float]]:
    """Return the outline of a stone from pole to pole in inner radii.

    Parameters
    ----------
    size_ratio : float
        Size ratio ξ.
    shape : Shape
    """
    rho, z = shape.meridian(np.linspace(0.0, np.pi, ANGLES))
    return _points(size_ratio * z, size_ratio * np.maximum(rho, 0.0))


def _points(z: Float[np.ndarray, " n"], r: Float[np.ndarray, " n"]) -> dict[str, list[float]]:
    return {"z": (z.round(DIGITS) + 0.0).tolist(), "r": (r.round(DIGITS) + 0.0).tolist()}
