"""Tables of an assessment for a terminal, and texts that the page uses too."""

from __future__ import annotations

import re
from pathlib import Path

from rich import box
from rich.markup import escape
from rich.table import Table

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import Row
from stonepass.clinic.contradiction import FEWER, MORE, contradiction
from stonepass.clinic.decisions import CONTRADICTIONS, decisions, next_measurement
from stonepass.clinic.patient import INPUTS
from stonepass.records.assess import LENGTHS
from stonepass.studies.censored_samples import Fraction, PercentileRange
from stonepass.units import METRE_PER_MM, PASCAL_PER

__all__ = [
    "FAR",
    "SENSITIVITY",
    "assess_summary",
    "assess_tables",
    "contradictions",
    "describe_beside",
    "describe_inputs",
    "describe_passed",
    "describe_range",
    "noise_in_words",
    "sentence",
]

_PERCENT = re.compile(r"(\d)%")
UNITS = {"kPa": "kPa", "mmHg": "mmHg", "cmH2O": "cmH₂O"}
FAR = {MORE: "↑", FEWER: "↓"}
ARROWS = "↑ more, ↓ fewer stones passed than the model's fraction"
SENSITIVITY = (
    "Sobol' total index of every uncertain input: the fraction of the variance of the rank of the "
    "critical pressure to which the input contributes, alone or together with others. The indices "
    "may therefore sum to more than 100 %."
)


def assess_summary(found: Assessment) -> list[Table]:
    """Return lists of contradictions and of questions that are undecided and decided."""
    asked = decisions(found)
    lists = {
        "Contradictions": contradictions(found),
        "These measurements cannot decide": [each.sentence for each in asked if not each.decided],
        "Within the model, they decide": [each.sentence for each in asked if each.decided],
        "Largest source of uncertainty": [next_measurement(found)] if found.sensitivity else [],
    }
    return [_list(title, sentences) for title, sentences in lists.items() if sentences]


def assess_tables(found: Assessment) -> list[Table]:
    """Return tables of the pressures and fractions, of the sensitivity, and of cohorts."""
    tables = [_pressures(found), _fractions(found)]
    if found.sensitivity:
        tables.append(_sensitivity(found))
    return [*tables, _cohorts(found)]


def contradictions(found: Assessment) -> list[str]:
    """Return the sentences about contradictions, that of the pressures first."""
    told = [each for each in found.warnings if each.code in CONTRADICTIONS]
    told.sort(key=lambda each: CONTRADICTIONS.index(each.code))
    return [sentence(str(each)) for each in told]


def sentence(text: str) -> str:
    """Return the text of a caution as a sentence, with its percentages spaced as elsewhere."""
    return _PERCENT.sub(r"\1 %", f"{text[:1].upper()}{text[1:]}.")


def describe_inputs(found: Assessment) -> dict[str, str]:
    """Return every input in words, by its name for a reader."""
    patient = found.patient
    inputs = {
        INPUTS[name]: each.describe(METRE_PER_MM, "mm") if name in LENGTHS else each.describe()
        for name, each in patient.measured.items()
    } | {"material of the wall": patient.material.name}
    load, model, shape = patient.load, patient.model, patient.shape
    if load.confining_pressure > 0.0:
        outside = f"{load.confining_pressure / 1e3:g} kPa, {load.confinement}"
        inputs["confining pressure"] = outside
    if load.prestretch != 1.0:
        inputs["pre-stretch"] = f"{load.prestretch:g}"
    if not shape.spheroidal:
        inputs["shape"] = Path(shape.reference).name or "given by points"
    elif shape.aspect != 1.0:
        inputs["aspect"] = f"{shape.aspect:g}"
    seating = getattr(model, "seating", None)
    inputs["model"] = model.NAME if seating is None else f"{model.NAME}, {seating} seating"
    return inputs


def describe_range(found: PercentileRange | None, unit: str = "kPa") -> tuple[str, str]:
    """Return median and interval in words in a unit of pressure; empty without a range."""
    if found is None:
        return "", ""
    scale, shown = PASCAL_PER[unit], UNITS[unit]

    def in_words(value: float | None) -> str:
        if value is not None:
            return f"{float(f'{value / scale:.3g}'):g}"
        assert found.at_least is not None
        return f"above {float(f'{found.at_least / scale:.3g}'):g}"

    return (
        f"{in_words(found.median)} {shown}",
        f"{in_words(found.low)} to {in_words(found.high)} {shown}",
    )


