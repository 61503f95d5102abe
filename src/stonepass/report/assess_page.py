"""An assessment as one HTML file that needs no other file, for a phone, a screen and a printer."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import date
from html import escape
from pathlib import Path

from stonepass.about import DISCLAIMER, VERSION
from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import COHORTS, Row
from stonepass.clinic.decisions import CONTRADICTIONS, decisions, next_measurement
from stonepass.clinic.pressure_limits import LIMITS, describe_limit
from stonepass.io.text_file import write_file
from stonepass.records.assess import CAUTION
from stonepass.report.assess_figure import (
    cohorts_figure,
    pressures_figure,
    sensitivity_figure,
    sizes_figure,
)
from stonepass.report.assess_report import (
    FAR,
    SENSITIVITY,
    UNITS,
    contradictions,
    describe_beside,
    describe_inputs,
    describe_passed,
    describe_range,
    noise_in_words,
    sentence,
)
from stonepass.report.assess_sketch import sketch_figure
from stonepass.report.assess_style import STYLE
from stonepass.report.html import inline_svg, page_text

__all__ = ["assessment_page", "write_assessment"]

TITLE = "A stone in a ureter: which urine pressures may move it"
MEASURED_ABOVE = "Measured above obstructing stones: 1.9 kPa on average, up to 6.0 kPa."
_DOI = re.compile(r"doi:(10\.[^\s,;)]+)")


def write_assessment(found: Assessment, path: Path, written: date | None = None) -> None:
    """Write the page to a file; see `assessment_page`."""
    write_file(path, assessment_page(found, written))


def assessment_page(found: Assessment, written: date | None = None) -> str:
    """Return the page as HTML.

    Parameters
    ----------
    found : Assessment
    written : date, optional
        Date of the report; today by default.
    """
    day = f"{written or date.today():%Y-%m-%d}"
    name = found.patient.title
    body = [
        "<header>",
        f"<h1>{escape(name) if name else TITLE}</h1>",
        f'<p class="about">{f"{TITLE}. " if name else ""}Report of {day}, stonepass {VERSION}.</p>',
        f'<p class="band">{DISCLAIMER}</p>',
        "</header>",
        *_contradictions(found),
        *_decisions(found),
        *_pressures(found),
        *_measurements(found),
        *_cautions(found),
        *_curves(found),
        *_cohorts(found),
        *_sources(found),
        f"<footer><p>{_how(found)}</p><p>{DISCLAIMER}</p></footer>",
    ]
    return page_text(name or TITLE, STYLE, "\n".join(body))


def _contradictions(found: Assessment) -> list[str]:
    told = contradictions(found)
    if not told:
        return []
    return ['<section class="alert">', "<h2>Contradictions</h2>", _list(told), "</section>"]


def _decisions(found: Assessment) -> list[str]:
    asked = decisions(found)
    parts = ['<section class="decide">', "<h2>These measurements cannot decide</h2>"]
    parts.append(_list([each.sentence for each in asked if not each.decided]))
    decided = [each.sentence for each in asked if each.decided]
    if decided:
        parts += ["<h2>Within the model, they decide</h2>", _list(decided)]
    if found.sensitivity:
        parts.append(f"<p>{escape(next_measurement(found))}</p>")
    if found.samples is None:
        parts.append(f"<p>{escape(found.message)}</p>")
    return [*parts, "</section>"]


def _pressures(found: Assessment) -> list[str]:
    cards = []
    for name, about, values in (
        (
            "Critical pressure",
            "The urine pressure above the stone at which it would start to move.",
            found.critical,
        ),
        (
            "Present urine pressure",
            f"Estimated from the width of the dilated segment. {MEASURED_ABOVE}",
            found.present,
        ),
    ):
        if values is not None:
            rows = "".join(_pressure_row(*describe_range(values, unit)) for unit in UNITS)
            cards.append(
                f'<div class="card"><h3>{name}</h3><table><tr><th>median</th><th>90 % interval</th>'
                f"</tr>{rows}</table><p>{about}</p></div>"
            )
    if not cards:
        return []
    rows = "".join(
        f"<tr><td>{escape(big)}</td><td>{escape(small)}</td></tr>"
        for big, small in _fractions(found)
    )
    head = "<tr><th>fraction</th><th>of the simulated input combinations in which …</th></tr>"
    return [
        "<h2>Pressures and fractions</h2>",
        f'<div class="cards">{"".join(cards)}</div>',
        f'<table class="facts">{head}{rows}</table>' if rows else "",
        f'<p class="about">{escape(CAUTION)}</p>',
    ]


def _pressure_row(median: str, interval: str) -> str:
    return f"<tr><td>{escape(median)}</td><td>{escape(interval)}</td></tr>"


def _fractions(found: Assessment) -> list[tuple[str, str]]:
    """Return each fraction in words with its meaning."""
    limit = f"{found.patient.limit / 1e3:.4g} kPa"
    about = f"the critical pressure is below the limit of {limit}"
    below, held = found.below_limit, found.below_limit_held
    told = []
    if held is not None and below is not None and found.loose > 0.0:
        everywhere = f"{below.describe()} of all combinations"
        told.append((held.describe(), f"{about}, among those with a held stone ({everywhere})"))
    elif below is not None:
        told.append((below.describe(), about))
    if found.critical is not None:
        loose = f"{round(100 * found.loose)} %"
        told.append((loose, "the stone is no larger than the lumen and is not held"))
    if found.below_present is not None:
        above = found.below_present.describe()
        told.append((above, "the present pressure is above the critical pressure"))
    return told


def _measurements(found: Assessment) -> list[str]:
    patient = found.patient
    rows = list(describe_inputs(found).items())
    if patient.place is not None:
        rows.append(("place", patient.place))
    limit = f"{patient.limit / 1e3:.4g} kPa, {describe_limit(patient.limit)}"
    rows.append(("pressure limit", limit))
    items = "".join(f"<li><b>{escape(name)}:</b> {_linked(text)}</li>" for name, text in rows)
    return [
        "<h2>Measurements and assumptions</h2>",
        inline_svg(sketch_figure(found), "Sketch of stone and ureter at the measured sizes"),
        '<p class="about">The diameters of stone and ureter are to scale, at the measured values; '
        "the transitions are schematic. The sign ± means one standard deviation.</p>",
        f'<ul class="inputs">{items}</ul>',
    ]


def _cautions(found: Assessment) -> list[str]:
    told = [sentence(str(each)) for each in found.warnings if each.code not in CONTRADICTIONS]
    return ["<h2>Limitations of this result</h2>", _list(told)] if told else []


def _curves(found: Assessment) -> list[str]:
    if found.samples is None:
        return []
    parts = [
        '<div class="pair"><div>',
        "<h2>Fractions at every urine pressure</h2>",
        "<p>The solid curve is the fraction of the simulated input combinations (samples) whose "
        "critical pressure is below a urine pressure.</p>",
        inline_svg(pressures_figure(found), "Fraction of samples over urine pressure"),
        "</div>",
    ]
    if found.sensitivity:
        parts += [
            "<div><h2>Sensitivity: which inputs cause the uncertainty</h2>",
            f"<p>{escape(SENSITIVITY)}</p>",
            inline_svg(sensitivity_figure(found), "Sobol' total index of every input"),
            "</div>",
        ]
    return [*parts, "</div>"]


def _cohorts(found: Assessment) -> list[str]:
    relevant = [row.cohort.name for row in found.cohorts]
    others = [cohort.name for cohort in COHORTS if cohort.name not in relevant]
    none = (
        f"<p>Cohorts without a class of such stones: {escape(', '.join(others))}.</p>"
        if others
        else ""
    )
    body = "".join(_cohort(found, name) for name in dict.fromkeys(relevant))
    head = "<tr><th>cohort, stones</th><th>passed</th><th>model</th></tr>"
    return [
        "<h2>Such stones in published cohorts</h2>",
        "<p>The fraction of stones that passed and the fraction of samples whose critical pressure "
        "is below the limit are different quantities. An arrow marks cohorts in which 20 "
        "percentage points more (↑) or fewer (↓) stones passed than the model's fraction. The "
        "model's fraction of a size class is that of the samples whose stone belongs to it.</p>",
        '<div class="pair"><div>',
        inline_svg(cohorts_figure(found), "Fractions that passed in cohorts, and the model's"),
        "</div><div>",
        "<p>The second figure compares other sizes of the stone. The curve is the model's "
        "fraction, and every grey line is a size class of a cohort. The definition of the lumen "
        "changes the model's fraction more than any other input: excised and empty ureters are "
        "much narrower than ureters in contrast CT.</p>",
        inline_svg(sizes_figure(found), "The model's fraction and the cohorts' over stone size"),
        "</div></div>",
        f"<table><thead>{head}</thead><tbody>{body}</tbody></table>{none}",
    ]


def _cohort(found: Assessment, name: str) -> str:
    """Return the rows of a cohort in the table; the first row describes the cohort."""
    rows = [row for row in found.cohorts if row.cohort.name == name]
    about = f"<b>{escape(name)}</b> {escape(rows[0].cohort.about)}"
    return f'<tr class="group"><td colspan="3">{about}</td></tr>' + "".join(
        f"<tr><td>{escape(row.group)}</td><td>{_passed(row)}</td><td>{_model(found, row)}</td></tr>"
        for row in rows
    )


def _passed(row: Row) -> str:
    first, *others = describe_passed(row).split(", ")
    return escape(first) + "".join(f'<span class="about">{escape(each)}</span>' for each in others)


def _model(found: Assessment, row: Row) -> str:
    """Return the model's fraction for a row of a cohort, marked if both are far apart."""
    text = escape(describe_beside(found, row))
    return f'<span class="off">{text}</span>' if text.endswith(tuple(FAR.values())) else text


