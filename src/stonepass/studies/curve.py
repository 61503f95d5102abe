"""Critical pressure over a range of size ratios."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import overload

from stonepass.array_dataclass import array_dataclass
from stonepass.errors import require
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.problem import require_kind
from stonepass.result import Result
from stonepass.studies.jobs import PressureJob, Progress, Results
from stonepass.studies.study import run_study

__all__ = ["CriticalCurve", "Curve", "critical_curve"]


@array_dataclass
@dataclass(frozen=True, repr=False)
class CriticalCurve(Result, Sequence[Answer]):
    """The critical pressure of a case at several sizes of its stone, a sequence of answers.

    Attributes
    ----------
    answers : tuple of Answer
        Answers in the order of the size ratios, without stress fields.
    """

    answers: tuple[Answer, ...]

    def summary(self) -> str:
        """Return the number of answers, the range of sizes and the tube in one line."""
        case, sizes = self.answers[0].case, self.size_ratios
        answered = sum(each.outcome.answered for each in self.answers)
        return (
            f"{answered} of {len(sizes)} size ratios answered, ξ {min(sizes):.4g} to "
            f"{max(sizes):.4g}; η {case.wall_ratio:.4g}, {case.ureter.material.name}, "
            f"friction {case.stone.friction:g}, model {self.answers[0].model.NAME}"
        )

    @property
    def size_ratios(self) -> tuple[float, ...]:
        """Size ratio ξ of each answer."""
        return tuple(each.case.size_ratio for each in self.answers)

    @property
    def pressures(self) -> tuple[float | None, ...]:
        """P_ucr of each answer in Pa; None if it does not exist."""
        return tuple(each.pressure for each in self.answers)

    @overload
    def __getitem__(self, index: int) -> Answer: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Answer, ...]: ...
    def __getitem__(self, index: int | slice) -> Answer | tuple[Answer, ...]:
        return self.answers[index]

    def __len__(self) -> int:
        return len(self.answers)

    def __iter__(self) -> Iterator[Answer]:
        return iter(self.answers)


@dataclass(frozen=True)
class Curve:
    """The study of the critical pressure of a case at several size ratios.

    The outcome is a `CriticalCurve`.

    Attributes
    ----------
    case : Case
        The case; the size of its own stone is ignored.
    size_ratios : sequence of float
        Size ratios ξ, each from 0.1 to 3.
    """

    case: Case
    size_ratios: Sequence[float]

    def jobs(self) -> list[PressureJob]:
        """Return one job for each size ratio."""
        return [PressureJob(self.case.with_size_ratio(float(each))) for each in self.size_ratios]

    def reduce(self, results: Results) -> CriticalCurve:
        """Return the answers in the order of the size ratios."""
        return CriticalCurve(tuple(results[job] for job in self.jobs()))


def critical_curve(
    case: Case,
    size_ratios: Iterable[float],
    *,
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: bool | Progress = True,
) -> CriticalCurve:
    """Compute the critical pressure as a function of the size of the stone.

    Parameters
    ----------
    case : Case
        The case; the size of its own stone is ignored.
    size_ratios : iterable of float
        Size ratios ξ, each from 0.1 to 3, e.g. ``numpy.linspace(1.0, 1.3, 31)``.
    executor : concurrent.futures.Executor, optional
        Where the cases are solved, e.g. the executor of `process_pool`; by default in this process.
    cache_folder : Path, optional
        Folder of the solution cache, e.g. `default_folder()`; by default there is no cache.
    progress : bool or callable
        True shows a progress bar in a terminal and in a notebook. A function is called with
        (done, all) after each case.

    Returns
    -------
    CriticalCurve
        A sequence of `Answer`, which can also be converted to a table (`to_frame`) or plotted.

    Raises
    ------
    BadInput
        There is no size ratio, a size ratio is out of bounds, `case` is not a Case, or its model
        has an opening curve, which is valid for one stone size only.

    References
    ----------
    docs/theory.md, "Closure and critical state".

    Examples
    --------
    >>> import stonepass as sp
    >>> beam = sp.ElasticFoundation("0.4 MPa", "0.02 MPa")
    >>> case = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3), model=beam)
    >>> curve = sp.critical_curve(case, [1.05, 1.1])
    >>> [round(each.pressure_kPa, 2) for each in curve]
    [2.33, 4.86]
    """
    require_kind("case", case, Case, "Case(stone, ureter)")
    sizes = tuple(float(each) for each in size_ratios)
    require(len(sizes) > 0, "size_ratios", "empty", "at least one number")
    return run_study(Curve(case, sizes), executor, cache_folder, progress)
