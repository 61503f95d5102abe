"""Grid lines for a contact between two stations: equal columns, or columns graded to its edges."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.problem import Resolution, Tube
from stonepass.fe.core.grading import graded, growing, intervals

__all__ = ["equal_layout", "graded_layout"]


def equal_layout(
    tube: Tube, contact: tuple[float, float], columns: int, growth: float, *, whole: bool
) -> Layout:
    """Return a grid with equal columns in the contact and growing columns outside of it.

    Parameters
    ----------
    tube : Tube
    contact : (float, float)
        First and last station of the contact, in inner radii.
    columns : int
        Number of equal columns in each half of the contact, at least 1.
    growth : float
        Largest ratio of the lengths of neighbouring columns outside the contact, above 1. For the
        heights of neighbouring rows the largest ratio is 1.5 × `growth`.
    whole : bool
        True for a grid of the whole tube; false for its half Z ≥ 0, with columns of the same length
        in the contact.

    Returns
    -------
    Layout
    """
    first, last = contact
    equal = np.linspace(first, last, 2 * columns + 1)
    size = (last - first) / (2 * columns)
    downstream = last + growing(size, tube.half_length - last, growth)
    radial = 1.0 + growing(size, tube.wall_ratio - 1.0, 1.5 * growth)
    if not whole:
        half = equal[columns:] - equal[columns]
        return Layout(radial, np.concatenate([half, downstream[1:]]), closed=columns)
    upstream = first - growing(size, tube.half_length + first, growth)[::-1]
    axial = np.concatenate([upstream[:-1], equal, downstream[1:]])
    return Layout(radial, axial, closed=2 * columns, wet=len(upstream) - 1)


def graded_layout(
    tube: Tube,
    resolution: Resolution,
    contact: tuple[float, float],
    reference: tuple[float, float],
    *,
    whole: bool,
    offset: float = 0.0,
    seal: float | None = None,
) -> Layout:
    """Return a grid whose columns shrink towards the edges of the contact from both sides.

    Parameters
    ----------
    tube : Tube
    resolution : Resolution
        Numbers, lengths and growth of the columns.
    contact : (float, float)
        First and last station of the contact, in inner radii.
    reference : (float, float)
        A contact, in inner radii, from which the numbers of rows and columns and the heights of the
        rows are computed. With the same reference, the grids for all contacts that occur during a
        solve belong to the same mesh and differ only in the positions of its nodes.
    whole : bool
        True for a grid of the whole tube, false for its half Z ≥ 0.
    offset : float
        Distance in inner radii by which the origin Z = 0 lies downstream of mid-length.
    seal : float, optional
        Position of an additional grid line in the contact, as a fraction in (0, 1) of its length
        from the first edge. The columns of the contact upstream of this line belong to the boundary
        "wetted". Without `seal` there are no wetted columns.

    Returns
    -------
    Layout
    """
    n, growth, fraction = resolution.closed, resolution.growth, resolution.edge / 2.0
    (first, last), half = contact, (reference[1] - reference[0]) / 2.0
    length = last - first
    inlet, outlet = tube.half_length + offset, tube.half_length - offset

    def beyond(reference_room: float, room: float) -> Float[np.ndarray, " points"]:
        count = intervals(2.0 * fraction * half, reference_room, growth)
        return graded(count, fraction * length, room)

    middle = 0.5 if seal is None else seal
    first_row = min(8.0 * fraction, 0.5) * half
    radial = 1.0 + growing(first_row, tube.wall_ratio - 1.0, 1.5 * growth)
    upstream = first - beyond(inlet + reference[0], inlet + first)[::-1]
    before = first + length * graded(n, fraction, middle)
    behind = last - length * graded(n, fraction, 1.0 - middle)[::-1]
    downstream = last + beyond(outlet - reference[1], outlet - last)
    wet = len(upstream) - 1
    if not whole:
        return Layout(radial, np.concatenate([behind, downstream[1:]]), closed=n)
    if seal is None:
        axial = np.concatenate([upstream[:-1], before[:-1], behind, downstream[1:]])
        return Layout(radial, axial, closed=2 * n, wet=wet)
    axial = np.concatenate([upstream[:-1], before, behind[1:], downstream[1:]])
    return Layout(radial, axial, closed=n, wet=wet, wetted=n)
