"""The first sign change of many functions at once: a coarse scan, then Ridders' method."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from stonepass.array_types import Bool, Float

__all__ = ["ALL", "STEPS", "Excess", "Rows", "first_crossing", "refined_guess"]

SCAN = 9  # number of points of the scan
REFINEMENTS = 3  # number of steps of Ridders' method, each with two evaluations

Rows = Any  # an array of row numbers, or the slice of all rows
Excess = Callable[[Float[np.ndarray, " m"], Rows], Float[np.ndarray, " m"]]
ALL = slice(None)
STEPS = (0.02, 0.002)  # distances of the second point of the secant method from the guess
# Largest last step of a secant method that has converged, as a fraction of the distance from x = 1:
# there a pressure that grows with this distance vanishes.
CLOSE = 1e-3


def first_crossing(
    excess: Excess, count: int
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """Find where n functions of x first become zero or negative on the way from x = 1 to x = 0.

    Parameters
    ----------
    excess : callable
        ``excess(x, rows)`` returns the values at x, an array (m), of the functions with the numbers
        `rows`, an array (m).
    count : int
        Number n of functions.

    Returns
    -------
    x : array (n)
        The place; 1 for a function that is not positive at x = 1.
    found : array (n) of bool
        False for a function that is positive at all points of the scan; its x is 0.

    References
    ----------
    Ridders 1979, IEEE Transactions on Circuits and Systems 26, 979–980.
    """
    x, found = np.zeros(count), np.zeros(count, dtype=bool)
    rows = np.arange(count)
    before = excess(np.ones(count), rows)
    x[before <= 0.0] = 1.0
    found[before <= 0.0] = True
    rows, before = rows[before > 0.0], before[before > 0.0]
    ends = np.linspace(1.0, 0.0, SCAN)
    for above, below in pairwise(ends.tolist()):
        after = excess(np.full(len(rows), below), rows)
        crossed = after <= 0.0
        there = rows[crossed]
        x[there] = _refined(excess, there, above, below, before[crossed], after[crossed])
        found[there] = True
        rows, before = rows[~crossed], after[~crossed]
    return x, found


def refined_guess(
    excess: Excess, guess: Float[np.ndarray, " n"], step: float = STEPS[0]
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """Improve guesses of zeros by three evaluations of the secant method.

    Parameters
    ----------
    excess : callable
        As for `first_crossing`; it is called for all functions.
    guess : array (n)
        Guesses between 0 and 1.
    step : float
        Distance of the second point from the guess.

    Returns
    -------
    x : array (n)
        Improved places between 0 and 1.
    sure : array (n) of bool
        True if the method has converged inside the interval.
    """
    before = excess(guess, ALL)
    down = (guess > step) & ((before > 0.0) | (guess > 1.0 - step))
    x = guess - np.where(down, step, -step)
    value = excess(x, ALL)
    second = _secant(guess, before, x, value)
    inside = (second > 0.0) & (second < 1.0)
    second = np.clip(second, 0.0, 1.0)
    last = _secant(x, value, second, excess(second, ALL))
    sure = inside & (last > 0.0) & (np.abs(last - second) < CLOSE * (1.0 - last))
    return np.clip(last, 0.0, 1.0), sure


def _secant(
    one: Float[np.ndarray, " n"],
    at_one: Float[np.ndarray, " n"],
    other: Float[np.ndarray, " n"],
    at_other: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " n"]:
    """Return the zeros of the straight lines through two points each."""
    change = at_other - at_one
    step = np.divide(other - one, change, out=np.zeros_like(change), where=change != 0.0)
    return other - at_other * step


def _refined(
    excess: Excess,
    rows: np.ndarray,
    above: float,
    below: float,
    positive: Float[np.ndarray, " m"],
    negative: Float[np.ndarray, " m"],
) -> Float[np.ndarray, " m"]:
    """Return the zeros between `above`, where the functions are positive, and `below`."""
    high, low = np.full(len(rows), above), np.full(len(rows), below)
    best = low
    for _ in range(REFINEMENTS):
        middle = (high + low) / 2.0
        at_middle = excess(middle, rows)
        root = np.sqrt(at_middle**2 - positive * negative)
        shift = np.divide(at_middle, root, out=np.zeros_like(root), where=root > 0.0)
        best = middle + (low - middle) * shift
        value = excess(best, rows)
        # The new bracket consists of the two nearest points with values of opposite sign.
        for point, number in ((middle, at_middle), (best, value)):
            is_high = (number > 0.0) & (point <= high) & (point >= low)
            is_low = (number <= 0.0) & (point <= high) & (point >= low)
            high, positive = np.where(is_high, point, high), np.where(is_high, number, positive)
            low, negative = np.where(is_low, point, low), np.where(is_low, number, negative)
    return best
