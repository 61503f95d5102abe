"""Compare the numbers of two versions of stonepass: paper CSVs, JSON of the examples, exports.

A redesign must not change a number. Collect the outputs of each version in a folder of its own,
with that version's checkout as the current folder, and compare the two folders:

    python verification/same_numbers.py collect before [--source ../before/src] [--quick]
    python verification/same_numbers.py compare before after

`compare` says for every file whether it is the same to the byte, the same to nine significant
digits, or different, and ends with exit code 1 where a number differs. Keys of JSON records that
were renamed on purpose are listed in `RENAMED`, keys that one version alone has are reported.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

DIGITS = 9
LATEX = ["--xi", "1.2", "--eta", "1.5", "--material", "latex"]
THIN = ["--stone", "4.2mm", "--inner", "3.5mm", "--outer", "4.54mm"]
# Name of the output and the arguments; the word OUT stands for the file that is written.
COMMANDS = {
    "thin.json": ["pressure", *THIN, "--json"],
    "latex.json": ["pressure", *LATEX, "--json"],
    "latex_profile.csv": ["pressure", *LATEX, "--accuracy", "fast", "--profile", "OUT"],
    "direct.json": ["pressure", *LATEX, "--model", "direct", "--json"],
    "wetted.json": ["pressure", *LATEX, "--model", "direct", "--wetted", "--accuracy", "fast",
                    "--json"],
    "leak.json": ["pressure", "--xi", "1.05", "--eta", "1.3", "--material", "latex", "--friction",
                  "1.8", "--model", "direct", "--accuracy", "fast", "--json"],
    "growing.json": ["pressure", *LATEX, "--seating", "growing", "--accuracy", "fast", "--json"],
    "frictionless.json": ["pressure", *LATEX, "--seating", "frictionless", "--json"],
    "reference.json": ["pressure", *LATEX, "--seating", "frictionless", "--accuracy", "reference",
                       "--json"],
    "confined.json": ["pressure", *LATEX, "--confining", "5.4kPa", "--confinement", "hydrostatic",
                      "--accuracy", "fast", "--json"],
    "dead.json": ["pressure", *THIN, "--confining", "4kPa", "--closure-start", "lumen",
                  "--accuracy", "fast", "--json"],
    "prestretch.json": ["pressure", *LATEX, "--prestretch", "1.1", "--accuracy", "fast", "--json"],
    "printed.json": ["pressure", *LATEX, "--as-printed", "--accuracy", "fast", "--json"],
    "series.json": ["pressure", *LATEX, "--closure", "series", "--accuracy", "fast", "--json"],
    "beam.json": ["pressure", "--eta", "1.3", "--xi", "1.2", "--model", "beam", "--E1", "0.465MPa",
                  "--E2", "0.02MPa", "--json"],
    "secant.json": ["pressure", "--eta", "1.3", "--xi", "1.1", "--model", "beam",
                    "--secant-stretch", "1.2", "--json"],
    "loose.json": ["pressure", "--xi", "0.9", "--eta", "1.5", "--json"],
    "egg.json": ["pressure", "--xi", "1.2", "--eta", "1.3", "--shape", "examples/egg.csv",
                 "--accuracy", "fast", "--json"],
    "aspect.json": ["pressure", *LATEX, "--aspect", "1.4", "--accuracy", "fast", "--json"],
    "file.json": ["pressure", "examples/thin_ureter.toml", "--accuracy", "fast", "--json"],
    "soft.json": ["pressure", "--xi", "1.2", "--eta", "1.3", "--material",
                  "examples/soft_ureter.toml", "--accuracy", "fast", "--json"],
    "own.json": ["pressure", "--xi", "1.2", "--eta", "1.3", "--material",
                 "examples/own_law.py:energy", "--accuracy", "fast", "--json"],
    "size.json": ["size", "--inner", "3.5mm", "--outer", "4.54mm", "--limit", "6kPa", "--accuracy",
                  "fast", "--json"],
    "size_direct.json": ["size", "--eta", "1.5", "--material", "latex", "--limit", "6kPa",
                         "--model", "direct", "--accuracy", "fast", "--json"],
    "size_beam.json": ["size", "--eta", "1.3", "--limit", "12kPa", "--model", "beam", "--E1",
                       "0.465MPa", "--E2", "0.02MPa", "--json"],
    "curve.csv": ["curve", "--eta", "1.5", "--material", "latex", "--xi", "1:1.2:0.05",
                  "--accuracy", "fast", "--out", "OUT"],
    "closures.json": ["closures", "--eta", "1.5", "--xi", "1.2", "--material", "latex",
                      "--accuracy", "fast", "--json"],
    "push.json": ["push", "--eta", "1.5", "--xi", "1.2", "--material", "latex", "--accuracy",
                  "fast", "--steps", "4", "--json"],
    "friction.json": ["friction", "examples/crystals.tif", "--crystal", "20um", "--json"],
    "fit.json": ["fit", "tensile", "examples/latex_tensile.csv", "--law", "neo-hookean", "--width",
                 "10mm", "--thickness", "1.2mm", "--json"],
    "fit_fung.json": ["fit", "tensile", "examples/ureter_tensile.csv", "--law", "fung", "--fix",
                      "G=12kPa", "--fix", "a1122=0.1856", "--json"],
    "assess.json": ["assess", "PATIENT", "--json"],
    "deck.inp": ["export", *LATEX, "--out", "OUT"],
    "deck_abaqus.inp": ["export", *THIN, "--flavour", "abaqus", "--out", "OUT"],
    "deck.feb": ["export", *THIN, "--confining", "2kPa", "--out", "OUT"],
    "deck_growing.inp": ["export", *LATEX, "--seating", "growing", "--prestretch", "1.05", "--out",
                         "OUT"],
    "wall.vtu": ["export", *LATEX, "--accuracy", "fast", "--seating", "frictionless", "--out",
                 "OUT"],
}  # fmt: skip
SLOW = {
    "invitro.json": ["invitro", "examples/latex_series.csv", "--material", "latex", "--json"],
    "paper": ["paper", "all", "--out", "OUT"],
}
PATIENTS = ("examples/patient.toml", "examples/person.toml")  # the later name first
# Times, texts, names that contain the version, and the residual, which is rounding error.
IGNORED = {
    "residual",
    "seconds",
    "version",
    "message",
    "warnings",
    "disclaimer",
    "notes",
    "pixel_source",
    "file",
    "caution",
}
# Old key: new key. Keys that moved to another place of the record are found by their name.
RENAMED = {
    "relief_um": "height_range_um",
    "relief_scaling": "height_range_scaling",
    "drivers": "sensitivity",
    "stone_diameter_m": "diameter_m",
    "law_constants": "constants",
    "shape_deviation": "deviation",
}
# Words that were replaced on purpose: old value, new value.
REWORDED = {("MOVES", "SOLVED"), ("CLEARS", "LEAKS")}
# Options that a record has only for their own model, names of files, and resolved defaults.
GONE = {
    "seating", "as_printed", "closure_start", "closure", "series_order", "pairs", "wetted",
    "circumferential_modulus", "longitudinal_modulus", "secant_stretch", "seating_friction",
}  # fmt: skip
# The fingerprint of a deck is a name; it follows from the canonical record of the case now.
FINGERPRINT = re.compile(r"INNER_[0-9A-F]{8}")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def collect(folder: Path, source: Path | None, quick: bool) -> int:
    """Run every command and keep what it prints or writes; report those that fail."""
    folder.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ, STONEPASS_CACHE=str(folder / "cache"))
    if source is not None:
        environment["PYTHONPATH"] = str(source.resolve())
    patient = next(name for name in PATIENTS if Path(name).exists())
    failed = 0
    for name, arguments in (COMMANDS | ({} if quick else SLOW)).items():
        path = folder.resolve() / name
        if path.exists():
            continue
        words = [str(path) if w == "OUT" else patient if w == "PATIENT" else w for w in arguments]
        done = subprocess.run(
            [sys.executable, "-m", "stonepass", *words],
            env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        if "OUT" not in arguments:
            path.write_text(done.stdout, encoding="utf-8")
        if done.returncode not in (0, 1) or not path.exists():
            failed += 1
            print(f"{name}: exit {done.returncode}: {done.stderr.strip()[-300:]}")
    return failed


def compare(before: Path, after: Path) -> int:
    """Print how every file of `before` differs in `after`; return the number that differ."""
    differing, counts = 0, {"byte": 0, "digits": 0, "numbers": 0}
    kept = (".json", ".csv", ".inp", ".feb", ".vtu")
    files = sorted(p for p in before.rglob("*") if p.suffix in kept and "cache" not in p.parts)
    for old in files:
        new = after / old.relative_to(before)
        name = old.relative_to(before)
        if not new.exists() or not new.stat().st_size:
            print(f"{name}: missing")
            differing += 1
            continue
        if old.read_bytes() == new.read_bytes():
            counts["byte"] += 1
            continue
        if old.suffix == ".json":
            problems, inspected = _json(json.loads(old.read_text()), json.loads(new.read_text()))
        else:
            problems, inspected = _text(old.read_text(), new.read_text())
        counts["numbers"] += inspected
        if problems:
            differing += 1
            print(f"{name}: {len(problems)} differences; " + "; ".join(problems[:6]))
        else:
            counts["digits"] += 1
            print(f"{name}: {inspected} numbers the same to {DIGITS} digits")
    print(
        f"{len(files)} files: {counts['byte']} the same to the byte, {counts['digits']} to "
        f"{DIGITS} digits ({counts['numbers']} numbers compared), {differing} differ"
    )
    return differing


def _same(a: float, b: float) -> bool:
    return a == b or math.isclose(a, b, rel_tol=10.0**-DIGITS, abs_tol=1e-300)


def _json(old: object, new: object, where: str = "", whole: object = None) -> tuple[list[str], int]:
    """Return the differences of two documents and the number of numbers compared.

    A key that has moved is searched by its name in the whole new document. A key whose value was
    null may be missing.
    """
    if whole is None or (isinstance(new, dict) and "record_version" in new):
        whole = new
    problems: list[str] = []
    inspected = 0
    if isinstance(old, dict):
        for key, value in old.items():
            if key in IGNORED | GONE:
                continue
            if isinstance(new, dict) and (key in new or RENAMED.get(key) in new):
                other = new[key] if key in new else new[RENAMED[key]]
            elif value is None:
                continue
            elif isinstance(value, dict):
                other = None  # its keys are looked for one by one
            else:
                other = _find(whole, RENAMED.get(key, key))
                if other is _MISSING:
                    problems.append(f"{where}.{key} is gone")
                    continue
            found, count = _json(value, other, f"{where}.{key}", whole)
            problems += found
            inspected += count
        return problems, inspected
    if isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            return [f"{where}: {len(old)} and {len(new)} entries"], 0
        for k, (a, b) in enumerate(zip(old, new, strict=True)):
            found, count = _json(a, b, f"{where}[{k}]", b if isinstance(b, dict) else whole)
            problems += found
            inspected += count
        return problems, inspected
    if isinstance(old, (int, float)) and isinstance(new, (int, float)):
        return ([] if _same(float(old), float(new)) else [f"{where}: {old!r} -> {new!r}"]), 1
    worded = isinstance(old, str) and isinstance(new, str) and (old, new) in REWORDED
    same = old == new or worded
    return ([] if same else [f"{where}: {old!r} -> {new!r}"]), 0


_MISSING = object()


def _find(document: object, key: str) -> object:
    """Return the first value of a key anywhere in a document."""
    if isinstance(document, dict):
        if key in document:
            return document[key]
        values = list(document.values())
    else:
        values = list(document) if isinstance(document, list) else []
    found = (_find(value, key) for value in values)
    return next((value for value in found if value is not _MISSING), _MISSING)


def _text(old: str, new: str) -> tuple[list[str], int]:
    """Return the differences of two texts line by line; numbers must agree, words may differ."""
    a, b = (FINGERPRINT.sub("INNER", text).splitlines() for text in (old, new))
    if len(a) != len(b):
        return [f"{len(a)} and {len(b)} lines"], 0
    problems, inspected = [], 0
    for k, (line, other) in enumerate(zip(a, b, strict=True), start=1):
        if line == other:
            continue
        first, second = NUMBER.findall(line), NUMBER.findall(other)
        inspected += len(first)
        if len(first) != len(second) or not all(
            _same(float(x), float(y)) for x, y in zip(first, second, strict=True)
        ):
            problems.append(f"line {k}: {line[:60]!r} -> {other[:60]!r}")
    return problems, inspected


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    actions = parser.add_subparsers(dest="action", required=True)
    collecting = actions.add_parser("collect")
    collecting.add_argument("folder", type=Path)
    collecting.add_argument("--source", type=Path, help="folder that holds the package")
    collecting.add_argument("--quick", action="store_true", help="leave out what takes minutes")
    comparing = actions.add_parser("compare")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    asked = parser.parse_args()
    if asked.action == "collect":
        return 1 if collect(asked.folder, asked.source, asked.quick) else 0
    return 1 if compare(asked.before, asked.after) else 0


if __name__ == "__main__":
    raise SystemExit(main())
