"""The contract of an export format: its declaration, and the arguments and result of its function.

A new format needs one file with a `Writer`, and one line in `export.registry`; see
docs/developing.md, "Add an export format". This module loads no numerical library, because the help
of the command line is made from these declarations.
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

KINDS = ("model", "law", "seating", "load", "shape")  # keys of the limits of a `Writer`


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
        Value that the function gets if the option is not given.
    default_text : str
        Description of the default in the help; empty if `default` itself is shown.
    choices : tuple of str
        Allowed words if `kind` is `str`.
    bounds : (float, float) or None
        Smallest and largest allowed number if `kind` is `float`.
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
    """The models, laws, seatings, loads or shapes that a format can express.

    A case with any other name is refused.

    Attributes
    ----------
    listed : tuple of str
        Names of models, laws, seatings, loads (``prestretch``, ``dead``, ``hydrostatic``) or shapes
        (``sphere``, ``spheroid``, ``outline``).
    reason : str
        Why other names are refused, or what to do instead; a clause at the end of the message. If
        it is empty, the message names the formats that can express the case.
    table : callable, optional
        Returns the names, each with the values that options must have for it, in the place of
        `listed`, e.g. ``{"yeoh": {}, "fung": {"flavour": "abaqus"}}``. It is called when a case is
        checked, because the tables of the laws load numerical libraries.
    """

    listed: tuple[str, ...] = ()
    reason: str = ""
    table: Callable[[], Mapping[str, Mapping[str, str]]] | None = None

    @property
    def allowed(self) -> Mapping[str, Mapping[str, str]]:
        """The names, each with the values that options must have for it."""
        return {name: {} for name in self.listed} if self.table is None else self.table()

    @property
    def names(self) -> tuple[str, ...]:
        """The names that are allowed with some values of the options."""
        return tuple(self.allowed)


@dataclass(frozen=True)
class Export:
    """The result of an export.

    Attributes
    ----------
    content : str, bytes or None
        Content of the file; text is written in UTF-8. It is None if the case has no result to
        write; `summary` then has the outcome as a sentence.
    summary : str
        Description of the content in one line.
    next_step : str
        What to do with the file; ``{file}`` and ``{stem}`` stand for its name with and without the
        ending. It may be empty.
    warnings : tuple of str
        Warnings of the answer whose results are in the file.
    path : Path or None
        The written file; None if no file has been written.
    """

    content: str | bytes | None = field(repr=False)
    summary: str
    next_step: str = ""
    warnings: tuple[str, ...] = ()
    path: Path | None = None


@runtime_checkable
class WriteFunction(Protocol):
    """The function of a format; it returns the content and does not write the file itself."""

    def __call__(
        self, case: Case, options: Mapping[str, Any], solved: Callable[[], Answer]
    ) -> Export:
        """Return the content of the file for `case`.

        Parameters
        ----------
        case : Case
            A case within the limits that the writer declares.
        options : mapping of str to value
            A checked value for each declared option.
        solved : callable
            Function that solves the case and returns its answer. Only a format that shows results
            calls it.

        Raises
        ------
        BadInput
            The format cannot express this case for a reason that no limit declares.
        """


@dataclass(frozen=True)
class Writer:
    """The declaration of an export format.

    Attributes
    ----------
    name : str
        Name of the format for ``--format NAME``, unique among the registered writers.
    ending : str
        Ending of its files in lower case, with the dot; unique as well.
    description : str
        Purpose of the file, a phrase for the help.
    write : WriteFunction
        Function that returns the content. It imports numerical libraries only when it is called.
    options : tuple of Option
        Options of the format; all others are refused.
    limits : mapping of str to Limit
        What the format can express, by kind (`KINDS`). A kind without a limit is unrestricted.
    ignores : tuple of str
        Names of inputs of models and numerics that have no influence on the file. A case may have
        any value of them. The command line refuses them as options, because a user who gives one
        expects an effect.
    """

    name: str
    ending: str
    description: str
    write: WriteFunction
    options: tuple[Option, ...] = ()
    limits: Mapping[str, Limit] = field(default_factory=dict)
    ignores: tuple[str, ...] = ()