def _sources(found: Assessment) -> list[str]:
    cohorts = [
        f"{each.name}: {each.source}"
        + (" (numbers read in a source that quotes it)" if each.read == "quoted" else "")
        for each in COHORTS
    ]
    limits = [f"{each.pressure / 1e3:g} kPa: {each.what} ({each.source})" for each in LIMITS]
    return [
        '<section class="sources">',
        "<h2>Sources</h2>",
        "<p>Cohorts. Mostly abstracts were read, not whole papers. “Unverified” means that no "
        "citable publication is known, or that the numbers could not be compared with it.</p>",
        _list(cohorts),
        "<p>Published urine pressures, which are the dotted lines of the figure.</p>",
        _list(limits),
        "</section>",
    ]


def _how(found: Assessment) -> str:
    patient = found.patient
    if found.samples is None:
        return f"{found.solves} cases were solved."
    count, error = len(found.samples.critical), f"{100.0 * found.surface_error:.2g} %"
    if found.solves == 0:
        source = (
            f"the surrogate '{patient.material.name}' of the package, whose error is at most "
            f"{error} in 95 % of the solved cases that it was compared with"
        )
    else:
        source = (
            f"a response surface through {found.solves} solved cases, whose error is at most "
            f"{error} in 95 % of them, as measured by leaving out one case at a time"
        )
    return (
        f"Computation: the critical pressures of {count} samples (seed {patient.seed}) come from "
        f"{source}. {100.0 * found.possible:.0f} % of the random draws describe a "
        f"possible wall. Standard error due to the number of samples: {noise_in_words(found)}."
    )


def _list(sentences: Sequence[str]) -> str:
    return "<ul>" + "".join(f"<li>{_linked(each)}</li>" for each in sentences) + "</ul>"


def _linked(text: str) -> str:
    """Return escaped text in which every DOI is a link."""
    return _DOI.sub(
        lambda found: f'<a href="https://doi.org/{found[1]}">doi:{found[1]}</a>', escape(text)
    )
