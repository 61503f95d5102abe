"""The warnings of an assessment."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.array_types import Bool
from stonepass.caution import Caution, caution
from stonepass.clinic.assessment import Assessment

__all__ = ["assessment_warnings"]

LARGE_ERROR = 0.05  # relative error of the response surface above which a warning is given
SMALL_FRACTION = 0.005  # fraction of samples up to which no warning is given
FEW_POSSIBLE = 0.5  # fraction of possible samples below which a warning is given


def assessment_warnings(found: Assessment) -> tuple[Caution, ...]:
    """Return the warnings of an assessment about assumptions, extrapolation and contradictions."""
    return (
        *found.patient.assumed,
        *_of_inputs(found),
        *_of_samples(found),
        *_of_present(found),
        *_of_accuracy(found),
    )


def _of_inputs(found: Assessment) -> list[Caution]:
    load = found.patient.load
    if load.confining_pressure == 0.0 and load.prestretch == 1.0:
        return []
    return [caution("diameters_without_load")]


def _of_samples(found: Assessment) -> list[Caution]:
    samples, beyond = found.samples, _strain_limit(found)
    if samples is None:
        return []
    return [
        *_where(samples.size_ratio > beyond["highest"], "samples_beyond_range", **beyond),
        *_where(samples.loose, "samples_loose"),
        *_where(samples.censored, "samples_censored"),
    ]


def _of_present(found: Assessment) -> list[Caution]:
    present, beyond = found.at_present, _strain_limit(found)
    if present is None:
        return []
    told = [
        *_where(present.opening > beyond["highest"], "dilation_beyond_range", **beyond),
        *_where(present.opening < 1.0, "dilation_none"),
    ]
    below = found.below_present
    if below is not None and below.low > SMALL_FRACTION:
        words = below.describe()
        told.append(caution("inputs_contradict", fraction=words, low=below.low, high=below.high))
    return told


def _of_accuracy(found: Assessment) -> list[Caution]:
    told = []
    if found.possible < FEW_POSSIBLE:
        told.append(caution("impossible_walls", fraction=1.0 - found.possible))
    if found.surface_error > LARGE_ERROR:
        told.append(caution("surface_error", error=found.surface_error))
    return told


def _strain_limit(found: Assessment) -> dict[str, Any]:
    """Return the largest stretch for which the material was measured, and its name."""
    material = found.patient.material
    return {"highest": material.strain_range[1], "material": material.name}


def _where(chosen: Bool[np.ndarray, " n"], code: str, **values: Any) -> list[Caution]:
    """Return the caution with this code if it concerns more than 0.5 % of the samples."""
    fraction = float(np.mean(chosen))
    return [caution(code, fraction=fraction, **values)] if fraction > SMALL_FRACTION else []
