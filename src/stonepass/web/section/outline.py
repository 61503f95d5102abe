"""Outlines of stone and wall, and the contact pressure, of a solved answer."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.model.answer import Answer
from stonepass.model.contact_state import SolvedState
from stonepass.model.shape import Shape
from stonepass.model.states.loaded_state import PushedState
from stonepass.report.section import wall_surface
from stonepass.web.section.points import EXTENT, contact_points, outline_points

__all__ = ["solved_section", "stone_outline"]

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
        shown = np.abs(z) <= EXTENT[0] * case.extent + EXTENT[1]
        surfaces[name] = outline_points(z[shown], r[shown])
    theta = np.linspace(contact.contact_angle, contact.downstream_angle, ANGLES)
    rho, z = (case.size_ratio * each for each in case.stone.shape.meridian(theta))
    pressure = contact.pressure_at(theta)
    return {
        "exact": True,
        "stone": stone_outline(answer.case.size_ratio, case.stone.shape),
        **surfaces,
        **contact_points(theta, z, rho, pressure),
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
    return outline_points(size_ratio * z, size_ratio * np.maximum(rho, 0.0))
