"""Files from outside with every kind of fault: one sentence that says where, and exit code 2."""

import math
import os
import time
from collections import Counter
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from damaged_tables import (
    CASE,
    KINDS,
    PATIENT,
    SPHEROID,
    Kind,
    beside,
    check_sentence,
    damaged,
    limited,
    outcome,
)

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.inputs.case_file import read_case
from stonepass.inputs.shape_file import read_shape
from stonepass.io.csv_file import MOST_ROWS

SEED = 20250
COUNT = dict.fromkeys(KINDS, 150) | {"shape": 20}  # a shape that is nearly one takes 0.3 s
FEW = dict.fromkeys(KINDS, 30) | {"shape": 8}
DISTINCT = ("shape", "pairs")  # where a row that is there twice is a mistake
TABLES = [kind for kind in KINDS if KINDS[kind].file.endswith(".csv")]
TEN_MILLION = 10**7 * 8  # bytes of as many rows; a hole, of which no byte is on the disk
SECONDS = 2.0  # of CPU, for any file that is refused


def refusal(kind, data, folder):
    """The sentence that refuses a file of these bytes or this text."""
    beside(folder)
    file = KINDS[kind].file
    (folder / file).write_bytes(data if isinstance(data, bytes) else data.encode())
    with limited(SECONDS), pytest.raises(BadInput) as refused:
        KINDS[kind].read(folder / file)
    check_sentence(kind, refused.value, file)
    return str(refused.value)


def changed(kind, old, new):
    text = KINDS[kind].text
    assert old in text
    return text.replace(old, new, 1)


def has(sentence, *parts):
    for part in parts:
        assert part in sentence


# Headers


@pytest.mark.parametrize(
    ("kind", "old", "new", "parts"),
    [
        ("tension", "stretch", "strech", ("column is strech", "did you mean 'stretch'")),
        ("tension", "stress_kPa", "stress_MPa", ("nominal_stress_MPa", "must be nominal_stress_kPa", "convert the values from MPa to kPa: 1 MPa is 1000 kPa")),
        ("tension", "axis", "axes", ("column is axes", "did you mean 'axis'")),
        ("tension", "stretch", "", ("the name of column 1 is empty", "give it a name")),
        ("tension", ",axis", ",stretch", ("column is stretch", "given once")),
        ("tension", "stretch,", "1.0,", ("column is 1.0", "one of stretch")),
        ("forces", "force_N", "force_kN", ("column is force_kN", "must be force_N", "1 kN is 1000 N")),
        ("inflation", "pressure_kPa", "pressure_mmHg", ("pressure_mmHg", "must be pressure_kPa", "from mmHg to kPa: 1 mmHg is 0.133322 kPa")),
        ("inflation", "inner_diameter_mm", "inner_diameter", ("write 'inner_diameter_mm' if its values are in mm",)),
        ("forces", "force_N", "axial", ("column is axial", "did you mean 'axis'")),
        ("outer diameters", "axial_stretch", "axial_strech", ("did you mean 'axial_stretch'",)),
        ("outer diameters", "axial_stretch", "inner_diameter_mm", ("the column of diameters is given twice",)),
        ("points", "eta", "η", ("column is η", "one of xi, eta, confining_kPa, pressure_kPa, sd_kPa")),
        ("points", "xi,", "eta,", ("column is eta", "given once")),
        ("points", "sd_kPa", "sem_kPa", ("column is sem_kPa", "did you mean 'sd_kPa'")),
        ("shape", "z,rho", "z,r", ("column is r", "one of z, rho", "did you mean 'rho'")),
        ("shape", "z,rho", "z;rho", ("row 4 is 1 cells", "2, as in the header")),
        ("shape", "z,rho", "Z,rho", ("column is Z", "one of z, rho")),
        ("pairs", "alpha_deg", "alpha_rad", ("alpha_rad", "must be alpha_deg", "1 rad is 57.2958 deg")),
        ("pairs", ",radius_ratio", "", ("column 'radius_ratio' is missing", "must be given")),
    ],
)  # fmt: skip
def test_a_header_that_is_wrong(tmp_path, kind, old, new, parts):
    has(refusal(kind, changed(kind, old, new), tmp_path), f"in {KINDS[kind].file}", *parts)


@pytest.mark.parametrize(
    ("kind", "text", "parts"),
    [
        ("tension", "stretch,axis\n1.1,axial\n", ("the column of stresses is missing", "nominal_stress_kPa or force_N")),
        ("tension", "stretch,force_N,nominal_stress_kPa\n1.1,1,2\n", ("the column of stresses is given twice",)),
        ("inflation", "pressure_kPa\n1\n", ("the column of diameters is missing", "inner_diameter_mm or outer_diameter_mm")),
        ("inflation", "pressure_kPa,inner_diameter_mm,outer_diameter_mm\n1,4,5\n", ("the column of diameters is given twice",)),
    ],
)  # fmt: skip
def test_one_of_two_columns(tmp_path, kind, text, parts):
    has(refusal(kind, text, tmp_path), f"in {KINDS[kind].file}", "given as either", *parts)


@pytest.mark.parametrize("kind", TABLES)
def test_a_table_of_nothing(tmp_path, kind):
    for text in ("", "\n\n\n", "\ufeff", "# made by hand\n", " , ,\n"):
        has(refusal(kind, text, tmp_path), "must be a table with the columns")


@pytest.mark.parametrize("kind", TABLES)
def test_a_header_alone(tmp_path, kind):
    header = next(line for line in KINDS[kind].text.splitlines() if line[0] != "#")
    has(refusal(kind, header + "\n", tmp_path), "at least one row under its header")


