"""The application: the sub-commands, each loaded when it is asked for, and the version flag."""

from __future__ import annotations

from importlib import import_module
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command

from stonepass.about import VERSION

__all__ = ["COMMANDS", "app"]

# Every sub-command by its name: the file of `stonepass.cli` that has it, and its line in the help.
COMMANDS = {
    "pressure": ("pressure", "Find the urine pressure at which a stone starts to move."),
    "size": ("size", "Find the critical size: the largest stone that moves at a pressure limit."),
    "curve": ("curve", "Compute critical pressure over size ratio."),
    "push": ("push", "Raise the urine pressure on a held stone, up to where it would move."),
    "closures": ("closures", "Compare critical pressures by every closure with the direct model."),
    "export": ("export", "Write the case for another finite-element program, or to look at."),
    "compare": ("compare", "Read CalculiX's results of an input deck and compare them with ours."),
    "friction": ("friction", "Estimate the coefficient of friction from a surface image."),
    "invitro": ("invitro", "Compare a measured in-vitro series with the model; fit its friction."),
    "assess": ("assess", "Assess the stone of one patient, with the uncertainty of every input."),
    "headline": ("headline", "Compute the two critical sizes of the paper."),
    "paper": ("paper", "Reproduce the figures and claims of the paper."),
    "fit": ("fit", "Fit the constants of a material law to laboratory tests."),
    "material": ("material", "List, show and check material laws."),
}


class _Group(TyperGroup):
    """A group whose commands are imported when they run or show their own help.

    The help of the application itself then needs none of them, and no command pays for another.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in COMMANDS:
            return None
        if ctx.resilient_parsing:  # completion: names alone
            return TyperCommand(cmd_name)
        return _load(cmd_name)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in COMMANDS.items()])


def _load(name: str) -> Any:
    module = import_module(f"stonepass.cli.{COMMANDS[name][0]}")
    if hasattr(module, "app"):
        return get_command(module.app)
    alone = typer.Typer(**_SETTINGS)
    alone.command(name)(module.command)
    return get_command(alone)


_SETTINGS: dict[str, Any] = {
    "add_completion": False,
    "rich_markup_mode": None,
    "pretty_exceptions_enable": False,
    "context_settings": {"help_option_names": ["-h", "--help"], "max_content_width": 100},
}

app = typer.Typer(
    name="stonepass",
    cls=_Group,
    help="At what urine pressure does a stone pass a ureter, and what is the largest stone that "
    "can pass? Research use only. Not a medical device.",
    epilog="Exit codes: 0 an answer, 1 no answer (the outcome says why), 2 a bad request, 3 a "
    "fault of the program. 'stonepass COMMAND --help' has the options of a command.",
    **_SETTINGS,
)


def _version(value: bool) -> None:
    if value:
        print(f"stonepass {VERSION}")
        raise typer.Exit()


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    pass
