"""The application: its sub-commands, each imported when it is called, and its own options."""

from __future__ import annotations

from importlib import import_module
from typing import Annotated, Any

import typer
from typer.core import TyperCommand
from typer.main import get_command

from stonepass.about import VERSION
from stonepass.cli.help import EXIT_CODES, PanelCommand, PanelGroup
from stonepass.errors import did_you_mean

__all__ = ["COMMANDS", "PANELS", "SETTINGS", "app"]

# Every sub-command by its name: the file of `stonepass.cli` that has it, and its line in the help.
COMMANDS = {
    "pressure": ("pressure", "Find the urine pressure at which a stone starts to move."),
    "size": ("size", "Find the largest stone that moves at a given urine pressure."),
    "curve": ("curve", "Compute the critical pressure for a range of stone sizes."),
    "sweep": ("sweep", "Solve the cases of a study file and store every result."),
    "results": ("results", "Show the results of a sweep, and write them as tables."),
    "push": ("push", "Follow a held stone while the urine pressure rises from zero."),
    "closures": ("closures", "Compare the closures of the paper's model with the direct model."),
    "export": ("export", "Write a case for CalculiX, Abaqus, FEBio or ParaView."),
    "compare": ("compare", "Compare a result of CalculiX with the result of stonepass."),
    "friction": ("friction", "Estimate the friction coefficient from an image of a stone."),
    "invitro": ("invitro", "Compare measured critical pressures with the model."),
    "assess": ("assess", "Assess the stone of one patient, with all uncertainties."),
    "sensitivity": ("sensitivity", "Find which uncertain inputs matter most, and which do not."),
    "headline": ("headline", "Compute the two critical sizes that the paper reports."),
    "paper": ("paper", "Reproduce the figures and claims of the paper."),
    "fit": ("fit", "Fit the constants of a material law to laboratory tests."),
    "material": ("material", "List, show and check material laws."),
    "surrogate": ("surrogate", "Build, check and evaluate fast surrogates of the models."),
    "serve": ("serve", "Serve a page in the browser and an HTTP API."),
}
PANELS = {
    "Questions about a stone": ("serve", "pressure", "size", "curve", "push", "assess"),
    "Many cases": ("sweep", "results", "sensitivity", "surrogate"),
    "Laboratory": ("friction", "fit", "invitro", "material"),
    "Comparisons": ("closures", "export", "compare", "headline", "paper"),
}


class _Group(PanelGroup):
    """A group whose commands are imported when they run or show their own help.

    The help of the group therefore imports none of them, and a command imports only itself.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in COMMANDS:
            return None
        if ctx.resilient_parsing:  # completion lists names and their help alone
            return TyperCommand(cmd_name, help=COMMANDS[cmd_name][1])
        return _load(cmd_name)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        name, *rest = args
        if name in COMMANDS:
            return name, _load(name), rest
        if ctx.resilient_parsing or name.startswith("-"):
            return super().resolve_command(ctx, args)
        near = did_you_mean(name, COMMANDS)
        return ctx.fail(f"There is no command '{name}'{near}; 'stonepass --help' lists all.")

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        for panel, names in PANELS.items():
            with formatter.section(panel):
                formatter.write_dl([(name, COMMANDS[name][1]) for name in names])


def _load(name: str) -> Any:
    """Import a command; its module has a `typer.Typer`, or a function and examples."""
    module = import_module(f"stonepass.cli.{COMMANDS[name][0]}")
    if hasattr(module, "app"):
        command = get_command(module.app)
    else:
        alone = typer.Typer(**SETTINGS)
        alone.command(name, cls=PanelCommand, epilog=module.EPILOG)(module.command)
        command = get_command(alone)
    command.name, command.short_help = name, COMMANDS[name][1]
    return command


SETTINGS: dict[str, Any] = {
    "add_completion": False,
    "rich_markup_mode": None,
    "pretty_exceptions_enable": False,
    "context_settings": {"help_option_names": ["-h", "--help"]},
}

app = typer.Typer(
    name="stonepass",
    cls=_Group,
    help="At what urine pressure does a kidney stone move in a ureter, and what is the largest "
    "stone that moves? Research use only. Not a medical device.",
    epilog="'stonepass COMMAND --help' shows the options of a command, with examples. "
    "'stonepass --install-completion' teaches your shell to complete commands and options.\n\n"
    f"Exit codes: {EXIT_CODES}.",
    **SETTINGS | {"add_completion": True},
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
    """Answer ``--version``."""