# Cells, by row and column


@pytest.mark.parametrize(
    ("kind", "old", "new", "parts"),
    [
        ("tension", "1.06,20.1491", "1.06,x", ("row 3, column 'nominal_stress_kPa' is x", "a number from -1e+07 to 1e+07")),
        ("tension", "1.06,", "16,", ("row 3, column 'stretch' is 16", "a number from 0.1 to 15")),
        ("tension", "1.06,", "1.06 mm,", ("row 3, column 'stretch' is 1.06 mm", "a number")),
        ("tension", "1.06,20.1491,circumferential", "1.06,20.1491,axal", ("row 3, column 'axis' is axal", "did you mean 'axial'")),
        ("tension", "1.06,20.1491,circumferential", "1.06,20.1491", ("row 3 is 2 cells", "must be 3, as in the header")),
        ("tension", "1.06,", "1,06,", ("row 3 is 4 cells", "must be 3, as in the header")),
        ("tension", "1.06,", "# by hand\n\n1.06 ,,", ("row 5 is 4 cells",)),
        ("forces", "0.776279", "", ("row 3, column 'force_N' is empty", "a number from -1e+06 to 1e+06")),
        ("forces", "0.776279", " \t ", ("row 3, column 'force_N' is empty", "a number")),
        ("forces", "0.776279", "-inf", ("row 3, column 'force_N' is -inf", "a number")),
        ("inflation", "2.79118", "NaN", ("row 3, column 'pressure_kPa' is NaN", "a number from -1000 to 10000")),
        ("inflation", "3.64", "0", ("row 3, column 'inner_diameter_mm' is 0", "a number from 0.001 to 1000")),
        ("inflation", "3.64", "0x3", ("row 3, column 'inner_diameter_mm' is 0x3",)),
        ("outer diameters", "4.7,1", "4.7,0.4", ("row 4, column 'axial_stretch' is 0.4", "a number from 0.5 to 3")),
        ("outer diameters", "4.7,1", "2.5,1", ("row 4", "outer_diameter_mm", "2.5", "large enough for the volume of the wall")),
        ("points", "1.2,1.5,0,44.3597", "1.2,1.5,0,1e400", ("row 3, column 'pressure_kPa' is 1e400", "a number from 0 to 1000")),
        ("points", "1.2,1.5,0", "1.2,1.01,0", ("row 3, column 'eta' is 1.01", "a number from 1.02 to 10")),
        ("points", "1.2,1.5,0", "-1.2,1.5,0", ("row 3, column 'xi' is -1.2", "a number from 0.1 to 3")),
        ("points", "1.27485", "-1", ("row 3, column 'sd_kPa' is -1", "a number from 0 to 1000")),
        ("points", "1.2,1.5,0", "1.2,1.5,1e3", ("row 3, column 'confining_kPa' is 1e3", "a number from 0 to 100")),
        ("shape", "0.015,0.198", "0.015,inf", ("row 5, column 'rho' is inf", "a number")),
        ("shape", "0.015,0.198", "0.015\a,0.198", ("row 5, column 'z' is 0.015?", "a number")),
        ("shape", "0.015,0.198", "0.015\0,0.198", ("row 5, column 'z' is 0.015?", "a number")),
        ("pairs", "70,", "91,", ("row 4, column 'alpha_deg' is 91", "a number from 0.001 to 90")),
        ("pairs", "70,", "0,", ("row 4, column 'alpha_deg' is 0", "a number from 0.001 to 90")),
        ("pairs", "1.09", '"1.09', ("must be a row of a CSV file",)),
        ("pairs", "1.09", "9" * 5000, ("row 4, column 'radius_ratio' is 999", "a number from 0.1 to 10")),
        ("pairs", "1.09", "9" * 200_000, ("must be a row of a CSV file",)),
    ],
)  # fmt: skip
def test_a_cell_that_is_wrong(tmp_path, kind, old, new, parts):
    has(refusal(kind, changed(kind, old, new), tmp_path), KINDS[kind].file, *parts)


NO_NUMBERS = ("nan", "-NaN", "inf", "1e400", "-1e400", "five", "5 mm", "''", "1/2", "--1")


@pytest.mark.parametrize("kind", TABLES)
def test_no_table_has_cells_that_are_no_numbers(tmp_path, kind):
    lines = KINDS[kind].text.splitlines()
    row, last = len(lines), lines.pop().split(",")
    column = next(line for line in lines if line[0] != "#").split(",")[0]
    for cell in NO_NUMBERS:
        sentence = refusal(kind, "\n".join([*lines, ",".join([cell, *last[1:]])]), tmp_path)
        has(sentence, f"in {KINDS[kind].file}, row {row}, column '{column}' is {cell}", "a number")


