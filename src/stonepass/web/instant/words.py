"""Sentences for readers of an instant answer."""

from __future__ import annotations

from collections.abc import Mapping
from math import floor, log10
from typing import Any

from stonepass.errors import Outcome
from stonepass.units import PASCAL_PER, Pressure

__all__ = ["digits", "pressure_sentence", "size_sentence"]


def pressure_sentence(outcome: Outcome, record: Mapping[str, Any]) -> str:
    """Return the answer to the question at which pressure the stone moves, in one sentence.

    Parameters
    ----------
    outcome : Outcome
    record : mapping
        The record of the answer of a surrogate.
    """
    critical, error = record["critical_pressure_kPa"], record["critical_pressure_error_kPa"]
    if outcome is Outcome.LOOSE:
        return "The stone is no larger than the opening of the ureter and is not held."
    if outcome is Outcome.MOVES and critical is not None:
        return (
            "The stone starts to move once the urine pressure above it reaches "
            f"{digits(critical)} ± {digits(error, 1)} kPa ({_others(critical)})."
        )
    if outcome is Outcome.BEYOND_CLOSURE:
        bound = record["lower_bound_kPa"]
        return (
            f"The stone needs more than {digits(bound)} kPa ({_others(bound)}); where it starts to "
            "move is beyond what the paper's model can say, and the model 'direct' can say it."
        )
    if record["lower_bound_kPa"]:
        bound = record["lower_bound_kPa"]
        return (
            f"The stone needs more than {digits(bound)} kPa ({_others(bound)}), where the instant "
            "answer ends; solve by finite elements instead."
        )
    return "There is no instant answer for these inputs; solve by finite elements instead."


def size_sentence(limit: Pressure, size: float, diameter: float | None, outcome: Outcome) -> str:
    """Return the answer to the question how large a stone moves, in one sentence.

    Parameters
    ----------
    limit : Pressure
        Pressure limit in Pa.
    size : float
        Critical size ratio, or the largest one that is known to move.
    diameter : float or None
        The diameter in mm that belongs to it, if the inner diameter is known.
    outcome : Outcome
    """
    at = f"at {digits(limit / 1e3)} kPa ({_others(limit / 1e3)})"
    wide = f"{size:.3f} times the inner diameter of the ureter"
    what = wide if diameter is None else f"{digits(diameter)} mm ({wide})"
    if outcome is Outcome.SOLVED:
        return f"Stones of up to {what} start to move {at}."
    if outcome is Outcome.BELOW_RANGE:
        return f"Only stones that are not held, of up to {what}, move {at}."
    if outcome is Outcome.BEYOND_CLOSURE:
        return f"Stones of up to {what} move {at}; the paper's model has no answer for larger ones."
    if outcome is Outcome.NO_SOLUTION:
        return f"Stones of up to {what} move {at}; the instant answer ends there."
    return f"All stones of up to {what}, the largest of the instant answer, move {at}."


def digits(number: float, count: int = 3) -> str:
    """Return a number with so many digits, and without an exponent."""
    if number == 0.0:
        return "0"
    return f"{number:.{max(0, count - 1 - floor(log10(abs(number))))}f}"


def _others(kPa: float) -> str:
    mmHg, cmH2O = (1e3 * kPa / PASCAL_PER[unit] for unit in ("mmHg", "cmH2O"))
    return f"{digits(mmHg)} mmHg, {digits(cmH2O)} cmH₂O"
