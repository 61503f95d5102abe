"""Small numerical methods of our own, beside those of SciPy, which take long to import."""

import math

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from stonepass.fe.core.roots import bracketed_root
from stonepass.model.monotone import monotone_integral

FUNCTIONS = {
    "cubic": lambda x: x**3 - 2.0 * x - 5.0,
    "root": lambda x: math.copysign(math.sqrt(abs(x - 2.0946)), x - 2.0946),
    "steep": lambda x: math.tanh(50.0 * (x - 1.234)),
    "exponential": lambda x: math.exp(x) - 9.0,
    "oscillating": lambda x: math.sin(3.0 * x) + 0.1 * x - 0.2,
    "jump": lambda x: -1.0 if x < 1.75 else 2.0,
    "almost straight": lambda x: 1e-9 * (x - 1.5) + 1e-15 * x**2,
}


@pytest.mark.parametrize("function", FUNCTIONS.values(), ids=FUNCTIONS)
@pytest.mark.parametrize("xtol", [2e-12, 1e-14, 1e-6])
def test_a_bracketed_root_is_that_of_scipy_to_the_bit_in_as_many_steps(function, xtol):
    generator, compared = np.random.default_rng(5), 0
    for low, high in np.sort(generator.uniform(0.0, 4.0, (60, 2)), axis=1):
        for ends in ((low, high), (high, low)):
            if not function(ends[0]) * function(ends[1]) < 0.0:
                continue
            asked = []

            def counted(x, asked=asked):
                asked.append(x)
                return function(x)

            root = bracketed_root(counted, *ends, xtol=xtol)
            wanted, report = brentq(function, *ends, xtol=xtol, full_output=True)
            assert root == wanted
            assert len(asked) == report.function_calls
            compared += 1
    assert compared > 10


def test_a_root_at_an_end_and_what_has_none():
    assert bracketed_root(lambda x: x - 1.0, 1.0, 2.0) == 1.0
    assert bracketed_root(lambda x: x - 2.0, 1.0, 2.0) == 2.0
    with pytest.raises(ValueError, match="opposite signs"):
        bracketed_root(lambda x: x * x + 1.0, -1.0, 1.0)
    with pytest.raises(FloatingPointError, match="100 steps"):  # as SciPy's, which finds none
        bracketed_root(lambda x: (x - 2.0946) ** 9, 1.0, 3.0)
    for low, high in ((-1.0, math.nan), (-1.0, 1.0)):
        with pytest.raises(FloatingPointError):
            bracketed_root(lambda x: x if abs(x) == 1.0 else math.nan, low, high)


@pytest.mark.parametrize("seed", range(8))
def test_a_monotone_integral_is_that_of_scipy(seed):
    """Rising, falling, turning and flat points, with ends of every kind."""
    generator = np.random.default_rng(seed)
    x = np.cumsum(generator.uniform(0.1, 2.0, 30))
    y = generator.normal(size=30)
    if seed % 2:
        y = np.cumsum(np.abs(y))
    y[10:14] = y[10]
    wanted = PchipInterpolator(x, y).antiderivative()
    found = monotone_integral(x, y)
    at = np.concatenate([x, np.linspace(x[0], x[-1], 501)])
    scale = np.abs(wanted(at)).max()
    np.testing.assert_allclose(found(at), wanted(at), rtol=1e-13, atol=1e-14 * scale)
    assert float(found(float(x[7]))) == pytest.approx(float(wanted(x[7])), rel=1e-13)


def test_the_integral_of_a_straight_line_by_hand():
    found = monotone_integral(np.array([0.0, 1.0, 4.0]), np.array([2.0, 4.0, 10.0]))
    np.testing.assert_allclose(found(np.array([0.0, 1.0, 2.0, 4.0])), [0.0, 3.0, 8.0, 24.0])
