"""The part of the sandbox that runs in the child process."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput
from stonepass.sandbox.protocol import LONGEST

__all__ = ["lift_memory_limit", "limit_memory", "serve"]

RESERVE = 32_000_000  # bytes above the limit, with which a failure is told
NEARLY = 0.85  # part of the limit above which a process lacks memory

Parsed = tuple[dict[str, Any], memoryview]


def serve(
    load: Callable[[Mapping[str, Any]], None], parse: Callable[[Mapping[str, Any]], Parsed]
) -> int:
    """Serve one request of `sandbox.parse_in_sandbox` on standard input and output.

    The request is a line of JSON. The result is a line of JSON, followed by plain numbers.

    Parameters
    ----------
    load : callable
        Function of the request that imports the libraries it needs; it runs before the limits are
        set.
    parse : callable
        Function of the request that parses the file and returns a JSON-ready header and the
        numbers. A `BadInput` error that it raises is sent to the parent process.

    Returns
    -------
    int
        Exit code 0.
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


def limit_memory(memory: int) -> None:
    """Set the limit of the data of this process in bytes, if the operating system has one."""
    try:
        import resource
    except ImportError:  # Windows
        return
    hard = memory + RESERVE
    _set(resource, ((resource.RLIMIT_DATA, memory, hard), (resource.RLIMIT_CORE, 0, 0)))


def lift_memory_limit() -> bool:
    """Make the reserve above the limit of `limit_memory` available, to tell why a job failed.

    Returns
    -------
    bool
        True if the data of this process had nearly reached the limit. A library that lacks memory
        raises errors of many kinds.
    """
    try:
        import resource
    except ImportError:  # Windows
        return False
    limit, hard = resource.getrlimit(resource.RLIMIT_DATA)
    _set(resource, ((resource.RLIMIT_DATA, hard, hard),))
    status = Path("/proc/self/status")
    if limit == resource.RLIM_INFINITY or not status.exists():
        return False
    found = re.search(r"^VmData:\s*(\d+) kB$", status.read_text(encoding="ascii"), re.MULTILINE)
    return found is not None and 1024 * int(found[1]) > NEARLY * limit


def _limit(memory: int, seconds: float) -> None:
    """Set the resource limits of the operating system, if it has them."""
    try:
        import resource
    except ImportError:  # on Windows the parent process limits the wall-clock time only
        return
    processor = int(_used(resource) + seconds) + 1
    # The soft limit of processor time is 1 s below the hard limit, so that the process ends with
    # the signal SIGXCPU, which tells the parent process the reason, and not with SIGKILL.
    wanted = (
        (resource.RLIMIT_DATA, memory, memory),
        (resource.RLIMIT_CPU, processor, processor + 1),
        (resource.RLIMIT_FSIZE, 0, 0),
        (resource.RLIMIT_CORE, 0, 0),
    )
    _set(resource, wanted)


def _set(resource: Any, wanted: Iterable[tuple[int, int, int]]) -> None:
    """Set soft and hard limits, which must not exceed the present hard limits."""
    for which, soft, hard in wanted:
        _, most = resource.getrlimit(which)
        bounds = (soft, hard)
        if most != resource.RLIM_INFINITY:
            bounds = (min(soft, most), min(hard, most))
        resource.setrlimit(which, bounds)


def _used(resource: Any) -> float:
    """Return the processor time of this process in s."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return float(used.ru_utime + used.ru_stime)


def _send(document: dict[str, Any]) -> None:
    sys.stdout.buffer.write(json.dumps(document).encode() + b"\n")
    sys.stdout.buffer.flush()
