"""Estimates of how long a command takes, for the line that is printed before it begins."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from stonepass.studies.jobs import Job

__all__ = ["estimated_seconds"]

# Seconds of one process at standard accuracy with an empty cache, on a machine of 2026.
OF_A_PRESSURE, OF_A_SIZE = 1.5, 8.0


def estimated_seconds(jobs: Iterable[Job[Any]], workers: int) -> float:
    """Return about how many seconds some processes need for the jobs; equal jobs run once."""
    from stonepass.studies.jobs import SizeJob

    each = [OF_A_SIZE if isinstance(job, SizeJob) else OF_A_PRESSURE for job in set(jobs)]
    return sum(each) / workers