@pytest.mark.parametrize("kind", DISTINCT)
@pytest.mark.parametrize("ends", ["\n", "\r\n", "\r"])
def test_a_row_that_is_there_twice(tmp_path, kind, ends):
    lines = KINDS[kind].text.splitlines()
    text = ends.join([*lines, "", lines[-2].replace(",", " ,\t")])
    sentence = refusal(kind, text, tmp_path)
    row, same = len(lines) + 2, len(lines) - 1
    has(
        sentence,
        f"in {KINDS[kind].file}, row {row} is equal to row {same}",
        "leave one of them out",
    )


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("0.015,0.198", "0.200,0.198", ("row 6", "z", "never falling")),
        ("0.015,0.198", "0.015,-0.198", ("row 5", "rho", "-0.198")),
        ("0.000,0.000", "0.000,0.100", ("row 4", "rho", "on the axis")),
    ],
)
def test_a_point_that_no_meridian_has(tmp_path, old, new, parts):
    has(refusal("shape", changed("shape", old, new), tmp_path), "egg.csv", *parts)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("z,rho\n0,0\n1,1\n2,0\n", ("3 points", "at least 9 points")),
        (SPHEROID.replace("1,", "-1,"), ("egg.csv",)),
        ("z,rho\n" + "".join(f"{k},{k % 2}\n" for k in range(11)), ("aspect of the stone is 5", "0.5 to 2.0")),
        ("z,rho\n" + "".join(f"{k},{3 * (k % 2)}\n" for k in range(11)), ("within 5% of the radius",)),
        ("z,rho\n" + "".join(f"{k},0.{k}\n" for k in range(9)), ("being the last point",)),
    ],
)  # fmt: skip
def test_points_that_are_no_meridian(tmp_path, text, parts):
    has(refusal("shape", text, tmp_path), "in egg.csv", *parts)


@pytest.mark.parametrize("scale", [1e-320, 1e-300, 1e154, 1e200, 1e307])
def test_a_stone_of_no_size_on_earth(tmp_path, scale):
    z, rho = np.loadtxt(SPHEROID.splitlines(), delimiter=",", skiprows=1, unpack=True)
    rows = zip(z * scale, rho * scale, strict=True)
    text = "z,rho\n" + "".join(f"{a:.17g},{b:.17g}\n" for a, b in rows)
    assert outcome("shape", text.encode(), tmp_path) in ("read", "refused")


# Bytes and encodings


NO_TEXT = (b"\xff\xfe\0\1", b"\x80", bytes(range(256)), b"\0" * 5000, b"\x1f\x8b\x08" * 9)


@pytest.mark.parametrize("kind", list(KINDS))
def test_another_encoding_or_no_text(tmp_path, kind):
    text, told = KINDS[kind].text, "a CSV file of text" if kind in TABLES else "valid "
    # JSON and tables may be UTF-16.
    encodings = {"friction": ("cp037",)}.get(
        kind, ("utf-32",) if kind in TABLES else ("utf-16", "utf-32")
    )
    for raw in (*NO_TEXT, *(text.encode(name, errors="replace") for name in encodings)):
        sentence = refusal(kind, raw, tmp_path)
        if raw[:1] == b"\xff" and raw != NO_TEXT[0]:  # whose two bytes are a letter of UTF-16
            has(sentence, told)


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_letter_of_latin_1(tmp_path, kind):
    text = KINDS[kind].text.replace("5", "5µ", 1)
    has(refusal(kind, text.encode("latin-1", errors="replace"), tmp_path), KINDS[kind].file)


@pytest.mark.parametrize("kind", TABLES)
@pytest.mark.parametrize("ends", ["\n", "\r\n", "\r"])
def test_line_ends_and_a_byte_order_mark_are_read(tmp_path, kind, ends):
    text = "\ufeff" + KINDS[kind].text.replace("\n", ends)
    assert outcome(kind, text.encode(), tmp_path) == "read"


# TOML


