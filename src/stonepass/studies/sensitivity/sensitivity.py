"""Sensitivity of the critical pressure and of the critical size to uncertain inputs."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from stonepass.array_dataclass import array_dataclass
from stonepass.caution import Caution, caution
from stonepass.errors import Outcome
from stonepass.result import Result
from stonepass.studies.jobs import Progress
from stonepass.studies.sensitivity.estimate import Gap, Sensitivities
from stonepass.studies.sensitivity.evaluator import (
    BAD_INPUT,
    OUTSIDE,
    Evaluations,
    Evaluator,
    outcome_fractions,
    outcome_name,
)
from stonepass.studies.sensitivity.morris import morris_design, morris_sensitivities
from stonepass.studies.sensitivity.responses import responses
from stonepass.studies.sensitivity.sobol import saltelli_design, sobol_sensitivities
from stonepass.studies.sensitivity.solved_cases import CaseEvaluator
from stonepass.studies.sensitivity.study import SensitivityStudy
from stonepass.studies.sensitivity.study_file import read_sensitivity
from stonepass.studies.sensitivity.surrogate_cases import SurrogateCases
from stonepass.studies.sensitivity.swept_cases import swept_cases
from stonepass.studies.sensitivity.tornado import Tornado, pressure_tornado, size_tornado
from stonepass.studies.surrogates.store import load_surrogate
from stonepass.studies.sweeps.results import read_results
from stonepass.units import Pressure

__all__ = ["Sensitivity", "sensitivity"]

WIDE = 0.1  # half width of the interval of a total index above which a warning is given


@array_dataclass
@dataclass(frozen=True, repr=False)
class Sensitivity(Result):
    """How sensitive the critical pressure and the critical size are to uncertain inputs.

    Attributes
    ----------
    study : SensitivityStudy
        The study.
    source : str
        Origin of the critical pressures in words, e.g. the model or a surrogate.
    evaluated : int
        Number of evaluated cases of the samples, without those of the tornado.
    outcomes : tuple of (str, float)
        Fraction of each outcome in the samples, by its name, in descending order. ``BAD_INPUT``
        stands for inputs that describe no case that can be solved, and ``OUTSIDE`` for cases
        outside the range of a surrogate or of a sweep.
    responses : tuple of Sensitivities
        Sensitivity of the critical pressure, of its rank, of the outcome that the stone moves
        within the pressure limit (if there is one), and of the outcome that a critical pressure
        exists.
    pressures : Tornado
        Effect of each input alone on the critical pressure in kPa.
    sizes : Tornado or None
        Effect of each input alone on the critical size in mm; None without a pressure limit.
    error : float or None
        Largest stated error of a critical pressure of a surrogate or a sweep in Pa; None if every
        case was solved.
    warnings : tuple of Caution
        Warnings about cases without an answer and about wide confidence intervals.

    References
    ----------
    docs/howto/sensitivity.md
    """

    study: SensitivityStudy
    source: str
    evaluated: int
    outcomes: tuple[tuple[str, float], ...]
    responses: tuple[Sensitivities, ...]
    pressures: Tornado
    sizes: Tornado | None
    error: float | None = None
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return the most important input, the method and the number of cases in one line."""
        method = {"sobol": "Sobol' indices", "morris": "elementary effects"}[str(self.study.method)]
        inputs = self.main.inputs
        first = f", most important: {self.title(inputs[0].key)}" if inputs else ""
        return (
            f"{method} of {len(self.study.uncertain.inputs)} inputs{first}; {self.evaluated} cases"
        )

    @property
    def main(self) -> Sensitivities:
        """Sensitivity of the critical pressure, or of its rank if the pressure is not complete."""
        pressure, rank = self.responses[:2]
        return pressure if pressure.dropped == 0 else rank

    @property
    def answered(self) -> bool:
        """True if a critical pressure exists in any case."""
        names = Outcome.__members__
        return any(name in names and names[name].answered for name, _ in self.outcomes)

    def title(self, key: str) -> str:
        """Return the name of an input in words."""
        return self.study.uncertain[key].title

    def response(self, name: str) -> Sensitivities:
        """Return the sensitivity of one response by its name, e.g. "answered"."""
        return next(each for each in self.responses if each.response.name == name)


