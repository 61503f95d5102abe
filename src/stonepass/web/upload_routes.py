"""Routes of uploaded files."""

from __future__ import annotations

import asyncio
from typing import Annotated, Literal

from fastapi import APIRouter, Query, Request
from fastapi import Path as InPath
from starlette.responses import Response

from stonepass.errors import BadInput
from stonepass.surface.height_maps import HEIGHT_MAPS
from stonepass.surface.surface_image import read_area
from stonepass.web.answers import Json, ProblemError
from stonepass.web.documented import BUSY, PROBLEMS, UploadDocument
from stonepass.web.state import ServerState, client_of, state_of
from stonepass.web.uploads.store import Upload, read_upload

__all__ = ["router"]

AT_ONCE = 4  # largest number of uploads that are received or read at the same time
ANY = "application/octet-stream"
# Content types of each kind, and the ending under which such a file is read.
TYPES = {
    "fit": {"text/csv": ".csv", "text/plain": ".csv", "application/csv": ".csv", ANY: ".csv",
            "application/vnd.ms-excel": ".csv"},
    "friction": {"image/png": ".png", "image/jpeg": ".jpg", "image/tiff": ".tif", ANY: ".bin"},
}  # fmt: skip
FORMATS = tuple(sorted({each.removeprefix(".") for each in HEIGHT_MAPS}))
GONE = "There is no upload with this id."
BODY = {
    "requestBody": {
        "required": True,
        "content": {
            kind: {"schema": {"type": "string", "format": "binary"}}
            for kind in sorted({each for types in TYPES.values() for each in types})
        },
    }
}
router = APIRouter(prefix="/api/v1/uploads", tags=["uploads"], responses=PROBLEMS | BUSY)
Identity = Annotated[str, InPath(description="id of the upload", max_length=64)]


@router.post("/{kind}", status_code=201, responses={201: {"model": UploadDocument}},
             openapi_extra=BODY, summary="Upload a file for a job")  # fmt: skip
async def upload(
    kind: Annotated[Literal["fit", "friction"], InPath(description="kind of the job")],
    request: Request,
    format: Annotated[
        str | None, Query(description="format of a height map, e.g. x3p", max_length=8)
    ] = None,
    area: Annotated[
        str | None,
        Query(
            description="part of a picture that shows the surface: left,top,right,bottom in "
            "pixels; only this part must be grey",
            max_length=40,
        ),
    ] = None,
) -> Json:
    """Read a table of a test, or a picture or height map of a surface, in the sandbox.

    The body is the file itself. It is held in memory for some minutes and written nowhere.
    """
    state = state_of(request)
    state.rate.take(client_of(request))
    ending = _ending(kind, request.headers.get("content-type", ""), format)
    if area is not None and kind != "friction":
        raise BadInput("area", area, "left out, because a table has no area")
    part = None if area is None else read_area(area)
    if state.reading >= AT_ONCE:
        raise ProblemError(
            429, "Too many files are being uploaded; try again.", headers={"retry-after": "2"}
        )
    state.reading += 1
    try:
        content = await request.body()
        if not content:
            raise BadInput("body", "empty", "the content of a file")
        found = await asyncio.to_thread(read_upload, kind, ending, content, part)
    finally:
        state.reading -= 1
    state.uploads.add(found)
    return Json(_document(found), 201)


@router.get(
    "/{identity}/preview",
    response_class=Response,
    summary="Picture of an upload",
    responses={200: {"content": {"image/png": {}}, "description": "the picture"}},
)
async def preview(identity: Identity, request: Request) -> Response:
    """Return the picture as PNG; its pixels are every `preview_step`-th pixel of the file."""
    found = _held(state_of(request), identity)
    if not found.preview:
        raise ProblemError(404, "A table has no picture.")
    return Response(found.preview, media_type="image/png")


@router.delete("/{identity}", status_code=204, summary="Drop an upload", response_class=Response)
async def drop(identity: Identity, request: Request) -> Response:
    """Drop an uploaded file at once."""
    state = state_of(request)
    _held(state, identity)
    state.uploads.drop(identity)
    return Response(status_code=204)


def _ending(kind: str, content_type: str, format: str | None) -> str:
    """Return the ending under which a file is read; the name that a client gave it is not used."""
    if format is not None:
        if kind != "friction" or format not in FORMATS:
            raise BadInput("format", format, "one of " + ", ".join(FORMATS) + " for a height map")
        return f".{format}"
    found = TYPES[kind].get(content_type.partition(";")[0].strip().lower())
    if found is None:
        allowed = " or ".join(sorted(TYPES[kind]))
        raise ProblemError(415, f"The content type must be {allowed}.", "Content-Type")
    return found


def _held(state: ServerState, identity: str) -> Upload:
    found = state.uploads.get(identity)
    if found is None:
        raise ProblemError(404, GONE)
    return found


def _document(found: Upload) -> dict[str, object]:
    links = {"preview": f"/api/v1/uploads/{found.id}/preview"} if found.preview else {}
    return {"id": found.id, "kind": found.kind, "summary": found.summary, "links": links}
