"""Responses that the OpenAPI description lists for every route."""

from __future__ import annotations

from typing import Any

from stonepass.web.answers import PROBLEM_TYPE, TITLES, Problem

__all__ = ["PROBLEMS"]

_SCHEMA = {"$ref": "#/components/schemas/Problem"}
PROBLEMS: dict[int | str, dict[str, Any]] = {
    status: {"description": f"{TITLES[status]}.", "content": {PROBLEM_TYPE: {"schema": _SCHEMA}}}
    for status in (400, 401, 403, 404, 405, 413, 415, 421, 422)
}
assert Problem.__name__ == _SCHEMA["$ref"].rpartition("/")[2]
