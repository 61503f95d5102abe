"""Critical pressure over a range of size ratios."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from stonepass.model.case import Case
from stonepass.model.critical import Answer, solve

__all__ = ["curve"]


def curve(
    case: Case,
    size_ratios: Sequence[float],
    progress: Callable[[int, int], None] | None = None,
) -> list[Answer]:
    """Answer `case` for every size ratio ξ; `progress` is told (done, all) after each.

    The answers keep their seated states without the stress field, which a curve does not need.
    """
    answers = []
    for count, size_ratio in enumerate(size_ratios, start=1):
        answers.append(_slim(solve(case.with_size_ratio(float(size_ratio)))))
        if progress is not None:
            progress(count, len(size_ratios))
    return answers


def _slim(answer: Answer) -> Answer:
    if answer.seated is None:
        return answer
    return replace(answer, seated=replace(answer.seated, wall=None))
