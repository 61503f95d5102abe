"""An answer about one stone as one HTML page that needs no other file, to print."""

from __future__ import annotations

from datetime import date
from html import escape
from pathlib import Path

from stonepass.about import DISCLAIMER, VERSION
from stonepass.errors import BadInput
from stonepass.inputs.case_file import values_of
from stonepass.inputs.case_record import fingerprint
from stonepass.inputs.catalogue import all_inputs
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.size import SizeAnswer
from stonepass.report.answer_figure import answer_figure
from stonepass.report.assess_style import STYLE
from stonepass.report.case_line import case_line
from stonepass.report.html import inline_svg, page_text
from stonepass.report.printing import as_html
from stonepass.report.table import pressure_tables, size_message, size_tables

__all__ = ["pressure_page", "size_page"]

PRESSURE_TITLE = "At what urine pressure does this stone move?"
SIZE_TITLE = "How large a stone moves at this urine pressure?"
LIMITS = (
    "The number is that of a model of a passive tube with a stone of regular shape. It is not the "
    "chance of passage: peristalsis, muscle tone, time and swelling are not in the model."
)
PAPER = "Liu et al. 2022, Critical size of kidney stone through ureter: A mechanical analysis"
DOI = "10.1016/j.jmbbm.2022.105432"


def pressure_page(answer: Answer, case: Case, written: date | None = None) -> str:
    """Return the page of a critical pressure.

    Parameters
    ----------
    answer : Answer
        With the stress field of its state, for the figure.
    case : Case
        The case that was asked.
    written : date, optional
        Date of the report; today by default.
    """
    result = [f"<p><b>{escape(answer.message)}</b></p>", as_html(pressure_tables(answer), [])]
    return _page(PRESSURE_TITLE, case, result, answer, answer.warnings, written)


def size_page(answer: SizeAnswer, case: Case, written: date | None = None) -> str:
    """Return the page of a critical size; for the parameters see `pressure_page`."""
    result = [f"<p><b>{escape(size_message(answer))}</b></p>", as_html(size_tables(answer), [])]
    return _page(SIZE_TITLE, case, result, answer.at_size, answer.warnings, written,
                 with_stone=False)  # fmt: skip


def _page(
    title: str,
    case: Case,
    result: list[str],
    shown: Answer | None,
    warnings: tuple[object, ...],
    written: date | None,
    *,
    with_stone: bool = True,
) -> str:
    day = f"{written or date.today():%Y-%m-%d}"
    told = "".join(f"<li>{escape(str(each))}.</li>" for each in warnings)
    body = [
        "<header>",
        f"<h1>{title}</h1>",
        f'<p class="about">{escape(case_line(case, case.model, with_stone=with_stone))}</p>',
        f'<p class="about">Report of {day}, stonepass {VERSION}.</p>',
        f'<p class="band">{DISCLAIMER}</p>',
        "</header>",
        '<section class="decide"><h2>Result</h2>',
        *result,
        f"<p>{LIMITS}</p></section>",
        *([f"<h2>Warnings</h2><ul>{told}</ul>"] if told else []),
        *_figure(shown),
        "<h2>Inputs</h2>",
        f'<ul class="inputs">{"".join(_inputs(case, with_stone))}</ul>',
        "<h2>Method and sources</h2>",
        f"<p>Model '{case.model.NAME}': {escape(case.model.MEANING)}. Accuracy "
        f"'{case.numerics.accuracy}'; numbers have estimates of their discretisation error.</p>",
        f"<p>Wall: {escape(case.ureter.material.source)}. Test: "
        f"{escape(case.ureter.material.test)}.</p>",
        f'<p>{PAPER}, <a href="https://doi.org/{DOI}">doi:{DOI}</a>.</p>',
        f"<footer><p>Fingerprint of the case: {fingerprint(case, case.model, case.numerics)}.</p>"
        f"<p>{DISCLAIMER}</p></footer>",
    ]
    return page_text(title, STYLE, "\n".join(body))


def _figure(answer: Answer | None) -> list[str]:
    """Return the picture of an answer, if it has one."""
    if answer is None:
        return []
    try:
        drawn = answer_figure(answer)
    except BadInput:  # no stone is in contact
        return []
    return [
        "<h2>Wall, contact and forces</h2>",
        inline_svg(drawn, "Section through wall and stone"),
    ]


def _inputs(case: Case, with_stone: bool) -> list[str]:
    """Return every input of the case as an item of a list, if asked without the stone's size."""
    sizes = () if with_stone else ("stone.diameter", "stone.size_ratio")
    return [
        f"<li><b>{escape(_title(key))}:</b> {escape(_shown(value))}</li>"
        for key, value in values_of(case, Path()).items()
        if key not in sizes
    ]


def _title(key: str) -> str:
    return all_inputs()[key].title.replace("_", " ")


def _shown(value: object) -> str:
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else str(value)
