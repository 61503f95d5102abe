"""What can go wrong: errors for a wrong request, outcomes for physics without an answer."""

from __future__ import annotations

import enum
import reprlib
from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import PurePath
from typing import Any, NoReturn, Self

__all__ = [
    "BadInput",
    "CacheNotWritten",
    "CacheWarning",
    "Misplaced",
    "Outcome",
    "StonepassError",
    "UnstableLaw",
    "did_you_mean",
    "refuse_unknown",
    "require",
]


NEAR = 0.5  # similarity of a word and the name that was probably meant, from 0 to 1
LONGEST, LONGEST_ALLOWED = 80, 300  # characters of a value, and of what is allowed
_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 200


class StonepassError(Exception):
    """Root of every error this package raises on purpose."""


class CacheWarning(UserWarning):
    """The solution cache held a damaged result, or could not be written; answers are unaffected."""


class CacheNotWritten(CacheWarning):
    """A result could not be written to the solution cache."""


class BadInput(StonepassError, ValueError):
    """The request is wrong: one sentence says what, which value, what is allowed, what to do."""

    def __init__(self, argument: str, value: Any, allowed: str, remedy: str = "") -> None:
        super().__init__(argument, value, allowed, remedy)
        self.argument, self.value, self.allowed, self.remedy = argument, value, allowed, remedy

    def within(self, file: str) -> Self:
        """Return the same refusal, of something that stands in a file."""
        return self.named(f"in {file}, {self.argument}")

    def named(self, argument: str) -> Self:
        """Return the same refusal with another name of the argument, as the door calls it."""
        return type(self)(argument, self.value, self.allowed, self.remedy)

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        allowed = _cut(self.allowed, LONGEST_ALLOWED)
        return _clean(f"{self.argument} is {_shown(self.value)}, but must be {allowed}{tail}.")


def _shown(value: Any) -> str:
    """Value in a sentence; what a file says may be nested or long beyond what can be written."""
    if isinstance(value, PurePath):  # its end says more than its beginning
        text = str(value)
        return text if len(text) <= LONGEST else "..." + text[3 - LONGEST :]
    if not isinstance(value, str):
        try:
            value = _SHORT.repr(value)
        except (ValueError, RecursionError):
            value = f"a {type(value).__name__} too long to show"
    return _cut(" ".join(value.split()), LONGEST) or "empty"


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else text[: longest - 3] + "..."


def _clean(sentence: str) -> str:
    """Without the control characters of a terminal, which a file may hold."""
    return "".join(each if each.isprintable() else "?" for each in sentence)


class UnstableLaw(BadInput):
    """The material law lets some strain lower the energy, so it describes no solid."""

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        name = _shown(self.value)
        return _clean(f"{self.argument} '{name}' is not stable: {self.allowed}{tail}.")


class Misplaced(BadInput):
    """An input was given that the rest of the request leaves no place for.

    `value` says what it does not go with, e.g. "the model 'paper'"; `allowed` says where it does.
    """

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        allowed = f": it {self.allowed}" if self.allowed else ""
        return _clean(f"{self.argument} cannot be used with {_shown(self.value)}{allowed}{tail}.")


class Outcome(enum.Enum):
    """How a question ended; the value says it in words, without the period of a sentence."""

    MOVES = "The stone moves once the urine pressure above it reaches the critical pressure"
    SOLVED = "The critical size was found"
    LOOSE = "The stone is no larger than the lumen: it is not stuck, no pressure is needed"
    LEAKS = "Urine passes the stone before the stone moves"
    BEYOND_CLOSURE = (
        "Drive and resistance do not balance before the paper's closure ends (contact angle 90°): "
        "this model has no answer; the direct push-through model is the way on"
    )
    NO_SOLUTION = "No equilibrium was found"
    BELOW_RANGE = "Every stuck stone needs more than the pressure limit"
    BEYOND_RANGE = "The pressure limit is not reached within the strain range of the material"

    @property
    def answered(self) -> bool:
        """Whether the outcome is an answer (exit code 0) rather than the lack of one."""
        return self in (Outcome.MOVES, Outcome.SOLVED, Outcome.LOOSE, Outcome.LEAKS)

    def sentence(self, reason: str = "") -> str:
        """The outcome as a sentence, with the reason where there is one."""
        return f"{self.value}: {reason}." if reason else f"{self.value}."


def require(condition: bool, argument: str, value: Any, allowed: str, remedy: str = "") -> None:
    """Raise `BadInput` unless `condition` holds; a NaN comparison is False and so refused."""
    if not condition:
        raise BadInput(argument, value, allowed, remedy)


def did_you_mean(value: str, known: Iterable[str]) -> str:
    """Return ``; did you mean 'x'`` with the nearest of the known names; empty without a near one.

    Capital letters make no difference.
    """
    names = {each.casefold(): each for each in known}
    near = get_close_matches(value.casefold(), names, n=1, cutoff=NEAR)
    return f"; did you mean '{names[near[0]]}'" if near else ""


def refuse_unknown(argument: str, value: str, known: list[str], otherwise: str = "") -> NoReturn:
    """Raise `BadInput` for a name that is not among `known`, naming the nearest one.

    `otherwise` says what to do for something that has no name.
    """
    remedies = [did_you_mean(value, known).removeprefix("; "), otherwise]
    remedy = "; ".join(filter(None, remedies))
    raise BadInput(argument, value, "one of " + ", ".join(known), remedy)