@pytest.mark.parametrize(
    ("kind", "old", "new", "parts"),
    [
        # Keys and sections
        ("case", "diameter", "diametr", ("key of [stone] is diametr", "did you mean 'diameter'")),
        ("case", "[load]", "[laod]", ("key is laod", "one of stone, ureter, load, method", "did you mean 'load'")),
        ("case", "series_order", "serie_order", ("key of [method] is serie_order", "did you mean 'series_order'")),
        ("case", "[method]", "[method.x]", ("key of [method] is x",)),
        ("beam case", "wall_ratio", "wal_ratio", ("key of [ureter] is wal_ratio", "did you mean 'wall_ratio'")),
        ("beam case", "[ureter]", "[[ureter]]", ("'ureter' is [{", "a section, written [ureter]")),
        ("law", "a1111", "b1111", ("key is b1111", "did you mean 'a1111'")),
        ("law", "source", "sauce", ("key is sauce", "did you mean 'source'")),
        ("patient", "samples", "sample", ("key of [assessment] is sample", "did you mean 'samples'")),
        ("patient", "[dilated]", "[dilatet]", ("key is dilatet", "did you mean 'dilated'")),
        # Missing, empty, there twice
        ("case", '[ureter]\ninner_diameter = "3.5 mm"', "[ureter]", ("'ureter.inner_diameter' is missing", "must be given")),
        ("case", 'diameter = "4.2 mm"', "", ("size of the stone is missing", "as diameter or size_ratio")),
        ("case", 'diameter = "4.2 mm"', 'diameter = "4.2 mm"\nsize_ratio = 1.2', ("size of the stone is given twice",)),
        ("case", 'diameter = "4.2 mm"', 'diameter = ""', ("'stone.diameter' is empty", "a length with its unit")),
        ("case", "friction = 0.5", "friction = 0.5\nfriction = 0.5", ("valid TOML", "line 5")),
        ("case", "[load]", "[stone]\n[load]", ("valid TOML", "line 12")),
        ("law", 'C = "0.2 MPa"', "", ("'C'", "missing", "given for law 'fung'")),
        ("law", "a2222 = 0.8892", "", ("'a2222'", "missing", "given for law 'fung'")),
        ("yeoh law", 'source = "a test"', "", ("'source' is missing",)),
        ("yeoh law", 'source = "a test"', 'source = ""', ("'source' is empty", "not empty")),
        ("patient", 'diameter = "5 mm ± 1 mm"', "", ("'stone.diameter' is missing",)),
        ("patient", 'wall_thickness = "0.7 ± 0.15 mm"', "", ("wall of the ureter is missing", "as either outer_diameter or wall_thickness")),
        ("patient", "[assessment]", "[assessment]\nlimit = '1 kPa'", ("valid TOML", "line")),
        # Units
        ("case", "4.2 mm", "4.2", ("'stone.diameter' is 4.2", "a length with its unit")),
        ("case", '"4.2 mm"', "4.2", ("'stone.diameter' is 4.2", "text in quotes")),
        ("case", "4.2 mm", "4.2 kg", ("'stone.diameter' is 4.2 kg", "a length")),
        ("case", "4.2 mm", "4,2 mm", ("'stone.diameter' is 4,2 mm", "with a decimal point", "4.2 mm")),
        ("case", "4.2 mm", "NaN mm", ("'stone.diameter' is NaN mm", "a length with its unit")),
        ("case", "4.2 mm", "1e400 mm", ("'stone.diameter' is 1e400 mm", "a finite length")),
        ("case", "4.2 mm", "-4.2 mm", ("'stone.diameter' is -4.2 mm", "0.01 mm to 1000 mm")),
        ("case", "4.2 mm", "4.2 m", ("'stone.diameter' is 4.2 m", "0.01 mm to 1000 mm")),
        ("case", "40 mmHg", "40 mm", ("'load.confining_pressure' is 40 mm", "a pressure")),
        ("case", "40 mmHg", "40 MPa", ("'load.confining_pressure' is 40 MPa", "0 kPa to 100 kPa")),
        ("beam case", "20 kPa", "20 kPa/m", ("'method.longitudinal_modulus' is 20 kPa/m", "a pressure")),
        ("law", "0.2 MPa", "0.2", ("C is 0.2", "a pressure with its unit")),
        ("law", "0.2 MPa", "0.2 mm", ("C is 0.2 mm", "a pressure")),
        ("law", "10 kPa", "1e400 kPa", ("G is 1e400 kPa", "a finite pressure")),
        ("law", "0.2 MPa", "-0.2 MPa", ("C is -200000", "a positive modulus")),
        ("yeoh law", "30 kPa", "30 kg", ("C10 is 30 kg", "a pressure")),
        ("patient", "5 mm ± 1 mm", "5 mm", ("stone diameter is 5 mm", "a length with its uncertainty")),
        ("patient", "5 mm ± 1 mm", "5", ("stone diameter is 5", "a length with its uncertainty")),
        ("patient", "5 mm ± 1 mm", "5 mm ± x", ("stone diameter is", "a length with its unit")),
        ("patient", "5 mm ± 1 mm", "5 mm ± 1 kg", ("stone diameter is 1 kg", "a length")),
        ("patient", "5 mm ± 1 mm", "5 kg ± 1 kg", ("stone diameter is 5 kg", "a length")),
        ("patient", "5 mm ± 1 mm", "NaN mm ± 1 mm", ("stone diameter is NaN mm",)),
        ("patient", "5 mm ± 1 mm", "5 mm ± NaN mm", ("stone diameter is NaN mm",)),
        ("patient", "5 mm ± 1 mm", "5 mm ± 1e400 mm", ("stone diameter is 1e400 mm", "a finite length")),
        ("patient", "5 mm ± 1 mm", "5 mm ± x %", ("5 mm ± x %", "followed by a number in percent")),
        ("patient", "5 mm ± 1 mm", "5 mm ± -1 mm", ("5 mm ± -1 mm", "an uncertainty from 0 to")),
        ("patient", "4 mm to 4.8 mm", "4.8 mm to 4 mm", ("inner diameter is 4.8 mm to 4 mm", "a rising range")),
        ("patient", "0.05 to 0.5", "0.05 to", ("friction is 0.05 to", "a number with its uncertainty")),
        ("patient", "1 ± 0.3", "nan ± 0.3", ("stiffness is nan ± 0.3", "from 0.05 to 20")),
        ("patient", "6 kPa", "6", ("limit is 6", "a pressure with its unit")),
        # Numbers
        ("case", "friction = 0.5", "friction = nan", ("'stone.friction' is nan", "a number from 0 to 2")),
        ("case", "friction = 0.5", "friction = -0.5", ("'stone.friction' is -0.5", "a number from 0 to 2")),
        ("case", "prestretch = 1.05", "prestretch = inf", ("'load.prestretch' is inf", "a number from 0.8 to 1.6")),
        ("case", "half_length = 12.5", "half_length = 1e400", ("'method.half_length' is inf", "a number from 3 to 100")),
        ("case", "half_length = 12.5", "half_length = 3", ("'method.half_length' is 3", "at least twice the stone's largest extent")),
        ("case", "series_order = 3", "series_order = 9", ("'method.series_order' is 9", "a whole number from 1 to 8")),
        ("case", "series_order = 3", "series_order = 3.0", ("'method.series_order' is 3.0", "a whole number")),
        ("case", "series_order = 3", "series_order = 7", ("'method.opening_curve' is 5 points", "at least as many points as coefficients, 7")),
        ("beam case", "size_ratio = 1.2", "size_ratio = nan", ("'stone.size_ratio' is nan", "a number from 0.1 to 3")),
        ("beam case", "aspect = 1.5", "aspect = 2.5", ("'stone.aspect' is 2.5", "a number from 0.5 to 2")),
        ("beam case", "wall_ratio = 1.3", "wall_ratio = 1", ("'ureter.wall_ratio' is 1.0", "a number from 1.02 to 10")),
        ("law", "0.7091", "nan", ("a1111 is nan", "a number above 0 and below 1000")),
        ("law", "0.1856", "1e3", ("a1122 is 1000.0", "a number between -1000 and 1000")),
        ("law", "[1.0, 1.3]", "[1.0, nan]", ("strain_range is [1.0, nan]", "two circumferential stretches")),
        ("law", "[1.0, 1.3]", "[1.0, 1.3, 1.4]", ("'strain_range'", "shorter")),
        ("law", "[1.0, 1.3]", "[1.0]", ("'strain_range", "given")),
        ("patient", "samples = 1024", "samples = 10", ("samples is 10", "a whole number from 256 to 65536")),
        ("patient", "seed = 7", "seed = -7", ("seed is -7", "from 0 to")),
        ("patient", "5 mm ± 1 mm", "50 mm ± 1 mm", ("stone diameter over inner diameter is 11.3636", "0.1 to 3")),
        # Words
        ("case", '"paper"', '"papre"', ("'method.model' is papre", "did you mean 'paper'")),
        ("case", '"soft.toml"', '"latx"', ("'ureter.material' is latx", "did you mean 'latex'")),
        ("law", '"fung"', '"fungus"', ("fungus", "did you mean 'fung'")),
        ("patient", '"distal"', '"dital"', ("place is dital", "did you mean 'distal'")),
        # Types and nesting
        ("case", "as_printed = true", 'as_printed = "no"', ("'method.as_printed' is no", "true or false")),
        ("case", "as_printed = true", "as_printed = 0", ("'method.as_printed' is 0", "true or false")),
        ("case", "friction = 0.5", 'friction = "0.5"', ("'stone.friction' is 0.5", "a number")),
        ("case", "friction = 0.5", "friction = true", ("'stone.friction' is True", "a number")),
        ("case", "friction = 0.5", "friction = {}", ("'stone.friction' is {}", "a number")),
        ("case", "friction = 0.5", "friction = [[[0.5]]]", ("'stone.friction' is [[[0.5]]]", "a number")),
        ("case", "friction = 0.5", "friction = 1979-05-27", ("'stone.friction' is datetime.date", "a number")),
        ("case", "friction = 0.5", "friction.coefficient = 0.5", ("'stone.friction' is {'coefficient'", "a number")),
        ("case", "friction = 0.5", "friction", ("valid TOML", "line 4")),
        ("case", '"4.2 mm"', '"4.2 mm', ("valid TOML", "line 3")),
        ("case", '"4.2 mm"', "[{a = 1}, {b = 2}]", ("'stone.diameter' is [{", "text in quotes")),
        ("beam case", "stone = {size_ratio = 1.2, aspect = 1.5}", "stone = 1.2", ("'stone' is 1.2", "a section, written [stone]")),
        ("law", '"fung"', '["fung"]', ("'law' is ['fung']", "text in quotes")),
        ("patient", '"1 ± 0.3"', "{value = 1, sd = 0.3}", ("'ureter.stiffness' is {", "text in quotes")),
        # Files that are named
        ("case", '"pairs.csv"', '"none.csv"', ("none.csv", "a file that exists")),
        ("case", '"pairs.csv"', '"."', ("a file that exists",)),
        ("case", '"soft.toml"', '"none.toml"', ("none.toml, but must be", "a file that exists")),
        ("case", '"soft.toml"', '"none.py:energy"', ("a file that exists",)),
        ("case", '"pairs.csv"', r'"a\u0000.csv"', ("a file that exists",)),
        ("patient", '"spheroid.csv"', '"pairs.csv"', ("in pairs.csv, column is alpha_deg", "one of z, rho")),
        ("patient", '"soft.toml"', '"patient.toml"', ("key is stone", "one of law, fibres, matrix, source")),
    ],
)  # fmt: skip
def test_a_key_or_a_value_that_is_wrong(tmp_path, kind, old, new, parts):
    has(refusal(kind, changed(kind, old, new), tmp_path), KINDS[kind].file, *parts)


