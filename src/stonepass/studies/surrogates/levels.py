"""The levels of solved cases that a surrogate is fitted to: many cheap ones, few accurate ones.

The polynomial of each level is fitted to what the polynomials of the levels before it leave over.
The contact without friction costs a fifth of the contact with friction and does not depend on the
friction coefficient; what friction changes in it is small, so that few cases suffice to learn it.
The change by a finer mesh is smaller still.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from stonepass.model.case import Case
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics

__all__ = ["Level", "levels_for"]


@dataclass(frozen=True)
class Level:
    """A number of cases that are solved in one way, and the polynomial that is fitted to them.

    Attributes
    ----------
    case : Case
        Model and numerics of the cases.
    count : int
        Number of cases.
    degrees : tuple of 4 int
        Largest degree of the polynomial in each coordinate of the box.
    total : int
        Largest total degree of the polynomial.
    refined : int
        Number of further cases where the surrogate is least certain (see `refinement`).
    """

    case: Case
    count: int
    degrees: tuple[int, int, int, int]
    total: int
    refined: int = 0


def levels_for(case: Case, effort: float = 1.0) -> list[Level]:
    """Return the levels for a surrogate of a case, the cheapest one first.

    Parameters
    ----------
    case : Case
        Material, load, model and numerics of the surrogate; the last level has its accuracy.
    effort : float
        Factor on the number of cases.
    """
    quick = replace(case, numerics=Numerics("fast", case.numerics.half_length))

    def count(number: int) -> int:
        return max(8, round(effort * number))

    loaded = case.load.confining_pressure > 0.0
    many = 512 if loaded else 256
    last = 1 if loaded else 0  # the fourth coordinate does not vary without a load
    levels = []
    if isinstance(case.model, SeatedBalance) and case.model.seating != "frictionless":
        smooth = replace(case.model, seating="frictionless", seating_friction=None)
        first = replace(quick, model=smooth)
        levels.append(Level(first, count(4 * many), (20, 16, 0, 8 * last), 20))
        levels.append(Level(quick, count(many), (8, 6, 6, 5 * last), 8, count(many // 4)))
    else:
        levels.append(Level(quick, count(4 * many), (20, 16, 0, 8 * last), 20))
    if case.numerics.accuracy != "fast":
        levels.append(Level(case, count(160), (5, 4, 4, last), 5))
    return levels
