"""Statements of what the measurements of a patient can and cannot decide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.clinic.assessment import Assessment
from stonepass.studies.censored_samples import Fraction, PercentileRange

__all__ = ["CONTRADICTIONS", "Decision", "decisions", "next_measurement"]

# A question is decided if its answer is the same in at least this fraction of the samples. The same
# fraction of the samples lies above the lower end of a 90 % interval, and below its upper end.
DECIDED = 0.95
# Codes of cautions about contradictions between the measurements, or with the model.
CONTRADICTIONS = ("inputs_contradict", "samples_loose")
# Fraction of the samples with a dilated segment that is not dilated, above which its diameter says
# nothing about the present pressure.
NOT_DILATED = 0.5
# Inputs that cannot be measured in a patient.
UNMEASURABLE = ("friction", "stiffness")


@dataclass(frozen=True)
class Decision:
    """A question about the patient.

    Attributes
    ----------
    decided : bool
        True if the measurements decide the question within the model.
    sentence : str
        The answer with its numbers, or the statement that the question is undecided.
    """

    decided: bool
    sentence: str


def decisions(found: Assessment) -> tuple[Decision, ...]:
    """Return the questions about a patient; undecided questions come first.

    A question is decided if at least 95 % of the samples agree on its answer.
    """
    asked = [_limit(found), _held(found), _present(found), _passage()]
    known = [each for each in asked if each is not None]
    return tuple(sorted(known, key=lambda each: each.decided))


def next_measurement(found: Assessment) -> str:
    """Return a sentence about the input that contributes most to the uncertainty; may be empty."""
    if not found.sensitivity:
        return ""
    largest = found.sensitivity[0]
    text = (
        f"The uncertainty of the {largest.name} contributes most to that of the critical pressure "
        f"(Sobol' total index {100.0 * largest.total:.0f} %)"
    )
    if largest.name in UNMEASURABLE:
        measured = [each for each in found.sensitivity if each.name not in UNMEASURABLE]
        text += ", but it cannot be measured in a patient"
        if measured:
            text += f"; of the measurements, that of the {measured[0].name} contributes most"
    return f"{text}."


def _limit(found: Assessment) -> Decision | None:
    """Return whether the samples decide on which side of the limit the critical pressure is."""
    fraction = found.below_limit if found.loose == 0.0 else found.below_limit_held
    if fraction is None:
        return None
    limit = f"the limit of {found.patient.limit / 1e3:.4g} kPa"
    among = "" if found.loose == 0.0 else " in which the stone is held"
    share = f"in {fraction.describe()} of the simulated input combinations{among}"
    if fraction.low >= DECIDED:
        return Decision(True, f"The critical pressure is below {limit}: this holds {share}.")
    if fraction.high <= 1.0 - DECIDED:
        return Decision(
            True, f"The critical pressure is above {limit}: it is below the limit {share}."
        )
    return Decision(
        False,
        f"Whether the critical pressure is below or above {limit}: it is below the limit {share}"
        f"{_interval(found.critical)}.",
    )


def _interval(values: PercentileRange | None) -> str:
    if values is None or values.low is None:
        return ""
    high = values.high if values.high is not None else values.at_least
    assert high is not None
    more = "" if values.high is not None else "more than "
    return f", and its 90 % interval is {values.low / 1e3:.3g} to {more}{high / 1e3:.3g} kPa"


def _held(found: Assessment) -> Decision | None:
    """Return whether the samples decide that the stone is larger than the lumen."""
    if found.critical is None:
        return None
    loose = Fraction(found.loose, found.loose).describe()
    if found.loose <= 1.0 - DECIDED:
        return Decision(True, "The stone is larger than the lumen and is held by the wall.")
    if found.loose >= DECIDED:
        return Decision(
            True, "The stone is no larger than the lumen, so the wall does not hold it."
        )
    return Decision(
        False,
        f"Whether the stone is larger than the lumen: in {loose} of the combinations it is not, "
        "and the wall would not hold it.",
    )


def _present(found: Assessment) -> Decision | None:
    """Return whether the samples decide that the present pressure is below the critical one."""
    present, above = found.at_present, found.below_present
    if present is None or above is None:
        return None
    if np.mean(present.opening < 1.0) > NOT_DILATED:
        return Decision(
            False,
            "How far the present urine pressure is from the critical pressure: the dilated segment "
            "was measured narrower than the ureter.",
        )
    if above.high <= 1.0 - DECIDED:
        return Decision(True, "The present urine pressure is below the critical pressure.")
    return Decision(
        False,
        "How far the present urine pressure is from the critical pressure: in "
        f"{above.describe()} of the combinations it is above, although the stone is held.",
    )


def _passage() -> Decision:
    return Decision(
        False,
        "Whether and when the stone passes: peristalsis, muscle tone, swelling and time are not in "
        "the model, and no number here is a probability of passage.",
    )
