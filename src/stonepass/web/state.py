"""The state that the server holds in memory while it runs."""

from __future__ import annotations

from dataclasses import dataclass, field

from fastapi import Request

from stonepass.web.jobs.book import JobBook
from stonepass.web.rate import RequestRate
from stonepass.web.settings import ServerSettings
from stonepass.web.uploads.store import UploadStore

__all__ = ["ServerState", "client_of", "state_of"]


@dataclass
class ServerState:
    """Jobs, uploaded files and counters of requests.

    Attributes
    ----------
    settings : ServerSettings
    book : JobBook
    uploads : UploadStore
    rate : RequestRate
    reading : int
        Number of uploads that are being received or read.
    streams : int
        Number of open streams of events.
    """

    settings: ServerSettings
    book: JobBook
    uploads: UploadStore
    rate: RequestRate
    reading: int = field(default=0)
    streams: int = field(default=0)

    @classmethod
    def of(cls, settings: ServerSettings) -> ServerState:
        """Return the state of a server that has just started."""
        limits = settings.limits
        return cls(settings, JobBook(settings), UploadStore(limits), RequestRate(limits.per_minute))


def state_of(request: Request) -> ServerState:
    """Return the state of the server that received a request."""
    state: ServerState = request.app.state.server
    return state


def client_of(request: Request) -> str:
    """Return the address of the client of a request."""
    return request.client.host if request.client is not None else ""
