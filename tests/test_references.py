"""Docstrings name sections of the documentation as their source; these sections exist."""

import ast
import re
from pathlib import Path

import stonepass

ROOT = Path(stonepass.__file__).parent
DOCS = Path(__file__).parents[1] / "docs"
# "A section" in docs/page.md, also "one" and "another"; docs/page.md, section "A section".
BEFORE = re.compile(r'((?:"[^"]+"(?:, | and |, and )?)+) in docs/(\w+\.md)')
AFTER = re.compile(r'docs/(\w+\.md), (?:section )?"([^"]+)"')


def docstrings(path):
    """Return the docstrings of a file that name a page, each with its white space on one line."""
    source = path.read_text(encoding="utf-8")
    if "docs/" not in source:
        return []
    kinds = ast.Module | ast.ClassDef | ast.FunctionDef
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, kinds)]
    found = [" ".join((ast.get_docstring(node) or "").split()) for node in nodes]
    return [text for text in found if "docs/" in text]


def references(text):
    """Pairs of a page and the name of a section that a text refers to."""
    for match in BEFORE.finditer(text):
        yield from ((match[2], name) for name in re.findall(r'"([^"]+)"', match[1]))
    yield from AFTER.findall(text)


def sections(page):
    """Names of the headings and of the paragraphs that begin in bold on a page."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = re.findall(r"^#+ (.+)$|^\*\*(.+?)\*\*", text, re.MULTILINE)
    return {(heading or bold).strip().rstrip(".") for heading, bold in found}


def test_the_forms_of_a_reference_are_found():
    text = 'See "One" and "Two" in docs/a.md; docs/b.md, section "Three", docs/c.md, "Four".'
    assert list(references(text)) == [
        ("a.md", "One"),
        ("a.md", "Two"),
        ("b.md", "Three"),
        ("c.md", "Four"),
    ]


def test_every_section_that_a_docstring_names_exists():
    found = {
        (path.relative_to(ROOT).as_posix(), *reference)
        for path in ROOT.rglob("*.py")
        for text in docstrings(path)
        for reference in references(text)
    }
    pages = {page: sections(page) for _, page, _ in found}
    assert len(found) > 50
    assert sorted(each for each in found if each[2] not in pages[each[1]]) == []
