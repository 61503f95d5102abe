"""The section through stone and wall for an instant answer, from sections that were solved."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.units import Pressure
from stonepass.web.section.grid import PLACES, STATIONS, SeatedSection, free_tube, grid_of
from stonepass.web.section.points import EXTENT, contact_points, outline_points

__all__ = ["instant_section"]

ANGLES = 61  # number of points of the outline of the stone


def instant_section(case: Case, stiffness: float) -> dict[str, Any] | None:
    """Return the section of a case in the form of `outline.solved_section`.

    The sections were solved for a friction coefficient of 0.5. ``exact`` is False.

    Parameters
    ----------
    case : Case
    stiffness : float
        Stiffness of the wall relative to the material.

    Returns
    -------
    dict or None
        None if the stone is no sphere, if the tube is pre-stretched or its confining pressure is no
        dead load, or if sizes or pressure are outside the range of the solved sections.
    """
    grid, load = grid_of(case.ureter.material.reference), case.load
    size, wall = case.size_ratio, case.wall_ratio
    # A wall that is n times as stiff deforms under n times the pressure as one of the material.
    confining = float(load.confining_pressure) / stiffness
    described = load.prestretch == 1.0 and (confining == 0.0 or load.confinement == "dead")
    if grid is None or not described or not case.stone.shape.spherical:
        return None
    if not grid.covers(size, wall, confining):
        return None
    tube = free_tube(replace(case, load=Load(Pressure(confining))))
    if tube is None:
        return None
    angle = np.linspace(0.0, np.pi, ANGLES)
    found: dict[str, Any] = {
        "exact": False,
        "stone": outline_points(-size * np.cos(angle), size * np.sin(angle)),
        "urine_pressure_kPa": 0.0,
    }
    if size <= tube.inner:
        radii = [np.full_like(PLACES, radius) for radius in (tube.inner, tube.outer)]
        rest = SeatedSection(
            PLACES, radii[0], PLACES, radii[1], np.pi / 2.0, np.zeros_like(STATIONS)
        )
        return found | _outlines(rest, size) | {"contact": None, "seal": None}
    section = grid.section(size, wall, confining, tube)
    return found | _outlines(section, size) | _contact(section, size, stiffness)


def _outlines(section: SeatedSection, size: float) -> dict[str, Any]:
    """Return both surfaces of the wall on both sides of the equator."""
    return {
        name: _both_sides(z, r, EXTENT[0] * size + EXTENT[1])
        for name, z, r in (
            ("inner", section.inner_z, section.inner_r),
            ("outer", section.outer_z, section.outer_r),
        )
    }


def _both_sides(
    z: Float[np.ndarray, " n"], r: Float[np.ndarray, " n"], extent: float
) -> dict[str, list[float]]:
    shown = z <= extent
    z, r = z[shown], r[shown]
    return outline_points(np.concatenate([-z[:0:-1], z]), np.concatenate([r[:0:-1], r]))


def _contact(section: SeatedSection, size: float, stiffness: float) -> dict[str, Any]:
    """Return the contact pressure along the contact and its largest value's place."""
    half = section.contact_angle + STATIONS * (np.pi / 2.0 - section.contact_angle)
    theta = np.concatenate([half, np.pi - half[-2::-1]])
    pressure = stiffness * np.concatenate([section.pressure, section.pressure[-2::-1]])
    z, r = -size * np.cos(theta), size * np.sin(theta)
    return contact_points(theta, z, r, pressure)
