"""An assessment as tables for a terminal."""

from __future__ import annotations

from pathlib import Path

from rich import box
from rich.table import Table

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.fractions import Fraction, Range, contradiction
from stonepass.clinic.patient import INPUTS
from stonepass.records.assess import LENGTHS
from stonepass.units import METRE_PER_MM, PASCAL_PER

__all__ = ["assess_tables", "describe_inputs", "describe_range", "noise_in_words"]


def assess_tables(found: Assessment) -> list[Table]:
    """Return tables of pressures and fractions, of the sensitivity, and of cohorts."""
    tables = [_pressures(found)]
    if found.sensitivity:
        tables.append(_sensitivity(found))
    return [*tables, _cohorts(found)]


def describe_inputs(found: Assessment) -> dict[str, str]:
    """Return every input in words, by its name for a reader."""
    patient = found.patient
    inputs = {
        INPUTS[name]: each.describe(METRE_PER_MM, "mm") if name in LENGTHS else each.describe()
        for name, each in patient.measured.items()
    } | {"wall": patient.material.name}
    load, model, shape = patient.load, patient.model, patient.shape
    if load.confining_pressure > 0.0:
        outside = f"{load.confining_pressure / 1e3:g} kPa, {load.confinement}"
        inputs["confining pressure"] = outside
    if load.prestretch != 1.0:
        inputs["pre-stretch"] = f"{load.prestretch:g}"
    if not shape.spheroidal:
        inputs["shape"] = Path(shape.reference).name or "of its own"
    elif shape.aspect != 1.0:
        inputs["aspect"] = f"{shape.aspect:g}"
    seating = getattr(model, "seating", None)
    inputs["model"] = model.NAME if seating is None else f"{model.NAME}, {seating}"
    return inputs


def describe_range(found: Range | None, unit: str = "kPa") -> tuple[str, str]:
    """Return median and interval in words, in kPa or mmHg; empty without a range."""
    if found is None:
        return "", ""
    scale = PASCAL_PER[unit]

    def in_words(value: float | None) -> str:
        if value is not None:
            return f"{float(f'{value / scale:.3g}'):g}"
        assert found.at_least is not None
        return f"above {float(f'{found.at_least / scale:.3g}'):g}"

    return (
        f"{in_words(found.median)} {unit}",
        f"{in_words(found.low)} to {in_words(found.high)} {unit}",
    )


def noise_in_words(found: Assessment) -> str:
    """Return how far median and fractions would move with other samples of the same number."""
    fraction = f"fractions ± {max(100.0 * found.fraction_noise, 0.1):.1f} %"
    if found.median_noise is None:
        return fraction
    return f"median ± {found.median_noise / 1e3:.2g} kPa, {fraction}"


def _pressures(found: Assessment) -> Table:
    title = " · ".join(f"{name} {text}" for name, text in describe_inputs(found).items())
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    for name in ("", "median", "90 % interval", "mmHg"):
        table.add_column(name)
    rows = (("critical pressure", found.critical), ("present urine pressure", found.present))
    for name, values in rows:
        if values is not None:
            table.add_row(
                f"[bold]{name}[/bold]", *describe_range(values), describe_range(values, "mmHg")[1]
            )
    if found.central is not None:
        table.add_row("critical, at the measured values", f"{found.central / 1e3:.3g} kPa", "", "")
    table.add_section()
    limit = f"{found.patient.limit / 1e3:.4g} kPa"
    fractions = (
        (f"critical below {limit}, stone held", found.below_limit_held, "of those held"),
        (f"critical below {limit}", found.below_limit, "of samples"),
        ("critical below the present one", found.below_present, "of samples"),
    )
    for name, fraction, of in fractions:
        if fraction is not None:
            words = f"[bold]{_words(fraction)}[/bold]"
            table.add_row(f"[bold]{name}[/bold]", words, of)
    if found.critical is not None:
        loose = Fraction(found.loose, found.loose)
        table.add_row("stone no larger than the lumen", _words(loose), "of samples")
    return table


def _sensitivity(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("what the spread comes from (with interactions)")
    table.add_column("", justify="right")
    table.add_column("")
    for each in found.sensitivity:
        bar = "█" * max(1, round(30 * each.total))
        table.add_row(each.name, f"{round(100 * each.total)} %", bar)
    return table


def _cohorts(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title="What cohorts saw", title_justify="left")
    for name in ("", "passed", "cohort", "model, below limit"):
        table.add_column(name, overflow="fold")
    for row in found.cohorts:
        passed = "" if row.passed is None else f"{round(100 * row.passed)} %"
        if row.days is not None:
            passed += f"{', ' if passed else ''}{row.days:g} days"
        fraction = found.beside(row)
        model = _words(fraction)
        if row.passed is not None:
            model += f", {contradiction(row.passed, fraction)}" if model else ""
        else:
            model = ""
        table.add_row(row.group, passed, row.cohort.name, model)
    return table


def _words(fraction: Fraction | None) -> str:
    return "" if fraction is None else fraction.describe()
