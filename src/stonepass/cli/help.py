"""The layout of the help: options in panels, examples, and exit codes.

The help is plain text. It needs no library for drawing, fits narrow terminals, and can be copied.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from typing import Any

from typer.core import TyperCommand, TyperGroup

__all__ = [
    "EXIT_CODES",
    "MODEL_PANEL",
    "OUTPUT",
    "QUESTION",
    "SOLVER",
    "STONE",
    "URETER",
    "PanelCommand",
    "PanelGroup",
    "epilog",
]

QUESTION = "Question"
STONE = "Stone"
URETER = "Ureter and its load"
MODEL_PANEL = "Model"
SOLVER = "Solver"
OUTPUT = "Output"
LAST = "Help"
# The order of the panels. Any other panel, such as the options of one model, follows the model.
FIRST_PANELS = (QUESTION, STONE, URETER, MODEL_PANEL)
LAST_PANELS = (SOLVER, OUTPUT, LAST)
NARROWEST, WIDEST = 30, 98  # characters of a line of the help
EXIT_CODES = (
    "0 answered; 1 no answer (the outcome says why); 2 the request was refused; 3 an error of the "
    "program"
)

Example = tuple[str, str]


class _Panelled:
    """A part of a command that lists its parameters in panels, each with a heading."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the panels; a parameter without a panel of its own belongs to the last one."""
        panels: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):  # type: ignore[attr-defined]
            record = parameter.get_help_record(ctx)
            if record is not None:
                panel = getattr(parameter, "rich_help_panel", None) or LAST
                name, text = record
                # The placeholder of an argument says what it is; its type would repeat that.
                panels.setdefault(panel, []).append((name.split(" <")[0], text))
        ends = (*FIRST_PANELS, *LAST_PANELS)
        others = [panel for panel in panels if panel not in ends]
        for panel in (*FIRST_PANELS, *others, *LAST_PANELS):
            if panel in panels:
                with formatter.section(panel):
                    formatter.write_dl(panels[panel])

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help no wider than the terminal; the library's own limit is 50 columns."""
        formatter.width = max(min(shutil.get_terminal_size().columns - 2, WIDEST), NARROWEST)
        super().format_help(ctx, formatter)  # type: ignore[misc]


class PanelCommand(_Panelled, TyperCommand):
    """A command whose help has panels."""


class PanelGroup(_Panelled, TyperGroup):
    """A group of commands whose help has panels."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the commands and then the options."""
        self.format_commands(ctx, formatter)
        super().format_options(ctx, formatter)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write one line of help for each command, never cut."""
        commands = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        with formatter.section("Commands"):
            formatter.write_dl([(name, _first_paragraph(each)) for name, each in commands])


def _first_paragraph(command: Any) -> str:
    return " ".join((command.help or "").split("\n\n")[0].split())


def epilog(examples: Sequence[Example], exit_codes: str = EXIT_CODES) -> str:
    """Return the end of a command's help.

    Parameters
    ----------
    examples : sequence of (str, str)
        Commands, without the name of the program, and what each of them answers.
    exit_codes : str
        The exit codes of the command, if they have another meaning than those of the others.
    """
    lines = [f"  stonepass {command}\n      {meaning}" for command, meaning in examples]
    # The character "\b" keeps the lines of a paragraph as they are.
    return "\b\nExamples:\n" + "\n".join(lines) + f"\n\nExit codes: {exit_codes}."
