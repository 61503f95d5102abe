"""Errors for invalid requests, and outcomes of valid calculations with or without an answer."""

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
    "lacks_memory",
    "nearest",
    "refuse_unknown",
    "require",
]


NEAR = 0.5  # similarity of a word and the name that was probably meant, from 0 to 1
# Largest numbers of characters of a value and of the description of allowed values in a message.
LONGEST, LONGEST_ALLOWED = 80, 300
# Parts of the messages by which libraries say that the machine lacks memory.
NO_MEMORY = (
    "bad_alloc",
    "allocate memory",
    "could not allocate",
    "failed to map segment",
    "can't start new thread",
)
_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 200


class StonepassError(Exception):
    """Base class of all errors that this package raises on purpose."""


class CacheWarning(UserWarning):
    """The solution cache contained a damaged result, or it cannot be written.

    The answers are not affected.
    """


class CacheNotWritten(CacheWarning):
    """A result could not be written to the solution cache."""


class BadInput(StonepassError, ValueError):
    """A request is invalid.

    The message is one sentence: "ARGUMENT is VALUE, but must be ALLOWED; REMEDY."

    Attributes
    ----------
    argument : str
        Name of the input, or of the place in a file.
    value : object
        The invalid value.
    allowed : str
        The values that are allowed.
    remedy : str
        The action that helps the user; may be empty.
    """

    def __init__(self, argument: str, value: Any, allowed: str, remedy: str = "") -> None:
        super().__init__(argument, value, allowed, remedy)
        self.argument, self.value, self.allowed, self.remedy = argument, value, allowed, remedy

    def within(self, file: str) -> Self:
        """Return the error with the name of the file in which the value was found."""
        return self.named(f"in {file}, {self.argument}")

    def named(self, argument: str) -> Self:
        """Return the error with another name of the argument."""
        return type(self)(argument, self.value, self.allowed, self.remedy)

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        allowed = _cut(self.allowed, LONGEST_ALLOWED)
        return _clean(f"{self.argument} is {_shown(self.value)}, but must be {allowed}{tail}.")


def _shown(value: Any) -> str:
    """Return a value as text for a message; a long or deeply nested value is shortened."""
    if isinstance(value, PurePath):  # the end of a path is more informative than its beginning
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
    """Replace control characters, which could change the state of a terminal."""
    return "".join(each if each.isprintable() else "?" for each in sentence)


class UnstableLaw(BadInput):
    """A material law is unstable: some strain lowers its energy."""

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        name = _shown(self.value)
        return _clean(f"{self.argument} '{name}' is not stable: {self.allowed}{tail}.")


class Misplaced(BadInput):
    """An input cannot be used together with other inputs.

    The message is one sentence: "ARGUMENT cannot be used with VALUE: it ALLOWED; REMEDY." The
    attribute `value` names the other input, e.g. "the model 'paper'", and `allowed` says where the
    input can be used, e.g. "belongs to 'direct'".
    """

    def __str__(self) -> str:
        tail = f"; {self.remedy}" if self.remedy else ""
        allowed = f": it {self.allowed}" if self.allowed else ""
        return _clean(f"{self.argument} cannot be used with {_shown(self.value)}{allowed}{tail}.")


class Outcome(enum.Enum):
    """The outcome of a calculation; its value is a sentence without the period."""

    MOVES = "The stone moves once the urine pressure above it reaches the critical pressure"
    SOLVED = "The critical size was found"
    LOOSE = "The stone is no larger than the lumen, so that no pressure is needed to move it"
    LEAKS = "Urine passes the stone before the stone moves"
    BEYOND_CLOSURE = (
        "Drive and resistance do not balance before the paper's closure ends (contact angle 90°), "
        "so that this model has no answer; the model 'direct' has no closure"
    )
    NO_SOLUTION = "No equilibrium was found"
    BELOW_RANGE = "Every stone that is larger than the lumen needs more than the pressure limit"
    BEYOND_RANGE = "The pressure limit is not reached within the strain range of the material"

    @property
    def answered(self) -> bool:
        """Whether the calculation has an answer; the exit code of a command is then 0."""
        return self in (Outcome.MOVES, Outcome.SOLVED, Outcome.LOOSE, Outcome.LEAKS)

    def sentence(self, reason: str = "") -> str:
        """Return the outcome as a sentence, with the reason if one is given."""
        return f"{self.value}: {reason}." if reason else f"{self.value}."


def require(condition: bool, argument: str, value: Any, allowed: str, remedy: str = "") -> None:
    """Raise `BadInput` unless a condition holds.

    Comparisons with NaN are False, so that NaN is refused.

    Parameters
    ----------
    condition : bool
        The condition.
    argument, value, allowed, remedy
        Attributes of the error (see `BadInput`).
    """
    if not condition:
        raise BadInput(argument, value, allowed, remedy)


def did_you_mean(value: str, known: Iterable[str], near: float = NEAR) -> str:
    """Return a suggestion for an unknown name, such as ``; did you mean 'x'``.

    Parameters
    ----------
    value : str
        The unknown name; upper and lower case letters count as equal.
    known : iterable of str
        The known names.
    near : float
        Smallest similarity of a suggested name, from 0 to 1.

    Returns
    -------
    str
        The suggestion, or an empty text if no known name is similar.
    """
    found = nearest(value, known, near)
    return "" if found is None else f"; did you mean '{found}'"


def nearest(value: str, known: Iterable[str], near: float = NEAR) -> str | None:
    """Return the most similar known name, or None; for the parameters see `did_you_mean`."""
    names = {each.casefold(): each for each in known}
    found = get_close_matches(value.casefold(), names, n=1, cutoff=near)
    return names[found[0]] if found else None


def refuse_unknown(argument: str, value: str, known: list[str], otherwise: str = "") -> NoReturn:
    """Raise `BadInput` for an unknown name; the message suggests the nearest known name.

    Parameters
    ----------
    argument : str
        Kind of the name, e.g. "law".
    value : str
        The unknown name.
    known : list of str
        The known names.
    otherwise : str
        A further remedy, e.g. how to give a law of your own; may be empty.
    """
    remedies = [did_you_mean(value, known).removeprefix("; "), otherwise]
    remedy = "; ".join(filter(None, remedies))
    raise BadInput(argument, value, "one of " + ", ".join(known), remedy)


def lacks_memory(problem: BaseException) -> bool:
    """Return True if an error of any library means that the machine lacks memory."""
    text = str(problem).lower()
    return isinstance(problem, MemoryError) or any(sign in text for sign in NO_MEMORY)
