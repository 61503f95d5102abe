"""Damage to files of text, seeded: bytes, cells, names, numbers, units, nesting; and what follows.

`KINDS` has a valid file for every reader, `damaged` breaks one, `outcome` reads what is left.
"""

import dataclasses
import json
import math
import re
import signal
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import numpy as np

from stonepass.bench.test_files import read_inflation, read_tension
from stonepass.clinic.patient import read_patient
from stonepass.errors import BadInput
from stonepass.inputs.case_file import read_case
from stonepass.inputs.friction_file import read_friction
from stonepass.inputs.material_file import load_material
from stonepass.inputs.measured_pressures import read_points
from stonepass.inputs.opening_curve_file import read_opening_curve
from stonepass.inputs.shape_file import read_shape
from stonepass.model.ureter import Ureter
from stonepass.units import length

EXAMPLES = Path(__file__).parents[1] / "examples"
LONGEST_SENTENCE = 600
LONGEST_TIME = 5.0  # s of CPU


def example(name: str) -> str:
    return (EXAMPLES / name).read_text(encoding="utf-8")


OUTER = """pressure_kPa,outer_diameter_mm,axial_stretch
0,4.55,1
1.4,4.62,1
2.8,4.7,1
1.4,4.6,1.1
2.8,4.66,1.1
"""
PAIRS = """alpha_deg,radius_ratio
40,1
55,1.04
70,1.09
85,1.15
90,1.18
"""
ANGLES = np.linspace(0.0, np.pi, 11)
SPHEROID = "z,rho\n" + "".join(
    f"{-1.4 * np.cos(t):.12g},{abs(np.sin(t).round(15)):.12g}\n" for t in ANGLES
)
CASE = """# Every section and what the paper's model has.
[stone]
diameter = "4.2 mm"
friction = 0.5
shape = "spheroid.csv"

[ureter]
inner_diameter = "3.5 mm"
outer_diameter = "4.55 mm"
material = "soft.toml"

[load]
confining_pressure = "40 mmHg"
confinement = "hydrostatic"
prestretch = 1.05

[method]
model = "paper"
seating = "pressed"
seating_friction = 0.2
half_length = 12.5
as_printed = true
closure_start = "lumen"
closure = "series"
series_order = 3
opening_curve = "pairs.csv"
far_field_ground = true
accuracy = "fast"
"""
BEAM = """stone = {size_ratio = 1.2, aspect = 1.5}
load.confining_pressure = "5.4 kPa"

[ureter]
wall_ratio = 1.3
material = 'latex'

[method]
model = "beam"
circumferential_modulus = "0.465 MPa"
longitudinal_modulus = "20 kPa"
"""
YEOH = """law = "yeoh"
name = "mine"
C10 = "30 kPa"
C20 = "5 kPa"
C30 = "1 kPa"
source = "a test"
test = "tension"
strain_range = [0.9, 1.4]
"""
PATIENT = """# Every section of a patient's file.
[stone]
diameter = "5 mm ± 1 mm"
place = "distal"
friction = "0.05 to 0.5"
shape = "spheroid.csv"

[ureter]
inner_diameter = "4 mm to 4.8 mm"
wall_thickness = "0.7 ± 0.15 mm"
material = "soft.toml"
stiffness = "1 ± 0.3"

[dilated]
inner_diameter = "5 mm ± 0.5 mm"
outer_diameter = "6.4 mm ± 0 mm"

[load]
confining_pressure = "1 kPa"
confinement = "dead"
prestretch = 1.02

[method]
model = "direct"
half_length = 10.0
wetted = true
accuracy = "fast"

[assessment]
limit = "6 kPa"
samples = 1024
seed = 7
"""
FRICTION = json.dumps(
    {
        "friction_coefficient": 0.5239,
        "k0": 0.38,
        "k1": 0.12,
        "pixel_um": [0.5, 0.5],
        "paths": [{"from": [0, 20], "to": [1000, 20], "friction_coefficient": 0.51}],
        "source": "known slopes",
        "warnings": [],
    },
    indent=2,
)
# What the files above name.
BESIDE = {
    "soft.toml": example("soft_ureter.toml"),
    "spheroid.csv": SPHEROID,
    "pairs.csv": PAIRS,
}


