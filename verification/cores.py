"""Call a function for many jobs on all cores, and print the progress."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

from stonepass.studies.executor import CORES, process_pool

INTERVAL = 15.0  # seconds between lines


def on_all_cores(what: str, function: Callable[..., Any], jobs: Sequence[tuple]) -> list[Any]:
    """Call `function` with each tuple of arguments, in new processes; return results in order.

    The processes end when this one ends, even if it is killed.
    """
    found: list[Any] = []
    last = time.monotonic()
    with process_pool(CORES) as pool:
        for result in pool.map(function, *zip(*jobs, strict=True)):
            found.append(result)
            if time.monotonic() - last >= INTERVAL:
                last = time.monotonic()
                print(f"{what}: {len(found)} of {len(jobs)}", file=sys.stderr, flush=True)
    return found
