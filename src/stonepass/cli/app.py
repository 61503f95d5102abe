"""The application: the sub-commands and the version flag."""

from __future__ import annotations

from typing import Annotated

import typer

from stonepass.about import VERSION
from stonepass.cli import (
    assess,
    closures,
    compare,
    curve,
    export,
    fit,
    friction,
    headline,
    invitro,
    material,
    paper,
    pressure,
    push,
    size,
)

__all__ = ["app"]

app = typer.Typer(
    name="stonepass",
    help="At what urine pressure does a stone pass a ureter, and how large may it be? "
    "Research use only. Not a medical device.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
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


app.command("pressure")(pressure.command)
app.command("size")(size.command)
app.command("curve")(curve.command)
app.command("push")(push.command)
app.command("closures")(closures.command)
app.command("export")(export.command)
app.command("compare")(compare.command)
app.command("friction")(friction.command)
app.command("invitro")(invitro.command)
app.command("assess")(assess.command)
app.command("headline")(headline.command)
app.command("paper")(paper.command)
app.add_typer(fit.app, name="fit")
app.add_typer(material.app, name="material")
