"""An assessment as one HTML file that needs nothing beside it and prints on two pages."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from stonepass.about import DISCLAIMER, VERSION
from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import Cohort, Row
from stonepass.clinic.fractions import FEWER, MORE, contradiction
from stonepass.clinic.pressure_limits import LIMITS, describe_limit
from stonepass.records.assess import CAUTION
from stonepass.report.assess_figure import cohorts_figure, pressures_figure, sensitivity_figure
from stonepass.report.assess_report import describe_inputs, describe_range, noise_in_words
from stonepass.report.html import inline_svg, write_html

__all__ = ["write_assessment"]

FAR = {MORE: "↑", FEWER: "↓"}
_STYLE = """
body { max-width: 52rem; }
h1 { margin-bottom: .2rem; } h2 { margin: 1.4rem 0 .3rem; }
p { margin: .4rem 0; } img { width: 100%; height: auto; display: block; }
p.band { background: #fef3c7; padding: .4rem .7rem; border-radius: .3rem; font-weight: 600; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(11rem, 1fr)); gap: .7rem;
  margin: .8rem 0; }
.card { border: 1px solid #e5e7eb; border-radius: .5rem; padding: .5rem .8rem; }
.card b { display: block; font-size: 1.35rem; line-height: 1.3; } .card span { color: #4b5563;
  font-size: .85rem; }
.who { width: 42%; } .off { color: #b54708; font-weight: 600; }
.about { color: #4b5563; font-size: .9em; }
ul { padding-left: 1.1rem; margin: .3rem 0; font-size: .88rem; }
.inputs { columns: 2; column-gap: 2rem; font-size: .88rem; margin: .3rem 0; padding: 0;
  list-style: none; }
.inputs li { break-inside: avoid; margin: .1rem 0; } .inputs b { font-weight: 500; }
@page { size: A4; margin: 11mm 14mm; }
@media print {
  body { font-size: 9.5pt; line-height: 1.32; margin: 0; padding: 0; max-width: none; }
  h1 { font-size: 15pt; margin-top: 0; } h2 { font-size: 11pt; margin: .7rem 0 .2rem; }
  table, ul, .inputs { font-size: 8.2pt; } th, td { padding: .14rem .4rem; }
  ul li { margin: 0; } footer p { margin: .4rem 0 0; font-size: 8pt; }
  .cards { grid-template-columns: repeat(5, 1fr); gap: .4rem; } .card { padding: .3rem .5rem; }
  .card b { font-size: 11.5pt; } .card span { font-size: 7.8pt; display: block; line-height: 1.25; }
  .second { break-before: page; } img, table, .card { break-inside: avoid; }
  img { width: 84%; margin: 0 auto; } .second img { width: 72%; }
  .sources li { font-size: 7.4pt; line-height: 1.22; }
}
"""


def write_assessment(found: Assessment, path: Path) -> None:
    """Write the page."""
    body = [
        "<h1>A stone in a ureter: what pressures may move it</h1>",
        f'<p class="band">{DISCLAIMER}</p>',
        f"<p>{escape(found.message)} {escape(CAUTION)}</p>",
        *_cards(found),
        *_pressures(found),
        *_inputs(found),
        *_sources(found),
        '<section class="second">',
        *_cohorts(found),
        *_warnings(found),
        "</section>",
        f"<footer><p>stonepass {VERSION}. {DISCLAIMER} {_how(found)}</p></footer>",
    ]
    write_html(path, "A stone in a ureter", _STYLE, "\n".join(body))


def _cards(found: Assessment) -> list[str]:
    cards = []
    for name, values in (
        ("critical pressure", found.critical),
        ("present urine pressure", found.present),
    ):
        if values is not None:
            median, interval = describe_range(values)
            beside = "; measured above stones: 1.9 to 6 kPa" if values is found.present else ""
            cards.append((median, f"{name}, median; 90 %: {interval}{beside}"))
    limit = f"{found.patient.limit / 1e3:.4g} kPa"
    below, held = found.below_limit, found.below_limit_held
    about = f"critical pressure below the limit, {limit}"
    if held is None or below is None or found.loose == 0.0:
        at_limit = (f"of samples: {about}", below)
    else:
        at_limit = (
            f"of the samples with the stone held: {about} ({below.describe()} of all samples)",
            held,
        )
    for name, fraction in (
        at_limit,
        ("of samples: critical pressure below the present one", found.below_present),
    ):
        if fraction is not None:
            cards.append((fraction.describe(), name))
    if found.critical is not None:
        loose = f"{round(100 * found.loose)} %"
        cards.append((loose, "of samples: stone no larger than the lumen (critical pressure 0)"))
    shown = "".join(
        f'<div class="card"><b>{escape(big)}</b><span>{escape(small)}</span></div>'
        for big, small in cards
    )
    return [f'<div class="cards">{shown}</div>'] if cards else []


def _pressures(found: Assessment) -> list[str]:
    if found.samples is None:
        return []
    parts = [
        "<h2>Over every pressure</h2>",
        inline_svg(pressures_figure(found), "Fraction of samples over urine pressure"),
    ]
    if found.sensitivity:
        parts += [
            "<h2>What the spread of the critical pressure comes from (with interactions)</h2>",
            inline_svg(sensitivity_figure(found), "Sensitivity index by input"),
        ]
    return parts


def _inputs(found: Assessment) -> list[str]:
    patient = found.patient
    limit = f"{patient.limit / 1e3:.4g} kPa: {describe_limit(patient.limit)}"
    rows = [*describe_inputs(found).items()]
    if patient.place is not None:
        rows.append(("place", patient.place))
    rows.append(("pressure limit", limit))
    items = "".join(f"<li><b>{escape(name)}:</b> {escape(text)}</li>" for name, text in rows)
    return [
        "<h2>What it was computed from (±: one standard deviation)</h2>",
        f'<ul class="inputs">{items}</ul>',
    ]


def _cohorts(found: Assessment) -> list[str]:
    by_cohort: dict[Cohort, list[Row]] = {}
    for row in found.cohorts:
        by_cohort.setdefault(row.cohort, []).append(row)
    body = "".join(
        f'<tr><td>{escape(cohort.name)} <span class="about">{escape(cohort.about)}</span></td>'
        f"<td>{' · '.join(_passed(found, row) for row in rows)}</td></tr>"
        for cohort, rows in by_cohort.items()
    )
    head = (
        '<tr><th class="who">cohort</th><th>passed (the model\'s fraction below the limit); '
        "↑ more, ↓ fewer than the model expects</th></tr>"
    )
    return [
        "<h2>What cohorts saw in such stones</h2>",
        "<p>The fraction that passed, and the fraction of samples that move below the limit, are "
        "two different things; an arrow marks where they lie more than 20 points apart. For a "
        "size class the model's fraction is that of the samples whose stone belongs to it. What "
        "counts as the "
        "lumen moves the model more than any other input: excised and empty ureters are far "
        "narrower than those in contrast CT.</p>",
        inline_svg(cohorts_figure(found), "Fractions that passed by size, and the model's"),
        f'<div class="scroll"><table><thead>{head}</thead><tbody>{body}</tbody></table></div>',
    ]


def _passed(found: Assessment, row: Row) -> str:
    days = "" if row.days is None else f"{row.days:g} days"
    if row.passed is None:
        return escape(f"{row.group}: {days}")
    fraction = found.beside(row)
    word = contradiction(row.passed, fraction)
    model = "" if fraction is None else f" ({fraction.describe()})"
    text = escape(f"{row.group}: {round(100 * row.passed)} %{', ' + days if days else ''}{model}")
    return f'<span class="off">{text} {FAR[word]}</span>' if word in FAR else text


def _warnings(found: Assessment) -> list[str]:
    sentences = [str(each) for each in found.warnings]
    return ["<h2>What to keep in mind</h2>", _list(sentences)] if sentences else []


def _sources(found: Assessment) -> list[str]:
    cohorts = {row.cohort.name: row.cohort for row in found.cohorts}
    sources = "; ".join(
        f"{each.name}: {each.source}" + (" (quoted elsewhere)" if each.read == "quoted" else "")
        for each in cohorts.values()
    )
    limits = "; ".join(
        f"{each.pressure / 1e3:g} kPa: {each.what} ({each.source})" for each in LIMITS
    )
    return [
        "<h2>Sources</h2>",
        '<div class="sources">'
        + _list([f"Cohorts: {sources}.", f"Pressures (dotted lines): {limits}."])
        + "</div>",
    ]


def _how(found: Assessment) -> str:
    patient = found.patient
    if found.samples is None:
        return f"{found.solves} solves."
    return (
        f"{len(found.samples.critical)} samples, seed {patient.seed}, of a response surface "
        f"through {found.solves} solves, off by up to {found.surface_error:.1%} in 95 of 100 "
        f"places (one solve left out at a time); {found.possible:.0%} of the draws describe a "
        f"possible wall. Noise of the samples (one standard error): {noise_in_words(found)}."
    )


def _list(sentences: Sequence[str]) -> str:
    return "<ul>" + "".join(f"<li>{escape(each)}</li>" for each in sentences) + "</ul>"
