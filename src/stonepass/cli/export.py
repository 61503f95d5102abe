"""``stonepass export``: a case as a file of a registered export format."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stonepass.cli.help import OUTPUT, epilog
from stonepass.cli.options import Cache, NoCache, Settings, cache_folder, takes_settings
from stonepass.errors import Misplaced
from stonepass.export.api import write
from stonepass.export.checks import find_writer
from stonepass.export.contract import Option, Writer
from stonepass.export.registry import WRITERS
from stonepass.export.words import as_flag
from stonepass.inputs.catalogue import option_of
from stonepass.model.models.registry import MODELS

if TYPE_CHECKING:  # loads NumPy and SciPy
    from stonepass.model.answer import Answer

__all__ = ["EPILOG", "command", "make_command"]

DEFAULTS = {"no_cache": False}  # of the options; None for all others
HELP = """Write a case for CalculiX, Abaqus, FEBio or ParaView.

Lengths in the file are in millimetres, with an inner radius of 1 mm if only ratios are given.
Stresses are in kPa in an input file and in Pa in a VTU file. Give a case file; or --stone, --inner
and --outer; or --xi and --eta.
"""
EPILOG = epilog(
    (
        (
            "export --xi 1.2 --eta 1.5 --material latex --out case.inp",
            "an input deck for CalculiX",
        ),
        (
            "export --xi 1.2 --eta 1.5 --material latex --out case.vtu --accuracy fast",
            "the solved wall with its stress, for ParaView",
        ),
    ),
    "0 the file is written; 1 the case has no result to write; 2 the request was refused; 3 an "
    "error of the program",
)


def make_command(writers: Sequence[Writer]) -> Callable[..., int]:
    """Return the sub-command; its formats, options and help are those that `writers` declare.

    Inputs that no format depends on have no options here.
    """

    def command(
        settings: Settings,
        out: Path,
        format: str | None,
        cache: Path | None,
        no_cache: bool,
        **options: Any,
    ) -> int:
        return _export(writers, settings, out, format, cache_folder(cache, no_cache), options)

    keyword = inspect.Parameter.KEYWORD_ONLY
    owners = _owners(writers)
    own = {
        "out": Annotated[
            Path,
            typer.Option(
                "--out",
                metavar="FILE",
                help="File to write. Its ending chooses the format.",
                rich_help_panel=OUTPUT,
            ),
        ],
        "format": Annotated[
            str | None,
            typer.Option(
                "--format",
                metavar="|".join(each.name for each in writers),
                help=_format_help(writers),
                rich_help_panel=OUTPUT,
            ),
        ],
        **{name: _flag(option, formats) for name, (option, formats) in owners.items()},
        "cache": Cache,
        "no_cache": NoCache,
    }
    command.__doc__ = HELP
    command.__annotations__ = {"settings": Settings, **own}
    required = {"settings", "out"}
    parameters = [
        inspect.Parameter(
            name,
            keyword,
            annotation=annotation,
            default=inspect.Parameter.empty if name in required else DEFAULTS.get(name),
        )
        for name, annotation in command.__annotations__.items()
    ]
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    ignored, remarks = _ignored(writers)
    models = tuple(name for name in MODELS if _takes_model(writers, name))
    return takes_settings(*ignored, models=models, choose_model=True, remarks=remarks)(command)


def _ignored(writers: Sequence[Writer]) -> tuple[list[str], dict[str, str]]:
    """Return the keys of inputs that all formats ignore, and a remark for those that some do."""
    ignoring: dict[str, list[str]] = {}
    for writer in writers:
        for name in writer.ignores:
            ignoring.setdefault(f"method.{name}", []).append(writer.name)
    everywhere = [key for key, names in ignoring.items() if len(names) == len(writers)]
    remarks = {}
    for key in ignoring.keys() - everywhere:
        others = [each.name for each in writers if each.name not in ignoring[key]]
        remarks[key] = f"Only for the format {' and '.join(others)}."
    return everywhere, remarks


def _takes_model(writers: Sequence[Writer], model: str) -> bool:
    """Return whether some format can express the results of a model."""
    limits = [writer.limits.get("model") for writer in writers]
    return any(limit is None or model in limit.allowed for limit in limits)


def _owners(writers: Sequence[Writer]) -> dict[str, tuple[Option, list[str]]]:
    """Return every declared option once, with the names of the formats that have it."""
    found: dict[str, tuple[Option, list[str]]] = {}
    for writer in writers:
        for option in writer.options:
            found.setdefault(option.name, (option, []))[1].append(writer.name)
    return found


def _format_help(writers: Sequence[Writer]) -> str:
    told = "; ".join(f"{each.name}: {each.description}" for each in writers)
    return f"{told}.  [default: chosen by the ending of --out]"


def _flag(option: Option, formats: Sequence[str]) -> Any:
    """Return the annotation of an option that some formats have."""
    default = option.default_text or option.default
    tail = "" if default is None else f"  [default: {default}]"
    text = f"Only for the format {' and '.join(formats)}: {option.meaning}."
    metavar = "|".join(option.choices) or "NUMBER"
    return Annotated[
        option.kind | None,
        typer.Option(
            as_flag(option.name), metavar=metavar, help=text + tail, rich_help_panel=OUTPUT
        ),
    ]


def _export(
    writers: Sequence[Writer],
    settings: Settings,
    out: Path,
    format: str | None,
    folder: Path | None,
    options: dict[str, Any],
) -> int:
    """Write the file and name the next step; exit code 1 if the case has no result to write."""
    from stonepass.cli.terminal import show, warn, working, wrote

    writer = find_writer(writers, out, format, as_flag)
    for name in writer.ignores:
        key = f"method.{name}"
        if key in settings.given:
            where = as_flag("format", writer.name)
            raise Misplaced(option_of(key), where, "has no influence on the file")
    case = settings.case()

    def solved() -> Answer:
        from stonepass.model.critical import solve  # loads the finite elements
        from stonepass.studies.jobs import state_solver

        with working("solving the finite-element model"):
            return solve(case, states=state_solver(folder, walls=True))

    made = write(case, out, format, solved=solved, writers=writers, words=as_flag, **options)
    warn(made.warnings)
    if made.path is None:
        show(made.summary)
        warn(["there is no result to show, so nothing was written"])
        return 1
    wrote(out)
    show("; ".join(part for part in (f"{out.name}: {made.summary}", made.next_step) if part))
    return 0


command = make_command(WRITERS)
