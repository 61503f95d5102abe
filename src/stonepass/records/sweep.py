"""The record of the results of a sweep: their outcomes, and quantiles of the critical pressure."""

from __future__ import annotations

from pydantic import Field

from stonepass.records.base import PartRecord, Record
from stonepass.studies.sweeps.results import SweepResults
from stonepass.studies.sweeps.statistics import (
    input_ranges,
    pressure_quantiles,
    warning_counts,
)

__all__ = ["SweepInputRecord", "SweepModelRecord", "SweepRecord", "sweep_record"]


class SweepInputRecord(PartRecord):
    """An input that a sweep varies."""

    key: str = Field(description="key in a case file, or `ureter.material.NAME` for a constant")
    column: str = Field(description="name of its column, which ends with the unit of its values")
    smallest: float | None = Field(description="smallest value; null if it is no number")
    largest: float | None = Field(description="largest value; null if it is no number")


class SweepModelRecord(PartRecord):
    """The outcomes of one model of a sweep."""

    model: str = Field(description="label of the model")
    outcomes: dict[str, int] = Field(description="number of cases by outcome")
    critical_pressure_quantiles_kPa: dict[str, float] | None = Field(
        description=(
            "quantiles of P_ucr of the cases that have one, by name: `smallest`, `5 %`, `median`, "
            "`95 %`, `largest`; null if no case has one"
        )
    )


class SweepRecord(Record):
    """The results of a sweep in a folder: a summary, while the rows stay in their files."""

    cases: int = Field(description="number of cases of the study")
    finished: int = Field(description="number of finished cases")
    inputs: list[SweepInputRecord] = Field(description="the varied inputs")
    models: list[SweepModelRecord] = Field(description="the models side by side")
    warning_counts: dict[str, int] = Field(description="number of cases by code of their warnings")
    solve_seconds: float = Field(description="time of all solves in s, summed over the workers")
    study: str = Field(description="SHA-256 digest of the study")


def sweep_record(found: SweepResults) -> SweepRecord:
    """Make the record of the results of a sweep."""
    ranges, quantiles = input_ranges(found), pressure_quantiles(found)
    return SweepRecord(
        cases=found.cases,
        finished=len(found),
        inputs=[
            SweepInputRecord(
                key=each["key"],
                column=each["column"],
                smallest=ranges[each["column"]][0],
                largest=ranges[each["column"]][1],
            )
            for each in found.ledger.plan["inputs"]
        ],
        models=[
            SweepModelRecord(
                model=label, outcomes=counts, critical_pressure_quantiles_kPa=quantiles.get(label)
            )
            for label, counts in found.counts.items()
        ],
        warning_counts=warning_counts(found),
        solve_seconds=found.seconds,
        study=found.ledger.digest,
    )