@pytest.mark.parametrize("kind", ["case", "beam case", "law", "yeoh law", "patient"])
def test_a_file_without_keys(tmp_path, kind):
    for text in ("", "\n", "# nothing\n", "x", "[", "[]", "= 1", "a = 1", "\ufeff\ufeff"):
        refusal(kind, text, tmp_path)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("friction = 0.5", "friction = " + "1" * 400),
        ("friction = 0.5", "friction = " + "1" * 5000),
        ("friction = 0.5", "friction = 0x" + "f" * 5000),
        ("friction = 0.5", "friction = 0." + "3" * 20_000 + "x"),
        ("friction = 0.5", "friction = " + "[" * 300 + "]" * 300),
        ("friction = 0.5", "friction = " + "[" * 900 + "]" * 900),
        ("friction = 0.5", "friction = " + "[" * 50_000),
        ("friction = 0.5", "friction = " + "{a = " * 5000 + "1" + "}" * 5000),
        ("friction = 0.5", "friction" + ".a" * 900 + " = 0.5"),
        ("friction = 0.5", "friction" + ".a" * 3000 + " = 0.5"),
        ("friction = 0.5", "friction" + ".a" * 100_000 + " = 0.5"),
        ("[load]", "[load" + ".a" * 20_000 + "]"),
        ("[load]", f"[{'k' * 5000}]\n[{'k' * 5000}]"),
        ("[load]", f"{'k' * 5000} = 1\n[load]"),
        ("4.2 mm", "4" * 100_000 + " !"),
        ("4.2 mm", "4.2" + " " * 300_000 + "mm !"),
        ("4.2 mm", "4.2 " + "m" * 100_000),
        ("4.2 mm", "4.2 m" + "*m/m" * 20_000),
        ("4.2 mm", "4.2 mm" + "(" * 20_000),
        ("4.2 mm", "4.2 mm**9**9**9"),
        ("4.2 mm", "4.2 mm^9^9^9"),
        ("4.2 mm", "4.2 mm*9**999999999"),
        ("spheroid.csv", "x" * 300 + ".csv"),
        ("pairs.csv", "x/" * 3000 + ".csv"),
        ("soft.toml", "x" * 300 + ".toml"),
        ("soft.toml", "x" * 300 + ".py:energy"),
        ("soft.toml", "x" * 100_000),
    ],
    ids=lambda text: text[:24],
)  # fmt: skip
def test_what_is_long_or_deep_in_a_case(tmp_path, old, new):
    refusal("case", changed("case", old, new), tmp_path)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("5 mm ± 1 mm", "5 mm" + " " * 100_000 + "x"),
        ("5 mm ± 1 mm", "5 mm ± " + "a" * 100_000 + " 1"),
        ("5 mm ± 1 mm", "5 mm" + " to" * 100_000),
        ("5 mm ± 1 mm", "±" * 100_000),
        ("5 mm ± 1 mm", "5 mm ± 1 mm**9**9**9"),
        ("1 ± 0.3", "1 ± " + "3" * 100_000 + "x"),
        ("seed = 7", "seed = " + "7" * 400),
        ("seed = 7", "seed = 0x" + "f" * 5000),
    ],
    ids=lambda text: text[:24],
)
def test_what_is_long_in_a_patient(tmp_path, old, new):
    refusal("patient", changed("patient", old, new), tmp_path)


