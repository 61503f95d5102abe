"""The child's side of the sandbox: JSON in, a line of JSON and plain numbers out, within limits."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from typing import Any

from stonepass.errors import BadInput
from stonepass.sandbox.protocol import LONGEST

__all__ = ["serve"]

Parsed = tuple[dict[str, Any], memoryview]


def serve(
    load: Callable[[Mapping[str, Any]], None], parse: Callable[[Mapping[str, Any]], Parsed]
) -> int:
    """Answer one request of `sandbox.parse_in_child` on stdin and stdout.

    Parameters
    ----------
    load : callable
        Imports the libraries that the request needs; it runs before the limits are set.
    parse : callable
        Parses the file of the request; returns a JSON-ready header and the numbers after it. What
        it refuses with `BadInput` reaches the parent as a refusal.
    """
    asked = json.loads(sys.stdin.buffer.readline())
    load(asked["request"])
    _limit(asked["memory"], asked["seconds"])
    _send({"ready": True})
    try:
        header, body = parse(asked["request"])
    except BadInput as problem:
        value = problem.value if isinstance(problem.value, str) else repr(problem.value)
        allowed = problem.allowed
        if isinstance(problem.__cause__, MemoryError):
            allowed = f"readable within {asked['memory'] // 1_000_000} MB"
        parts = (problem.argument, value, allowed, problem.remedy)
        _send({"refused": [text[:LONGEST] for text in parts]})
        return 0
    _send({"header": header})
    sys.stdout.buffer.write(body.cast("B"))
    return 0


def _limit(memory: int, seconds: float) -> None:
    """Set the limits of the operating system, where it has any."""
    try:
        import resource
    except ImportError:  # Windows: the parent's clock is the only limit
        return
    processor = int(_used(resource) + seconds) + 1
    # A second below the hard limit, which kills: the signal for processor time can be told apart.
    wanted = (
        (resource.RLIMIT_DATA, memory, memory),
        (resource.RLIMIT_CPU, processor, processor + 1),
        (resource.RLIMIT_FSIZE, 0, 0),
        (resource.RLIMIT_CORE, 0, 0),
    )
    for which, soft, hard in wanted:
        _, most = resource.getrlimit(which)
        bounds = (soft, hard)
        if most != resource.RLIM_INFINITY:
            bounds = (min(soft, most), min(hard, most))
        resource.setrlimit(which, bounds)


def _used(resource: Any) -> float:
    """Processor time so far in s."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return float(used.ru_utime + used.ru_stime)


def _send(document: dict[str, Any]) -> None:
    sys.stdout.buffer.write(json.dumps(document).encode() + b"\n")
    sys.stdout.buffer.flush()
