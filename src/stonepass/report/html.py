"""Pages that consist of a single HTML file, with their common style sheet."""

from __future__ import annotations

import base64
import io
from html import escape
from pathlib import Path

from matplotlib.figure import Figure

from stonepass.io.text_file import write_file
from stonepass.report.style import in_style

__all__ = ["inline_svg", "page_text", "svg_of", "write_html"]

_STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #1f2937; max-width: 62rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.7rem; line-height: 1.25; } h2 { font-size: 1.2rem; margin-top: 2.6rem; }
p.note, figcaption, footer, details { color: #4b5563; font-size: .9rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .88rem; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .4rem .6rem;
  border-bottom: 1px solid #e5e7eb; }
th { border-bottom: 2px solid #9ca3af; }
"""


def write_html(path: Path, title: str, style: str, body: str) -> None:
    """Write a page; see `page_text`."""
    write_file(path, page_text(title, style, body))


def page_text(title: str, style: str, body: str) -> str:
    """Return a page; `body` is HTML, and `style` is CSS that is added to that of all pages."""
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{_STYLE}{style}</style></head><body>\n"
        f"{body}\n</body></html>\n"
    )


@in_style
def svg_of(figure: Figure) -> str:
    """Return a figure as the text of an SVG file."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="svg", metadata={"Date": None})
    return drawn.getvalue().decode()


def inline_svg(figure: Figure, text: str) -> str:
    """Return an HTML image with the figure in it; `text` describes the figure for readers."""
    data = base64.b64encode(svg_of(figure).encode()).decode()
    return f'<img src="data:image/svg+xml;base64,{data}" alt="{escape(text)}">'
