"""Responses that the OpenAPI description lists for every route."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from stonepass.web.answers import PROBLEM_TYPE, TITLES, Problem

__all__ = ["BUSY", "PROBLEMS", "InstantDocument", "JobDocument", "UploadDocument"]

_SCHEMA = {"$ref": "#/components/schemas/Problem"}


def _documented(*statuses: int) -> dict[int | str, dict[str, Any]]:
    return {
        status: {
            "description": f"{TITLES[status]}.",
            "content": {PROBLEM_TYPE: {"schema": _SCHEMA}},
        }
        for status in statuses
    }


PROBLEMS = _documented(400, 401, 403, 404, 405, 408, 413, 415, 421, 422, 431)
BUSY = _documented(409, 410, 429)
assert Problem.__name__ == _SCHEMA["$ref"].rpartition("/")[2]


class ProgressDocument(BaseModel):
    """How far a job is."""

    model_config = ConfigDict(extra="forbid")

    done: int = Field(description="steps done")
    total: int = Field(description="steps in total; 0 if unknown")
    sentence: str = Field(description="what is being done")


class JobDocument(BaseModel):
    """The state of a job."""

    model_config = ConfigDict(extra="forbid")

    id: str = Field(description="fingerprint of the question")
    kind: str = Field(description="kind of the job")
    status: Literal["queued", "running", "done", "failed", "cancelled"]
    progress: ProgressDocument
    links: dict[str, str]
    result: dict[str, Any] | None = Field(
        None,
        description="the record that the command of this kind prints with --json, with additions",
    )
    problem: Problem | None = Field(None, description="why the job failed")


class UploadDocument(BaseModel):
    """An uploaded file."""

    model_config = ConfigDict(extra="forbid")

    id: str = Field(description="digest of the file, which a job names")
    kind: str = Field(description="kind of the job that may use it")
    summary: dict[str, Any] = Field(
        description="of a table: test, rows, columns, ranges and sizes at rest that are needed; of "
        "a picture: width, height, pixel size, area of the surface and notes"
    )
    links: dict[str, str]


class WarningDocument(BaseModel):
    """A warning about the inputs of an answer."""

    model_config = ConfigDict(extra="forbid")

    code: str = Field(description="code of the warning, which does not change with its sentence")
    sentence: str
    input: str = Field(description="key of the input that causes it")


class RangeDocument(BaseModel):
    """The range of an input within which the instant answer exists, in SI units."""

    model_config = ConfigDict(extra="forbid")

    low: float
    high: float
    value: float
    inside: bool
    sentence: str


class InstantDocument(BaseModel):
    """The answer of a surrogate."""

    model_config = ConfigDict(extra="forbid")

    answer: dict[str, Any] | None = Field(
        description="the record of `stonepass surrogate evaluate` with message, sentence, model, "
        "material and source; null if no surrogate describes the case"
    )
    size: dict[str, Any] | None = Field(
        description="the largest stone that moves at the limit: outcome, message, sentence, "
        "critical size ratio and diameter, or lower bounds; null without a limit"
    )
    curve: dict[str, list[Any]] | None = Field(
        None, description="lists over the size of the stone; numbers that do not exist are null"
    )
    map: dict[str, Any] | None = Field(
        None,
        description="critical pressure on a grid of size ratio and wall ratio; with a limit, also "
        "the size ratio of the largest stone that moves, for each wall ratio",
    )
    section: dict[str, Any] | None = Field(
        None, description="outlines of stone and wall in inner radii, and the contact pressure"
    )
    validity: dict[str, RangeDocument] = Field(description="valid range of each input by its key")
    warnings: list[WarningDocument]
    repeat: dict[str, str | None] = Field(
        description="command line, Python code and request that repeat the answer and the solve"
    )
    notice: str
    version: str
    fingerprint: str = Field(description="digest of the case")
