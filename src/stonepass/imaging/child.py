"""The process that reads a file for `untrusted`: JSON in, JSON and numbers out, within limits."""

from __future__ import annotations

import json
import sys
from dataclasses import astuple
from pathlib import Path
from typing import Any

__all__ = ["main"]

LONGEST = 500  # characters


def main() -> int:
    """Read what stdin asks for, and write the picture, or why not, to stdout."""
    asked = json.loads(sys.stdin.buffer.readline())
    from stonepass.errors import BadInput
    from stonepass.imaging.readers import load_libraries, read_picture

    path = Path(asked["path"])
    load_libraries(path)
    _limit(asked["memory"], asked["seconds"])
    _tell({"ready": True})
    try:
        picture = read_picture(path)
    except BadInput as problem:
        value = problem.value if isinstance(problem.value, str) else repr(problem.value)
        told = (problem.argument, value, problem.allowed, problem.remedy)
        _tell({"refused": [text[:LONGEST] for text in told]})
        return 0
    _tell(
        {
            "shape": picture.values.shape,
            "type": picture.values.dtype.name,
            "pixel": picture.pixel,
            "full_scale": picture.full_scale,
            "area": astuple(picture.area),
            "pixel_source": picture.pixel_source,
            "notes": picture.notes,
        }
    )
    sys.stdout.buffer.write(picture.values.data.cast("B"))
    return 0


def _limit(memory: int, seconds: float) -> None:
    """Limits of the operating system, where it has any."""
    try:
        import resource
    except ImportError:  # Windows: the parent's clock is the only limit
        return
    wanted = (
        (resource.RLIMIT_DATA, memory),
        (resource.RLIMIT_CPU, int(_used(resource) + seconds) + 1),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    )
    for which, value in wanted:
        _, hard = resource.getrlimit(which)
        bound = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(which, (bound, bound))


def _used(resource: Any) -> float:
    """Processor time so far in s."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return float(used.ru_utime + used.ru_stime)


def _tell(document: dict[str, Any]) -> None:
    sys.stdout.buffer.write(json.dumps(document).encode() + b"\n")
    sys.stdout.buffer.flush()


if __name__ == "__main__":
    raise SystemExit(main())
