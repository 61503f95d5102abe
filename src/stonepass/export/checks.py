"""Checks before an export: known formats and options, and cases that the format can express."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.export.contract import Limit, Option, Writer
from stonepass.export.words import FormatWords

if TYPE_CHECKING:  # loads NumPy and SciPy
    from stonepass.model.case import Case

__all__ = ["check_case", "checked_options", "checked_value", "find_writer", "names_of"]

OWN_LAW = "a user-defined law"
WITH_OPTIONS = ("model", "seating")  # kinds of limits for which messages name the option


def find_writer(
    writers: Sequence[Writer], path: Path, format: str | None, words: FormatWords
) -> Writer:
    """Return the writer with a given name, or else the one with the ending of a path.

    Parameters
    ----------
    writers : sequence of Writer
        Formats to choose from.
    path : Path
        The file to be written.
    format : str or None
        Name of the format; None for the one with the ending of `path`.
    words : callable
        Function that returns the name of an option in messages.

    Raises
    ------
    BadInput
        No writer has this name, or without a `format` no writer has this ending.
    """
    if format is None:
        found = [each for each in writers if each.ending == path.suffix.lower()]
        if not found:
            raise BadInput(f"ending of {words('path')}", path.name,
                           "one of " + ", ".join(each.ending for each in writers),
                           f"or give a {words('format')}")  # fmt: skip
    else:
        found = [each for each in writers if each.name == format]
        if not found:
            refuse_unknown(words("format"), str(format), [each.name for each in writers])
    return found[0]


def checked_options(
    writers: Sequence[Writer], writer: Writer, given: Mapping[str, Any], words: FormatWords
) -> dict[str, Any]:
    """Return a checked value for every option of a writer.

    Parameters
    ----------
    writers : sequence of Writer
        All formats; they are needed to name the format that an option belongs to.
    writer : Writer
        The format of the export.
    given : mapping of str to value
        Given options by name; None stands for the default.
    words : callable
        Function that returns the name of an option in messages.

    Raises
    ------
    BadInput
        An option is unknown, belongs to another format, or has a value that is not allowed.
    """
    values = {option.name: option.default for option in writer.options}
    declared = {option.name: option for option in writer.options}
    for name, value in given.items():
        if name in declared:
            values[name] = (
                values[name] if value is None else checked_value(declared[name], value, words)
            )
            continue
        owners = [each.name for each in writers if any(o.name == name for o in each.options)]
        if not owners and declared:
            refuse_unknown(f"option of {words('format', writer.name)}", name, list(declared))
        if value is not None or not owners:
            remedy = f"it is an option of {' and '.join(owners)}" if owners else "it has no options"
            allowed = f"left out with {words('format', writer.name)}"
            raise BadInput(words(name), value, allowed, remedy)
    return values


def checked_value(option: Option, value: Any, words: FormatWords) -> Any:
    """Return the value of an option after a check against its choices or bounds.

    Parameters
    ----------
    option : Option
        Declaration of the option.
    value : str or float
        The given value, in the unit of the option.
    words : callable
        Function that returns the name of an option in messages.

    Raises
    ------
    BadInput
        The value is none of the choices, or a number out of bounds.
    """
    if option.kind is str:
        if value not in option.choices:
            refuse_unknown(words(option.name), str(value), list(option.choices))
        return value
    low, high = option.bounds or (-math.inf, math.inf)
    number = isinstance(value, Real) and not isinstance(value, bool)
    allowed = f"{low:g} to {high:g}" + (f", {option.unit}" if option.unit else "")
    require(number and low <= value <= high, words(option.name), value, allowed)
    return float(value)


def check_case(
    writers: Sequence[Writer],
    writer: Writer,
    case: Case,
    options: Mapping[str, Any],
    words: FormatWords,
) -> None:
    """Refuse a case that a format cannot express.

    Parameters
    ----------
    writers : sequence of Writer
        All formats; the message names those that can express the case.
    writer : Writer
        The format of the export.
    case : Case
        The case to be written.
    options : mapping of str to value
        A value for every option of the writer.
    words : callable
        Function that returns the name of an option in messages.

    Raises
    ------
    BadInput
        The law, model, seating, load or shape of the case is outside a declared limit.
    """
    for kind, names in names_of(case).items():
        limit = writer.limits.get(kind)
        for name in names if limit is not None else ():
            assert limit is not None
            if not _within(limit, name, options):
                allowed = _listed([each for each in limit.allowed if _within(limit, each, options)])
                raise BadInput(
                    words(kind) if kind in WITH_OPTIONS else kind,
                    name,
                    f"{allowed} with {words('format', writer.name)}",
                    _remedy(writers, writer, kind, name, words),
                )


def names_of(case: Case) -> dict[str, tuple[str, ...]]:
    """Return the names of the model, law, seating, loads and shape of a case.

    The keys are those of `contract.KINDS`, and the names are those that a `Limit` contains. There
    is one name for each kind except the loads: a case may have no load, or a pre-stretch and a
    confining pressure.
    """
    from stonepass.materials.known_laws import name_of_law  # loads NumPy

    load, shape = case.load, case.stone.shape
    pulled = ("prestretch",) if load.prestretch != 1.0 else ()
    pressed = (load.confinement,) if load.confining_pressure > 0.0 else ()
    outline = "sphere" if shape.aspect == 1.0 else "spheroid"
    return {
        "model": (case.model.NAME,),
        "law": (name_of_law(case.ureter.material.law) or OWN_LAW,),
        "seating": (getattr(case.model, "seating", ""),),
        "load": (*pulled, *pressed),
        "shape": ("outline" if len(shape.outline) > 1 else outline,),
    }


def _within(limit: Limit, name: str, options: Mapping[str, Any]) -> bool:
    needs = limit.allowed.get(name)
    return needs is not None and all(options[key] == value for key, value in needs.items())


def _remedy(
    writers: Sequence[Writer], writer: Writer, kind: str, name: str, words: FormatWords
) -> str:
    """Return the reason of the limit, or the options or formats that can express the name."""
    own = writer.limits[kind]
    if name not in own.allowed and own.reason:
        return own.reason
    ways = []
    if name in own.allowed:
        ways.append(" ".join(words(*each) for each in own.allowed[name].items()))
    for other in writers:
        limit = other.limits.get(kind)
        if other is not writer and limit is not None and name in limit.allowed:
            needs = limit.allowed[name].items()
            ways.append(" ".join(words(*each) for each in (("format", other.name), *needs)))
    return f"use {' or '.join(ways)}" if ways else ""


def _listed(names: Sequence[str]) -> str:
    return " or ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
