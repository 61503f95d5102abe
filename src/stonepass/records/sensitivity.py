"""The record of a sensitivity study, and its table with one row for each input."""

from __future__ import annotations

from typing import Any, cast

from pydantic import Field

from stonepass.records.base import CautionRecord, PartRecord, Record, kilo, warning_records
from stonepass.studies.sensitivity.conclusions import conclusions
from stonepass.studies.sensitivity.estimate import (
    Effects,
    IndexEstimate,
    Indices,
    Interaction,
    Sensitivities,
)
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.studies.sensitivity.tornado import Bar, End, Tornado
from stonepass.studies.sensitivity.uncertain_case import UncertainInput

__all__ = ["SensitivityRecord", "sensitivity_record", "sensitivity_rows"]

QUANTILES = (0.05, 0.5, 0.95)
# Numbers of each method that have columns in the table.
NUMBERS = {"sobol": ("first_order", "total"), "morris": ("mean_absolute_effect",)}


class UncertainInputRecord(PartRecord):
    """An uncertain input; its values are in `unit`."""

    key: str = Field(description="key of the input in a case file")
    title: str = Field(description="name of the input in words")
    uncertain: str = Field(description="range or distribution as text")
    unit: str = Field(description="unit of the values; empty for a dimensionless input")
    quantile_5: float = Field(description="5 % quantile")
    median: float = Field(description="median")
    quantile_95: float = Field(description="95 % quantile")


class IndexEstimateRecord(PartRecord):
    """An estimate with its 95 % confidence interval."""

    value: float = Field(description="the estimate")
    low: float = Field(description="lower end of the interval")
    high: float = Field(description="upper end of the interval")


class InputSensitivityRecord(PartRecord):
    """Sensitivity of a response to one input."""

    key: str = Field(description="key of the input")
    first_order: IndexEstimateRecord | None = Field(
        description="Sobol' first-order index; null for Morris"
    )
    total: IndexEstimateRecord | None = Field(description="Sobol' total index; null for Morris")
    mean_absolute_effect: IndexEstimateRecord | None = Field(
        description="mean absolute elementary effect μ*, in the response's unit; null for Sobol'"
    )
    mean_effect: float | None = Field(description="mean elementary effect μ; null for Sobol'")
    effect_spread: float | None = Field(
        description="standard deviation σ of the elementary effects; null for Sobol'"
    )


class InteractionRecord(PartRecord):
    """Sobol' second-order index of two inputs."""

    keys: list[str] = Field(description="keys of the two inputs")
    second_order: IndexEstimateRecord = Field(description="the index")


class ResponseSensitivityRecord(PartRecord):
    """Sensitivity of one response to all inputs."""

    response: str = Field(
        description=(
            "`pressure`, `rank` (of the critical pressure), `moves` (within the pressure limit) or "
            "`answered` (a critical pressure exists)"
        )
    )
    title: str = Field(description="the response in words")
    unit: str = Field(description="unit of effects; empty for a number without unit")
    groups: int = Field(description="number of groups of samples, or of trajectories")
    dropped_groups: int = Field(
        description="number of groups left out because the response of a member is unknown"
    )
    gap: str | None = Field(description="reason why there is no sensitivity; null if there is one")
    inputs: list[InputSensitivityRecord] = Field(
        description="sensitivity to each input in descending order; empty with a `gap`"
    )
    interactions: list[InteractionRecord] = Field(
        description="second-order indices in descending order; empty for Morris"
    )


class TornadoEndRecord(PartRecord):
    """The result at one value of the moved input."""

    input: float | None = Field(
        description="value of the moved input in its unit; null if all inputs have their medians"
    )
    value: float | None = Field(description="the result in the unit of the tornado")
    outcome: str = Field(description="outcome of the calculation (glossary: outcomes)")
    lower_bound: float | None = Field(
        description="lower bound of a result that does not exist; null if none is known"
    )


class TornadoBarRecord(PartRecord):
    """The results at both ends of the range of one input."""

    key: str = Field(description="key of the input")
    low: TornadoEndRecord = Field(description="result at the 5 % quantile of the input")
    high: TornadoEndRecord = Field(description="result at the 95 % quantile of the input")


class TornadoRecord(PartRecord):
    """The effect of one input at a time, with the others at their medians."""

    quantity: str = Field(description="`critical pressure` or `critical size`")
    unit: str = Field(description="unit of the results")
    centre: TornadoEndRecord = Field(description="result with all inputs at their medians")
    bars: list[TornadoBarRecord] = Field(
        description="bars without a span first, the others in descending order of their span"
    )


class SensitivityRecord(Record):
    """Sensitivity of the critical pressure and of the critical size to uncertain inputs."""

    method: str = Field(description="`sobol` or `morris`")
    source: str = Field(description="origin of the critical pressures in words")
    samples: int = Field(description="number of base samples (Sobol') or of trajectories (Morris)")
    seed: int = Field(description="seed of the samples")
    largest_error_kPa: float | None = Field(
        description=(
            "largest stated error of a critical pressure of a surrogate or an interpolation; null "
            "if every case was solved"
        )
    )
    evaluated: int = Field(description="number of evaluated cases without those of the tornado")
    limit_kPa: float | None = Field(description="pressure limit; null without one")
    inputs: list[UncertainInputRecord] = Field(description="the uncertain inputs")
    outcomes: dict[str, float] = Field(
        description=(
            "fraction of each outcome in the samples; `BAD_INPUT` stands for inputs that describe "
            "no case that can be solved, `OUTSIDE` for cases outside the range of the source"
        )
    )
    responses: list[ResponseSensitivityRecord] = Field(
        description="sensitivity of each response to the inputs"
    )
    tornado_pressure: TornadoRecord = Field(
        description="effect of each input alone on the critical pressure"
    )
    tornado_size: TornadoRecord | None = Field(
        description="effect of each input alone on the critical size; null without a limit"
    )
    conclusions: list[str] = Field(description="what the study shows, as sentences")
    warnings: list[CautionRecord] = Field(
        description="cases without an answer, and wide confidence intervals"
    )


