"""Answers as tables for a terminal, with pressures in kPa, mmHg and cmH₂O."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

from rich import box
from rich.markup import escape
from rich.table import Table

from stonepass.model.answer import Answer, NamedQuantity
from stonepass.model.contact_state import SolvedState
from stonepass.model.problem import Problem
from stonepass.model.size import SizeAnswer
from stonepass.report.case_line import case_line
from stonepass.units import PASCAL_PER

__all__ = [
    "case_title",
    "curve_table",
    "grouped_warnings",
    "pressure_tables",
    "significant",
    "size_message",
    "size_tables",
]


SYMMETRIC = 1e-9  # rad; tolerance within which a contact is symmetric about the equator
ERROR = "discretisation error"  # header of the column
_PASCALS = {"kPa": 1e3, "Pa": 1.0}


def pressure_tables(answer: Answer) -> list[Table]:
    """Return the tables of one answer: its pressures, and its other quantities."""
    pressures = _pressures(case_title(answer.case))
    if answer.pressure is not None:
        error = None if answer.error is None else answer.error.critical_pressure
        _pressure_row(pressures, "[bold]critical pressure[/bold]", answer.pressure, error)
    others = _others()
    _state_rows(pressures, others, answer)
    if answer.critical_angle is not None and answer.closure_end_pressure is not None:
        _angle_row(others, "critical angle", answer.critical_angle)
    return [pressures, *([others] if others.row_count else [])]


def size_tables(answer: SizeAnswer) -> list[Table]:
    """Return the tables of a critical size: the size, then pressures and others at that size."""
    case = answer.case
    pressures = _pressures(case_title(case, with_stone=False))
    _pressure_row(pressures, "pressure limit", answer.limit)
    if answer.size_ratio is None or answer.at_size is None:
        return [pressures]
    others = _others()
    error = answer.size_ratio_error
    if answer.diameter is not None:
        inner = answer.diameter / answer.size_ratio
        shown = "" if error is None else f"± {_up(1e3 * error * inner, 1e-3)} mm"
        diameter = f"[bold]{answer.diameter * 1e3:.3f} mm[/bold]"
        others.add_row("[bold]critical diameter[/bold]", diameter, shown)
    size = f"[bold]{answer.size_ratio:.4f}[/bold]"
    shown = "" if error is None else f"± {_up(error, 1e-4)}"
    others.add_row("[bold]critical size ratio ξ[/bold]", size, shown)
    _state_rows(pressures, others, answer.at_size)
    return [pressures, others]


def size_message(answer: SizeAnswer) -> str:
    """Return the message of a critical size, in millimetres if the ureter has lengths."""
    if answer.diameter is None or answer.size_ratio is None:
        return answer.message
    return (
        f"A stone of {answer.diameter * 1e3:.4g} mm, which is {answer.size_ratio:.4g} times the "
        "inner diameter, moves at the pressure limit."
    )


def curve_table(answers: Sequence[Answer]) -> Table:
    """Return a table with one row for each size ratio."""
    first = answers[0].case
    inner = first.ureter.inner_diameter
    table = Table(
        box=box.SIMPLE_HEAD, title=case_title(first, with_stone=False), title_justify="left"
    )
    sizes = ["size ratio ξ"] if inner is None else ["stone mm", "size ratio ξ"]
    for name in (*sizes, "outcome", "kPa", "mmHg", "cmH₂O", ERROR, "contact angle"):
        table.add_column(name, justify="left" if name == "outcome" else "right")
    for answer in answers:
        pressures = (
            ["–"] * 3
            if answer.pressure is None
            else [significant(answer.pressure / scale) for scale in PASCAL_PER.values()]
        )
        angle = "–" if answer.contact is None else f"{_deg(answer.contact.contact_angle):.2f}°"
        error = (
            "" if answer.error is None else _share(answer.error.critical_pressure, answer.pressure)
        )
        ratio = answer.case.size_ratio
        size = [] if inner is None else [f"{1e3 * ratio * inner:.4g}"]
        table.add_row(*size, f"{ratio:.4g}", answer.outcome.name, *pressures, error, angle)
    return table


def grouped_warnings(answers: Sequence[Answer], left_out: Collection[str] = ()) -> list[str]:
    """Return one sentence for each kind of warning, with the number of cases that have it.

    Parameters
    ----------
    answers : sequence of Answer
    left_out : collection of str
        Codes of cautions that are left out.

    Returns
    -------
    list of str
        Each sentence is that of the last case in which the warning occurs.
    """
    kinds: dict[str, list[tuple[float, str]]] = {}
    for answer in answers:
        for warning in answer.warnings:
            if warning.code in left_out:
                continue
            kinds.setdefault(warning.code, []).append((answer.case.size_ratio, str(warning)))
    return [
        f"in {len(found)} of {len(answers)} cases: {found[-1][1]} (at ξ = {found[-1][0]:.4g})"
        for found in kinds.values()
    ]


def _pressures(title: str) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    table.add_column("pressures")
    for column in ("kPa", "mmHg", "cmH₂O", ERROR):
        table.add_column(column, justify="right")
    return table


def _others() -> Table:
    """Return an empty table for quantities that are not pressures."""
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("other quantities")
    for column in ("value", ERROR):
        table.add_column(column, justify="right")
    return table


def _pressure_row(table: Table, name: str, pascals: float, error: float | None = None) -> None:
    values = (significant(pascals / scale) for scale in PASCAL_PER.values())
    table.add_row(name, *values, _share(error, pascals))


def _angle_row(table: Table, name: str, radians: float, error: float | None = None) -> None:
    shown = "" if error is None else f"± {_up(_deg(error), 1e-3)}°"
    table.add_row(name, f"{_deg(radians):.2f}°", shown)


def _share(error: float | None, value: float | None) -> str:
    """Write an error relative to its value; empty if either is missing, or the value is 0."""
    if error is None or not value:
        return ""
    return f"± {_up(100.0 * error / value, 1e-3)} %"


def _up(error: float, least: float) -> str:
    """Write an error rounded up to one significant digit: 0.31 becomes 0.4, and 12 becomes 20."""
    error = max(error, least)
    digits = -math.floor(math.log10(error))
    rounded = math.ceil(error * 10.0**digits - 1e-9) / 10.0**digits
    return f"{rounded:.{max(digits, 0)}f}"


def _state_rows(pressures: Table, others: Table, answer: Answer) -> None:
    """Add rows of the contact and of the quantities that only this model has."""
    contact = answer.contact
    quantities = [] if answer.detail is None else answer.detail.quantities()
    if contact is not None:
        error = answer.error
        equator = None if error is None else error.equator_contact_pressure
        angle = None if error is None else error.contact_angle
        at_equator, peak = contact.equator_contact_pressure, contact.peak_contact_pressure
        _pressure_row(pressures, "contact pressure, equator", at_equator, equator)
        _pressure_row(pressures, "contact pressure, peak", peak)
        _angle_row(others, "contact angle", contact.contact_angle, angle)
        if abs(contact.contact_angle + contact.downstream_angle - math.pi) > SYMMETRIC:
            _angle_row(others, "contact ends", contact.downstream_angle)
    for each in quantities:
        if contact is not None or each.unit == "kPa":
            _quantity_row(pressures, others, each)
    if isinstance(contact, SolvedState):
        margin = contact.stability.margin
        remark = "see the warning" if margin <= 0.0 else ""
        others.add_row("stability margin", f"{margin:.2f}", remark)


def _quantity_row(pressures: Table, others: Table, quantity: NamedQuantity) -> None:
    """Add a quantity that only one model has, if it has a title."""
    value = quantity.value
    if not quantity.title or not isinstance(value, float):
        return
    if quantity.unit in _PASCALS:
        _pressure_row(pressures, quantity.title, value * _PASCALS[quantity.unit])
    elif quantity.unit == "deg":
        _angle_row(others, quantity.title, math.radians(value))
    else:
        others.add_row(quantity.title, f"{value:.3f} {quantity.unit}".strip(), "")


def case_title(case: Problem, *, with_stone: bool = True) -> str:
    """Return the line of the case that figures have too; markup in it is escaped."""
    line = escape(case_line(case, with_stone=with_stone))
    printed = getattr(getattr(case, "model", None), "as_printed", False)
    return f"{line} · Eq. 5 as printed" if printed else line


def _deg(radians: float) -> float:
    return math.degrees(radians)


def significant(value: float) -> str:
    """Write four significant digits without an exponent: 0.04151, 12.00, 91.62, 1234."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    digits = max(0, 3 - math.floor(math.log10(abs(value))))
    return f"{value:.{digits}f}"