class Kind(NamedTuple):
    """A valid file, its name, and what reads it."""

    text: str
    file: str
    read: Callable[[Path], Any]


def read_forces(path: Path) -> Any:
    return read_tension(path, length("4 mm"), length("1 mm"))


def read_tube(path: Path) -> Any:
    return read_inflation(path, Ureter("3.5 mm", "4.55 mm"))


def read_law(path: Path) -> Any:
    return load_material(str(path))


KINDS: dict[str, Kind] = {
    "tension": Kind(example("ureter_tensile.csv"), "strips.csv", read_tension),
    "forces": Kind(example("latex_tensile.csv"), "forces.csv", read_forces),
    "inflation": Kind(example("ureter_inflation.csv"), "inner.csv", read_tube),
    "outer diameters": Kind(OUTER, "outer.csv", read_tube),
    "points": Kind(example("latex_series.csv"), "series.csv", read_points),
    "shape": Kind(example("egg.csv"), "egg.csv", read_shape),
    "pairs": Kind(PAIRS, "opened.csv", read_opening_curve),
    "case": Kind(CASE, "case.toml", read_case),
    "beam case": Kind(BEAM, "beam.toml", read_case),
    "law": Kind(example("soft_ureter.toml"), "law.toml", read_law),
    "yeoh law": Kind(YEOH, "yeoh.toml", read_law),
    "patient": Kind(PATIENT, "patient.toml", read_patient),
    "friction": Kind(FRICTION, "friction.json", read_friction),
}


# What follows


def outcome(kind: str, data: bytes, folder: Path) -> str:
    """Read a file of these bytes: "read" or "refused"; `AssertionError` for anything else."""
    told = KINDS[kind]
    beside(folder)
    path = folder / told.file
    path.write_bytes(data)
    try:
        with limited(LONGEST_TIME), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # as the command does
            found = told.read(path)
    except BadInput as refused:
        check_sentence(kind, refused, told.file)
        return "refused"
    except Exception as problem:
        raise AssertionError(f"{kind}: {type(problem).__name__}: {str(problem)[:200]}") from problem
    numbers = list(floats(found))
    assert numbers, f"{kind}: read, but without a number"
    odd = [number for number in numbers if not np.isfinite(number).all()]
    assert not odd, f"{kind}: read {odd[0]}"
    return "read"


def beside(folder: Path) -> None:
    """Put there what the files name."""
    for name, text in BESIDE.items():
        if not (folder / name).exists():
            (folder / name).write_text(text, encoding="utf-8")


