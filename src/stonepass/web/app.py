"""The application: routes of the API and of the page, behind the guard."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from fastapi import FastAPI
from starlette.responses import FileResponse, Response
from starlette.staticfiles import StaticFiles

from stonepass.about import DISCLAIMER, VERSION
from stonepass.web import job_routes, routes, upload_routes
from stonepass.web.answers import Problem, problem_response
from stonepass.web.guard import Guard
from stonepass.web.problems import handle_problems
from stonepass.web.settings import ServerSettings
from stonepass.web.state import ServerState

__all__ = ["create_app"]

FORGETTING = 20.0  # time in s after which old results and files are looked for again
PAGE = Path(__file__).parent / "page"
DESCRIPTION = (
    "At what urine pressure does a kidney stone move in a ureter, and how large a stone moves at a "
    f"given pressure? {DISCLAIMER} Quantities in requests are texts with a unit, such as '3 mm' or "
    "'6 kPa'; numbers in responses have their unit in the name of the key."
)


def create_app(settings: ServerSettings) -> Guard:
    """Return the ASGI application of the server.

    Parameters
    ----------
    settings : ServerSettings
        Address, token, folder of the solution cache, and limits.
    """

    @asynccontextmanager
    async def running(app: FastAPI) -> AsyncIterator[None]:
        """Hold what the server remembers, and end the worker processes at last."""
        state = app.state.server = ServerState.of(settings)
        forgetting = asyncio.create_task(_forget(state))
        yield
        forgetting.cancel()
        await state.book.close()

    app = FastAPI(
        title="stonepass",
        lifespan=running,
        version=VERSION,
        description=DESCRIPTION,
        openapi_url="/api/v1/openapi.json",
        docs_url=None,  # their pages load scripts from other machines
        redoc_url=None,
    )
    handle_problems(app)
    for part in (routes.router, job_routes.router, job_routes.reports, upload_routes.router):
        app.include_router(part)
    _add_page(app)
    _describe_problems(app)
    return Guard(app, settings)


async def _forget(state: ServerState) -> None:
    """Drop old results and uploaded files, also while nobody asks for anything."""
    while True:
        await asyncio.sleep(FORGETTING)
        state.book.forget_old()
        state.uploads.drop_old()


def _add_page(app: FastAPI) -> None:
    """Serve the files of the page."""

    @app.get("/", include_in_schema=False)
    def page() -> Response:
        """Return the page."""
        index = PAGE / "index.html"
        if not index.is_file():
            return problem_response(404, "This installation of stonepass has no page.")
        return FileResponse(index, media_type="text/html; charset=utf-8")

    app.mount("/assets", StaticFiles(directory=PAGE, check_dir=False), name="assets")


def _describe_problems(app: FastAPI) -> None:
    """Add the schema of a problem, which no route returns as its result, to the description."""
    plain = app.openapi

    def described() -> dict[str, Any]:
        document = plain()
        schemas = document.setdefault("components", {}).setdefault("schemas", {})
        schemas.setdefault("Problem", Problem.model_json_schema())
        return document

    app.openapi = described  # type: ignore[method-assign]
