"""Coefficients of the binomial series, for sums of powers of nearly equal eigenvalues."""

from __future__ import annotations

__all__ = ["NEAR", "TERMS", "binomials"]

# For two eigenvalues m (1 ± √u) the series in u replaces differences of powers if u < `NEAR`. At
# u = `NEAR` the eigenvalues differ by 0.2 %; the error of the series is 1e-20, while differences of
# powers lose three of sixteen digits.
NEAR = 1e-6
TERMS = 3


def binomials(a: float) -> list[float]:
    """Return the coefficients a (a − 1) … (a − k + 1)/k! of (1 + x)ᵃ for k = 0, …, 2 `TERMS`."""
    found = [1.0]
    for k in range(2 * TERMS):
        found.append(found[-1] * (a - k) / (k + 1))
    return found