def check_sentence(kind: str, refused: BadInput, file: str) -> None:
    """One sentence that names the file and what was expected."""
    try:
        told = str(refused)
    except Exception as problem:
        raise AssertionError(f"{kind}: no sentence: {type(problem).__name__}") from problem
    shown = f"{kind}: {told[:200]!r}"
    assert told.isprintable(), f"{shown} has control characters or several lines"
    assert told.endswith("."), f"{shown} does not end"
    assert len(told) < LONGEST_SENTENCE, f"{shown} has {len(told)} characters"
    assert file in told, f"{shown} does not name {file}"
    expected = "must be" in told or "cannot be used with" in told
    assert expected, f"{shown} does not say what was expected"


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Stop what needs more CPU time; `TimeoutError`, also where it was caught on the way."""

    late = TimeoutError(f"more than {seconds:g} s")
    seen = []

    def stop(*_: Any) -> None:
        seen.append(late)
        raise late

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    if seen:
        raise late


def floats(found: Any) -> Iterator[Any]:
    """Every number and every array of them in what was read; a whole one beyond 64 bit is none."""
    if isinstance(found, float | np.ndarray):
        yield found
    elif isinstance(found, int) and not isinstance(found, bool):
        yield float(found) if abs(found) < 2**63 else math.inf
    elif dataclasses.is_dataclass(found):
        for field in dataclasses.fields(found):
            yield from floats(getattr(found, field.name))
    elif isinstance(found, Mapping):
        for each in found.values():
            yield from floats(each)
    elif isinstance(found, tuple | list):
        for each in found:
            yield from floats(each)


# Damage to text

NUMBERS = (
    "nan", "NaN", "-nan", "inf", "-inf", "Infinity", "1e400", "-1e400", "1e308", "-1e308", "1e200",
    "1e-160", "1e-320", "-1", "0", "-0.0", "1e9", "1e-9", "", "-", ".", "e5", "1e", "--1", "1 2",
    "1_0", "0x1F", "0o7", "1,5", "1.2.3", "٣", "½", "1.", ".5", "+1", "true", "None", "null",
    "1.1.2025", "12:30", "=1+1", "9" * 400, "9" * 5000, "0x" + "f" * 5000, "0." + "3" * 5000,
)  # fmt: skip
QUANTITIES = (
    "5", "5 kg", "5 mm ± x", "NaN mm", "1e400 mm", "1e-400 mm", "5 mm ±", "± 5 mm", "5 mm ± 1",
    "5 ± 1", "5 mm ± nan mm", "5 mm ± 1e400 mm", "5 mm ± -1 mm", "7 mm to 5 mm", "5 mm to", "to",
    "5 mm ± 20 %", "0 mm", "-5 mm", "5 m", "5 km", "5 µm", "5 inch", "5 kPa", "5 MPa", "5 Pa",
    "5 mmHg", "5 cmH2O", "5 mm²", "5 mm**2", "5 mm*2", "5 mm/mm", "5 mm**9**9", "5 mm**9**9**9",
    "5 mm**0.5", "5 mm((((", "5 )", "5 parsec", "5 °C", "5 %", "5 nan", "5 inf*mm", "mm", "mm 5",
    "5  mm", "5mm", "5,5 mm", "５ mm", "5 ㎜", "1_0 mm", "0x5 mm", "5 mm 5 mm", "five mm", "5 mm\\n",
    "5 mm +/- 1 mm", "5 mm ± 1 kg", "inf ± 1", "1 ± 1e-320", "1 ± 0", "1e308 to 1e309",
)  # fmt: skip
VALUES = (
    "{}", "{a = 1}", "{diameter = '5 mm'}", "[]", "[1, 2]", "[1, 'a']", "[[1], [2]]", "[{a = 1}]",
    "[nan, inf]", "[1.0, 1.3, 1.4]", "'text'", '"text"', '""', "''", '"""several\nlines"""',
    "true", "false", "1", "-1", "1.5", "nan", "-inf", "1979-05-27", "07:32:00", "null",
    "1979-05-27T07:32:00Z", '{"a": 1}', '{"a": {"b": [1, null]}}', "0b101", "'../case.toml'",
    "'none.csv'", "'pairs.csv'", "'spheroid.csv'", "'soft.toml'", "'.'", "'/'", "'law.py:energy'",
    "'" + "x" * 300 + ".csv'", "'" + "x" * 300 + ".toml'", "'a\0.csv'", r'"a\u0000.toml"',
)  # fmt: skip
INSERTED = (
    "\0", "\a", "\b", "\x1b[31m", "\x7f", "\x85", "\xa0", "\u200b", "\u202e", "\u2028", "\ufeff",
    "\ud800", "\t", "\v", "\f", "\r", "\n", "\r\n", '"', "'", '"""', "'''", "#", "[", "]", "[[",
    "{", "}", "\\", "\\u0000", "\\x", "±", ",", ",,", ";", "=", ":", ".", "e", "-", " ", "µ", "é",
    "ß", "漢", "🪨", "%s", "{0}", "\x1b]0;a\a",
)  # fmt: skip
LONG = ("x", "9", " ", "mm ", "a.", "5 mm ± ", "to ", "(", "\t", "1,", "é", "-", "0.")
LENGTHS = (100, 1000, 5000, 20_000, 140_000)
DEPTHS = (5, 90, 300, 1000, 5000, 30_000)
NESTS = (("[", "]"), ("{a = ", "}"), ('{"a": ', "}"), ("(", ")"), ("[[", "]]"))
ENCODINGS = ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "cp037", "utf-7")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?!\w)")
QUANTITY = re.compile(r'(?<=")[-+.\d]+ [^"\n]*(?=")')
WORD = re.compile(r"[A-Za-z_]\w+")
UNIT = re.compile(r"(?<=_)(?:kPa|mm|N|deg)\b|\b(?:kPa|mm|MPa|mmHg)\b")
UNITS = ("kPa", "MPa", "Pa", "mmHg", "cmH2O", "mm", "m", "um", "N", "kg", "rad", "deg", "%", "")
Text = Callable[[str, Random], str]


