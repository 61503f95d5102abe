"""Equations as MathML, which browsers show without a script and without another machine.

Few systems have a font with the measures that subscripts and fractions need, so the site has one.
"""

import shutil
from pathlib import Path

import ziamath
from docutils import nodes
from latex2mathml.converter import convert

FONT = Path(ziamath.__file__).parent / "fonts" / "STIXTwoMath-Regular.ttf"


def inline(translator, node):
    """Write an equation within a line."""
    translator.body.append(convert(node.astext(), display="inline"))
    raise nodes.SkipNode


def block(translator, node):
    """Write an equation that stands by itself."""
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    translator.body.append(convert(node.astext(), display="block"))
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app):
    """Register the renderer, and put the font where the site finds it."""
    folder = Path(app.srcdir) / "generated" / "fonts"
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(FONT, folder / FONT.name)
    app.config.html_static_path.append("generated/fonts")
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
