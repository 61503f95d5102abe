"""The guard of the guard: wrong shapes and types are really refused while tests run."""

import numpy as np
import pytest
from jaxtyping import TypeCheckError

from stonepass.fe.core.grading import graded
from stonepass.model.far_field import inflation_by_quadrature


def test_a_wrong_type_is_refused():
    with pytest.raises(TypeCheckError):
        graded("3", 1.0, 7.0)


def test_a_wrong_element_type_is_refused():
    with pytest.raises(TypeCheckError):
        inflation_by_quadrature(np.array(["1.1"]), 1.5, object())
