"""Export of a case to a file for another program; Python and the command line use it."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stonepass.export.checks import check_case, checked_options, find_writer
from stonepass.export.contract import Export, Writer
from stonepass.export.registry import WRITERS
from stonepass.export.words import FormatWords, as_keyword
from stonepass.io.text_file import check_writable, write_file

if TYPE_CHECKING:  # these modules load NumPy and SciPy
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["formats", "write"]


def formats() -> tuple[Writer, ...]:
    """Return the registered export formats with their options and limits.

    Returns
    -------
    tuple of Writer
        The formats in the order in which the help lists them. Each has the attributes `name`,
        `ending`, `description`, `options` and `limits`.

    Examples
    --------
    >>> [option.name for each in formats() for option in each.options if each.name == "inp"]
    ['flavour', 'element', 'fine']
    """
    return WRITERS


def write(
    case: Case,
    path: Path | str,
    format: str | None = None,
    *,
    solved: Callable[[], Answer] | None = None,
    writers: Sequence[Writer] = WRITERS,
    words: FormatWords = as_keyword,
    **options: Any,
) -> Export:
    """Write the input file of a case for another program, or its solved wall for display.

    Parameters
    ----------
    case : Case
        The case to be written. Lengths in the file are in mm; the inner radius is 1 mm if the case
        has only ratios.
    path : Path or str
        File to write, with the ending of the format. An existing file is replaced.
    format : str, optional
        Name of a registered format (`formats`); by default the one with the ending of `path`.
    solved : callable, optional
        Function that returns the answer of `case`. Only formats that show results call it; by
        default they solve the case.
    writers : sequence of Writer, optional
        Formats to choose from; the registered ones by default.
    words : callable, optional
        Function that returns the name of an option in messages; by default its keyword in Python.
    **options
        Options of the format, e.g. ``flavour="abaqus"``; None stands for the default.

    Returns
    -------
    Export
        Its `path` is the written file. If the case has no result to show, no file is written, the
        path is None, and `summary` has the outcome as a sentence.

    Raises
    ------
    BadInput
        The format or an option is unknown, the option belongs to another format, the format cannot
        express the case, or the file cannot be written.

    References
    ----------
    docs/export.md, "What is in an input deck".

    Examples
    --------
    >>> import tempfile
    >>> import stonepass as sp
    >>> case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write(case, Path(folder) / "stone.inp", element="CAX8R").summary
    '280 elements, 0.201 R_a of travel'
    """
    path = Path(path)
    writer = find_writer(writers, path, format, words)
    values = checked_options(writers, writer, options, words)
    check_writable(path, (writer.ending,))
    check_case(writers, writer, case, values, words)
    made = writer.write(case, values, solved or (lambda: _solve(case)))
    if made.content is None:
        return made
    write_file(path, made.content)
    names = {"file": shlex.quote(path.name), "stem": shlex.quote(path.stem)}
    return replace(made, next_step=made.next_step.format(**names), path=path)


def _solve(case: Case) -> Answer:
    from stonepass.model.critical import solve  # loads the finite elements

    return solve(case)
