"""Damaged files of tables, cases, laws and patients must be read, or refused in one sentence."""

from __future__ import annotations

import resource
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from page import Check, Section

from stonepass.studies.executor import process_pool

ROOT = Path(__file__).parents[1]
TRIED = 20_000
SEED = 20250
PROCESSES = 2
LARGEST_TIME = 2.0  # s of one core
LEAST_SHARE = 0.05  # of each kind read, and refused; else the damage is too large or too small
MEMORY = 2_000_000_000  # bytes
SHOWN = 20


@dataclass
class Ended:
    """Results of damaged files, by kind."""

    how: Counter[tuple[str, str]] = field(default_factory=Counter)
    slowest: dict[str, float] = field(default_factory=dict)
    others: list[tuple[int, str]] = field(default_factory=list)

    def count(self, kind: str, *how: str) -> int:
        return sum(self.how[kind, each] for each in how or ("read", "refused", "otherwise"))

    def with_other(self, other: Ended) -> Ended:
        kinds = {*self.slowest, *other.slowest}
        slowest = {k: max(self.slowest.get(k, 0.0), other.slowest.get(k, 0.0)) for k in kinds}
        return Ended(self.how + other.how, slowest, sorted(self.others + other.others))


def section() -> Section:
    sys.path.insert(0, str(ROOT / "tests"))
    from damaged_tables import KINDS, LONGEST_SENTENCE, LONGEST_TIME

    ended = fuzz()
    rows = [
        [kind, KINDS[kind].file, *(str(ended.count(kind, *how))
                                   for how in ((), ("read",), ("refused",), ("otherwise",))),
         f"{ended.slowest[kind]:.2f}"]
        for kind in KINDS
    ]  # fmt: skip
    tried, odd = sum(ended.how.values()), len(ended.others)
    least = {how: min(ended.count(kind, how) / ended.count(kind) for kind in KINDS)
             for how in ("read", "refused")}  # fmt: skip
    last = max(ended.slowest, key=ended.slowest.__getitem__)
    tables = [
        (f"{TRIED} damaged files, seed {SEED}:",
         ("kind", "file", "tried", "read", "refused in one sentence", "other results",
          "slowest, s"), rows),
    ]  # fmt: skip
    if ended.others:
        shown = [[str(k), " ".join(told.split()).replace("|", "¦")] for k, told in ended.others]
        caption = f"The first of {odd} other results:"
        tables.append((caption, ("number", "result"), shown[:SHOWN]))
    return Section(
        title="Tables and files of text",
        text=(
            "A valid file of every kind that is read as CSV, TOML or JSON is damaged one to four "
            "times. Bytes are flipped, left out or repeated, or the file is cut short. Control "
            "characters, NUL characters and other encodings are inserted. Lines and cells are "
            "swapped, repeated, left out or emptied. Names are misspelt or taken from another "
            "file. Numbers are replaced by text, by values that are not finite, huge or tiny, or "
            "by other notations. Units and uncertainties are changed. Values get another type, "
            "cells up to 140 000 characters, and nested values a depth of 30 000. Quotes, line "
            "ends and byte order marks are changed. Each file must be read into finite numbers, or "
            f"be refused as bad input, within {LONGEST_TIME:g} s of one core. The message of a "
            f"refusal has one line of fewer than {LONGEST_SENTENCE} characters without control "
            "characters, ends in a full stop, names the file and says what was expected. "
            "tests/test_damaged_tables.py checks with chosen files that the messages name rows and "
            "columns."
        ),
        tables=tables,
        checks=[
            Check("a damaged file is read or refused in one sentence that names it",
                  f"{tried} tried, {odd} ended otherwise", odd == 0 and tried == TRIED),
            *(Check(f"at least {LEAST_SHARE:.0%} of the files of every kind are {how}",
                    f"{share:.0%} or more", share >= LEAST_SHARE)
              for how, share in least.items()),
            Check(f"no file takes longer than {LARGEST_TIME:g} s of one core",
                  f"{ended.slowest[last]:.2f} s ({last})", ended.slowest[last] <= LARGEST_TIME),
        ],
    )  # fmt: skip


def fuzz() -> Ended:
    """Return the results; the damage of file k does not depend on the process that takes it."""
    shares = [range(first, TRIED, PROCESSES) for first in range(PROCESSES)]
    found = Ended()
    with process_pool(PROCESSES) as pool:
        for some in pool.map(fuzz_some, shares):
            found = found.with_other(some)
    return found


def fuzz_some(numbers: range) -> Ended:
    sys.path.insert(0, str(ROOT / "tests"))
    from damaged_tables import KINDS, damaged, outcome

    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    names = list(KINDS)
    ended = Ended()
    with TemporaryDirectory() as folder:
        for kind in names:  # imports of the first call are not timed
            assert outcome(kind, KINDS[kind].text.encode(), Path(folder)) == "read"
        for k in numbers:
            kind = names[k // PROCESSES % len(names)]
            data = damaged(kind, Random(f"{SEED} {k}"))
            begun = time.process_time()
            try:
                how = outcome(kind, data, Path(folder))
            except AssertionError as problem:
                how = "otherwise"
                ended.others.append((k, str(problem)[:200]))
            seconds = time.process_time() - begun
            ended.how[kind, how] += 1
            ended.slowest[kind] = max(ended.slowest.get(kind, 0.0), seconds)
    return ended
