"""Roughness of profiles: mean and root mean square of heights, and of slopes."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.surface.friction_result import Roughness

__all__ = ["roughness"]


def roughness(
    distance: Float[np.ndarray, " n"],
    heights: Float[np.ndarray, "paths n"],
    known: Bool[np.ndarray, "paths n"],
) -> Roughness:
    """Compute the roughness from measured heights only.

    `known` is False where a gap was bridged. A slope counts if its seven samples are all measured.
    """
    powers = np.column_stack([np.ones_like(distance), distance / distance[-1]])
    lines = powers @ np.linalg.lstsq(powers, heights.T, rcond=None)[0]
    levelled = heights - lines.T
    step = float(distance[1] - distance[0])
    weights = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / (60.0 * step)
    slopes = np.array([np.correlate(row, weights, "valid") for row in levelled])
    all_known = np.array([np.correlate(row, np.ones(7), "valid") > 6.5 for row in known * 1.0])
    if not all_known.any(axis=1).all():  # a path without seven measured samples in a row
        all_known[:] = True
    return Roughness(
        float(
            np.mean([np.abs(row[have]).mean() for row, have in zip(levelled, known, strict=True)])
        ),
        float(np.mean([_rms(row[have]) for row, have in zip(levelled, known, strict=True)])),
        float(np.mean([_rms(row[have]) for row, have in zip(slopes, all_known, strict=True)])),
    )


def _rms(values: Float[np.ndarray, " n"]) -> float:
    return float(np.sqrt((values**2).mean()))
