"""Output in an encoding that lacks Greek letters or symbols, which are then spelled out.

On systems with a code page such as cp1252, redirected output is written in that code page.
"""

from __future__ import annotations

import codecs
import sys
import unicodedata
from typing import TextIO

__all__ = ["encodes_everything", "spell_what_is_lacking"]

HANDLER = "stonepass-spelled"
# Symbols of the tables and sentences; Greek letters are spelled by their names, xi for ξ.
SPELLED = {
    "·": "*", "×": "x", "−": "-", "–": "-", "—": "-", "…": "...", "≤": "<=", "≥": ">=", "≈": "~",
    "±": "+/-", "→": "->", "°": " deg", "′": "'", "∞": "inf", "∫": "integral", "√": "sqrt",
    "≠": "!=", "∈": "in", "µ": "mu", "“": '"', "”": '"', "‘": "'", "’": "'", "•": "*", "█": "#",
    "″": "''", "⁻": "-", "↑": "up", "↓": "down", "∂": "d",
}  # fmt: skip


def encodes_everything(stream: TextIO) -> bool:
    """Return whether the encoding of a stream has every character."""
    return "utf" in (getattr(stream, "encoding", None) or "utf-8").lower()


def spell_what_is_lacking() -> None:
    """Make stdout and stderr spell out the characters that their encoding lacks."""
    codecs.register_error(HANDLER, _spelled)
    for stream in (sys.stdout, sys.stderr):
        if not encodes_everything(stream) and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=HANDLER)


def _spelled(problem: UnicodeError) -> tuple[str, int]:
    if not isinstance(problem, UnicodeEncodeError):
        raise problem
    lacking = problem.object[problem.start : problem.end]
    if lacking[-1] in "µμ" and problem.object[problem.end :].startswith("m"):
        return "".join(map(spell, lacking[:-1])) + "u", problem.end  # um
    return "".join(map(spell, lacking)), problem.end


def spell(character: str) -> str:
    """Write one character in ASCII: ``xi`` for ξ, ``2`` for ₂, ``-`` for a line of a table."""
    if character in SPELLED:
        return SPELLED[character]
    name = unicodedata.name(character, "")
    if name.startswith("BOX DRAWINGS"):
        return "-" if "HORIZONTAL" in name else "|"
    if name.startswith("GREEK") and " LETTER " in name:
        letter = name.split(" LETTER ")[1].split()[-1]
        return letter.capitalize() if "CAPITAL" in name else letter.lower()
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return plain or "?"
