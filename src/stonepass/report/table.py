"""Answers as short tables for a terminal, pressures in kPa, mmHg and cmH₂O."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from pathlib import Path

from rich import box
from rich.markup import escape
from rich.table import Table

from stonepass.model.answer import Answer, Quantity
from stonepass.model.contact_state import SolvedState
from stonepass.model.problem import Problem
from stonepass.model.size import SizeAnswer
from stonepass.units import PASCAL_PER

__all__ = [
    "case_title",
    "curve_table",
    "grouped_warnings",
    "pressure_table",
    "significant",
    "size_table",
]


SYMMETRIC = 1e-9  # rad, within which a contact ends where its mirror image begins


def pressure_table(answer: Answer) -> Table:
    """One answer: what was asked, then the pressures."""
    table = _pressures(case_title(answer.case))
    if answer.pressure is not None:
        error = None if answer.error is None else answer.error.critical_pressure
        _pressure_row(table, "[bold]critical pressure[/bold]", answer.pressure, error)
    _state_rows(table, answer)
    if answer.critical_angle is not None and answer.closure_end_pressure is not None:
        _angle_row(table, "critical angle", answer.critical_angle)
    return table


def size_table(answer: SizeAnswer) -> Table:
    """One critical size: the size, then the state at it."""
    case = answer.case
    table = _pressures(case_title(case, with_stone=False))
    _pressure_row(table, "pressure limit", answer.limit)
    if answer.size_ratio is None or answer.at_size is None:
        return table
    error = "" if answer.size_ratio_error is None else f"± {_up(answer.size_ratio_error, 1e-4)}"
    size = f"[bold]{answer.size_ratio:.4f}[/bold]"
    table.add_row("[bold]critical size ratio[/bold]", size, "", "", error)
    if answer.diameter is not None:
        table.add_row("[bold]critical diameter[/bold]", f"[bold]{answer.diameter * 1e3:.3f} mm")
    _state_rows(table, answer.at_size)
    return table


def curve_table(answers: Sequence[Answer]) -> Table:
    """A curve: one row per size ratio."""
    table = Table(box=box.SIMPLE_HEAD, title=case_title(answers[0].case, with_stone=False))
    for name in ("size ratio", "outcome", "kPa", "mmHg", "cmH₂O", "solver error", "contact angle"):
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
        size = f"{answer.case.size_ratio:.4g}"
        table.add_row(size, answer.outcome.name, *pressures, error, angle)
    return table


def grouped_warnings(answers: Sequence[Answer], left_out: Collection[str] = ()) -> list[str]:
    """One sentence for each kind of warning: in how many cases, and that of the last one.

    `left_out` has codes of cautions that are not listed.
    """
    kinds: dict[str, list[tuple[float, str]]] = {}
    for answer in answers:
        for warning in answer.warnings:
            if warning.code in left_out:
                continue
            kinds.setdefault(warning.code, []).append((answer.case.size_ratio, str(warning)))
    return [
        f"in {len(found)} of {len(answers)} cases, the last one ξ = {found[-1][0]:.4g}: "
        f"{found[-1][1]}"
        for found in kinds.values()
    ]


def _pressures(title: str) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    table.add_column("")
    for column in ("kPa", "mmHg", "cmH₂O", "solver error"):
        table.add_column(column, justify="right")
    return table


def _pressure_row(table: Table, name: str, pascals: float, error: float | None = None) -> None:
    values = (significant(pascals / scale) for scale in PASCAL_PER.values())
    table.add_row(name, *values, _share(error, pascals))


def _angle_row(table: Table, name: str, radians: float, error: float | None = None) -> None:
    shown = "" if error is None else f"± {_up(_deg(error), 1e-3)}°"
    table.add_row(name, f"{_deg(radians):.2f}°", "", "", shown)


def _share(error: float | None, value: float | None) -> str:
    """An error relative to its number; nothing where either is missing, or the number is 0."""
    if error is None or not value:
        return ""
    return f"± {_up(100.0 * error / value, 1e-3)} %"


def _up(error: float, least: float) -> str:
    """An error rounded up to one significant digit: 0.31 is 0.4, 12 is 20."""
    error = max(error, least)
    digits = -math.floor(math.log10(error))
    rounded = math.ceil(error * 10.0**digits - 1e-9) / 10.0**digits
    return f"{rounded:.{max(digits, 0)}f}"


def _state_rows(table: Table, answer: Answer) -> None:
    contact = answer.contact
    quantities = [] if answer.detail is None else answer.detail.quantities()
    pressures = [each for each in quantities if each.unit == "kPa"]
    for each in pressures:
        _quantity_row(table, each)
    if contact is None:
        return
    error = answer.error
    equator = None if error is None else error.equator_contact_pressure
    _pressure_row(table, "contact pressure, equator", contact.equator_contact_pressure, equator)
    _pressure_row(table, "contact pressure, peak", contact.peak_contact_pressure)
    angle = None if error is None else error.contact_angle
    _angle_row(table, "contact angle", contact.contact_angle, angle)
    for each in quantities:
        if each not in pressures:
            _quantity_row(table, each)
    if abs(contact.contact_angle + contact.downstream_angle - math.pi) > SYMMETRIC:
        _angle_row(table, "contact ends", contact.downstream_angle)
    if isinstance(contact, SolvedState):
        table.add_row("stability margin", f"{contact.stability.margin:.2f}")


def _quantity_row(table: Table, quantity: Quantity) -> None:
    """One of the numbers that only this model knows, where it has a title."""
    value = quantity.value
    if not quantity.title or not isinstance(value, float):
        return
    if quantity.unit == "kPa":
        _pressure_row(table, quantity.title, value * 1e3)
    elif quantity.unit == "Pa":
        table.add_row(quantity.title, significant(value / 1e3))
    elif quantity.unit == "deg":
        _angle_row(table, quantity.title, math.radians(value))
    else:
        table.add_row(quantity.title, f"{value:.3f} {quantity.unit}".strip())


def case_title(case: Problem, *, with_stone: bool = True) -> str:
    """What was asked, in one line."""
    stone, ureter = case.stone, case.ureter
    sizes = [f"η = {case.wall_ratio:.4g}"]
    if with_stone:
        sizes.insert(0, f"ξ = {case.size_ratio:.4g}")
    parts = [", ".join(sizes), f"friction {stone.friction:g}", ureter.material.name]
    if not stone.shape.spheroidal:
        name = Path(stone.shape.reference).name or "of its own"
        parts.append(f"shape {escape(name)}")
    elif stone.aspect != 1.0:
        parts.append(f"aspect {stone.aspect:g}")
    if case.load.confining_pressure > 0.0:
        parts.append(f"P_out {case.load.confining_pressure / 1e3:g} kPa {case.load.confinement}")
    if case.load.prestretch != 1.0:
        parts.append(f"pre-stretch {case.load.prestretch:g}")
    if getattr(getattr(case, "model", None), "as_printed", False):
        parts.append("Eq. 5 as printed")
    return " · ".join(parts)


def _deg(radians: float) -> float:
    return math.degrees(radians)


def significant(value: float) -> str:
    """Four significant digits without an exponent: 0.04151, 12, 91.62, 1234."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    digits = max(0, 3 - math.floor(math.log10(abs(value))))
    return f"{value:.{digits}f}"
