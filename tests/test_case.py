"""What a case refuses, and with which words."""

from dataclasses import replace

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.model.models.registry import model_named

NAN = float("nan")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: sp.Stone(), "size of the stone is missing"),
        (lambda: sp.Stone(diameter="4 mm", size_ratio=1.2), "given twice"),
        (lambda: sp.Stone(diameter=4.2), "stone diameter is 4.2"),
        (lambda: sp.Stone(diameter="-4 mm"), "0.01 mm to 1000 mm"),
        (lambda: sp.Stone(diameter="0 mm"), "0.01 mm to 1000 mm"),
        (lambda: sp.Stone(diameter="4 kPa"), "must be a length"),
        (lambda: sp.Stone(size_ratio=40.0), "size_ratio is 40.0, but must be a number from 0.1 to 3"),
        (lambda: sp.Stone(size_ratio=NAN), "size_ratio is nan"),
        (lambda: sp.Stone(size_ratio="1.2"), "size_ratio is 1.2"),
        (lambda: sp.Stone(size_ratio=1.2, friction=-0.1), "friction is -0.1"),
        (lambda: sp.Stone(size_ratio=1.2, friction=NAN), "friction is nan"),
        (lambda: sp.Stone(size_ratio=1.2, friction=True), "friction is True"),
        (lambda: sp.Ureter(), "size of the ureter is missing"),
        (lambda: sp.Ureter(inner_diameter="3 mm"), "outer diameter is missing"),
        (lambda: sp.Ureter(outer_diameter="3 mm"), "inner diameter is missing"),
        (lambda: sp.Ureter("3 mm", "3 mm"), "larger than the inner diameter, 3 mm"),
        (lambda: sp.Ureter("3 mm", "2 mm"), "larger than the inner diameter, 3 mm"),
        (lambda: sp.Ureter("3 mm", "4 mm", wall_ratio=2.0), "cannot be used with both diameters; they give"),
        (lambda: sp.Ureter(wall_ratio=1e9), "wall_ratio is 1000000000.0, but must be a number from"),
        (lambda: sp.Ureter(wall_ratio=1.0), "wall_ratio is 1.0"),
        (lambda: sp.Ureter(wall_ratio=1.3, material="latx"), "did you mean 'latex'"),
        (lambda: sp.Ureter(wall_ratio=1.3, material=7), "a name of the catalogue or a Material"),
        (lambda: sp.Load(4.0), "a pressure with its unit"),
        (lambda: sp.Load("-1 kPa"), "0 kPa to 100 kPa"),
        (lambda: sp.Load("1 kPa", "alive"), "one of dead, hydrostatic"),
        (lambda: sp.Load(prestretch=0.0), "prestretch is 0.0"),
        (lambda: model_named("direkt"), "one of paper"),
        (lambda: asking(half_length=1.0), "half_length is 1.0"),
        (lambda: asking(as_printed="yes"), "true or false"),
        (lambda: sp.Case(sp.Stone("4 mm"), sp.Ureter(wall_ratio=1.3)), "inner diameter is missing"),
        (
            lambda: sp.Case(sp.Stone("40 mm"), sp.Ureter("1 mm", "2 mm")),
            r"size ratio \(stone diameter over inner diameter\) is 40.0",
        ),
        (
            lambda: sp.Case(
                sp.Stone(size_ratio=2.0), sp.Ureter(wall_ratio=1.3), **asking(half_length=3.0)
            ),
            "at least twice the stone's largest extent from its widest place, 4",
        ),
    ],
)  # fmt: skip
def test_bad_values_are_refused_in_one_sentence(make, words):
    with pytest.raises(sp.BadInput, match=words) as refusal:
        make()
    sentence = str(refusal.value)
    assert sentence.endswith(".")
    assert "\n" not in sentence


def test_ratios_of_diameters():
    case = sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", "4.55 mm"))
    assert case.size_ratio == pytest.approx(1.2, rel=1e-15)
    assert case.wall_ratio == pytest.approx(1.3, rel=1e-15)


def test_values_are_values():
    stone = sp.Stone("4.2 mm")
    assert replace(stone, friction=0.1) == sp.Stone("4.2 mm", friction=0.1)
    ureter = sp.Ureter("3.5 mm", "4.55 mm")
    assert replace(ureter, material="latex") == sp.Ureter("3.5 mm", "4.55 mm", "latex")
    with pytest.raises(sp.Misplaced, match=r"the diameters give 0\.75 mm"):
        replace(ureter, outer_diameter="5 mm")
    derived = {"wall_ratio": None, "wall_thickness": None}
    assert replace(ureter, outer_diameter="5 mm", **derived) == sp.Ureter("3.5 mm", "5 mm")
    thick = replace(ureter, outer_diameter=None, wall_ratio=None, wall_thickness="0.75 mm")
    assert thick == sp.Ureter("3.5 mm", "5 mm")
    with pytest.raises(AttributeError):
        stone.friction = 0.2


def test_numpy_numbers_are_numbers():
    assert sp.Stone(size_ratio=np.float64(1.2), friction=np.int64(1)).friction == 1.0


def test_exceptions_survive_a_process_boundary():
    import pickle

    with pytest.raises(sp.BadInput) as refusal:
        sp.Stone(size_ratio=40.0)
    again = pickle.loads(pickle.dumps(refusal.value))
    assert str(again) == str(refusal.value)


@pytest.mark.parametrize(("inner", "outer"), [("1.1 mm", "1.122 mm"), ("0.3 mm", "3 mm")])
def test_a_wall_at_the_bound_is_not_refused_for_the_rounding_of_its_quotient(inner, outer):
    assert sp.Ureter(inner, outer).wall_ratio in (
        pytest.approx(1.02, rel=1e-12),
        pytest.approx(10.0, rel=1e-12),
    )
