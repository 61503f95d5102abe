import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from stonepass.errors import BadInput
from stonepass.units import Length, Pressure, format_length, format_pressure, length, pressure


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("4.2mm", 4.2e-3),
        ("4.2 mm", 4.2e-3),
        ("0.42 cm", 4.2e-3),
        ("4200 um", 4.2e-3),
        ("1e-3m", 1e-3),
    ],
)
def test_lengths(text, metres):
    assert length(text) == metres


# 1 mmHg = 133.322387415 Pa (13.5951 g/cm³ × g × 1 mm), 1 cmH2O = 98.0665 Pa (1 g/cm³ × g × 1 cm).
@pytest.mark.parametrize(
    ("text", "pascals"),
    [("12kPa", 12e3), ("0.1465 MPa", 146.5e3), ("90 mmHg", 11999.01), ("122 cmH2O", 11964.113)],
)
def test_pressures(text, pascals):
    assert pressure(text) == pytest.approx(pascals, rel=1e-6)


@pytest.mark.parametrize(
    "value", [4.2, 4, "4.2", "", "mm", "nan mm", "inf mm", None, True, "1 2 mm"]
)
def test_a_number_without_its_unit_is_refused(value):
    with pytest.raises(BadInput, match="with its unit"):
        length(value, "stone")


@pytest.mark.parametrize("value", ["4 kPa", "4 kg", "4 foo", "4 /mm", "4 mm^2"])
def test_a_unit_of_the_wrong_kind_is_refused(value):
    with pytest.raises(BadInput, match=r"stone is .*must be a length"):
        length(value, "stone")


def test_an_overflowing_value_is_refused():
    with pytest.raises(BadInput, match="finite"):
        pressure("1e400 kPa")


def test_si_values_pass_again_but_not_as_the_other_kind():
    assert length(Length(0.1)) == 0.1
    with pytest.raises(BadInput):
        pressure(Length(0.1))


@given(st.floats(1e-6, 1e3))
def test_what_is_written_is_read_again(value):
    assert math.isclose(length(format_length(value)), value, rel_tol=1e-11)
    assert math.isclose(pressure(format_pressure(value)), value, rel_tol=1e-11)
    assert isinstance(pressure("1 kPa"), Pressure)
