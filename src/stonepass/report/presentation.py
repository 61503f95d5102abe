"""The presentation of each result: its record, its rows, its tables, its graph and its picture.

`SHOWN` has one entry for each type of result. The package names this module as the presentation of
`stonepass.result`, so that ``answer.plot()`` ends here.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.bench.comparison import point_curves
from stonepass.bench.invitro import InVitro
from stonepass.bench.law_fit import FittedLaw
from stonepass.clinic.assessment import Assessment
from stonepass.errors import BadInput
from stonepass.io.csv_file import write_csv
from stonepass.io.text_file import check_writable, write_file
from stonepass.model.answer import Answer
from stonepass.model.size import SizeAnswer
from stonepass.records.answer import answer_record
from stonepass.records.assess import assess_record
from stonepass.records.base import Record, kilo
from stonepass.records.closures import closures_record
from stonepass.records.curve import curve_records
from stonepass.records.fit import fit_record
from stonepass.records.friction import friction_record
from stonepass.records.invitro import invitro_record
from stonepass.records.rising import rising_record
from stonepass.records.sensitivity import sensitivity_record, sensitivity_rows
from stonepass.records.size import size_record
from stonepass.records.sweep import sweep_record
from stonepass.report import plots
from stonepass.report.answer_figure import answer_figure
from stonepass.report.assess_figure import pressures_figure
from stonepass.report.assess_report import assess_summary, assess_tables
from stonepass.report.closures_report import closures_figure, closures_table
from stonepass.report.curve_figure import curve_figure
from stonepass.report.fit_figure import fit_figure
from stonepass.report.fit_report import fit_table
from stonepass.report.friction_figure import friction_figure
from stonepass.report.friction_report import friction_table
from stonepass.report.invitro_figure import invitro_figure
from stonepass.report.invitro_report import invitro_table
from stonepass.report.notebook_figure import displayed
from stonepass.report.printing import Part, as_html, as_text
from stonepass.report.rising_report import rising_figure, rising_table
from stonepass.report.sensitivity_figure import sensitivity_figure
from stonepass.report.sensitivity_report import sensitivity_parts
from stonepass.report.style import FORMATS
from stonepass.report.style import save as save_figure
from stonepass.report.sweep_figure import plot_sweep, sweep_figure
from stonepass.report.sweep_report import sweep_sentences, sweep_tables, sweep_warnings
from stonepass.report.table import (
    curve_table,
    grouped_warnings,
    pressure_tables,
    size_message,
    size_tables,
)
from stonepass.studies.closures import CLOSURES, ClosureComparison
from stonepass.studies.curve import CriticalCurve
from stonepass.studies.rising import Rising
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.studies.sweeps.results import SweepResults
from stonepass.surface.friction_result import SurfaceFriction

__all__ = ["SHOWN", "Shown", "figure", "html", "plot", "record", "rows", "save", "text"]

Row = dict[str, Any]


@dataclass(frozen=True)
class Shown:
    """The presentation of one type of result.

    Attributes
    ----------
    record : callable
        Returns a JSON-ready dictionary.
    parts : callable
        Returns tables and sentences, in their order.
    warnings : callable
        Returns sentences.
    plot : callable
        Draws the main graph on axes.
    figure : callable
        Returns the whole picture.
    rows : callable
        Returns the rows of a table; the scalars of the record by default.
    """

    record: Callable[[Any], Row]
    parts: Callable[[Any], Sequence[Part]]
    warnings: Callable[[Any], Sequence[object]]
    plot: Callable[[Any, Axes], None]
    figure: Callable[[Any], Figure]
    rows: Callable[[Any], list[Row]] | None = None


def record(result: Any) -> Row:
    """Return a JSON-ready dictionary."""
    return _of(result).record(result)


def rows(result: Any) -> list[Row]:
    """Return the rows of a table with one scalar in each cell."""
    own = _of(result).rows
    return [_scalars(record(result))] if own is None else own(result)


def text(result: Any) -> str:
    """Return tables, sentences and warnings as plain text."""
    return as_text(_of(result).parts(result), _of(result).warnings(result))


def html(result: Any) -> str:
    """Return tables, sentences and warnings for a notebook."""
    return as_html(_of(result).parts(result), _of(result).warnings(result))


def plot(result: Any, axes: Axes) -> None:
    """Draw the main graph on axes."""
    _of(result).plot(result, axes)


def figure(result: Any) -> Figure:
    """Return the whole picture, which a notebook displays."""
    return displayed(_of(result).figure(result))


def save(result: Any, path: Path) -> None:
    """Write a picture (.svg, .png, .pdf), the record (.json) or the rows (.csv)."""
    pictures = tuple(f".{each}" for each in FORMATS)
    check_writable(path, (*pictures, ".json", ".csv"))
    ending = path.suffix.lower()
    if ending == ".json":
        document = json.dumps(record(result), indent=2, ensure_ascii=False, allow_nan=False)
        write_file(path, document + "\n")
    elif ending == ".csv":
        table = rows(result)
        write_csv(path, tuple(table[0]), [list(row.values()) for row in table])
    else:
        save_figure(figure(result), path)


def _of(result: Any) -> Shown:
    for kind in type(result).__mro__:
        if kind in SHOWN:
            return SHOWN[kind]
    raise TypeError(f"{type(result).__name__} is not registered in report.presentation.SHOWN")


def _scalars(document: Row) -> Row:
    """Return the entries of a record that are single values; warnings become their codes.

    Entries that every record has (version, disclaimer) are left out.
    """
    found = {
        name: value
        for name, value in document.items()
        if name not in Record.model_fields
        and (value is None or isinstance(value, str | float | int))
    }
    codes = [each["code"] for each in document.get("warnings", [])]
    return found | {"warnings": " ".join(codes)}


def _answer_rows(answer: Answer) -> list[Row]:
    case, found = answer.case, _scalars(record(answer))
    return [
        found
        | {
            "friction": case.stone.friction,
            "confining_pressure_kPa": case.load.confining_pressure / 1e3,
            "prestretch": case.load.prestretch,
        }
    ]


def _curve_rows(curve: CriticalCurve) -> list[Row]:
    return [_scalars(each.to_dict()) for each in curve_records(curve)]


def _closure_rows(found: ClosureComparison) -> list[Row]:
    return [
        {
            "closure": name,
            "meaning": meaning,
            "critical_pressure_kPa": kilo(found.pressures[name]),
            "relative_to_direct": found.error(name),
        }
        for name, meaning in CLOSURES.items()
    ]


def _fit(found: FittedLaw) -> Row:
    """Return the record without the inputs of the command line: file and sizes at rest."""
    document = fit_record(found, {"file": "", "relative": False}).to_dict()
    return document | {"data": document.pop("inputs")["data"]}


def _series(found: InVitro) -> Row:
    document = invitro_record(found, "").to_dict()
    del document["inputs"]["file"]
    return document


def _without(document: Row, key: str) -> Row:
    return {name: value for name, value in document.items() if name != key}


def _sentence(answer: Answer) -> str:
    return f"{answer.outcome.name}: {answer.message}"


def _own(result: Any) -> Sequence[object]:
    warnings: Sequence[object] = result.warnings
    return warnings


def _size_figure(found: SizeAnswer) -> Figure:
    if found.at_size is None or found.size_ratio is None:
        raise BadInput("figure", found.outcome.name, "asked for where a critical size was found")
    return answer_figure(found.at_size)


def _sweep_rows(found: SweepResults) -> list[Row]:
    return [
        {name: _joined(value) for name, value in row.items()} for row in found.table().to_pylist()
    ]


def _joined(value: Any) -> Any:
    """Return a list of numbers as text, any other value as it is."""
    return "; ".join(map(repr, value)) if isinstance(value, list) else value


def _series_figure(found: InVitro) -> Figure:
    return invitro_figure(found, point_curves(found.comparison))


SHOWN: dict[type, Shown] = {
    Answer: Shown(
        record=lambda found: answer_record(found).to_dict(),
        parts=lambda found: [*pressure_tables(found), _sentence(found)],
        warnings=_own,
        plot=plots.plot_answer,
        figure=answer_figure,
        rows=_answer_rows,
    ),
    SizeAnswer: Shown(
        record=lambda found: size_record(found).to_dict(),
        parts=lambda found: [
            *size_tables(found),
            f"{found.outcome.name}: {size_message(found)}",
        ],
        warnings=_own,
        plot=plots.plot_size,
        figure=_size_figure,
    ),
    CriticalCurve: Shown(
        record=lambda found: {"points": [each.to_dict() for each in curve_records(found)]},
        parts=lambda found: [curve_table(found)],
        warnings=grouped_warnings,
        plot=plots.plot_curve,
        figure=curve_figure,
        rows=_curve_rows,
    ),
    ClosureComparison: Shown(
        record=lambda found: closures_record(found).to_dict(),
        parts=lambda found: [closures_table(found)],
        warnings=_own,
        plot=plots.plot_closures,
        figure=closures_figure,
        rows=_closure_rows,
    ),
    Rising: Shown(
        record=lambda found: rising_record(found).to_dict(),
        parts=lambda found: [rising_table(found), _sentence(found.critical)],
        warnings=lambda found: found.critical.warnings,
        plot=plots.plot_rising,
        figure=rising_figure,
        rows=lambda found: record(found)["states"],
    ),
    FittedLaw: Shown(
        record=_fit,
        parts=lambda found: [fit_table(found)],
        warnings=_own,
        plot=plots.plot_fit,
        figure=fit_figure,
        rows=lambda found: record(found)["constants"],
    ),
    InVitro: Shown(
        record=_series,
        parts=invitro_table,
        warnings=_own,
        plot=plots.plot_series,
        figure=_series_figure,
        rows=lambda found: record(found)["points"],
    ),
    SurfaceFriction: Shown(
        record=lambda found: _without(friction_record(found, "").to_dict(), "image"),
        parts=lambda found: [friction_table(found, "surface")],
        warnings=_own,
        plot=plots.plot_friction,
        figure=friction_figure,
    ),
    Assessment: Shown(
        record=lambda found: assess_record(found, "").to_dict(),
        parts=lambda found: [*assess_summary(found), *assess_tables(found), found.message],
        warnings=_own,
        plot=plots.plot_assessment,
        figure=pressures_figure,
    ),
    Sensitivity: Shown(
        record=lambda found: sensitivity_record(found).to_dict(),
        parts=sensitivity_parts,
        warnings=_own,
        plot=plots.plot_sensitivity,
        figure=sensitivity_figure,
        rows=sensitivity_rows,
    ),
    SweepResults: Shown(
        record=lambda found: sweep_record(found).to_dict(),
        parts=lambda found: [*sweep_tables(found), *sweep_sentences(found)],
        warnings=sweep_warnings,
        plot=plot_sweep,
        figure=sweep_figure,
        rows=_sweep_rows,
    ),
}
