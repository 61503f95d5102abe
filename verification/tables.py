"""Tables, cases, laws and patients in files: a damaged one is read or refused in a sentence."""

from __future__ import annotations

import resource
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from page import Check, Section

ROOT = Path(__file__).parents[1]
TRIED = 20_000
SEED = 20250
PROCESSES = 2
LARGEST_TIME = 2.0  # s of one core
LEAST_SHARE = 0.05  # of a kind, read and refused: else the damage is too coarse or too fine
MEMORY = 2_000_000_000  # bytes
SHOWN = 20


@dataclass
class Ended:
    """How damaged files ended, by kind."""

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
         ("kind", "file", "tried", "read", "refused in one sentence", "anything else",
          "slowest, s"), rows),
    ]  # fmt: skip
    if ended.others:
        shown = [[str(k), " ".join(told.split()).replace("|", "¦")] for k, told in ended.others]
        tables.append((f"The first that ended otherwise, of {odd}:", ("no.", "how"), shown[:SHOWN]))
    return Section(
        title="Tables and files of text",
        text=(
            "A valid file for every reader of CSV, TOML and JSON, damaged one to four times: "
            "bytes flipped, left out or repeated, files cut short; control characters, NUL and "
            "other encodings; lines and cells swapped, repeated, left out or emptied; names "
            "misspelt or of another file; numbers that are none, not finite, huge, tiny or "
            "written otherwise; other units and uncertainties; values of another type, cells of "
            "up to 140 000 characters, nesting 30 000 deep; quotes, line ends and byte order "
            "marks. Each must be read into finite numbers, or be refused as bad input in one line "
            "of fewer than "
            f"{LONGEST_SENTENCE} characters without control characters, that ends in a full stop, "
            "names the file and says what was expected; within "
            f"{LONGEST_TIME:g} s of one core. That rows and columns are named is tested by hand "
            "in tests/test_damaged_tables.py."
        ),
        tables=tables,
        checks=[
            Check("a damaged file is read or refused in one sentence that names it",
                  f"{tried} tried, {odd} ended otherwise", odd == 0 and tried == TRIED),
            *(Check(f"of every kind at least {LEAST_SHARE:.0%} are {how}",
                    f"{share:.0%} at least", share >= LEAST_SHARE)
              for how, share in least.items()),
            Check(f"none takes longer than {LARGEST_TIME:g} s of one core",
                  f"{ended.slowest[last]:.2f} s ({last})", ended.slowest[last] <= LARGEST_TIME),
        ],
    )  # fmt: skip


def fuzz() -> Ended:
    """How all end; number k is damaged alike whichever process takes it."""
    shares = [range(first, TRIED, PROCESSES) for first in range(PROCESSES)]
    found = Ended()
    with ProcessPoolExecutor(PROCESSES, mp_context=get_context("spawn")) as pool:
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
        for kind in names:  # what is imported with the first is not timed
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