def swap_lines(text: str, random: Random) -> str:
    lines = text.split("\n")
    i, k = (random.randrange(len(lines)) for _ in range(2))
    lines[i], lines[k] = lines[k], lines[i]
    return "\n".join(lines)


def repeat_line(text: str, random: Random) -> str:
    lines = text.split("\n")
    at = random.randrange(len(lines))
    count = random.choice((1, 1, 1, 2, 300))
    return "\n".join([*lines[:at], *[lines[at]] * count, *lines[at:]])


def leave_out_lines(text: str, random: Random) -> str:
    lines = text.split("\n")
    at = random.randrange(len(lines))
    del lines[at : at + random.choice((1, 1, 1, 2, 5, 1000))]
    return "\n".join(lines)


def in_a_line(change: Callable[[list[str], Random], None]) -> Text:
    """Damage to the cells of one line, or to key and value."""

    def damage(text: str, random: Random) -> str:
        lines = text.split("\n")
        at = random.randrange(len(lines))
        mark = next((mark for mark in ("=", ":", ",") if mark in lines[at]), ",")
        cells = lines[at].split(mark)
        change(cells, random)
        lines[at] = mark.join(cells)
        return "\n".join(lines)

    return damage


@in_a_line
def swap_cells(cells: list[str], random: Random) -> None:
    random.shuffle(cells)


@in_a_line
def repeat_cell(cells: list[str], random: Random) -> None:
    cells.insert(random.randrange(len(cells) + 1), random.choice(cells))


@in_a_line
def leave_out_cell(cells: list[str], random: Random) -> None:
    del cells[random.randrange(len(cells))]


@in_a_line
def empty_cell(cells: list[str], random: Random) -> None:
    cells[random.randrange(len(cells))] = random.choice(("", " ", '""', "\t"))


@in_a_line
def other_value(cells: list[str], random: Random) -> None:
    cells[-1] = " " + random.choice(VALUES)


@in_a_line
def nested_value(cells: list[str], random: Random) -> None:
    opened, closed = random.choice(NESTS)
    depth = random.choice(DEPTHS)
    cells[-1] = opened * depth + random.choice(("", "1")) + closed * random.choice((depth, 0, 1))


@in_a_line
def nested_key(cells: list[str], random: Random) -> None:
    bracket = "]" if cells[0].endswith("]") else ""
    more = random.choice((".a", ".'a b'", ". a")) * random.choice(DEPTHS[:5])
    cells[0] = cells[0].rstrip().removesuffix("]") + more + bracket


@in_a_line
def long_cell(cells: list[str], random: Random) -> None:
    at = random.randrange(len(cells))
    more = random.choice(LONG) * random.choice(LENGTHS)
    place = random.randrange(len(cells[at]) + 1)
    cells[at] = cells[at][:place] + more + cells[at][place:]


@in_a_line
def quoted_cell(cells: list[str], random: Random) -> None:
    at, mark = random.randrange(len(cells)), random.choice("\"'")
    bare = cells[at].strip().strip("\"'")
    cells[at] = random.choice((f"{mark}{bare}{mark}", bare, f"{mark}{bare}", f"{bare}{mark}"))


def in_place(pattern: re.Pattern[str], other: Callable[[str, Random], str]) -> Text:
    """Put something else in the place of one match."""

    def damage(text: str, random: Random) -> str:
        found = list(pattern.finditer(text))
        if not found:
            return text
        match = random.choice(found)
        return text[: match.start()] + other(match[0], random) + text[match.end() :]

    return damage


