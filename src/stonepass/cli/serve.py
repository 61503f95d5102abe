"""``stonepass serve``: the page in the browser and the HTTP API."""

from __future__ import annotations

import os
from typing import Annotated

import typer

from stonepass.cli.help import OUTPUT, QUESTION, SOLVER, epilog
from stonepass.cli.options import Cache, NoCache, cache_folder

__all__ = ["EPILOG", "command"]

TOKEN = "STONEPASS_TOKEN"  # variable of the environment with the token
EPILOG = epilog(
    (
        ("serve", "the page at http://127.0.0.1:8765/, for this machine only"),
        ("serve --port 9000 --no-browser", "the API alone, for programs"),
    ),
    "0 the server was stopped; 2 the request was refused; 3 an error of the program",
)


def command(
    host: Annotated[
        str,
        typer.Option(
            "--host",
            metavar="ADDRESS",
            help="Address to bind to. Any other than that of this machine needs a token.",
            rich_help_panel=QUESTION,
        ),
    ] = "127.0.0.1",
    port: Annotated[
        int,
        typer.Option(
            "--port", help="Port; 0 lets the system choose one.", rich_help_panel=QUESTION
        ),
    ] = 8765,
    allow_host: Annotated[
        list[str] | None,
        typer.Option(
            "--allow-host",
            metavar="NAME",
            help="A further host name under which clients address the server; may be repeated.",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    browser: Annotated[
        bool,
        typer.Option(
            "--browser/--no-browser", help="Open the page in the browser.", rich_help_panel=OUTPUT
        ),
    ] = True,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Annotated[
        int | None,
        typer.Option(
            "--workers",
            min=1,
            metavar="INTEGER",
            help="Number of processes that solve.  [default: all cores]",
            rich_help_panel=SOLVER,
        ),
    ] = None,
) -> int:
    """Serve the page in the browser and the HTTP API until Ctrl-C.

    Only programs on this machine can reach the server. With --host, other machines can; each
    request then needs the token in the variable STONEPASS_TOKEN of the environment.
    """
    from stonepass.io.optional_imports import library
    from stonepass.studies.executor import CORES

    for name in ("fastapi", "uvicorn"):
        library(name, "serve the page", "web")
    from stonepass.web.server import serve
    from stonepass.web.settings import MOST_WORKERS, ServerSettings

    settings = ServerSettings(
        host,
        port,
        os.environ.pop(TOKEN, ""),  # no process that this one starts shall know it
        tuple(allow_host or ()),
        workers or min(CORES, MOST_WORKERS),
        cache_folder(cache, no_cache),
    )
    serve(settings, browser=browser)
    return 0
