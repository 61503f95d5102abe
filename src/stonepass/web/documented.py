"""Responses that the OpenAPI description lists for every route."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from stonepass.web.answers import PROBLEM_TYPE, TITLES, Problem

__all__ = ["BUSY", "PROBLEMS", "JobDocument", "UploadDocument"]

_SCHEMA = {"$ref": "#/components/schemas/Problem"}


def _documented(*statuses: int) -> dict[int | str, dict[str, Any]]:
    return {
        status: {
            "description": f"{TITLES[status]}.",
            "content": {PROBLEM_TYPE: {"schema": _SCHEMA}},
        }
        for status in statuses
    }


PROBLEMS = _documented(400, 401, 403, 404, 405, 408, 413, 415, 421, 422)
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