def misspelt(word: str, random: Random) -> str:
    at = random.randrange(len(word))
    letter = random.choice("aeiouxyz_0")
    return random.choice(
        (
            word[:at] + word[at + 1 :],
            word[:at] + letter + word[at:],
            word[:at] + letter + word[at + 1 :],
            word.upper(),
            word.title(),
            f"{word} {word}",
            f"{word}_{word}",
            word.replace("_", " "),
            f'"{word}"',
            "",
        )
    )


def another_word(word: str, random: Random) -> str:
    """A word of a file of any kind."""
    return random.choice(WORD.findall(KINDS[random.choice(sorted(KINDS))].text))


def insert(text: str, random: Random) -> str:
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(INSERTED) * random.choice((1, 1, 1, 3)) + text[at:]


def other_line_ends(text: str, random: Random) -> str:
    return text.replace("\n", random.choice(("\r\n", "\r", "\n\n", "\n\r", "\u2028", "", " ")))


def byte_order_mark(text: str, random: Random) -> str:
    return "\ufeff" + text


def without_quotes(text: str, random: Random) -> str:
    return text.replace('"', random.choice(("", "'", '""', "“")))


def blank(text: str, random: Random) -> str:
    return random.choice(("", "\n", " ", "\n" * 2000, "#", "\0" * 100, "{}", "[]", "a", ","))


LINES_AND_CELLS: tuple[Text, ...] = (
    swap_lines,
    repeat_line,
    leave_out_lines,
    swap_cells,
    repeat_cell,
    leave_out_cell,
    empty_cell,
    other_value,
    nested_value,
    nested_key,
    long_cell,
    quoted_cell,
    insert,
    other_line_ends,
    byte_order_mark,
    without_quotes,
    blank,
)
ONE_WORD: tuple[Text, ...] = (
    in_place(NUMBER, lambda _, random: random.choice(NUMBERS)),
    in_place(NUMBER, lambda _, random: f"{random.lognormvariate(0.0, 2.0):.6g}"),
    in_place(NUMBER, lambda number, random: f"{float(number) * random.uniform(0.9, 1.1):.6g}"),
    in_place(QUANTITY, lambda _, random: random.choice(QUANTITIES)),
    in_place(UNIT, lambda _, random: random.choice(UNITS)),
    in_place(WORD, misspelt),
    in_place(WORD, another_word),
)


# Damage to bytes


def flip(raw: bytearray, random: Random) -> None:
    for _ in range(random.randint(1, 6)):
        at = random.randrange(len(raw))
        raw[at] = random.choice(
            (raw[at] ^ (1 << random.randrange(8)), 0, 255, random.randrange(256))
        )


def cut(raw: bytearray, random: Random) -> None:
    del raw[random.randrange(len(raw)) :]


def leave_out(raw: bytearray, random: Random) -> None:
    at = random.randrange(len(raw))
    del raw[at : at + random.randint(1, 40)]


def repeat(raw: bytearray, random: Random) -> None:
    at = random.randrange(len(raw))
    raw[at:at] = raw[at : at + random.randint(1, 40)] * random.choice((1, 2, 50))


def no_text(raw: bytearray, random: Random) -> None:
    at = random.randrange(len(raw))
    raw[at:at] = random.choice((b"\0", b"\xff\xfe", b"\x80", b"\xc3", b"\xed\xa0\x80", b"\xf8\x88"))


BYTE_DAMAGE = (flip, flip, cut, leave_out, repeat, no_text)


def damaged(kind: str, random: Random) -> bytes:
    """The valid file of a kind with one to four damages."""
    whole = KINDS[kind].text
    raw = bytearray(whole, "utf-8")
    while raw == bytearray(whole, "utf-8"):  # some find nothing to damage
        text = whole
        for _ in range(random.choice((1, 1, 1, 1, 2, 2, 3))):
            text = random.choice(random.choice((LINES_AND_CELLS, ONE_WORD)))(text, random)
        if random.random() < 0.06:
            raw = bytearray(text.encode(random.choice(ENCODINGS), errors="replace"))
            continue
        raw = bytearray(text.encode("utf-8", errors="surrogatepass"))
        if raw and random.random() < 0.2:
            random.choice(BYTE_DAMAGE)(raw, random)
    return bytes(raw)
