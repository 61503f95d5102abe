import math

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stonepass.errors import BadInput
from stonepass.units import (
    _FACTORS,
    Length,
    Pressure,
    format_length,
    format_pressure,
    length,
    pressure,
)


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


# A French is 1/3 mm; 1 Torr = 101325/760 Pa; 1 kgf/cm² = 9.80665 N over 1e-4 m².
@pytest.mark.parametrize(
    ("read", "text", "si"),
    [
        (length, "12 Fr", 4e-3),
        (length, "12 Ch", 4e-3),
        (length, "1 inch", 0.0254),
        (pressure, "2 kN/m²", 2e3),
        (pressure, "2 kN/m^2", 2e3),
        (pressure, "760 Torr", 101325.0),
        (pressure, "1 kgf/cm2", 98066.5),
        (pressure, "0.3 N/mm2", 3e5),
        (pressure, "1e4 dyn/cm2", 1e3),
    ],
)
def test_units_of_the_clinic_and_of_testing_machines(read, text, si):
    assert read(text) == pytest.approx(si, rel=1e-12)


def test_every_factor_is_that_of_pint():
    registry = pint.UnitRegistry()
    registry.define("French = millimeter / 3 = Fr = Ch")
    spelled = {"cmH2O": "centimeter_H2O", "mmHg": "millimeter_Hg", "Torr": "torr", "inch": "inch"}
    checked = 0
    for kind, si in ((Length, "meter"), (Pressure, "pascal")):
        for unit, factor in _FACTORS[kind].items():
            if unit.startswith("mmH"):
                continue  # pint has the centimetre of water alone
            name = spelled.get(unit.replace("₂", "2"), unit)
            name = name.replace("m2", "m**2") if "/" in name else name
            found = registry.Quantity(1.0, name).to(si).magnitude
            assert factor == pytest.approx(found, rel=1e-9), unit
            checked += 1
    assert checked >= 30


@pytest.mark.parametrize(
    ("read", "text", "sentence"),
    [
        (length, "12px", "must be a length in m, cm, mm, um, nm, in or Fr"),
        (length, "4 pt", "must be a length in"),
        (length, "4,2 mm", r"with a decimal point; write '4\.2 mm'\.$"),
        (length, "4,200um", r"write '4\.200um', or '4200um' if the comma separates thousands"),
        (pressure, "0,200 MPa", r"write '0\.200 MPa'\.$"),
        (length, "4 MM", "did you mean mm"),
        (length, "1 ly", "must be a length in"),
        (pressure, "12 kpa", "did you mean kPa"),
        (pressure, "90 mmhg", "did you mean mmHg"),
        (pressure, "4 eV/angstrom**3", "must be a pressure in"),
        (pressure, "3 mm", "must be a pressure in"),
    ],
)
def test_a_word_that_is_a_unit_somewhere_else_is_none_here(read, text, sentence):
    with pytest.raises(BadInput, match=sentence):
        read(text, "stone")


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


def test_quantities_of_pint_are_read():
    registry = pint.UnitRegistry()
    assert length(4.2 * registry.mm, "stone diameter") == 0.0042
    assert isinstance(length(4.2 * registry.mm, "stone diameter"), Length)
    assert pressure(90 * registry.mmHg) == pytest.approx(11999.014867, rel=1e-9)
    for wrong, words in [
        (3 * registry.kPa, "3 kilopascal, but must be one value that is a length"),
        ([1, 2] * registry.mm, "must be one value that is a length"),
        (float("nan") * registry.mm, "nan millimeter, but must be a finite length"),
        (4 * registry.dimensionless, "4 dimensionless"),
    ]:
        with pytest.raises(BadInput, match=words):
            length(wrong, "stone diameter")
