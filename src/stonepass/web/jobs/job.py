"""A job: its question, its state, and the clients that follow it."""

from __future__ import annotations

import asyncio
import enum
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from typing import Any

from stonepass.web.uploads.store import Upload

__all__ = ["ServerJob", "Status"]


class Status(enum.Enum):
    """The state of a job."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def ended(self) -> bool:
        """True if the state does not change any more."""
        return self not in (Status.QUEUED, Status.RUNNING)


@dataclass(eq=False)
class ServerJob:
    """A question that a worker process answers.

    Attributes
    ----------
    id : str
        Fingerprint of the question.
    kind : str
    body : dict
        The JSON-ready body of the request; it is dropped when the job ends.
    upload : Upload or None
        The file that the question is about; it is dropped when the job ends.
    status : Status
    progress : dict
        ``done`` and ``total`` steps (0 if unknown), and a ``sentence``.
    format : str
        Format of the report to print, ``html`` or ``pdf``; empty for no report.
    result : dict or None
    report : bytes
        The report; empty if there is none.
    size : int
        Number of bytes of result, as JSON, and report.
    problem : dict or None
        Why the job failed.
    ended_at : float
        Time of the event loop at which the job ended.
    """

    id: str
    kind: str
    body: dict[str, Any]
    upload: Upload | None = None
    format: str = ""
    status: Status = Status.QUEUED
    progress: dict[str, Any] = field(
        default_factory=lambda: {"done": 0, "total": 0, "sentence": "Waiting for a worker."}
    )
    result: dict[str, Any] | None = None
    report: bytes = b""
    size: int = 0
    problem: dict[str, Any] | None = None
    ended_at: float = 0.0
    _changed: asyncio.Event = field(default_factory=asyncio.Event)

    def change(self, **values: Any) -> None:
        """Set attributes and wake all clients that follow the job."""
        for name, value in values.items():
            setattr(self, name, value)
        self._changed.set()
        self._changed = asyncio.Event()

    def document(self) -> dict[str, Any]:
        """Return the state of the job as JSON-ready dictionary."""
        found: dict[str, Any] = {
            "id": self.id,
            "kind": self.kind,
            "status": self.status.value,
            "progress": self.progress,
            "links": {
                "self": f"/api/v1/jobs/{self.id}",
                "events": f"/api/v1/jobs/{self.id}/events",
            },
        }
        if self.result is not None:
            found["result"] = self.result
        if self.problem is not None:
            found["problem"] = self.problem
        return found

    async def ended(self) -> None:
        """Wait until the job has ended."""
        while not self.status.ended:
            await self._changed.wait()

    async def changes(self, pause: float) -> AsyncIterator[dict[str, Any] | None]:
        """Yield the state now and after every change until the job has ended.

        None is yielded if nothing has changed for `pause` seconds.
        """
        while True:
            changed = self._changed
            yield self.document()
            if self.status.ended:
                return
            while not changed.is_set():
                try:
                    await asyncio.wait_for(changed.wait(), pause)
                except TimeoutError:
                    yield None
