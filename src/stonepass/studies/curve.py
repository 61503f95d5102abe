"""Critical pressure over a range of size ratios."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import as_completed

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.studies.executor import can_travel, executor

__all__ = ["curve", "solve_slim"]


def curve(
    case: Case,
    size_ratios: Sequence[float],
    progress: Callable[[int, int], None] | None = None,
    workers: int = 1,
) -> list[Answer]:
    """Answer `case` for every size ratio ξ; `progress` is told (done, all) after each.

    The answers keep their seated states without the stress field, which a curve does not need.
    A case that cannot be sent to another process (a user's own function) is solved in this one.
    """
    cases = [case.with_size_ratio(float(size_ratio)) for size_ratio in size_ratios]
    with executor(workers if can_travel(case) else 1) as pool:
        futures = [pool.submit(solve_slim, each) for each in cases]
        for done, _ in enumerate(as_completed(futures), start=1):
            if progress is not None:
                progress(done, len(cases))
        return [future.result() for future in futures]


def solve_slim(case: Case) -> Answer:
    """Solve, and leave the stress field behind."""
    return solve(case).without_wall()
