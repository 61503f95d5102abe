"""The expected duration of a sweep, and the refusal of one that would take too long."""

from __future__ import annotations

from concurrent.futures import BrokenExecutor
from dataclasses import dataclass

import numpy as np

from stonepass.errors import StonepassError
from stonepass.studies.executor import KILLED
from stonepass.studies.sweeps.blocks import case_seconds
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.workers import Workers

__all__ = ["DAYS", "Duration", "estimated", "refuse_long"]

DAYS = 3.0  # longest duration in days that is accepted without being asked for
MEASURED_FROM = 2_000  # cases from which some are solved first to measure what they take
MEASURED = 8  # number of these cases
LONGEST = 20.0  # time in s of the measurement, after which no further case is begun
DAY = 86_400.0


@dataclass(frozen=True)
class Duration:
    """The expected duration of a sweep.

    Attributes
    ----------
    cases : int
        Number of cases that are not finished.
    seconds_per_case : float
        Measured time in s of a case.
    workers : int
        Number of cases that are solved at the same time.
    """

    cases: int
    seconds_per_case: float
    workers: int

    @property
    def days(self) -> float:
        """Expected duration in days."""
        return self.cases * self.seconds_per_case / self.workers / DAY

    def __str__(self) -> str:
        """The arithmetic in words."""
        return (
            f"{self.cases:,} cases × {self.seconds_per_case:.2g} s a case / {self.workers} "
            f"worker{'s' if self.workers > 1 else ''} = {self.days:.2g} days"
        ).replace(",", " ")


def estimated(plan: Sweep, left: int, workers: Workers) -> Duration | None:
    """Return the expected duration, measured by solving some cases; None for a small study.

    Parameters
    ----------
    plan : Sweep
        The plan.
    left : int
        Number of cases that are not finished.
    workers : Workers
        Where the cases are solved; one of the workers solves the measured cases.
    """
    if left < MEASURED_FROM:
        return None
    # The middle of each of equal parts, because the first cases of a grid may be the easy ones.
    indices = [int((k + 0.5) * plan.cases / MEASURED) for k in range(MEASURED)]
    try:
        seconds = workers.executor.submit(case_seconds, plan, indices, LONGEST).result()
    except BrokenExecutor as problem:
        raise StonepassError(KILLED) from problem
    return Duration(left, float(np.mean(seconds)), workers.count)


def refuse_long(estimate: Duration, days: float, lift: str) -> None:
    """Raise an error if a sweep would take too long.

    Parameters
    ----------
    estimate : Duration
        The expected duration.
    days : float
        Longest accepted duration in days.
    lift : str
        How a longer duration is accepted, e.g. ``--max-days``.

    Raises
    ------
    StonepassError
        The expected duration is longer.
    """
    if estimate.days > days:
        raise StonepassError(
            f"the sweep would take too long: {estimate}, and {days:g} days are accepted; vary "
            f"fewer inputs, use more workers, or accept it with {lift} {_above(estimate.days)}."
        )


def _above(days: float) -> str:
    return f"{int(days * 1.2) + 1}"
