"""Routes of jobs: ask, follow, cancel."""

from __future__ import annotations

import asyncio
import hashlib
import json
from collections.abc import AsyncIterator
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from fastapi import Path as InPath
from starlette.responses import Response, StreamingResponse

from stonepass.about import VERSION
from stonepass.web.answers import Json, ProblemError
from stonepass.web.documented import BUSY, PROBLEMS, JobDocument
from stonepass.web.jobs.bodies import JobBody
from stonepass.web.jobs.book import QueueFull
from stonepass.web.jobs.job import Job, Status
from stonepass.web.state import ServerState, client_of, state_of
from stonepass.web.uploads.store import Upload

__all__ = ["router"]

EVENTS = "text/event-stream"
PAUSE = 15.0  # seconds after which a stream of events shows that it is alive
GONE = "There is no job with this id; ask the question again."
router = APIRouter(prefix="/api/v1/jobs", tags=["jobs"], responses=PROBLEMS)
Identity = Annotated[str, InPath(description="id of the job", max_length=64)]


@router.post("", status_code=202, responses=BUSY | {202: {"model": JobDocument}},
             summary="Ask a question that takes seconds")  # fmt: skip
async def ask(body: Annotated[JobBody, Body()], request: Request) -> Json:
    """Queue a question for a worker process.

    The id is the fingerprint of the question, so that a repeated question has the same id and is
    answered at once if the first one has been answered.
    """
    state = state_of(request)
    state.rate.take(client_of(request))
    asked = await asyncio.to_thread(body.question)
    job = Job(_fingerprint(body.kind, asked), body.kind, body.model_dump(mode="json"))
    if body.UPLOAD and not _answering(state.book.get(job.id)):
        job.upload = _upload(state, body.UPLOAD, getattr(body, "upload", ""))
    try:
        found = state.book.add(job)
    except QueueFull as problem:
        wait = str(problem.retry_after)
        raise ProblemError(
            429,
            f"The queue of jobs is full; ask again in {wait} s.",
            headers={"retry-after": wait},
        ) from None
    return Json(found.document(), 202, {"location": f"/api/v1/jobs/{found.id}"})


@router.get("/{identity}", responses={200: {"model": JobDocument}}, summary="State of a job")
async def show(identity: Identity, request: Request) -> Json:
    """Return the state of a job, and its result if it is done."""
    return Json(_job(request, identity).document())


@router.get(
    "/{identity}/events",
    responses=BUSY | {200: {"content": {EVENTS: {}}, "description": "states of the job"}},
    response_class=StreamingResponse,
    summary="States of a job as server-sent events",
)
async def follow(identity: Identity, request: Request) -> Response:
    """Send the state of a job now and after every change, until it has ended."""
    job, state = _job(request, identity), state_of(request)
    if state.streams >= state.settings.limits.streams:
        raise ProblemError(
            429, "Too many streams of events are open.", headers={"retry-after": "10"}
        )
    return StreamingResponse(_events(job, state), media_type=EVENTS)


@router.delete("/{identity}", responses={200: {"model": JobDocument}}, summary="Cancel a job")
async def cancel(identity: Identity, request: Request) -> Json:
    """Cancel a job that waits or runs; forget the result of one that has ended."""
    job = _job(request, identity)
    await state_of(request).book.cancel(job)
    return Json(job.document())


def _fingerprint(kind: str, asked: dict[str, Any]) -> str:
    """Return the digest of everything that an answer depends on."""
    text = json.dumps({"kind": kind, "asked": asked, "version": VERSION}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _answering(job: Job | None) -> bool:
    return job is not None and job.status not in (Status.FAILED, Status.CANCELLED)


def _upload(state: ServerState, kind: str, identity: str) -> Upload:
    found = state.uploads.get(identity)
    if found is None or found.kind != kind:
        raise ProblemError(
            410, f"There is no upload for '{kind}' with this id; upload the file again.", "upload"
        )
    return found


def _job(request: Request, identity: str) -> Job:
    found = state_of(request).book.get(identity)
    if found is None:
        raise ProblemError(404, GONE)
    return found


async def _events(job: Job, state: ServerState) -> AsyncIterator[bytes]:
    state.streams += 1
    try:
        async for document in job.changes(PAUSE):
            if document is None:
                yield b": alive\n\n"
            else:
                yield b"event: job\ndata: " + bytes(Json(document).body) + b"\n\n"
    finally:
        state.streams -= 1