def sensitivity_record(found: Sensitivity) -> SensitivityRecord:
    """Make the record of a sensitivity study."""
    study = found.study
    return SensitivityRecord(
        method=str(study.method),
        source=found.source,
        samples=cast("int", study.samples),
        seed=study.seed,
        largest_error_kPa=kilo(found.error),
        evaluated=found.evaluated,
        limit_kPa=kilo(cast("float | None", study.limit)),
        inputs=[_input(each) for each in study.uncertain.inputs],
        outcomes=dict(found.outcomes),
        responses=[_response(each) for each in found.responses],
        tornado_pressure=_tornado(found, found.pressures),
        tornado_size=None if found.sizes is None else _tornado(found, found.sizes),
        conclusions=list(conclusions(found)),
        warnings=warning_records(found.warnings),
    )


def sensitivity_rows(found: Sensitivity) -> list[dict[str, Any]]:
    """Return one row for each input: its uncertainty, its indices, and the results at both ends."""
    rows = []
    for each in found.study.uncertain.inputs:
        row: dict[str, Any] = _input(each).to_dict()
        for response in found.responses:
            row |= _index_cells(response, each.key, NUMBERS[str(found.study.method)])
        for tornado in filter(None, (found.pressures, found.sizes)):
            row |= _tornado_cells(tornado, each.key)
        rows.append(row)
    return rows


def _input(each: UncertainInput) -> UncertainInputRecord:
    low, median, high = (each.quantile(fraction) / each.scale for fraction in QUANTILES)
    return UncertainInputRecord(
        key=each.key,
        title=each.title,
        uncertain=each.describe(),
        unit=each.unit,
        quantile_5=low,
        median=median,
        quantile_95=high,
    )


def _response(each: Sensitivities) -> ResponseSensitivityRecord:
    return ResponseSensitivityRecord(
        response=each.response.name,
        title=each.response.title,
        unit=each.response.unit,
        groups=each.groups,
        dropped_groups=each.dropped,
        gap=None if each.gap is None else each.gap.value,
        inputs=[_sensitivity(one) for one in each.inputs],
        interactions=[_interaction(one) for one in each.interactions],
    )


def _sensitivity(one: Indices | Effects) -> InputSensitivityRecord:
    sobol = isinstance(one, Indices)
    return InputSensitivityRecord(
        key=one.key,
        first_order=_estimate(one.first) if isinstance(one, Indices) else None,
        total=_estimate(one.total) if isinstance(one, Indices) else None,
        mean_absolute_effect=None if sobol else _estimate(one.importance),
        mean_effect=one.mean if isinstance(one, Effects) else None,
        effect_spread=one.spread if isinstance(one, Effects) else None,
    )


def _interaction(one: Interaction) -> InteractionRecord:
    return InteractionRecord(keys=list(one.keys), second_order=_estimate(one.second))


def _estimate(estimate: IndexEstimate) -> IndexEstimateRecord:
    return IndexEstimateRecord(value=estimate.value, low=estimate.low, high=estimate.high)


def _tornado(found: Sensitivity, tornado: Tornado) -> TornadoRecord:
    def bar(each: Bar) -> TornadoBarRecord:
        scale = found.study.uncertain[each.key].scale
        return TornadoBarRecord(
            key=each.key, low=_end(each.low, scale), high=_end(each.high, scale)
        )

    return TornadoRecord(
        quantity=tornado.quantity,
        unit=tornado.unit,
        centre=_end(tornado.centre, 1.0),
        bars=[bar(each) for each in tornado.bars],
    )


def _end(end: End, scale: float) -> TornadoEndRecord:
    return TornadoEndRecord(
        input=None if end.input is None else end.input / scale,
        value=end.value,
        outcome=end.outcome,
        lower_bound=end.lower_bound,
    )


def _index_cells(response: Sensitivities, key: str, names: tuple[str, ...]) -> dict[str, Any]:
    """Return the cells of one response and one input; None where there is no sensitivity."""
    one = next((each for each in response.inputs if each.key == key), None)
    record = None if one is None else _sensitivity(one).to_dict()
    cells: dict[str, Any] = {}
    for name in names:
        for part in ("value", "low", "high"):
            column = f"{response.response.name}_{name}" + ("" if part == "value" else f"_{part}")
            estimate = None if record is None else record[name]
            cells[column] = None if estimate is None else estimate[part]
    return cells


def _tornado_cells(tornado: Tornado, key: str) -> dict[str, Any]:
    bar = next((each for each in tornado.bars if each.key == key), None)
    name = f"{tornado.quantity}_at".replace(" ", "_")
    unit = tornado.unit.replace(" ", "_")
    cells: dict[str, Any] = {}
    for quantile in ("low", "high"):
        end = None if bar is None else getattr(bar, quantile)
        column = f"{name}_quantile_{'5' if quantile == 'low' else '95'}"
        cells[f"{column}_{unit}"] = None if end is None else end.value
        cells[f"{column}_outcome"] = None if end is None else end.outcome
    return cells
