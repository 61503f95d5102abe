"""The levels of solved cases that a surrogate is fitted to: many without friction, few with it.

The contact without friction costs a quarter of the contact with friction and does not depend on the
friction coefficient. The change by friction is small, so that fewer cases suffice to learn it. All
cases are solved with the numerics of the surrogate. A coarser mesh would hardly be faster: most of
the time of a case without friction does not depend on the mesh.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from stonepass.materials.relaxed_energy import Microbuckling
from stonepass.model.case import Case
from stonepass.model.models.seated_balance import SeatedBalance

__all__ = ["FitLevel", "levels_for"]


@dataclass(frozen=True)
class FitLevel:
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
    candidates : int
        Number of cases among which they are chosen.
    """

    case: Case
    count: int
    degrees: tuple[int, int, int, int]
    total: int
    refined: int = 0
    candidates: int = 0


def levels_for(case: Case, effort: float = 1.0) -> list[FitLevel]:
    """Return the levels for a surrogate of a case, the cheapest one first.

    In the thin walls of a material that does not microbuckle, friction changes the contact so fast
    close to the buckling load that the change by friction needs high degrees, and further cases
    that are chosen among many.

    Parameters
    ----------
    case : Case
        Material, load, model and numerics of the surrogate.
    effort : float
        Factor on the number of cases.
    """

    def count(number: int) -> int:
        return max(8, round(effort * number))

    loaded = case.load.confining_pressure > 0.0
    many = 512 if loaded else 256
    last = 1 if loaded else 0  # the fourth coordinate does not vary without a load
    degrees = (20, 16, 0, 8 * last)
    if isinstance(case.model, SeatedBalance) and case.model.seating != "frictionless":
        smooth = replace(case.model, seating="frictionless", seating_friction=None)
        base = FitLevel(replace(case, model=smooth), count(4 * many), degrees, 20)
        cases = count(many), count(many // 2)
        if isinstance(case.ureter.material.law, Microbuckling):
            return [base, FitLevel(case, cases[0], (8, 6, 6, 5 * last), 8, cases[1], 512)]
        return [base, FitLevel(case, cases[0], (16, 12, 8, 6 * last), 16, cases[1], 2048)]
    return [FitLevel(case, count(4 * many), degrees, 20)]