def sensitivity(
    study: SensitivityStudy | str | Path,
    evaluator: Evaluator | None = None,
    *,
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: bool | Progress = True,
) -> Sensitivity:
    """Compute how sensitive the critical pressure and the critical size are to uncertain inputs.

    Parameters
    ----------
    study : SensitivityStudy, str or Path
        The study, or the TOML file of a study.
    evaluator : Evaluator, optional
        Function that evaluates many cases; by default the surrogate or the sweep of the study, and
        without both every case is solved.
    executor : concurrent.futures.Executor, optional
        Where cases are solved, e.g. the executor of `process_pool`; by default in this process.
    cache_folder : Path, optional
        Folder of the solution cache, e.g. `default_folder()`; by default there is no cache.
    progress : bool or callable
        True shows a progress bar in a terminal and in a notebook. A function is called with
        (done, all) after each case.

    Returns
    -------
    Sensitivity

    Raises
    ------
    BadInput
        The file is refused, SALib is not installed, or the surrogate or the sweep is unknown or
        does not describe the case.

    References
    ----------
    docs/howto/sensitivity.md

    Examples
    --------
    >>> import stonepass as sp
    >>> beam = sp.ElasticFoundation("0.4 MPa", "0.02 MPa")
    >>> case = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3), model=beam)
    >>> uncertain = {"stone.friction": "0.1 to 0.5", "stone.size_ratio": "1.05 to 1.1"}
    >>> study = sp.SensitivityStudy(sp.uncertain_case(case, uncertain), samples=64)
    >>> sp.sensitivity(study)
    <Sensitivity: Sobol' indices of 2 inputs, most important: friction; 384 cases>
    """
    if isinstance(study, str | Path):
        study = read_sensitivity(study)
    evaluate = evaluator or _evaluator(study, executor, cache_folder, progress)
    quantities, samples = study.uncertain.quantities, cast("int", study.samples)
    limit = cast("Pressure | None", study.limit)
    design_of, sensitivities_of = {
        "sobol": (saltelli_design, sobol_sensitivities),
        "morris": (morris_design, morris_sensitivities),
    }[str(study.method)]
    found = evaluate(design_of(quantities, samples, study.seed))
    each_response = tuple(
        sensitivities_of(quantities, response, values, study.seed)
        for response, values in responses(found, limit)
    )
    sizes = None if limit is None else size_tornado(study.uncertain, evaluate, limit)
    return Sensitivity(
        study=study,
        source=evaluate.source,
        evaluated=len(found.outcome),
        outcomes=outcome_fractions(found),
        responses=each_response,
        pressures=pressure_tornado(study.uncertain, evaluate),
        sizes=sizes,
        error=found.error,
        warnings=tuple(_warnings(found, each_response)),
    )


def _evaluator(
    study: SensitivityStudy,
    executor: Executor | None,
    cache_folder: Path | None,
    progress: bool | Progress,
) -> Evaluator:
    uncertain = study.uncertain
    if study.sweep is not None:
        return swept_cases(uncertain, read_results(study.sweep))
    if study.surrogate is None:
        return CaseEvaluator(uncertain, executor, cache_folder, progress)
    surrogate = load_surrogate(study.surrogate, uncertain.median_case.model.NAME)
    return SurrogateCases(uncertain, surrogate, Path(study.surrogate).stem)


def _warnings(found: Evaluations, each_response: tuple[Sensitivities, ...]) -> list[Caution]:
    told = []
    fractions = dict(outcome_fractions(found))
    refused = fractions.get(outcome_name(BAD_INPUT), 0.0)
    if refused:
        told.append(caution("cases_refused", fraction=refused, reason=found.reason.rstrip(".")))
    outside = fractions.get(outcome_name(OUTSIDE), 0.0)
    if outside:
        told.append(caution("cases_outside", fraction=outside))
    for dropped in sorted({each.dropped for each in each_response if each.dropped}):
        alike = [each for each in each_response if each.dropped == dropped]
        for code, some in (
            ("groups_dropped", [each for each in alike if each.gap is not Gap.INCOMPLETE]),
            ("groups_too_few", [each for each in alike if each.gap is Gap.INCOMPLETE]),
        ):
            if some:
                titles = " and of ".join(each.response.title for each in some)
                told.append(caution(code, response=titles, dropped=dropped, groups=some[0].groups))
    bounded = found.value.mask & ~found.lower_bound.mask
    if bounded.any():
        told.append(caution("bounds_in_rank", fraction=float(bounded.mean())))
    main = each_response[0] if each_response[0].dropped == 0 else each_response[1]
    widest = max((e.importance.half_width for e in main.inputs), default=0.0)
    if main.interactions and widest > WIDE:
        told.append(caution("indices_wide", response=main.response.title, width=widest))
    return told
