"""What a reader of an assessment must keep in mind, in sentences."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool
from stonepass.clinic.assessment import Assessment

__all__ = ["assessment_warnings"]

LARGE_ERROR = 0.05
SMALL_FRACTION = 0.005  # not worth a sentence
FEW_POSSIBLE = 0.5


def assessment_warnings(found: Assessment) -> tuple[str, ...]:
    """Return the warnings of an assessment: what was assumed, extrapolated or left open."""
    return (
        *found.patient.assumed,
        *_of_inputs(found),
        *_of_samples(found),
        *_of_present(found),
        *_of_accuracy(found),
    )


def _of_inputs(found: Assessment) -> list[str]:
    load = found.patient.load
    if load.confining_pressure == 0.0 and load.prestretch == 1.0:
        return []
    return ["diameters of the ureter are taken as those without load, but imaging shows "
            "them under it"]  # fmt: skip


def _of_samples(found: Assessment) -> list[str]:
    samples, highest = found.samples, found.patient.material.strain_range[1]
    if samples is None:
        return []
    return [
        *_where(
            samples.size_ratio > highest,
            f"the stone stretches the wall beyond {highest:g} times its circumference, "
            f"{_known_up_to(found)}",
        ),
        *_where(
            samples.loose,
            "the stone is no larger than the lumen; one that obstructs is held, so "
            "these say that the sizes are known too badly, or that something else holds it",
        ),
        *_where(
            samples.censored,
            "only a lower bound of the critical pressure is known: the stone is "
            "larger, or the friction higher, than the model answers",
        ),
    ]


def _of_present(found: Assessment) -> list[str]:
    present, highest = found.at_present, found.patient.material.strain_range[1]
    if present is None:
        return []
    sentences = [
        *_where(
            present.opening > highest,
            f"the dilated segment is wider than {highest:g} times the ureter, "
            f"{_known_up_to(found)}: the present pressure is extrapolated, and a wall that has "
            "crept makes it too high",
        ),
        *_where(
            present.opening < 1.0,
            "the dilated segment is no wider than the ureter; its transmural pressure counts as 0",
        ),
    ]
    if found.below_present is not None and found.below_present.low > SMALL_FRACTION:
        sentences.append(
            f"in {found.below_present.describe()} of the samples the present pressure exceeds the "
            "critical one although the stone is there: these inputs contradict one another, or "
            "what holds the stone is not in the model"
        )
    return sentences


def _of_accuracy(found: Assessment) -> list[str]:
    sentences = []
    if found.possible < FEW_POSSIBLE:
        sentences.append(
            f"{1.0 - found.possible:.0%} of the draws describe no possible wall and were "
            "left out: the diameters are known too badly, and what is left is narrower "
            "than they say"
        )
    if found.surface_error > LARGE_ERROR:
        sentences.append(f"the response surface is off by up to {found.surface_error:.0%}")
    return sentences


def _known_up_to(found: Assessment) -> str:
    material = found.patient.material
    highest = material.strain_range[1]
    return f"but the constants of material '{material.name}' were used up to {highest:g} only"


def _where(chosen: Bool[np.ndarray, " n"], sentence: str) -> list[str]:
    """Return the sentence where it concerns more than a few samples."""
    fraction = float(np.mean(chosen))
    return [f"in {fraction:.0%} of the samples {sentence}"] if fraction > SMALL_FRACTION else []