def test_a_number_beside_diameters_that_is_none(tmp_path):
    text = CASE.replace("[load]", "wall_ratio = nan\n[load]")
    has(refusal("case", text, tmp_path), "'ureter.wall_ratio' cannot be used with both diameters")


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("0.2 MPa", "0.2 kg", ("C is 0.2 kg", "a pressure")),
        ("0.7091", "-1.0", ("a1111 is -1.0", "a number above 0")),
        ("source", "sauce", ("key is sauce", "did you mean 'source'")),
    ],
)
def test_a_law_beside_a_case_is_named_with_it(tmp_path, old, new, parts):
    beside(tmp_path)
    law = tmp_path / "soft.toml"
    law.write_text(law.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    with pytest.raises(BadInput) as refused:
        read_case(tmp_path / "case.toml")
    check_sentence("case", refused.value, "case.toml")
    has(str(refused.value), "soft.toml", *parts)


# JSON


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", ("valid JSON",)),
        ("{", ("valid JSON",)),
        ("[1]", ("'friction_coefficient' is missing",)),
        ("0.5", ("'friction_coefficient' is missing",)),
        ('{"friction": 0.5}', ("'friction_coefficient' is missing",)),
        ('{"friction_coefficient": "0.5"}', ("'friction_coefficient' is 0.5", "a number")),
        ('{"friction_coefficient": true}', ("'friction_coefficient' is True", "a number")),
        ('{"friction_coefficient": null}', ("'friction_coefficient' is None", "a number")),
        ('{"friction_coefficient": NaN}', ("'friction_coefficient' is nan", "a number")),
        ('{"friction_coefficient": -Infinity}', ("'friction_coefficient' is -inf", "a number")),
        ('{"friction_coefficient": 1e400}', ("'friction_coefficient' is inf", "a number")),
        ('{"friction_coefficient": [0.5]}', ("'friction_coefficient' is [0.5]", "a number")),
        ('{"friction_coefficient": 1' + "0" * 400 + "}", ("a number",)),
        ('{"friction_coefficient": 1' + "0" * 5000 + "}", ("valid JSON",)),
        ('{"friction_coefficient": ' + "[" * 900 + "]" * 900 + "}", ("a number",)),
        ('{"friction_coefficient": ' + "[" * 100_000, ("valid JSON",)),
        ('{"friction_coefficient": ' + '{"a":' * 900 + "1" + "}" * 901, ("a number",)),
    ],
    ids=lambda text: text[:36] if isinstance(text, str) else "",
)
def test_a_friction_file_that_is_wrong(tmp_path, text, parts):
    has(refusal("friction", text, tmp_path), "friction.json", *parts)


# Files that are none, or cannot be read


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_file_that_is_none(tmp_path, kind):
    file = KINDS[kind].file
    for path in (tmp_path / file, tmp_path / "x" / file, tmp_path / file / file):
        with pytest.raises(BadInput) as refused:
            KINDS[kind].read(path)
        check_sentence(kind, refused.value, file)
        has(str(refused.value), "a file that exists")
    (tmp_path / file).mkdir()
    with pytest.raises(BadInput) as refused:
        KINDS[kind].read(tmp_path / file)
    check_sentence(kind, refused.value, file)


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_file_in_a_folder_of_a_long_name(tmp_path, kind):
    for folder in ("f" * 90, "/".join(["folder"] * 20)):
        (tmp_path / folder).mkdir(parents=True)
        refusal(kind, b"\xff\xfe\0", tmp_path / folder)


@pytest.mark.parametrize("kind", list(KINDS))
def test_a_name_that_is_too_long(tmp_path, kind):
    with pytest.raises(BadInput, match="a file that exists"):
        KINDS[kind].read(tmp_path / ("x" * 300 + KINDS[kind].file))


