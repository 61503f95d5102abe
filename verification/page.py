"""Data of a section of the verification page, and its Markdown."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Check:
    """A claim, the measured value that supports it, and whether it holds, as the run found."""

    claim: str
    measured: str
    holds: bool


@dataclass(frozen=True)
class Section:
    """A section of the page: title, text, tables and checks."""

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

`make verify` writes this page. The line below each section has the date of its run, the version of
the code, and the command that renews the section."""
MARK = re.compile(r"^<!-- (\w+) -->$", re.MULTILINE)


def renewed(page: str, name: str, section: str, order: Sequence[str]) -> str:
    """Return the page with a new section `name` and the others that `order` names."""
    parts = MARK.split(page)
    found = dict(zip(parts[1::2], parts[2::2], strict=True)) | {name: section}
    kept = [f"<!-- {each} -->\n{found[each].strip()}" for each in order if each in found]
    return "\n\n".join([HEAD, *kept]) + "\n"
