"""Benchmark: stonepass compared with CalculiX, growth with unknowns, and whole commands.

    python benchmarks/run.py [--out FOLDER] [--json] [--resume]

Writes docs/benchmark.md and docs/data/benchmark.json; decks and results of CalculiX stay in FOLDER
(build/benchmark). Every solve has one thread, and ratios compare times of the same run. The
machines are noisy, so that a missed target is reported and is not an error.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import subprocess
import sys
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from measure import ONE_THREAD, Decks, Row, machine

if TYPE_CHECKING:
    from peers import Duel

ROOT = Path(__file__).resolve().parents[1]
SECTIONS = {
    "peers": "Comparison with CalculiX on the exported deck",
    "duels": "Comparison with CalculiX decks tuned to one case",
    "scaling": "Growth with unknowns",
    "one answer": "One answer, after import (processor time)",
    "many": "Many answers (clock)",
    "cold commands": "Whole commands, cold (clock)",
    "memory": "Memory",
}


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--out", type=Path, default=ROOT / "build" / "benchmark")
    options.add_argument("--json", action="store_true", help="JSON on stdout as well")
    options.add_argument(
        "--resume",
        action="store_true",
        help="take the decks that an interrupted run left in FOLDER",
    )
    given = options.parse_args()
    if not all(os.environ.get(name) == "1" for name in ONE_THREAD):
        # Libraries read these when they are loaded, so before this process began.
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | ONE_THREAD)
    found = measured(Decks(given.out, given.resume))
    data = ROOT / "docs" / "data" / "benchmark.json"
    data.write_text(json.dumps(found, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    from page import page

    (ROOT / "docs" / "benchmark.md").write_text(page(found, SECTIONS), encoding="utf-8")
    if given.json:
        print(json.dumps(found, indent=2, ensure_ascii=False))


def measured(decks: Decks) -> dict:
    """Run all measurements; print each row when it is known."""
    from peers import calculix, cold_ratios, duel_rows, duels, peers, ratios
    from phases import phases
    from rival import SETTINGS
    from workloads import LARGEST_EXPONENT, commands, many, processes, scalings, single

    described = machine()
    print(", ".join(f"{name} {value}" for name, value in described.items()))
    rows: list[Row] = []
    beside, growth = [], []

    def tell(row: Row) -> None:
        rows.append(row)
        mark = {True: "met", False: "MISSED", None: ""}[row.met]
        bound = "" if row.target is None else f"{'≥' if row.at_least else '≤'} {row.target:g}"
        print(f"{row.what:<74}{row.value:>9.2f} {row.unit:<3}{bound:>8}  {mark}", flush=True)

    for kind, solved, exact in peers(decks):
        for each in (*solved, exact):
            angle, sigma, critical = each.errors(exact)
            beside.append({"seating": kind, "who": each.who, "cpu_s": each.cpu,
                           "contact_angle_error_deg": angle, "equator_pressure_error": sigma,
                           "critical_pressure_error": critical})  # fmt: skip
            print(f"{kind}, {each.who:<23} {each.cpu:>8.2f} s CPU   errors: α₀ {angle:.3f}°, "
                  f"σ(90°) {sigma:.2%}, P_ucr {critical:.2%}")  # fmt: skip
        for row in chain(ratios(kind, solved, exact), cold_ratios(kind, solved)):
            tell(row)
    fought = [] if calculix() is None else list(duels(decks))
    for row in duel_rows(fought) if fought else ():
        tell(row)
    for scaling in scalings():
        growth.append({"what": scaling.what, "dofs": scaling.dofs, "cpu_s": scaling.seconds,
                       "exponent": scaling.exponent})  # fmt: skip
        tell(Row("scaling", f"power of the unknowns, {scaling.what}", scaling.exponent, "",
                 LARGEST_EXPONENT))  # fmt: skip
    for row in chain(single(), many(processes()), commands()):
        tell(row)
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "code": commit(),
        "machine": described,
        "resumed": decks.resumed,
        "beside": beside,
        "duels": [duel_record(each) for each in fought],
        "settings": {name: list(values) for name, values in SETTINGS.items()},
        "scaling": growth,
        "rows": [row.record() for row in rows],
        "phases": phases(),
    }


def duel_record(duel: Duel) -> dict[str, Any]:
    """Return the fastest tuned deck of a case, compared with stonepass, ready for JSON."""
    angle, sigma, critical = duel.best.errors(duel.exact)
    return {
        "case": duel.name,
        "seating": duel.kind,
        "settings": duel.settings,
        "decks_run": duel.tried,
        "decks_near_enough": duel.ended,
        "cpu_s": duel.best.cpu,
        "contact_angle_error_deg": angle,
        "equator_pressure_error": sigma,
        "critical_pressure_error": critical,
        "ours_cpu_s": {each.who: each.cpu for each in duel.mine},
        "ratios": dict(duel.ratios()),
    }


def commit() -> str:
    """Return the commit of the code that was measured."""
    found = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, text=True,
                           capture_output=True, check=False)  # fmt: skip
    return found.stdout.strip()


if __name__ == "__main__":
    main()
