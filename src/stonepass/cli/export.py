"""``stonepass export``: a case for another program, made from the registered export formats."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stonepass.cli.options import Settings, takes_settings
from stonepass.errors import Misplaced
from stonepass.export.api import write
from stonepass.export.checks import find_writer
from stonepass.export.contract import Option, Writer
from stonepass.export.registry import WRITERS
from stonepass.export.words import as_flag
from stonepass.inputs.catalogue import option_of

if TYPE_CHECKING:  # loads NumPy and SciPy
    from stonepass.model.answer import Answer

__all__ = ["command", "make_command"]

HELP = """Write a case as an input file for another program, or its solved wall to look at.

Lengths are in millimetres, with an inner radius of 1 mm where only ratios are given; stresses in
an input file are in kPa, in a VTU file in Pa. Give the stone as for pressure.
"""


def make_command(writers: Sequence[Writer]) -> Callable[..., int]:
    """Make the sub-command: its formats, options and help are those that `writers` declare."""

    def command(settings: Settings, out: Path, format: str | None, **options: Any) -> int:
        return _export(writers, settings, out, format, options)

    keyword = inspect.Parameter.KEYWORD_ONLY
    owners = _owners(writers)
    own = {
        "out": Annotated[
            Path, typer.Option("--out", metavar="FILE", help="File to write; its ending counts.")
        ],
        "format": Annotated[str | None, typer.Option("--format", help=_format_help(writers))],
        **{name: _flag(option, formats) for name, (option, formats) in owners.items()},
    }
    command.__doc__ = HELP
    command.__annotations__ = {"settings": Settings, **own}
    required = {"settings", "out"}
    parameters = [
        inspect.Parameter(
            name,
            keyword,
            annotation=annotation,
            default=inspect.Parameter.empty if name in required else None,
        )
        for name, annotation in command.__annotations__.items()
    ]
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    return takes_settings()(command)


def _owners(writers: Sequence[Writer]) -> dict[str, tuple[Option, list[str]]]:
    """Every declared option once, with the names of the formats that have it."""
    found: dict[str, tuple[Option, list[str]]] = {}
    for writer in writers:
        for option in writer.options:
            found.setdefault(option.name, (option, []))[1].append(writer.name)
    return found


def _format_help(writers: Sequence[Writer]) -> str:
    told = "; ".join(f"{each.name}: {each.description}" for each in writers)
    return f"{told}.  [default: by the ending of --out]"


def _flag(option: Option, formats: Sequence[str]) -> Any:
    choices = f": {' or '.join(option.choices)}" if option.choices else ""
    default = option.default_text or option.default
    tail = "" if default is None else f"  [default: {default}]"
    text = f"Formats {' and '.join(formats)}: " if len(formats) > 1 else f"Format {formats[0]}: "
    kind = option.kind | None
    return Annotated[
        kind, typer.Option(as_flag(option.name), help=f"{text}{option.meaning}{choices}.{tail}")
    ]


def _export(
    writers: Sequence[Writer],
    settings: Settings,
    out: Path,
    format: str | None,
    options: dict[str, Any],
) -> int:
    """Write the file and say how to go on; exit code 1 where there is nothing to write."""
    from stonepass.cli.terminal import show, warn, working

    writer = find_writer(writers, out, format, as_flag)
    for name in writer.ignores:
        key = f"method.{name}"
        if key in settings.given:
            where = as_flag("format", writer.name)
            raise Misplaced(option_of(key), where, "has no influence on the file")
    case = settings.case()

    def solved() -> Answer:
        from stonepass.model.critical import solve  # loads the finite elements

        with working("solving for the wall"):
            return solve(case)

    made = write(case, out, format, solved=solved, writers=writers, words=as_flag, **options)
    warn(made.warnings)
    if made.path is None:
        show(made.summary)
        warn(["there is no result to show, so nothing was written"])
        return 1
    show("; ".join(part for part in (f"{out.name}: {made.summary}", made.next_step) if part))
    return 0


command = make_command(WRITERS)
