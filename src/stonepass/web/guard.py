"""The outermost layer of the server: who may ask what, how much, how slowly; headers of responses.

Every request passes these checks before any of its body is read:

* the host it is addressed to is one of this server (against DNS rebinding);
* a request that changes something comes from a page of this server, or from no page at all;
* it has the token, if the server has one;
* its body is not larger than allowed, and arrives in time.
"""

from __future__ import annotations

import asyncio
import os
import secrets
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs, urlsplit

from starlette.responses import RedirectResponse, Response

from stonepass.web.answers import FAULT, problem_response
from stonepass.web.settings import ServerSettings

__all__ = ["COOKIE", "HEADERS", "POLICY", "Guard"]

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

COOKIE = "stonepass_token"
READING = ("GET", "HEAD", "OPTIONS")
UPLOADS = "/api/v1/uploads/"
POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "font-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'none'",
    )
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), geolocation=(), microphone=()",
    "x-frame-options": "DENY",
}


class _Unread(Exception):
    """The body of a request is larger than allowed, or did not arrive in time."""


@dataclass(frozen=True)
class Guard:
    """An ASGI application that checks every request before another application answers it.

    Attributes
    ----------
    app : ASGI application
        Answers the requests that pass.
    settings : ServerSettings
    """

    app: App
    settings: ServerSettings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request; other kinds of connections are passed on or refused."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        elif scope["type"] == "http":
            await self._answer(scope, receive, _with_headers(send, scope["path"]))
        else:
            await send({"type": "websocket.close", "code": 1008})

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        headers = _headers(scope)
        refusal = self._refusal(scope, headers)
        if refusal is not None:
            await refusal(scope, receive, send)
            return
        body = _LimitedBody(receive, self._most(scope), self.settings.limits.body_seconds)
        begun = False

        async def sending(message: Message) -> None:
            """Send a response, unless it is about a body that was not read to its end."""
            nonlocal begun
            if begun or not body.failed:
                begun = True
                await send(message)

        try:
            await self.app(scope, body.receive, sending)
        except _Unread:
            pass
        except Exception:  # an error of the program; its traceback could contain a request
            if os.environ.get("STONEPASS_DEBUG"):
                raise
            if not begun and not body.failed:
                await problem_response(500, FAULT)(scope, receive, send)
        if body.failed and not begun:
            refusal = problem_response(body.failed, self._why(scope, body.failed))
            refusal.headers["connection"] = "close"  # the rest of the body is not read
            await refusal(scope, receive, send)

    def _refusal(self, scope: Scope, headers: Mapping[str, str]) -> Response | None:
        """Return the response to a request that must not be answered, else None."""
        most = self.settings.limits.head
        if sum(len(name) + len(value) for name, value in scope["headers"]) > most:
            return problem_response(
                431, f"The headers of a request must have at most {most} bytes."
            )
        host = headers.get("host", "")
        if _name_of(host) not in self.settings.allowed_hosts:
            return problem_response(
                421, "The request is addressed to a host that is not this server; 'stonepass "
                "serve --allow-host NAME' adds a name.", "Host", host)  # fmt: skip
        if scope["method"] not in READING and not _same_origin(headers, host):
            return problem_response(
                403,
                "A request that changes something must come from a page of this server or from a "
                "program, not from another page.",
                "Origin",
                headers.get("origin"),
            )
        if self.settings.token:
            entering = self._entering(scope)
            if entering is not None:
                return entering
            if not self._has_token(headers):
                return problem_response(
                    401, "The request needs the token of this server, as the header "
                    "'Authorization: Bearer TOKEN'.",
                    headers={"www-authenticate": "Bearer"})  # fmt: skip
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length[:20]) > self._most(scope):
            refusal = problem_response(413, self._why(scope, 413))
            refusal.headers["connection"] = "close"
            return refusal
        return None

    def _has_token(self, headers: Mapping[str, str]) -> bool:
        """Return True if a request has the token, in its header or in the cookie of the page."""
        kind, _, given = headers.get("authorization", "").partition(" ")
        if kind.lower() == "bearer" and self._is_token(given):
            return True
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            return False
        return cookie is not None and self._is_token(cookie.value)

    def _is_token(self, given: str) -> bool:
        return secrets.compare_digest(given.encode(), self.settings.token.encode())

    def _entering(self, scope: Scope) -> Response | None:
        """Return a redirection to the page, with a cookie, for the address with the token."""
        if scope["path"] != "/" or scope["method"] != "GET":
            return None
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        if not given or not self._is_token(given):
            return None
        response = RedirectResponse("/", status_code=303)
        response.set_cookie(COOKIE, self.settings.token, httponly=True, samesite="strict")
        return response

    def _most(self, scope: Scope) -> int:
        limits = self.settings.limits
        return limits.upload if scope["path"].startswith(UPLOADS) else limits.body

    def _why(self, scope: Scope, status: int) -> str:
        if status == 413:
            return f"The body of the request must have at most {self._most(scope)} bytes."
        seconds = self.settings.limits.body_seconds
        return f"The body of the request did not arrive within {seconds:g} s."


class _LimitedBody:
    """The body of a request, which is read only as far as it is small and in time.

    Attributes
    ----------
    failed : int
        Status of the response if the body is too large or too slow, otherwise 0.
    """

    def __init__(self, receive: Receive, most: int, seconds: float) -> None:
        self.failed = 0
        self._receive, self._most, self._count = receive, most, 0
        self._last = asyncio.get_running_loop().time() + seconds
        self._complete = False

    async def receive(self) -> Message:
        """Return the next part of the body; after the body, wait for the end of the connection."""
        if self._complete:
            return await self._receive()
        left = self._last - asyncio.get_running_loop().time()
        try:
            message = await asyncio.wait_for(self._receive(), max(0.0, left))
        except TimeoutError:
            self.failed = 408
            raise _Unread from None
        if message["type"] == "http.request":
            self._count += len(message.get("body", b""))
            self._complete = not message.get("more_body", False)
        if self._count > self._most:
            self.failed = 413
            raise _Unread
        return message


def _headers(scope: Scope) -> dict[str, str]:
    """Return the headers by lower-case name; the values of repeated headers are joined."""
    found: dict[str, str] = {}
    for name, value in scope["headers"]:
        key = name.decode("latin-1").lower()
        text = value.decode("latin-1")
        found[key] = f"{found[key]}, {text}" if key in found else text
    return found


def _name_of(host: str) -> str:
    """Return the name of a Host header in lower case, without its port."""
    name, colon, port = host.rpartition(":")
    return (name if colon and port.isdecimal() else host).lower()


def _same_origin(headers: Mapping[str, str], host: str) -> bool:
    """Return True if a request comes from a page of this server, or from no page."""
    if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
        return False
    origin = headers.get("origin")
    if origin is None:
        return True
    try:
        parts = urlsplit(origin)
    except ValueError:
        return False
    return parts.scheme in ("http", "https") and parts.netloc.lower() == host.lower()


def _with_headers(send: Send, path: str) -> Send:
    """Return a sender that adds the headers of security to every response."""
    kept = path.startswith("/assets/")

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            own = {name.lower() for name, _ in message["headers"]}
            added = HEADERS | {"cache-control": "no-cache" if kept else "no-store"}
            message["headers"] = [
                *message["headers"],
                *((n.encode(), v.encode()) for n, v in added.items() if n.encode() not in own),
            ]
        await send(message)

    return sending
