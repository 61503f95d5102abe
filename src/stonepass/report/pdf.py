"""A page of HTML of this package as a PDF file, set by typst.

Only the elements that the pages of this package use are translated. All text reaches typst as
string literals and all figures as data, so that nothing in a page can act as typst code.
"""

from __future__ import annotations

import base64
import re
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import matplotlib

from stonepass.io.optional_imports import library

__all__ = ["pdf_of_page", "typst_source"]

FONTS = Path(matplotlib.get_data_path()) / "fonts" / "ttf"  # DejaVu Sans, as in the figures
PREAMBLE = """
#set page(paper: "a4", margin: (x: 16mm, y: 15mm), numbering: "1 / 1")
#set text(font: "DejaVu Sans", size: 8.2pt, lang: "en")
#set par(leading: 0.55em, spacing: 0.8em)
#set table(inset: (x: 4pt, y: 3pt), stroke: (x, y) => (bottom: 0.4pt + rgb("#9ca3af")))
#show heading.where(level: 1): set text(size: 14pt)
#show heading.where(level: 2): set text(size: 10.5pt)
#show heading.where(level: 3): set text(size: 9.2pt)
#show heading: set block(above: 1.1em, below: 0.6em)
#show link: set text(fill: rgb("#0072b2"))
"""
BOXES = {"alert": "#fdecea", "decide": "#eef4fb", "band": "#f3f4f6", "card": "#f9fafb"}
INLINE = {"b": "strong", "strong": "strong", "em": "emph", "i": "emph"}
SKIPPED = ("head", "style", "script")
DATA = re.compile(r"data:image/svg\+xml;base64,([A-Za-z0-9+/=]+)")
SECONDS_OF_DAY = 0  # the file has no time of creation, so that equal pages give equal files


@dataclass
class _Table:
    """The rows of a table that is being read; a cell is its content and its column span."""

    rows: list[list[tuple[str, int]]] = field(default_factory=list)

    def source(self) -> str:
        columns = max((sum(span for _, span in row) for row in self.rows), default=1)
        cells = []
        for row in self.rows:
            for content, span in row:
                cells.append(f"table.cell(colspan: {span})[{content}]")
            missing = columns - sum(span for _, span in row)
            cells += ["[]"] * missing
        return f"\n#table(columns: {columns}, {', '.join(cells)})\n"


class _Translator(HTMLParser):
    """Translation of HTML to typst; `parts` is a stack of the elements that are open."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.parts: list[list[str]] = [[]]
        self.tables: list[_Table] = []
        self.spans: list[int] = []
        self.links: list[str] = []
        self.boxes: list[str] = []
        self.figures: dict[str, str] = {}
        self._skipping = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if tag in SKIPPED:
            self._skipping += 1
        elif tag == "img":
            self._image(given)
        elif tag == "br":
            self._say(" \\\n")
        elif tag == "meta":
            return
        else:
            if tag == "table":
                self.tables.append(_Table())
            elif tag == "tr" and self.tables:
                self.tables[-1].rows.append([])
            elif tag in ("td", "th"):
                span = given.get("colspan", "1")
                self.spans.append(int(span) if span.isdecimal() else 1)
            elif tag == "ul":
                self.boxes.append("columns" if given.get("class") == "inputs" else "")
            elif tag == "a":
                self.links.append(given.get("href", ""))
            elif tag in ("div", "section", "p"):
                self.boxes.append(BOXES.get(given.get("class", ""), ""))
            elif tag == "span" and given.get("class") == "about":
                self._say(" \\\n")  # a remark on a line of its own
            self.parts.append([])

    def handle_endtag(self, tag: str) -> None:
        if tag in SKIPPED:
            self._skipping -= 1
        elif tag not in ("img", "br", "meta") and len(self.parts) > 1:
            self._close(tag, "".join(self.parts.pop()))

    def handle_data(self, data: str) -> None:
        text = re.sub(r"\s+", " ", data)
        if text and not self._skipping:
            self._say(f"#{_literal(text)};" if text.strip() else " ")

    def _say(self, source: str) -> None:
        self.parts[-1].append(source)

    def _close(self, tag: str, inside: str) -> None:
        """Add a closed element to the one around it."""
        if tag in ("td", "th"):
            cell = f"#strong[{inside}]" if tag == "th" else inside
            self.tables[-1].rows[-1].append((cell, self.spans.pop()))
        elif tag == "table":
            self._say(self.tables.pop().source())
        elif tag == "a":
            target = self.links.pop()
            self._say(f"#link({_literal(target)})[{inside}]" if target else inside)
        elif tag in ("h1", "h2", "h3"):
            self._say(f"\n#heading(level: {tag[1]})[{inside}]\n")
        elif tag in INLINE:
            self._say(f"#{INLINE[tag]}[{inside}]")
        elif tag == "ul":
            wide = self.boxes.pop() == "columns"
            self._say(f"\n#columns(2)[{inside}]\n" if wide else inside)
        elif tag == "li":
            self._say(f"\n#list.item[{inside}]\n")
        elif tag in ("div", "section", "p"):
            self._say(_box(inside, self.boxes.pop()))
        elif tag == "footer":
            self._say(f"\n#line(length: 100%, stroke: 0.4pt)\n{inside}\n")
        else:
            self._say(inside)

    def _image(self, given: dict[str, str]) -> None:
        found = DATA.fullmatch(given.get("src", ""))
        if found is None:
            return
        name = f"figure{len(self.figures)}"
        self.figures[name] = base64.b64decode(found[1]).decode()
        alt = _literal(given.get("alt", ""))
        self._say(f'\n#image(bytes(sys.inputs.{name}), format: "svg", width: 62%, alt: {alt})\n')


def typst_source(page: str) -> tuple[str, dict[str, str]]:
    """Return a page of HTML as typst source, and its figures as SVG by the name of their input."""
    translator = _Translator()
    translator.feed(page)
    translator.close()
    return PREAMBLE + "".join(translator.parts[0]), translator.figures


def pdf_of_page(page: str) -> bytes:
    """Return a page of HTML of this package as a PDF file.

    Parameters
    ----------
    page : str
        A whole page, e.g. of `assess_page.assessment_page`.

    Raises
    ------
    BadInput
        The library typst is not installed.
    """
    typst: Any = library("typst", "write a PDF", "web")
    source, figures = typst_source(page)
    compiler = typst.Compiler(
        source.encode(), font_paths=[str(FONTS)], ignore_system_fonts=True, sys_inputs=figures
    )
    made: bytes = compiler.compile(format="pdf", timestamp=SECONDS_OF_DAY)
    return made


def _box(inside: str, colour: str) -> str:
    if not colour:
        return f"\n\n{inside}\n\n"
    return f"\n#block(fill: rgb({_literal(colour)}), inset: 6pt, width: 100%)[{inside}]\n"


def _literal(text: str) -> str:
    """Return a text as a string literal of typst."""
    plain = "".join(each if each.isprintable() else " " for each in text)
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