@pytest.mark.skipif(not Path("/proc/self/mem").is_file(), reason="no file that cannot be read")
@pytest.mark.parametrize("kind", list(KINDS))
def test_a_file_that_cannot_be_read(tmp_path, kind):
    path = tmp_path / KINDS[kind].file
    path.symlink_to("/proc/self/mem")  # its first byte cannot be read, by nobody
    with pytest.raises(BadInput) as refused:
        KINDS[kind].read(path)
    check_sentence(kind, refused.value, KINDS[kind].file)


# Many rows


@pytest.mark.parametrize("kind", list(KINDS))
def test_ten_million_rows_are_refused_unread(tmp_path, monkeypatch, kind):
    path = tmp_path / KINDS[kind].file
    path.write_text(KINDS[kind].text, encoding="utf-8")
    os.truncate(path, TEN_MILLION)
    for name in ("open", "read_text", "read_bytes"):
        monkeypatch.setattr(Path, name, lambda *_, **__: pytest.fail("read"))
    with pytest.raises(BadInput) as refused:
        KINDS[kind].read(path)
    check_sentence(kind, refused.value, path.name)
    has(str(refused.value), "smaller than")


@pytest.mark.parametrize("row", ["1,2", "", "#"])
def test_one_row_too_many(tmp_path, row):
    sentence = refusal("pairs", "alpha_deg,radius_ratio\n" + f"{row}\n" * MOST_ROWS, tmp_path)
    has(sentence, "opened.csv", f"more than {MOST_ROWS}", "fewer")


def test_the_last_row_that_may_be(tmp_path):
    text = "alpha_deg,radius_ratio\n" + "#\n" * (MOST_ROWS - 2)
    assert outcome("pairs", f"{text}40,1".encode(), tmp_path) == "read"
    has(refusal("pairs", f"{text}40,x", tmp_path), f"row {MOST_ROWS}, column 'radius_ratio' is x")


def test_a_meridian_of_many_points_takes_no_minutes(tmp_path):
    t = np.linspace(0.0, np.pi, 20_000)
    rho = np.sin(t) + 0.01 * np.random.default_rng(SEED).random(len(t))
    rho[[0, -1]] = 0.0
    rows = (f"{a:.9g},{b:.9g}" for a, b in zip(-np.cos(t), rho, strict=True))
    with limited(SECONDS):
        try:
            read_shape(written(tmp_path / "many.csv", "z,rho\n" + "\n".join(rows)))
        except BadInput as refused:
            check_sentence("shape", refused, "many.csv")


def written(path, text):
    path.write_text(text, encoding="utf-8")
    return path


# The command

SIZES = ["--xi", "1.2", "--eta", "1.3"]
TUBE = ["--inner", "3.5mm", "--outer", "4.55mm"]
COMMANDS = {
    "fit tensile": ("tension", ["fit", "tensile", "FILE", "--law", "fung"]),
    "fit forces": ("forces", ["fit", "tensile", "FILE", "--law", "fung", "--width", "4mm", "--thickness", "1mm"]),
    "fit inflation": ("inflation", ["fit", "inflation", "FILE", "--law", "fung", *TUBE]),
    "invitro": ("points", ["invitro", "FILE", "--material", "latex", "--no-cache"]),
    "assess": ("patient", ["assess", "FILE", "--no-cache"]),
    "pressure": ("case", ["pressure", "FILE"]),
    "pressure --material": ("law", ["pressure", *SIZES, "--material", "FILE"]),
    "pressure --friction-from": ("friction", ["pressure", *SIZES, "--friction-from", "FILE"]),
    "pressure --shape": ("shape", ["pressure", *SIZES, "--shape", "FILE"]),
    "pressure --opening-curve": ("pairs", ["pressure", *SIZES, "--closure", "series", "--opening-curve", "FILE"]),
    "curve --shape": ("shape", ["curve", "--xi", "1:1.2:0.1", "--eta", "1.3", "--shape", "FILE"]),
    "size": ("case", ["size", "FILE", "--limit", "12kPa"]),
    "size --material": ("yeoh law", ["size", "--eta", "1.3", "--limit", "12kPa", "--material", "FILE"]),
}  # fmt: skip
FAULTS = {
    "csv": [
        (lambda text: text.rstrip("\n").rpartition(",")[0] + ",x", ("row ", "column '", " is x")),
        (lambda text: text.rstrip("\n").rpartition(",")[0] + ",nan\n", ("row ", "column '", " is nan")),
        (lambda text: text + text.splitlines()[-1] + ",1\n", ("row ", "as in the header")),
        (lambda text: "", ("a table with the columns",)),
        (lambda text: text.encode("utf-32"), ("a CSV file of text",)),
        (lambda text: TEN_MILLION, ("smaller than",)),
        (lambda text: None, ("a file that exists",)),
    ],
    "toml": [
        (lambda text: text.replace(" = ", "x = ", 1), ("key", "did you mean '")),
        (lambda text: text.replace('"', "", 1), ("valid TOML", "line ")),
        (lambda text: "", ("is missing",)),
        (lambda text: text.encode("utf-16"), ("valid TOML",)),
        (lambda text: TEN_MILLION, ("smaller than",)),
        (lambda text: None, ("a file that exists",)),
    ],
    "json": [
        (lambda text: text.replace("0.5239", "NaN"), ("'friction_coefficient' is nan", "a number")),
        (lambda text: text.replace("0.5239", "5"), ("friction", "5", "a number from 0 to 2")),
        (lambda text: text[:9], ("valid JSON",)),
        (lambda text: text.encode("latin-1") + b"\xe9", ("valid JSON",)),
        (lambda text: TEN_MILLION, ("smaller than",)),
        (lambda text: None, ("a file that exists",)),
    ],
}  # fmt: skip


