"""Routes that answer at once: information, and the instant answer."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request

from stonepass.web import information
from stonepass.web.answers import Json
from stonepass.web.bodies import InstantBody
from stonepass.web.documented import PROBLEMS, InstantDocument
from stonepass.web.instant.answer import instant_answer
from stonepass.web.state import state_of

__all__ = ["router"]

router = APIRouter(prefix="/api/v1", responses=PROBLEMS)


@router.get("", tags=["information"], summary="Name, version and addresses")
def about() -> Json:
    """Return name, version, notice and addresses."""
    return Json(information.about())


@router.get("/inputs", tags=["information"], summary="Declared inputs of a case")
def inputs() -> Json:
    """Return every input of a case: section, name, kind, unit, bounds, default and meaning."""
    return Json(information.inputs())


@router.get("/materials", tags=["information"], summary="Materials of the catalogue")
def materials() -> Json:
    """Return the materials with their constants and sources."""
    return Json(information.materials())


@router.get("/laws", tags=["information"], summary="Laws that can be fitted")
def laws() -> Json:
    """Return the material laws with the declarations of their constants."""
    return Json(information.laws())


@router.get("/pressure-limits", tags=["information"], summary="Published pressure limits")
def pressure_limits() -> Json:
    """Return the published pressure limits with their sources."""
    return Json(information.pressure_limits())


@router.get("/glossary", tags=["information"], summary="Words and their meanings")
def glossary() -> Json:
    """Return the words of the documentation with their meanings."""
    return Json(information.glossary())


@router.post(
    "/instant",
    tags=["answers"],
    summary="Answer of a surrogate",
    responses={200: {"model": InstantDocument}},
)
def instant(body: InstantBody, request: Request) -> Json:
    """Answer by a surrogate within milliseconds, with curve, map and section if asked.

    Outside the range of the surrogate `answer` has no number; `validity` and `warnings` say why.
    """
    asked: dict[str, Any] = body.model_dump(exclude_unset=True)
    address = f"{request.url.scheme}://{request.headers['host']}"
    token = bool(state_of(request).settings.token)
    return Json(instant_answer(body.question(), asked, address, token=token))
