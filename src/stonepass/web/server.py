"""The server process."""

from __future__ import annotations

import logging
import os
import socket
import webbrowser
from contextlib import suppress
from typing import Any
from urllib.parse import quote

import uvicorn

from stonepass.errors import BadInput
from stonepass.fe.core.threads import one_thread
from stonepass.web.app import create_app
from stonepass.web.protocol import limited_protocol
from stonepass.web.settings import ServerSettings, is_unspecified

__all__ = ["make_server", "serve"]

BACKLOG = 128  # connections that the system holds before they are accepted


def serve(settings: ServerSettings, *, browser: bool = True) -> None:
    """Run the server until it is interrupted.

    Parameters
    ----------
    settings : ServerSettings
        Address, token, folder of the solution cache, and limits.
    browser : bool
        True if the page is opened in the user's browser.

    Raises
    ------
    BadInput
        The server cannot listen at the address.
    """
    server, listening = make_server(settings, browser=browser)
    # Ctrl-C is the usual way to stop a server. The small matrices of an answer gain nothing from
    # several threads.
    with suppress(KeyboardInterrupt), one_thread():
        server.run([listening])


def make_server(
    settings: ServerSettings, *, browser: bool = False
) -> tuple[uvicorn.Server, socket.socket]:
    """Return a server and the socket at which it will listen; see `serve`."""
    listening = _listen(settings)
    config = uvicorn.Config(
        create_app(settings),
        http=limited_protocol(settings.limits),
        h11_max_incomplete_event_size=settings.limits.head,
        access_log=False,  # nothing of a request is kept
        log_level=logging.CRITICAL,
        server_header=False,
        ws="none",
        proxy_headers=False,  # a client cannot say that it is another one
        timeout_keep_alive=15,
        timeout_graceful_shutdown=3,
    )
    return _Server(config, settings, browser), listening


def _listen(settings: ServerSettings) -> socket.socket:
    """Return a socket that listens at the address of the settings."""
    host = settings.host
    made: socket.socket | None = None
    try:
        found = socket.getaddrinfo(host, settings.port, type=socket.SOCK_STREAM)[0]
        made = socket.socket(found[0], socket.SOCK_STREAM)
        if os.name == "posix":  # elsewhere the option means that two servers may share a port
            made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        made.bind(found[4])
        made.listen(BACKLOG)
        made.setblocking(False)
    except OSError as problem:
        if made is not None:
            made.close()
        address = f"{settings.host}:{settings.port}"
        allowed = f"an address at which this program can listen ({problem.strerror})"
        remedy = "choose another with --port or --host"
        raise BadInput("address", address, allowed, remedy) from None
    return made


class _Server(uvicorn.Server):
    """A server that says its address once it listens, and opens the page."""

    def __init__(self, config: uvicorn.Config, settings: ServerSettings, browser: bool) -> None:
        super().__init__(config)
        self._settings, self._browser = settings, browser

    async def startup(self, sockets: list[Any] | None = None) -> None:
        """Start the server, then say its address."""
        await super().startup(sockets)
        if not self.started or not sockets:
            return
        host, token = self._settings.host, self._settings.token
        if is_unspecified(host):  # a browser cannot open the address that stands for all
            host = "::1" if ":" in host else "127.0.0.1"
        name = f"[{host}]" if ":" in host else host
        address = f"http://{name}:{sockets[0].getsockname()[1]}/"
        print(f"stonepass serves {address} (Ctrl-C stops it)", flush=True)
        if self._browser:
            webbrowser.open(f"{address}?token={quote(token, safe='')}" if token else address)
