"""HTTP over a connection, with limits of its time and of the number of connections.

uvicorn does not limit the time of a request that arrives slowly, nor that of a client that does not
read its response. Here each of these states has a limit of time. When too many connections are
open, the one that has waited longest for the head of a request is closed.
"""

from __future__ import annotations

import asyncio
import socket
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from stonepass.web.answers import problem_response
from stonepass.web.guard import HEADERS
from stonepass.web.settings import ServerLimits

__all__ = ["limited_protocol"]

MALFORMED = "What was sent is not a request of HTTP/1.1, or its head is longer than allowed."
SLACK = 5.0  # time in s after which a body is cut off that the guard does not read


def limited_protocol(limits: ServerLimits) -> type[H11Protocol]:
    """Return the protocol of connections with these limits."""

    class LimitedProtocol(_LimitedProtocol):
        """The protocol with the limits of this server."""

        _limits = limits

    return LimitedProtocol


class _LimitedProtocol(H11Protocol):
    """HTTP/1.1 that closes connections whose client is too slow."""

    _limits: ServerLimits

    def __init__(self, *arguments: Any, **keywords: Any) -> None:
        super().__init__(*arguments, **keywords)
        self._awaited: Any = None  # part of a request that is awaited: IDLE (the head) or SEND_BODY
        self._timer: asyncio.TimerHandle | None = None
        self._unread: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        # Head and body of a response are written separately. The system would hold back the body
        # until the client has acknowledged the head, which takes 40 ms.
        transport.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._await(h11.IDLE)
        if len(self.connections) > self._limits.connections:
            self._make_room()

    def connection_lost(self, exc: Exception | None) -> None:
        self._await(None)
        self._stop_unread()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        state = self.conn.their_state
        self._await(state if state in (h11.IDLE, h11.SEND_BODY) else None)

    def send_400_response(self, msg: str) -> None:
        """Answer by a problem, where uvicorn would answer by a line of text."""
        refusal = problem_response(400, MALFORMED)
        refusal.headers.update(HEADERS | {"cache-control": "no-store", "connection": "close"})
        for event in (
            h11.Response(status_code=400, headers=refusal.raw_headers, reason=b"Bad Request"),
            h11.Data(data=bytes(refusal.body)),
            h11.EndOfMessage(),
        ):
            self.transport.write(self.conn.send(event))
        self.transport.close()

    def pause_writing(self) -> None:
        """Note that the client does not read what has been sent."""
        super().pause_writing()
        self._stop_unread()
        self._unread = self.loop.call_later(self._limits.body_seconds, self._abort)

    def resume_writing(self) -> None:
        super().resume_writing()
        self._stop_unread()

    @property
    def awaits_head(self) -> bool:
        """True if no request has arrived completely, or none after a response."""
        return self._awaited is h11.IDLE or self.timeout_keep_alive_task is not None

    def _await(self, state: Any) -> None:
        """Start the clock of a state, unless it is running already; None stops it."""
        if state is self._awaited:
            return
        self._awaited = state
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if state is not None:
            head = state is h11.IDLE
            seconds = self._limits.header_seconds if head else self._limits.body_seconds + SLACK
            self._timer = self.loop.call_later(seconds, self._abort)

    def _make_room(self) -> None:
        """Close the connection that has waited longest for the head of a request, or this one."""
        waiting = [
            each for each in self.connections
            if isinstance(each, _LimitedProtocol) and each.awaits_head and each is not self
        ]  # fmt: skip
        oldest = min(waiting, key=lambda each: each._deadline, default=self)
        oldest._abort()

    @property
    def _deadline(self) -> float:
        return 0.0 if self._timer is None else self._timer.when()

    def _stop_unread(self) -> None:
        if self._unread is not None:
            self._unread.cancel()
            self._unread = None

    def _abort(self) -> None:
        self.transport.abort()
