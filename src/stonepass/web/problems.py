"""Handlers that turn every error of a request into a problem with one sentence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException

from stonepass.errors import BadInput, did_you_mean
from stonepass.inputs.catalogue import all_inputs, sections
from stonepass.web.answers import FAULT, ProblemError, problem_response, refused
from stonepass.web.case_body import TABLES
from stonepass.web.jobs.worker import MODULES

__all__ = ["handle_problems"]

ALLOWED = {
    "missing": "given",
    "string_type": "text",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "list_type": "a list",
    "dict_type": "an object",
    "model_type": "an object",
    "model_attributes_type": "an object",
    "string_pattern_mismatch": "the id of an uploaded file",
    "union_tag_not_found": "given",
}
TAGS = ("union_tag_invalid", "union_tag_not_found")
NO_JSON = "The body of the request must be JSON, with the content type application/json."
# Parts at the beginning and at the end of the location of an error that are no keys of an input.
CONTAINERS = ("case", "patient", "question", *MODULES)
TYPES = ("str", "dict[str,any]", "float")
SENTENCES = {
    404: "There is nothing at this address; GET /api/v1 lists the addresses.",
    405: "This method is not allowed at this address; GET /api/v1/openapi.json lists the methods.",
}


def handle_problems(app: FastAPI) -> None:
    """Register the handlers of an application."""
    app.add_exception_handler(BadInput, _bad_input)
    app.add_exception_handler(ProblemError, _problem)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _http)
    app.add_exception_handler(Exception, _fault)


def _bad_input(_: Request, problem: Exception) -> Response:
    assert isinstance(problem, BadInput)
    return refused(problem)


def _problem(_: Request, problem: Exception) -> Response:
    assert isinstance(problem, ProblemError)
    return problem_response(problem.status, problem.detail, problem.field, None, problem.headers)


def _invalid(_: Request, problem: Exception) -> Response:
    """Describe the first key of a request that is missing, unknown or of the wrong type."""
    assert isinstance(problem, RequestValidationError)
    first: Mapping[str, Any] = problem.errors()[0]
    kind, where = first["type"], first["loc"]
    if kind == "json_invalid":
        return problem_response(400, "The body of the request is not valid JSON.")
    if where == ("body",) and isinstance(first.get("input"), bytes):  # it was not read as JSON
        return problem_response(415, NO_JSON, "Content-Type")
    keys = [str(part) for part in where[1:]]
    while len(keys) > 1 and keys[0] in CONTAINERS:
        del keys[0]
    while keys and keys[-1] in TYPES:
        del keys[-1]
    value = "missing" if kind == "missing" else first.get("input")
    if kind in TAGS:
        keys.append(first["ctx"]["discriminator"].strip("'"))
        value = first["ctx"].get("tag", "missing")
    field = ".".join(keys) or "body"
    return refused(BadInput(field, value, _allowed(first, keys)), field)


def _allowed(error: Mapping[str, Any], keys: Sequence[str]) -> str:
    if error["type"] == "extra_forbidden":
        known = sections()
        names = known.get(keys[0], known) if len(keys) > 1 else known
        return f"left out, because there is no such key{did_you_mean(keys[-1], names)}"
    if error["type"] == "literal_error":
        return f"one of {error['ctx']['expected']}"
    declared = all_inputs().get(".".join(keys))
    if declared is not None and declared.declaration.kind in TABLES:
        return TABLES[declared.declaration.kind]
    if error["type"] == "union_tag_invalid":
        return f"one of {error['ctx']['expected_tags']}"
    return ALLOWED.get(error["type"], f"valid ({error['msg']})")


def _http(_: Request, problem: Exception) -> Response:
    assert isinstance(problem, HTTPException)
    sentence = SENTENCES.get(problem.status_code, f"{str(problem.detail).rstrip('.')}.")
    return problem_response(problem.status_code, sentence, headers=dict(problem.headers or {}))


def _fault(_: Request, problem: Exception) -> Response:
    """Answer a request that met an error of the program."""
    return problem_response(500, FAULT)
