"""Tables from outside: what is read, and the one sentence for what is not."""

import numpy as np
import pytest

import stonepass
from stonepass.errors import BadInput
from stonepass.io.csv_file import LARGEST_FILE, read_columns


def read(tmp_path, text, required=("a", "b"), optional=("c",)):
    path = tmp_path / "data.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_columns(path, required, optional)


@pytest.mark.parametrize(
    "text",
    [
        "a,b\n1,2\n3,4\n",
        "b,a\n2,1\n4,3",
        "\ufeffa, b\r\n1, 2\r\n\r\n# 9,9\r\n3,4\r\n",
        "# made by hand\na,b,c\n1,2,7\n3,4,8\n",
        '"a","b"\n"1","2"\n3e0,4.0\n',
    ],
)
def test_columns_come_by_name(tmp_path, text):
    found = read(tmp_path, text)
    np.testing.assert_array_equal(found["a"], [1.0, 3.0])
    np.testing.assert_array_equal(found["b"], [2.0, 4.0])
    assert ("c" in found) == ("c" in text)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "but must be a table with the columns a, b"),
        ("\n\n", "but must be a table with the columns a, b"),
        ("a,b\n", "at least one row under its header"),
        ("a\n1\n", "in data.csv, column 'b' is missing, but must be given"),
        (
            "a,b,cc\n1,2,3\n",
            "in data.csv, column is cc, but must be one of a, b, c; did you mean 'c'",
        ),
        ("a,b,a\n1,2,3\n", "in data.csv, column is a, but must be given once"),
        ("a,b\n1,2\n3\n", "in data.csv, row 3 is 1 cells, but must be 2, as in the header"),
        ("a,b\n1,2\n3,x\n", "in data.csv, row 3, column 'b' is x, but must be a number"),
        ("a,b\n1,2\n\n\n3,nan\n", "in data.csv, row 5, column 'b' is nan, but must be a number"),
        ("a,b\n1,\n", "in data.csv, row 2, column 'b' is empty, but must be a number"),
        ("a,b\n1,1e999\n", "in data.csv, row 2, column 'b' is 1e999, but must be a number"),
        ("a,b\n1,2,5\n", "in data.csv, row 2 is 3 cells"),
        (b"\xff\xfe\x00\x00a", "but must be a CSV file of text"),
        (b"a,b\n1,\x002\n", "in data.csv, row 2, column 'b'"),
        ('a,b\n"1,2\n', "but must be a row of a CSV file"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(tmp_path, text, sentence):
    with pytest.raises(BadInput) as refused:
        read(tmp_path, text)
    assert sentence in str(refused.value)


def test_a_file_that_is_missing_or_too_large(tmp_path):
    with pytest.raises(BadInput, match="a file that exists"):
        read_columns(tmp_path / "none.csv", ("a",))
    with pytest.raises(BadInput, match="a file that exists"):
        read_columns(tmp_path, ("a",))
    with pytest.raises(BadInput, match="smaller than 10 MB"):
        read(tmp_path, b"a,b\n" + b"1,2\n" * (LARGEST_FILE // 4))


@pytest.mark.parametrize(
    "name",
    [
        "read_shape",
        "read_points",
        "read_tension",
        "read_patient",
        "read_surface_image",
        "read_in_sandbox",
    ],
)
def test_the_front_door_takes_a_path_as_text(name):
    with pytest.raises(BadInput, match=r"/nowhere\.csv"):
        getattr(stonepass, name)("/nowhere.csv")


@pytest.mark.parametrize(
    "text",
    [
        "a,b\n1,2.5\n1,2.5\n",
        "a;b\n1;2.5\n1;2.5\n",
        "a;b\n1;2,5\n1;2,5\n",
        "sep=;\na;b\n1;2,5\n1;2,5\n",
        "a\tb\n1\t2.5\n1\t2.5\n",
        "# made by hand, with a comma\na;b\n1;2,5\n1;2,5\n",
        "a,b,,\n1,2.5,,\n1,2.5,,\n",
        ",a,,b\n,1,,2.5\n,1,,2.5\n",  # empty columns anywhere
        'a,b\n"1,0000","2,5000"\n"1,0000","2,5000"\n',  # in quotes, a comma is a decimal comma
        "# a,b\n1,2.5\n1,2.5\n",  # as NumPy writes the names
        "a,b\n\u00a01,2.5\n1,2.5\u00a0\n",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_a_table_of_a_spreadsheet_or_a_machine(tmp_path, text, encoding):
    """A measurement may be there twice; commas, semicolons or tabs; decimal commas."""
    path = tmp_path / "machine.csv"
    path.write_bytes(text.encode(encoding))
    columns = read_columns(path, ("a", "b"))
    np.testing.assert_array_equal(columns["a"], [1.0, 1.0])
    np.testing.assert_array_equal(columns["b"], [2.5, 2.5])


def test_three_decimals_are_decimals_where_a_number_begins_with_zero(tmp_path):
    found = read(tmp_path, "a;b\n1,250;0,500\n2,500;1,125\n")
    np.testing.assert_array_equal(found["a"], [1.25, 2.5])
    np.testing.assert_array_equal(found["b"], [0.5, 1.125])


def test_minus_signs_and_dashes_of_typesetters_are_read(tmp_path):
    found = read(tmp_path, "# a \u2013 b\na,b\n\u22121,2\n".encode())
    assert (found["a"][0], found["b"][0]) == (-1.0, 2.0)
    cp1252 = "# Pr\u00fcfung \u2013 Labor\na,b\n1,2\n".encode("cp1252")
    assert read(tmp_path, cp1252)["b"].tolist() == [2.0]


@pytest.mark.parametrize(
    ("content", "remedy"),
    [
        (b"PK\x03\x04\x14\x00\x81\xff", "export the table as CSV"),
        ("a,b\n1,2\n".encode("utf-16-le"), "save it with the encoding UTF-8"),
        (b"\x81\x8d\x00\x01", "save it with the encoding UTF-8"),
    ],
)
def test_a_file_that_is_no_text_is_named_with_the_remedy(tmp_path, content, remedy):
    with pytest.raises(BadInput, match=remedy):
        read(tmp_path, content)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a b\n1 2\n", "the separator of the cells is ' '"),
        ("a|b\n1|2\n", "the separator of the cells is '|'"),
        ("a,b\n1,5,2,5\n", "separate the cells by semicolons"),
        ("a,,b\n1,7,2\n", "the name of column 2 is empty"),
    ],
)
def test_other_separators_and_columns_without_names_are_named(tmp_path, text, sentence):
    with pytest.raises(BadInput) as refused:
        read(tmp_path, text)
    assert sentence in str(refused.value)


@pytest.mark.parametrize(
    ("name", "remedy"),
    [
        ("strain", "convert the values to 'stretch': a stretch is 1 + the strain"),
        ("strain_percent", "convert the values to 'stretch'"),
        ("inner_radius_mm", "convert the values to 'inner_diameter_mm': a diameter is twice"),
    ],
)
def test_another_measure_is_not_a_matter_of_the_name(tmp_path, name, remedy):
    path = tmp_path / "machine.csv"
    path.write_text(f"{name},stress_kPa\n1,2\n")
    with pytest.raises(BadInput) as refused:
        read_columns(path, ("stress_kPa",), ("stretch", "inner_diameter_mm"))
    assert remedy in str(refused.value)
    assert "did you mean" not in str(refused.value)


@pytest.mark.parametrize(
    "text",
    [
        "-,Pa\nstretch,stress_kPa\n1,0\n1.5,2.5\n",
        "stretch,stress_kPa\n-,Pa\n1,0\n1.5,2.5\n",
        "stretch,stress_kPa\n[1],[N/mm²]\n1,0\n1.5,2.5\n",
    ],
)
def test_units_above_and_below_the_names_must_agree_with_them(tmp_path, text):
    path = tmp_path / "machine.csv"
    path.write_text(text)
    with pytest.raises(BadInput, match="convert the values to kPa, and change this row"):
        read_columns(path, ("stretch", "stress_kPa"))


@pytest.mark.parametrize(
    "text",
    [
        "a\tb\n1,234\t2\n",  # thousands or decimals?
        "a;b\n1,5;2.5\n",
        "a;b\n1,234;2\n",
        "a\tb\n1,234\t2,500\n",
    ],
)
def test_a_comma_of_two_meanings_is_refused(tmp_path, text):
    path = tmp_path / "machine.csv"
    path.write_text(text)
    with pytest.raises(BadInput, match=r"in machine\.csv, row 2.* is 1,\d+, but must be a number"):
        read_columns(path, ("a", "b"))


@pytest.mark.parametrize(
    "text",
    [
        "Machine;5944\nOperator;N. N.\n\nstretch;stress_kPa\n1,0;0,0\n1,5;2,5\n",
        "Tensile test, 3 mm/min\nstretch,stress_kPa\n-,kPa\n1,0\n1.5,2.5\n",
        'Date: 2021-05-04\n"stretch"\t"stress_kPa"\n(mm/mm)\t(kPa)\n1\t0\n1.5\t2.5\n',
        "stretch,stress_kPa\n[-],[kPa]\n1,0\n1.5,2.5\n",
        "sep=;\nreport\nstress_kPa;stretch\nkPa;\n0;1\n2.5;1.5\n",
        "stretch;stress_kPa\nspeed;fast\n\nstretch;stress_kPa\n;kPa\n1,0;0\n1,5;2,5\n",
        "columns\nstretch,stress_kPa\nbelow\nstretch,stress_kPa\n1,0\n1.5,2.5\n",
    ],
)
def test_lines_before_the_table_and_a_row_of_units(tmp_path, text):
    path = tmp_path / "machine.csv"
    path.write_text(text, encoding="utf-8")
    columns = read_columns(path, ("stretch", "stress_kPa"))
    np.testing.assert_array_equal(columns["stretch"], [1.0, 1.5])
    np.testing.assert_array_equal(columns["stress_kPa"], [0.0, 2.5])
    assert path.read_text().splitlines()[columns.lines[1] - 1].startswith(("1", "2"))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            "stretch,stress_kPa\n-,MPa\n1,0\n",
            "row 2, the unit of column 'stress_kPa' is MPa, but must be kPa; convert the values",
        ),
        ("stretch,stress_kPa\n%,kPa\n1,0\n", "column 'stretch' is %, but must be empty, since the"),
        ("report\nLoad_N;Extension_mm\nN;mm\n1;2\n", "column is Load_N, but must be one of"),
        ("a report\nwithout a table\n", "column is a report, but must be one of"),
        ("stretch,stress_kPa\n-,-\n1,0\n", "row 2, column 'stretch' is -, but must be a number"),
    ],
)
def test_units_and_names_that_do_not_fit_are_named(tmp_path, text, sentence):
    path = tmp_path / "machine.csv"
    path.write_text(text)
    with pytest.raises(BadInput) as refused:
        read_columns(path, ("stretch", "stress_kPa"))
    assert sentence in str(refused.value)


def test_columns_without_a_name_that_have_cells_are_refused(tmp_path):
    path = tmp_path / "machine.csv"
    path.write_text("a,b,\n1,2,3\n")
    with pytest.raises(BadInput, match="the name of column 3 is empty, but must be given"):
        read_columns(path, ("a", "b"))
