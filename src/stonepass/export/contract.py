"""The writer contract: what an export format declares, what its function takes and returns.

A new format is one file that makes a `Writer`, and one line in `export.registry`. This module loads
no numerical library, since the help of the command line is made from these declarations.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

if TYPE_CHECKING:  # these modules load NumPy and SciPy
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["KINDS", "Export", "Limit", "Option", "WriteFunction", "Writer"]

KINDS = ("model", "law", "seating", "load", "shape")  # what a `Limit` may restrict


@dataclass(frozen=True)
class Option:
    """An option of a format: a keyword of `export.write` and a flag of ``stonepass export``.

    Attributes
    ----------
    name : str
        Lower-case letters only; the flag is the name after two hyphens.
    meaning : str
        One phrase without a full stop, for the help.
    kind : type
        `str` for one of `choices`, `float` for a number within `bounds`.
    default : str, float or None
        Value that the function gets where the option is not given.
    default_text : str
        What the help says of the default; empty where `default` says it.
    choices : tuple of str
        Allowed words, where `kind` is `str`.
    bounds : (float, float) or None
        Smallest and largest number, both allowed, where `kind` is `float`.
    unit : str
        Unit of the number, as a phrase for messages.
    """

    name: str
    meaning: str
    kind: type[str] | type[float]
    default: str | float | None = None
    default_text: str = ""
    choices: tuple[str, ...] = ()
    bounds: tuple[float, float] | None = None
    unit: str = ""


@dataclass(frozen=True)
class Limit:
    """The names of one kind that a format can express; a case with any other name is refused.

    Attributes
    ----------
    names : tuple of str
        Names of laws, models, seatings, loads (``prestretch``, ``dead``, ``hydrostatic``) or shapes
        (``sphere``, ``spheroid``, ``outline``).
    reason : str
        Why the others are refused, or what to do instead: a clause for the end of the message.
        Where it is empty, the message names the formats that can express the case.
    needs : mapping
        Values that options must have for a name: ``{"fung": {"flavour": "abaqus"}}``.
    """

    names: tuple[str, ...]
    reason: str = ""
    needs: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


@dataclass(frozen=True)
class Export:
    """What a writer made of a case.

    Attributes
    ----------
    content : str, bytes or None
        Content of the file (text is written in UTF-8). None where the case has no answer, so that
        there is nothing to write; `summary` then has the outcome and its sentence.
    summary : str
        What the file holds, in one line.
    next_step : str
        What to do with the file; ``{file}`` and ``{stem}`` stand for its name with and without the
        ending. May be empty.
    warnings : tuple of str
        Warnings of the answer behind it.
    path : Path or None
        Where it was written; None before that, and where there is no content.
    """

    content: str | bytes | None = field(repr=False)
    summary: str
    next_step: str = ""
    warnings: tuple[str, ...] = ()
    path: Path | None = None


@runtime_checkable
class WriteFunction(Protocol):
    """The function of a format. It writes no file and solves nothing that it does not need."""

    def __call__(
        self, case: Case, options: Mapping[str, Any], solved: Callable[[], Answer]
    ) -> Export:
        """Return the content of the file for `case`.

        Parameters
        ----------
        case : Case
            It is within the limits that the writer declares.
        options : mapping
            A checked value for each declared option, the default where none was given.
        solved : callable
            Solves the case and returns its answer; only a format that shows results calls it.

        Raises
        ------
        BadInput
            The format cannot express this case for a reason that no limit declares.
        """


@dataclass(frozen=True)
class Writer:
    """An export format.

    Attributes
    ----------
    name : str
        Name of the format, ``--format NAME``; unique among the registered writers.
    ending : str
        Ending of its files with the dot, in lower case; unique as well.
    description : str
        What the file is for, a phrase for the help.
    write : WriteFunction
        The function that makes the content. It imports numerical libraries when it is called, so
        that declaring a format costs nothing.
    options : tuple of Option
        The options it has; all others are refused.
    limits : mapping of str to Limit
        What it can express, by kind (`KINDS`). A kind that is left out is not limited.
    ignores : tuple of str
        Names of inputs of models and numerics that have no influence on the file. A case may have
        any values of them; the command line refuses them as flags, since whoever gives one expects
        an effect.
    """

    name: str
    ending: str
    description: str
    write: WriteFunction
    options: tuple[Option, ...] = ()
    limits: Mapping[str, Limit] = field(default_factory=dict)
    ignores: tuple[str, ...] = ()
