"""The command-line options that give a case."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from stonepass.declaration import Kind
from stonepass.errors import BadInput
from stonepass.inputs.case_file import held_values, values_of
from stonepass.inputs.catalogue import all_inputs
from stonepass.model.case import Case

__all__ = ["command_options"]


def command_options(case: Case, left_out: Collection[str] = ()) -> list[str]:
    """Return the words of a command line that give the inputs of a case.

    Inputs that have their default value are left out.

    Parameters
    ----------
    case : Case
    left_out : collection of str
        Keys of further inputs that are left out, e.g. ``"stone.size_ratio"``.

    Raises
    ------
    BadInput
        An input cannot be named on a command line, e.g. a law that is given by its constants.
    """
    words: list[str] = []
    held = held_values(case)
    for key, value in values_of(case, Path()).items():
        declared = all_inputs()[key]
        if held[key] == declared.default or key in left_out:
            continue
        if isinstance(value, dict):  # a law by its constants, or a shape by its points
            raise BadInput(key, "a table", "a name or a file", "use a case file")
        names = declared.declaration.option.split("/")
        if declared.declaration.kind is Kind.FLAG:
            words.append(names[0] if value else names[-1])
            continue
        text = f"{value:.12g}" if isinstance(value, float) else str(value).replace(" ", "")
        if text != declared.declaration.shown_default:
            words += [names[0], text]
    return words
