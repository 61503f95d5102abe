"""Responses of the API: JSON without NaN, and problems as RFC 9457 describes them."""

from __future__ import annotations

import json
from typing import Any

from fastapi import Response
from pydantic import BaseModel, ConfigDict, Field

from stonepass.errors import BadInput
from stonepass.inputs.build import in_words
from stonepass.web.problem_fields import field_of, part_of_table

__all__ = [
    "FAULT",
    "Json",
    "Problem",
    "ProblemError",
    "problem_document",
    "problem_response",
    "refused",
]

PROBLEM_TYPE = "application/problem+json"
LONGEST_VALUE = 200  # characters of a refused value that a problem repeats
FAULT = "This is an error of stonepass; please report it together with your request."
TITLES = {
    400: "The request cannot be read",
    401: "The token is missing or wrong",
    403: "The request is not allowed",
    404: "There is nothing at this address",
    405: "The method is not allowed here",
    408: "The request did not arrive in time",
    409: "The job ended without an answer",
    410: "What was here is gone",
    413: "The request is too large",
    415: "The content type is not supported",
    421: "The request is addressed to another host",
    422: "An input is refused",
    429: "There are too many requests",
    431: "The headers of the request are too large",
    500: "This is an error of stonepass",
}


class Problem(BaseModel):
    """A problem with a request, as RFC 9457 describes it."""

    model_config = ConfigDict(extra="forbid")

    type: str = Field(description="kind of the problem; always about:blank")
    title: str = Field(description="the problem in general")
    status: int = Field(description="status code of the response")
    detail: str = Field(description="the problem in one sentence")
    field: str | None = Field(None, description="input that is refused, e.g. stone.diameter")
    value: str | None = Field(None, description="refused value as text, shortened")


class ProblemError(Exception):
    """An error that ends a request with a problem.

    Attributes
    ----------
    status : int
        Status code of the response.
    detail : str
        The problem in one sentence.
    field : str or None
        The input that is refused.
    headers : dict of str to str
        Further headers of the response.
    """

    def __init__(
        self,
        status: int,
        detail: str,
        field: str | None = None,
        headers: dict[str, str] | None = None,
    ) -> None:
        super().__init__(detail)
        self.status, self.detail, self.field = status, detail, field
        self.headers = headers or {}


class Json(Response):
    """A JSON response in ASCII, so that any text a client sent can be repeated."""

    media_type = "application/json"

    def render(self, content: Any) -> bytes:
        """Return the content as JSON; NaN and infinity raise `ValueError`."""
        return json.dumps(content, allow_nan=False, separators=(",", ":")).encode("ascii")


def problem_response(
    status: int,
    detail: str,
    field: str | None = None,
    value: Any = None,
    headers: dict[str, str] | None = None,
) -> Response:
    """Return a response that describes a problem.

    Parameters
    ----------
    status : int
        Status code.
    detail : str
        The problem in one sentence.
    field : str, optional
        The input that is refused.
    value : object, optional
        The refused value.
    headers : dict of str to str, optional
        Further headers.
    """
    document = problem_document(status, detail, field, value)
    return Json(document, status, headers, PROBLEM_TYPE)


def problem_document(
    status: int, detail: str, field: str | None = None, value: Any = None
) -> dict[str, Any]:
    """Return the JSON-ready description of a problem; for the parameters see `problem_response`."""
    document: dict[str, Any] = {
        "type": "about:blank",
        "title": TITLES.get(status, "The request failed"),
        "status": status,
        "detail": detail,
    }
    if field is not None:
        document["field"] = field
    if value is not None:
        document["value"] = str(value)[:LONGEST_VALUE]
    return document


def refused(problem: BadInput, field: str | None = None) -> Response:
    """Return the response to a request with an invalid input.

    Parameters
    ----------
    problem : BadInput
        The error.
    field : str, optional
        The input that is refused; by default the one that the error is about.
    """
    field = field or field_of(problem)
    part = part_of_table(problem.argument)  # a part of an input is named beside the input
    word = field if part is None else f"{field}, {part}"
    named = in_words(problem, {} if field is None or word is None else {problem.argument: word})
    return problem_response(422, str(named), field, named.value)
