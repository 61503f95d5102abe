"""Values with arrays: equal where all their numbers are, and never hashed."""

import dataclasses
import importlib
import pkgutil

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.array_dataclass import array_dataclass, equal

pytestmark = pytest.mark.usefixtures("shared_solutions")
FAST = asking(accuracy="fast", seating="frictionless")


def dataclasses_with_arrays():
    for each in pkgutil.walk_packages(sp.__path__, "stonepass."):
        if each.name.endswith("__main__"):
            continue
        for kind in vars(importlib.import_module(each.name)).values():
            ours = isinstance(kind, type) and kind.__module__ == each.name
            if ours and dataclasses.is_dataclass(kind):
                types = [str(field.type) for field in dataclasses.fields(kind)]
                if any("ndarray" in text or "Values" in text for text in types):
                    yield kind


def test_every_value_with_arrays_says_how_it_is_compared():
    """The equality of a dataclass raises where two arrays are compared."""
    kinds = set(dataclasses_with_arrays())
    assert len(kinds) > 25
    wrong = [
        kind.__name__
        for kind in kinds
        if kind.__eq__ is not object.__eq__ and "array_dataclass" not in kind.__eq__.__qualname__
    ]
    assert wrong == []


def test_answers_are_equal_where_their_numbers_are():
    stone, ureter = sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex")
    one, two = (sp.critical_pressure(stone, ureter, **FAST) for _ in range(2))
    slower = dataclasses.replace(two.contact.solver, seconds=1e3)
    two = dataclasses.replace(two, contact=dataclasses.replace(two.contact, solver=slower))
    assert one == two
    other = sp.critical_pressure(sp.Stone(size_ratio=1.21), ureter, **FAST)
    assert one != other
    assert one != "an answer"
    pressure = two.contact.contact_pressure.copy()
    pressure[3] *= 1.0 + 1e-12
    moved = dataclasses.replace(two.contact, contact_pressure=pressure)
    assert one != dataclasses.replace(two, contact=moved)
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)


@array_dataclass
@dataclasses.dataclass(frozen=True)
class Sample:
    values: np.ndarray
    label: str = ""
    more: tuple = ()


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (Sample(np.array([1.0, np.nan])), Sample(np.array([1.0, np.nan])), True),
        (Sample(np.array([1.0])), Sample(np.array([1])), True),
        (Sample(np.array(["a"])), Sample(np.array(["a"])), True),
        (Sample(np.array([1.0])), Sample(np.array([1.0, 1.0])), False),
        (Sample(np.array([1.0]), "a"), Sample(np.array([1.0]), "b"), False),
        (Sample(np.array([1.0]), more=(np.ones(2),)), Sample(np.array([1.0]), more=(np.ones(2),)), True),
        ({"a": [np.ones(2), np.nan]}, {"a": [np.ones(2), np.nan]}, True),
        ({"a": 1}, {"b": 1}, False),
        ([1], (1,), False),
    ],
)  # fmt: skip
def test_what_is_equal(one, other, same):
    assert equal(one, other) is same
    assert (one == other) is same if isinstance(one, Sample) else True
