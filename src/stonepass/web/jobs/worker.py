"""The worker process: it does the jobs that it reads from its standard input, one after another.

Each request is a line of JSON, and each message back is one: the progress, then the result, a
refusal, or the name of an unexpected error. The process ends when its standard input is closed,
also during a job, so that it never outlives the server.
"""

from __future__ import annotations

import base64
import json
import os
import queue
import sys
import threading
import warnings
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from pydantic import ValidationError

from stonepass.errors import BadInput, lacks_memory
from stonepass.inputs.build import in_words
from stonepass.sandbox.worker import lift_memory_limit, limit_memory
from stonepass.web.api_words import in_api_words
from stonepass.web.jobs.context import Context, Done
from stonepass.web.problem_fields import field_of

__all__ = ["MODULES", "serve_jobs"]

LONGEST_VALUE = 200  # characters of a refused value
# The module of `stonepass.web.jobs.tasks` that does each kind of job.
MODULES = {
    "pressure": "solve",
    "size": "solve",
    "push": "solve",
    "assess": "patient",
    "fit": "laboratory",
    "friction": "laboratory",
}


def serve_jobs(reading: IO[bytes], writing: IO[bytes]) -> None:
    """Do jobs until `reading` ends."""
    asked: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_read, args=(reading, asked), daemon=True).start()
    while True:
        request = json.loads(asked.get())
        _send(writing, _answer(request, writing))


def _read(reading: IO[bytes], asked: queue.SimpleQueue[bytes]) -> None:
    """Pass requests on; end the process when there are no more."""
    for line in reading:
        asked.put(line)
    os._exit(0)


def _answer(request: Mapping[str, Any], writing: IO[bytes]) -> dict[str, Any]:
    """Return the last message about a job."""

    def tell(done: int, total: int, sentence: str) -> None:
        _send(writing, {"progress": {"done": done, "total": total, "sentence": sentence}})

    folder, file = (
        None if request[key] is None else Path(request[key]) for key in ("cache_folder", "file")
    )
    limit_memory(request["memory"])
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an answer has warnings of its own
            done = _run(request, Context(tell, folder, file, request["area"], request["format"]))
            return {"result": done.result, "report": _report(done.page, request["format"])}
    except BadInput as problem:
        return {"refused": _refusal(problem)}
    except ValidationError as problem:
        first = problem.errors()[0]
        return {"refused": [f"The request is not valid: {first['msg']}.", "", ""]}
    except Exception as problem:
        starved = lift_memory_limit() or lacks_memory(problem)
        return {"fault": "MemoryError" if starved else type(problem).__name__}


def _refusal(problem: BadInput) -> list[str]:
    """Return sentence, field and value of an error, in the words of the API."""
    problem = in_api_words(problem)
    field = field_of(problem) or problem.argument
    sentence = str(in_words(problem, {problem.argument: field}))
    return [sentence, field, str(problem.value)[:LONGEST_VALUE]]


def _report(page: str, form: str) -> str:
    """Return the report in the base 64; empty if there is none."""
    if not page:
        return ""
    content = page.encode()
    if form == "pdf":
        content = import_module("stonepass.report.pdf").pdf_of_page(page)
    return base64.b64encode(content).decode()


def _run(request: Mapping[str, Any], context: Context) -> Done:
    module = import_module(f"stonepass.web.jobs.tasks.{MODULES[request['kind']]}")
    done: Done = module.TASKS[request["kind"]](request["body"], context)
    return done


def _send(writing: IO[bytes], message: Mapping[str, Any]) -> None:
    writing.write(json.dumps(message, allow_nan=False).encode() + b"\n")
    writing.flush()


def _own_output() -> IO[bytes]:
    """Return the standard output, and give libraries that print something else in its place."""
    kept = os.dup(sys.stdout.fileno())
    with open(os.devnull, "wb") as nothing:
        os.dup2(nothing.fileno(), sys.stdout.fileno())
    return os.fdopen(kept, "wb")


if __name__ == "__main__":
    serve_jobs(sys.stdin.buffer, _own_output())