def describe_passed(row: Row) -> str:
    """Return the rate of a cohort in words: fraction, interval, number of stones, mean time."""
    parts = []
    if row.passed is not None:
        parts.append(f"{round(100 * row.passed)} %")
    if row.interval is not None:
        parts.append("95 %: {:.0f} to {:.0f} %".format(*(100.0 * end for end in row.interval)))
    if row.count is not None:
        parts.append(f"n = {row.count}")
    if row.days is not None:
        parts.append(f"{row.days:g} days")
    return ", ".join(parts)


def describe_beside(found: Assessment, row: Row) -> str:
    """Return the model's fraction for a row, with an arrow if it differs much from the cohort's."""
    fraction = found.beside(row)
    if row.passed is None or fraction is None:
        return ""
    arrow = FAR.get(contradiction(row.passed, fraction), "")
    return f"{fraction.describe()} {arrow}".strip()


def noise_in_words(found: Assessment) -> str:
    """Return the standard errors of median and fractions due to the number of samples."""
    fraction = f"fractions ± {max(100.0 * found.fraction_noise, 0.1):.1f} %"
    if found.median_noise is None:
        return fraction
    return f"median ± {found.median_noise / 1e3:.2g} kPa, {fraction}"


def _list(title: str, sentences: list[str]) -> Table:
    table = Table(box=None, show_header=False, title=title, title_justify="left", padding=(0, 1))
    for _ in range(2):
        table.add_column()
    for each in sentences:
        table.add_row("•", escape(each))
    return table


def _pressures(found: Assessment) -> Table:
    title = " · ".join(f"{name} {text}" for name, text in describe_inputs(found).items())
    table = Table(box=box.SIMPLE_HEAD, title=escape(title), title_justify="left")
    for name in ("pressures", "median", "90 % interval"):
        table.add_column(name)
    rows = (("critical pressure", found.critical), ("present urine pressure", found.present))
    for name, values in rows:
        if values is not None:
            for unit in UNITS:
                first = f"[bold]{name}[/bold]" if unit == "kPa" else ""
                table.add_row(first, *describe_range(values, unit))
    if found.central is not None:
        table.add_row("critical, at the measured values", f"{found.central / 1e3:.3g} kPa", "")
    return table


def _fractions(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("condition")
    table.add_column("fraction of the simulated input combinations")
    limit = f"{found.patient.limit / 1e3:.4g} kPa"
    rows = (
        ("present pressure above the critical pressure", found.below_present),
        (f"critical pressure below {limit}, among held stones", found.below_limit_held),
        (f"critical pressure below {limit}", found.below_limit),
    )
    for name, fraction in rows:
        if fraction is not None:
            table.add_row(name, f"[bold]{_words(fraction)}[/bold]")
    if found.critical is not None:
        loose = Fraction(found.loose, found.loose)
        table.add_row("stone no larger than the lumen, not held", _words(loose))
    table.add_row("standard error due to the number of samples", noise_in_words(found))
    return table


def _sensitivity(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("sensitivity (Sobol' total indices; may sum to more than 100 %)")
    table.add_column("", justify="right")
    table.add_column("")
    for each in found.sensitivity:
        bar = "█" * max(1, round(20 * each.total))
        table.add_row(each.name, f"{round(100 * each.total)} %", bar)
    return table


def _cohorts(found: Assessment) -> Table:
    title = f"Such stones in published cohorts ({ARROWS})"
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    for name in ("cohort", "stones", "n", "passed", "95 % interval", "model"):
        table.add_column(name, justify="right" if name in ("n", "passed") else "left")
    for row in found.cohorts:
        passed = f"{row.days:g} days" if row.passed is None else f"{round(100 * row.passed)} %"
        ends = (
            ""
            if row.interval is None
            else "{:.0f} to {:.0f} %".format(*(100.0 * end for end in row.interval))
        )
        count = "" if row.count is None else str(row.count)
        table.add_row(row.cohort.name, row.group, count, passed, ends, describe_beside(found, row))
    return table


def _words(fraction: Fraction | None) -> str:
    return "" if fraction is None else fraction.describe()
