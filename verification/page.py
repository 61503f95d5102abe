"""What a verification run returns, and how it becomes a section of the page."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Check:
    """A claim with the number it rests on; `holds` is decided by the run, never typed in."""

    claim: str
    measured: str
    holds: bool


@dataclass(frozen=True)
class Section:
    """One heading of the page: prose, tables, checks."""

    title: str
    text: str
    checks: Sequence[Check]
    tables: Sequence[tuple[str, Sequence[str], Sequence[Sequence[str]]]] = field(default=())

    @property
    def holds(self) -> bool:
        return bool(self.checks) and all(check.holds for check in self.checks)

    def markdown(self) -> str:
        parts = [f"## {self.title}", self.text]
        for caption, header, rows in self.tables:
            parts += [caption, table(header, rows)]
        rows = [[c.claim, c.measured, "holds" if c.holds else "**FAILS**"] for c in self.checks]
        parts.append(table(("claim", "measured", ""), rows))
        return "\n\n".join(parts)


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)


HEAD = """# Verification

`make verify` writes this page. The date and the code of the run that measured the numbers of a
section stand below it. `python verification/run.py NAME` renews one section."""
MARK = re.compile(r"^<!-- (\w+) -->$", re.MULTILINE)


def renewed(page: str, name: str, section: str, order: Sequence[str]) -> str:
    """The page with section `name` put in its place; others stay as long as `order` names them."""
    parts = MARK.split(page)
    found = dict(zip(parts[1::2], parts[2::2], strict=True)) | {name: section}
    kept = [f"<!-- {each} -->\n{found[each].strip()}" for each in order if each in found]
    return "\n\n".join([HEAD, *kept]) + "\n"
