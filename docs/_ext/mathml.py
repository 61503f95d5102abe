"""Equations as MathML, which browsers show without a script and without another machine.

Few systems have a font with the measures that subscripts and fractions need, so the site has one.
"""

import re
import shutil
from pathlib import Path

import ziamath
from docutils import nodes
from latex2mathml.converter import convert

# A function and, in the second form, its power; what follows without a bracket needs a space.
FUNCTION = r"<mi>(?:sin|cos|tan|arcsin|arctan|ln)</mi>"
ARGUMENT = r"<m(?:i|n|sub|sup|frac)>"
BEFORE_ARGUMENT = re.compile(rf"({FUNCTION}|<msup>{FUNCTION}<mn>\d</mn></msup>)(?={ARGUMENT})")
FONT = Path(ziamath.__file__).parent / "fonts" / "STIXTwoMath-Regular.ttf"


def mathml(equation, display):
    """Return MathML of an equation in the notation of TeX."""
    return BEFORE_ARGUMENT.sub(r'\1<mspace width="0.167em"/>', convert(equation, display=display))


def inline(translator, node):
    """Write an equation within a line."""
    translator.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def block(translator, node):
    """Write an equation that stands by itself."""
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    translator.body.append(mathml(node.astext(), "block"))
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
