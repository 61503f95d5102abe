"""The guard of the guard: wrong shapes and types are really refused while tests run."""

import re
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from conftest import DOORS, NUMERICAL, numerical_modules
from first_call import EVERY
from jaxtyping import TypeCheckError

from stonepass.fe.core.grading import graded
from stonepass.fe.core.lobatto import joined
from stonepass.model.far_field import inflation_by_quadrature

ARRAY = re.compile(r"\b(Float|Int|Bool|Complex|Num|Shaped)\[")


@pytest.mark.parametrize(
    "call",
    [
        lambda: graded("3", 1.0, 7.0),
        lambda: inflation_by_quadrature(np.array(["1.1"]), 1.5, object()),
        lambda: joined(np.zeros(3)),
    ],
    ids=["type", "type of elements", "shape"],
)
def test_what_is_wrong_is_refused(call):
    """At the first call; at the latest after so many, where a function has been called often."""
    for _ in range(EVERY):
        try:
            call()
        except TypeCheckError:
            return
        except Exception:  # that of the function itself
            continue
    pytest.fail("no call was checked")


def test_every_numerical_module_but_the_doors_is_checked():
    specs = {name: find_spec(name) for name in numerical_modules()}
    hooked = {
        name for name, spec in specs.items() if type(spec.loader).__name__ == "_JaxtypingLoader"
    }
    assert set(specs) - hooked == set(DOORS)
    assert {name.split(".")[1] for name in hooked} == {*NUMERICAL, "web", "inputs", "io"}
    with_arrays = [m for m in hooked if ARRAY.search(Path(specs[m].origin).read_text("utf-8"))]
    # Raise these where modules are added; less means that the guard no longer sees them.
    assert len(hooked) >= 120
    assert len(with_arrays) >= 55
