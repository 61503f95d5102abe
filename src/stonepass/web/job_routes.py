"""Routes of jobs: ask, follow, cancel; and of reports to print, which are jobs too."""

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
from stonepass.web.jobs.bodies import JobBody, ReportBody
from stonepass.web.jobs.book import QueueFull
from stonepass.web.jobs.job import ServerJob, Status
from stonepass.web.state import ServerState, client_of, state_of
from stonepass.web.uploads.store import Upload

__all__ = ["reports", "router"]

EVENTS = "text/event-stream"
PAUSE = 15.0  # seconds after which a stream of events shows that it is alive
GONE = "There is no job with this id; ask the question again."
MEDIA = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
REPORT = {"content": {each: {} for each in MEDIA.values()}, "description": "the report"}
reports = APIRouter(prefix="/api/v1", tags=["reports"], responses=PROBLEMS)
router = APIRouter(prefix="/api/v1/jobs", tags=["jobs"], responses=PROBLEMS)
Identity = Annotated[str, InPath(description="id of the job", max_length=64)]


@router.post("", status_code=202, responses=BUSY | {202: {"model": JobDocument}},
             summary="Ask a question that takes seconds")  # fmt: skip
async def ask(body: Annotated[JobBody, Body()], request: Request) -> Json:
    """Queue a question for a worker process.

    The id is the fingerprint of the question, so that a repeated question has the same id and is
    answered at once if the first one has been answered.
    """
    found = await _queued(body, request)
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


@reports.post("/report", responses=BUSY | {200: REPORT}, response_class=Response,
              summary="Report to print")  # fmt: skip
async def report(body: ReportBody, request: Request) -> Response:
    """Answer a question with a report to print, as one HTML file or as PDF.

    The question is solved by a worker process unless its states are in the solution cache, so that
    the response may take as long as the job.
    """
    job = await _queued(body.question, request, body.kind)
    await job.ended()
    if job.problem is not None:
        problem = job.problem
        raise ProblemError(problem["status"], problem["detail"], problem.get("field"))
    if job.status is not Status.DONE:
        raise ProblemError(410, "The job was cancelled.")
    name = f"stonepass-{body.question.kind}-{job.id[:8]}.{body.kind}"
    return Response(
        job.report,
        media_type=MEDIA[body.kind],
        headers={
            "content-disposition": f'attachment; filename="{name}"',
            "content-security-policy": "sandbox; default-src 'none'; img-src data:; "
            "style-src 'unsafe-inline'",
        },
    )


async def _queued(body: Any, request: Request, form: str = "") -> ServerJob:
    """Return the job that answers a question, and put it into the queue if it is new.

    Parameters
    ----------
    body : JobBody
    request : Request
    form : str
        Format of the report to print; empty for no report.
    """
    state = state_of(request)
    state.rate.take(client_of(request))
    asked = await asyncio.to_thread(body.question)
    content = body.model_dump(mode="json")
    job = ServerJob(_fingerprint(body.kind, asked, form), body.kind, content, format=form)
    if body.UPLOAD and not _answering(state.book.get(job.id)):
        job.upload = _upload(state, body.UPLOAD, body.upload)
    try:
        return state.book.add(job)
    except QueueFull as problem:
        wait = str(problem.retry_after)
        raise ProblemError(
            429,
            f"The queue of jobs is full; ask again in {wait} s.",
            headers={"retry-after": wait},
        ) from None


def _fingerprint(kind: str, asked: dict[str, Any], form: str) -> str:
    """Return the digest of everything that an answer depends on."""
    document = {"kind": kind, "asked": asked, "format": form, "version": VERSION}
    text = json.dumps(document, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _answering(job: ServerJob | None) -> bool:
    return job is not None and job.status not in (Status.FAILED, Status.CANCELLED)


def _upload(state: ServerState, kind: str, identity: str) -> Upload:
    found = state.uploads.get(identity)
    if found is None or found.kind != kind:
        raise ProblemError(
            410, f"There is no upload for '{kind}' with this id; upload the file again.", "upload"
        )
    return found


def _job(request: Request, identity: str) -> ServerJob:
    found = state_of(request).book.get(identity)
    if found is None:
        raise ProblemError(404, GONE)
    return found


async def _events(job: ServerJob, state: ServerState) -> AsyncIterator[bytes]:
    state.streams += 1
    try:
        async for document in job.changes(PAUSE):
            if document is None:
                yield b": alive\n\n"
            else:
                yield b"event: job\ndata: " + bytes(Json(document).body) + b"\n\n"
    finally:
        state.streams -= 1
