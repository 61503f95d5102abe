"""The page of a reproduction: table of claims, then every figure with its data."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from stonepass.about import DISCLAIMER, VERSION
from stonepass.paper.section import Asked, Claim, Section
from stonepass.report.html import write_html

__all__ = ["write_page"]

DOI = "10.1016/j.jmbbm.2022.105432"
_STYLE = """
td.mark { white-space: nowrap; font-weight: 600; }
.yes { color: #00785a; } .no { color: #b54708; } .open { color: #6b7280; }
figure { margin: 1rem 0; } img { max-width: 100%; height: auto; }
"""
_MARKS = {True: ("yes", "reproduced"), False: ("no", "differs"), None: ("open", "not judged")}


def write_page(
    sections: Sequence[Section], asked: Asked, path: Path, missing: Sequence[str] = ()
) -> None:
    """Write one HTML page beside the files it shows; `missing` names parts that it leaves out."""
    claims = [claim for section in sections for claim in section.claims]
    body = [
        "<h1>Critical size of a kidney stone: the paper, reproduced</h1>",
        f"<p>{_extent(sections, missing)} of Liu et al. 2022, <cite>Critical size of kidney stone "
        f'through ureter: A mechanical analysis</cite> (<a href="https://doi.org/{DOI}">doi {DOI}'
        f"</a>), with its errata corrected; pressure limit {asked.limit / 1e3:g} kPa.</p>",
    ]
    if missing:
        body.append(f"<p>Not on this page: {escape(', '.join(missing))}.</p>")
    if claims:
        body += ["<h2>Published claims beside ours</h2>", _table(claims)]
    for section in sections:
        if section.pictures or section.files:
            body += _section(section)
    body.append(f"<footer><p>stonepass {VERSION}. {DISCLAIMER}</p></footer>")
    write_html(path, "The paper, reproduced", _STYLE, "\n".join(body))


def _extent(sections: Sequence[Section], missing: Sequence[str]) -> str:
    if not missing:
        return "Every computed result"
    count = len(sections)
    return f"A part of the computed results ({count} of {count + len(missing)} sections)"


def _table(claims: Sequence[Claim]) -> str:
    header = ("claim", "published", "ours", "deviation", "", "reason")
    rows = []
    for claim in claims:
        name, word = _MARKS[claim.holds]
        off = "" if claim.deviation is None else f"{claim.deviation:+.3g}"
        if claim.tolerance is not None:
            off += f" (± {claim.tolerance:.3g})"
        cells = (claim.what, claim.published, claim.ours, off)
        rows.append(
            "<tr>"
            + "".join(f"<td>{escape(cell)}</td>" for cell in cells)
            + f'<td class="mark {name}">{word}</td><td>{escape(claim.reason)}</td></tr>'
        )
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>\n'
        + "\n".join(rows)
        + "\n</tbody></table></div>"
    )


def _section(section: Section) -> list[str]:
    parts = [f"<h2>{escape(section.title)}</h2>"]
    if section.text:
        parts.append(f"<p>{escape(section.text)}</p>")
    for name, caption in section.pictures:
        parts.append(
            f'<figure><img src="{name}.svg" alt="{escape(caption)}" loading="lazy">'
            f'<figcaption>{escape(caption)} <a href="{name}.png">PNG</a></figcaption></figure>'
        )
    if section.warnings:
        told = "".join(f"<li>{escape(each)}</li>" for each in section.warnings)
        parts.append(
            f"<details><summary>Warnings of the computed answers ({len(section.warnings)})"
            f"</summary><ul>{told}</ul></details>"
        )
    links = ", ".join(f'<a href="{name}">{escape(name)}</a>' for name in section.files)
    return [*parts, f'<p class="note">Data: {links}</p>']
