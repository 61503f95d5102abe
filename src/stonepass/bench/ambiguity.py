"""Constants that describe the data as well as the fitted ones, and another solid than these.

A test may leave more than one set of constants, although each of them is determined in its
neighbourhood. At axial stretch 1, for example, the pressure in a tube of an Ogden law is the same
for (μ, α) and for (−μ, −α).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from stonepass.bench.fit_search import Search
from stonepass.bench.same_solid import energies, same_solid
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput
from stonepass.materials.protocol import Law

__all__ = ["ambiguous"]


def ambiguous(search: Search, law: Law, as_good: Sequence[Mapping[str, float]]) -> list[Caution]:
    """Return a caution if other constants describe the data as well, but another solid.

    Parameters
    ----------
    search : Search
        The fitted constants.
    law : Law
        The fitted law.
    as_good : sequence of mapping of str to float
        Sets of all constants, in SI units, that describe the data as well.
    """
    fitted = energies(law)
    for values in as_good:
        try:
            other = search.made(**values)
        except BadInput:  # these constants describe no solid
            continue
        if not same_solid(energies(other), fitted):
            return [caution("ambiguous_fit", constants=search.shown(values))]
    return []
