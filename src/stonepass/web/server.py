"""The server process: uvicorn with a limit of the time for headers and of open connections."""

from __future__ import annotations

import webbrowser
from typing import Any

import uvicorn

from stonepass.web.app import create_app
from stonepass.web.settings import ServerSettings

__all__ = ["serve"]


def serve(settings: ServerSettings, *, browser: bool = True) -> None:
    """Run the server until it is interrupted.

    Parameters
    ----------
    settings : ServerSettings
        Address, token, folder of the solution cache, and limits.
    browser : bool
        True if the page is opened in the user's browser.
    """
    config = uvicorn.Config(
        create_app(settings),
        host=settings.host,
        port=settings.port,
        access_log=False,  # nothing of a request is kept
        log_level="warning",
        server_header=False,
        ws="none",
        timeout_keep_alive=15,
        timeout_graceful_shutdown=3,
    )
    _Server(config, browser).run()


class _Server(uvicorn.Server):
    """A server that says its address once it listens, and opens the page."""

    def __init__(self, config: uvicorn.Config, browser: bool) -> None:
        super().__init__(config)
        self._browser = browser

    async def startup(self, sockets: list[Any] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            port = self.servers[0].sockets[0].getsockname()[1]
            address = f"http://{self.config.host}:{port}/"
            print(f"stonepass serves {address} (Ctrl-C stops it)", flush=True)
            if self._browser:
                webbrowser.open(address)
