"""An assessment: JSON record and tables for a terminal."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rich import box
from rich.table import Table

from stonepass.about import DISCLAIMER, VERSION
from stonepass.clinic.assessment import Assessment, Range, Share, contradiction
from stonepass.clinic.patient import INPUTS
from stonepass.clinic.pressure_limits import limit_told
from stonepass.records.answer import record
from stonepass.units import METRE_PER_MM, PASCAL_PER

__all__ = ["CAUTION", "assess_record", "assess_tables", "measured_told", "range_told"]

CAUTION = (
    "The shares speak of the inputs' uncertainty in a model of a passive tube. They are no chance "
    "of passing: peristalsis, muscle tone, time and swelling are not in it."
)
LENGTHS = tuple(name for name in INPUTS if "diameter" in name or "thickness" in name)


def assess_record(found: Assessment, file: str) -> dict[str, Any]:
    """All of it as a JSON-ready record; `file` is where the person stands."""
    person = found.person
    return {
        "outcome": found.outcome.name,
        "message": found.message,
        "critical_pressure_kPa": _range(found.critical),
        "critical_pressure_at_values_kPa": None if found.central is None else found.central / 1e3,
        "at_values": record(found.at_values),
        "present_pressure_kPa": _range(found.present),
        "critical_below_limit": _share(found.below_limit),
        "critical_below_present": _share(found.below_present),
        "no_larger_than_lumen": found.loose,
        "drivers": {driver.name: driver.share for driver in found.drivers},
        "by_size": [
            {"diameter_mm": size, **(_share(share) or {})} for size, share in found.by_size
        ],
        "cohorts": [
            {
                "cohort": row.cohort.name,
                "source": row.cohort.source,
                "read": row.cohort.read,
                "about": row.cohort.about,
                "group": row.group,
                "passed": row.passed,
                "days": row.days,
                "model": _share(found.beside(row)),
                "comparison": ""
                if row.passed is None
                else contradiction(row.passed, found.beside(row)),
            }
            for row in found.cohorts
        ],
        "inputs": {
            "file": file,
            "measured": {
                name: {
                    "value": each.value,
                    "sd": each.sd,
                    "low": None if each.sd is not None else each.low,
                    "high": None if each.sd is not None else each.high,
                    "unit": "m" if name in LENGTHS else "",
                }
                for name, each in person.measured.items()
            },
            "material": person.material.name,
            "place": person.place,
            "limit_kPa": person.limit / 1e3,
            "limit_source": limit_told(person.limit),
            "samples": person.samples,
            "seed": person.seed,
        },
        "accuracy": {
            "possible": found.possible,
            "solves": found.solves,
            "surface_error": found.surface_error,
        },
        "level": 0.90,
        "warnings": list(found.warnings),
        "caution": CAUTION,
        "version": VERSION,
        "disclaimer": DISCLAIMER,
    }


def assess_tables(found: Assessment) -> list[Table]:
    """Pressures and shares, what drives them, cohorts."""
    tables = [_pressures(found)]
    if found.drivers:
        tables.append(_drivers(found))
    return [*tables, _cohorts(found)]


def measured_told(found: Assessment) -> dict[str, str]:
    """Every input in words, by what it is called."""
    person = found.person
    told = {
        INPUTS[name]: each.told(METRE_PER_MM, "mm") if name in LENGTHS else each.told()
        for name, each in person.measured.items()
    } | {"wall": person.material.name}
    load, method, shape = person.load, person.method, person.shape
    if load.confining_pressure > 0.0:
        outside = f"{load.confining_pressure / 1e3:g} kPa, {load.confinement}"
        told["confining pressure"] = outside
    if load.prestretch != 1.0:
        told["pre-stretch"] = f"{load.prestretch:g}"
    if not shape.spheroidal:
        told["shape"] = Path(shape.reference).name or "of its own"
    elif shape.aspect != 1.0:
        told["aspect"] = f"{shape.aspect:g}"
    told["model"] = method.model if method.model == "direct" else f"paper, {method.seating}"
    return told


def range_told(found: Range | None, unit: str = "kPa") -> tuple[str, str]:
    """Median and interval in words, in kPa or mmHg."""
    if found is None:
        return "", ""
    scale = PASCAL_PER[unit]

    def told(value: float | None) -> str:
        if value is not None:
            return f"{float(f'{value / scale:.3g}'):g}"
        assert found.at_least is not None
        return f"above {float(f'{found.at_least / scale:.3g}'):g}"

    return f"{told(found.median)} {unit}", f"{told(found.low)} to {told(found.high)} {unit}"


def _pressures(found: Assessment) -> Table:
    title = " · ".join(f"{name} {told}" for name, told in measured_told(found).items())
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    for name in ("", "median", "90 % interval", "mmHg"):
        table.add_column(name)
    rows = (("critical pressure", found.critical), ("present urine pressure", found.present))
    for name, values in rows:
        if values is not None:
            table.add_row(
                f"[bold]{name}[/bold]", *range_told(values), range_told(values, "mmHg")[1]
            )
    if found.central is not None:
        table.add_row("critical, at the measured values", f"{found.central / 1e3:.3g} kPa", "", "")
    table.add_section()
    limit = f"{found.person.limit / 1e3:.4g} kPa"
    shares = (
        (f"critical below the limit, {limit}", found.below_limit),
        ("critical below the present pressure", found.below_present),
    )
    for name, share in shares:
        if share is not None:
            table.add_row(f"[bold]{name}[/bold]", f"[bold]{_told(share)}[/bold]", "of samples")
    if found.critical is not None:
        table.add_row("of these: no larger than the lumen", f"{round(100 * found.loose)} %",
                      "of samples")  # fmt: skip
    return table


def _drivers(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("what the spread comes from (with interactions)")
    table.add_column("", justify="right")
    table.add_column("")
    for driver in found.drivers:
        bar = "█" * max(1, round(30 * driver.share))
        table.add_row(driver.name, f"{round(100 * driver.share)} %", bar)
    return table


def _cohorts(found: Assessment) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title="What cohorts saw", title_justify="left")
    for name in ("", "passed", "cohort", "model, below limit"):
        table.add_column(name, overflow="fold")
    for row in found.cohorts:
        passed = "" if row.passed is None else f"{round(100 * row.passed)} %"
        if row.days is not None:
            passed += f"{', ' if passed else ''}{row.days:g} days"
        share = found.beside(row)
        told = _told(share)
        if row.passed is not None:
            told += f", {contradiction(row.passed, share)}" if told else ""
        else:
            told = ""
        table.add_row(row.group, passed, row.cohort.name, told)
    return table


def _told(share: Share | None) -> str:
    return "" if share is None else share.told()


def _range(found: Range | None) -> dict[str, float | None] | None:
    if found is None:
        return None
    return {
        name: None if value is None else value / 1e3
        for name, value in (
            ("low", found.low),
            ("median", found.median),
            ("high", found.high),
            ("at_least", found.at_least),
        )
    }


def _share(share: Share | None) -> dict[str, float] | None:
    return None if share is None else {"low": share.low, "high": share.high}
