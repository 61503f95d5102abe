"""Tables of the results of a sweep: outcomes by model, critical pressures, and inputs."""

from __future__ import annotations

from rich import box
from rich.table import Table

from stonepass.errors import Outcome
from stonepass.studies.sweeps.case_rows import OUTCOMES
from stonepass.studies.sweeps.results import SweepResults
from stonepass.studies.sweeps.statistics import (
    QUANTILES,
    input_ranges,
    pressure_quantiles,
    warning_counts,
)

__all__ = ["sweep_sentences", "sweep_tables", "sweep_warnings"]

MINUTE, HOUR, DAY = 60.0, 3600.0, 86_400.0


def sweep_tables(found: SweepResults) -> list[Table]:
    """Return a table of the outcomes, one of the critical pressures, and one of the inputs."""
    pressures = _pressures(found)
    return [
        _outcomes(found),
        *([pressures] if pressures.row_count else []),
        *([_inputs(found)] if found.inputs else []),
    ]


def _table(title: str, first: str, *others: str) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    table.add_column(first)
    for each in others:
        table.add_column(each, justify="right")
    return table


def _outcomes(found: SweepResults) -> Table:
    counts = found.counts
    title = f"{len(found)} of {found.cases} cases"
    table = _table(title, "outcome", *counts, "what it means")
    table.columns[-1].justify = "left"
    order = [*Outcome.__members__, *OUTCOMES]
    seen = {outcome for of_model in counts.values() for outcome in of_model}
    for outcome in sorted(seen, key=order.index):
        cells = [_share(of_model, outcome) for of_model in counts.values()]
        table.add_row(outcome, *cells, _meaning(outcome))
    return table


def _share(counts: dict[str, int], outcome: str) -> str:
    count, total = counts.get(outcome, 0), sum(counts.values())
    return f"{count} ({count / total:.1%})" if count else "–"


def _meaning(outcome: str) -> str:
    return OUTCOMES[outcome] if outcome in OUTCOMES else Outcome[outcome].value.split(",")[0]


def _pressures(found: SweepResults) -> Table:
    table = _table("critical pressure of the cases that have one (kPa)", "model", *QUANTILES)
    for label, values in pressure_quantiles(found).items():
        table.add_row(label, *(f"{each:.4g}" for each in values.values()))
    return table


def _inputs(found: SweepResults) -> Table:
    table = _table("varied inputs", "column", "from", "to")
    for name, ends in input_ranges(found).items():
        table.add_row(name, *("–" if each is None else f"{each:.6g}" for each in ends))
    return table


def sweep_sentences(found: SweepResults) -> list[str]:
    """Return a sentence on the cost of the cases, and one on the cases that are left."""
    told = []
    if len(found):
        mean = found.seconds / len(found)
        told.append(
            f"Solving took {mean:.2g} s a case and {_duration(found.seconds)} of one processor."
        )
    if len(found) < found.cases:
        told.append(
            f"{found.cases - len(found)} cases are not finished: the same sweep, resumed, solves "
            "them."
        )
    return told


def _duration(seconds: float) -> str:
    for unit, name in ((DAY, "days"), (HOUR, "h"), (MINUTE, "min")):
        if seconds >= 2.0 * unit:
            return f"{seconds / unit:.2g} {name}"
    return f"{seconds:.2g} s"


def sweep_warnings(found: SweepResults) -> list[str]:
    """Return one sentence for each code of a warning, with the number of its cases."""
    return [
        f"{count} of {len(found)} cases have the warning '{code}'"
        for code, count in warning_counts(found).items()
    ]