def sentence_of_command(capsys, arguments):
    """Run a command that is refused; what it says."""
    code = run([str(each) for each in arguments])
    out, err = capsys.readouterr()
    assert (code, out) == (2, "")
    assert err.startswith("stonepass: ")
    assert err.endswith(".\n")
    assert err[:-1].isprintable()
    return err


@pytest.mark.parametrize("name", list(COMMANDS))
def test_the_command_refuses_with_exit_code_2(tmp_path, capsys, name):
    kind, arguments = COMMANDS[name]
    beside(tmp_path)
    path = tmp_path / KINDS[kind].file
    for fault, parts in FAULTS[path.suffix[1:]]:
        data = fault(KINDS[kind].text)
        if data is None:
            path.unlink()
        elif data == TEN_MILLION:
            os.truncate(path, TEN_MILLION)
        else:
            path.write_bytes(data if isinstance(data, bytes) else data.encode())
        given = [path if each == "FILE" else each for each in arguments]
        has(sentence_of_command(capsys, given), path.name, *parts)


def test_a_law_of_several_lines_that_is_not_stable_is_told_in_one(tmp_path, capsys):
    law = changed("law", "0.1856", "0.95") + 'name = "a\\nb\\u001b[31m"\n'
    path = written(tmp_path / "law.toml", law)
    has(sentence_of_command(capsys, ["pressure", *SIZES, "--material", path]), "is not stable")


def test_a_page_is_not_written_where_the_file_is_refused(tmp_path, capsys):
    path = written(tmp_path / "patient.toml", PATIENT.replace("5 mm ± 1 mm", "5 mm ± x"))
    page = tmp_path / "page.html"
    has(sentence_of_command(capsys, ["assess", path, "--html", page]), "patient.toml")
    assert not page.exists()


# Damage, seeded


@pytest.mark.parametrize("kind", list(KINDS))
def test_the_files_that_are_damaged_are_good(tmp_path, kind):
    assert outcome(kind, KINDS[kind].text.encode(), tmp_path) == "read"


@pytest.mark.parametrize("kind", list(KINDS))
@pytest.mark.parametrize(
    "counts", [FEW, pytest.param(COUNT, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_whatever_is_damaged_is_read_or_refused(kind, counts):
    random, count = Random(f"{kind} {SEED}"), counts[kind]
    with TemporaryDirectory() as folder:
        found = Counter(outcome(kind, damaged(kind, random), Path(folder)) for _ in range(count))
    assert found["read"] + found["refused"] == count
    assert found["read"] >= 0.05 * count
    assert found["refused"] >= 0.5 * count


def test_damage_is_seeded_and_leaves_no_file_whole():
    for kind in KINDS:
        first, again = ([damaged(kind, Random(k)) for k in range(20)] for _ in range(2))
        assert first == again
        assert len(set(first)) > 15
        assert KINDS[kind].text.encode() not in first


class Loud(BadInput):
    def __str__(self):
        return self.argument


def raising(problem):
    def read(path):
        raise problem

    return read


@pytest.mark.parametrize(
    ("read", "words"),
    [
        (raising(KeyError("a")), "KeyError"),
        (raising(OSError(36, "a")), "OSError"),
        (raising(ValueError("a")), "ValueError"),
        (raising(RecursionError("a")), "RecursionError"),
        (raising(MemoryError()), "MemoryError"),
        (raising(BadInput("in other.csv, row 3", "x", "a number")), "does not name broken.csv"),
        (raising(Loud("broken.csv must be better" + "!" * 700 + ".", 1, "")), "characters"),
        (raising(Loud("broken.csv must be\nbetter.", 1, "")), "several lines"),
        (raising(Loud("broken.csv must be \x1b better.", 1, "")), "control characters"),
        (raising(Loud("broken.csv must be better", 1, "")), "does not end"),
        (raising(Loud("broken.csv is bad.", 1, "")), "what was expected"),
        (raising(Loud(None, 1, "")), "no sentence"),
        (lambda path: math.nan, "read nan"),
        (lambda path: {"a": (1.0, [-math.inf])}, "read -inf"),
        (lambda path: np.array([1.0, np.nan]), "nan"),
        (lambda path: 10**30, "read inf"),
        (lambda path: "words", "without a number"),
    ],
)  # fmt: skip
def test_what_is_no_contract_is_found(tmp_path, monkeypatch, read, words):
    """Guard: the outcome of a reader that breaks the contract in each way."""
    monkeypatch.setitem(KINDS, "broken", Kind("", "broken.csv", read))
    with pytest.raises(AssertionError, match=words):
        outcome("broken", b"", tmp_path)


def burn(seconds):
    begun = time.process_time()
    while time.process_time() - begun < seconds:
        pass


def test_what_takes_too_long_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr("damaged_tables.LONGEST_TIME", 0.05)
    monkeypatch.setitem(KINDS, "slow", Kind("", "slow.csv", lambda path: burn(1.0)))
    with pytest.raises(AssertionError, match="TimeoutError"):
        outcome("slow", b"", tmp_path)

    def swallowing(path):
        try:
            burn(1.0)
        except TimeoutError:
            return 1.0

    monkeypatch.setitem(KINDS, "slow", Kind("", "slow.csv", swallowing))
    with pytest.raises(AssertionError, match="TimeoutError"):
        outcome("slow", b"", tmp_path)
