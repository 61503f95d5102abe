"""Inputs and published results of the paper (Liu et al. 2022)."""

from __future__ import annotations

from stonepass.model.answer import Model
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.elastic_foundation import ElasticFoundation
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.units import Pressure

__all__ = [
    "BEAM",
    "BEAM_SIZE",
    "CONFINING",
    "FRICTION",
    "LATEX_FRICTION",
    "LATEX_WALLS",
    "LIMIT",
    "PASSING",
    "PUBLISHED",
    "SLOPES",
    "WATER",
    "latex_case",
    "ureter_case",
]

LIMIT = Pressure(12e3)  # from a study of minipigs; see "Errata" in docs/theory.md
FRICTION = 0.5
# wall ratio η: published ξ_cr, Fung wall, friction 0.5, no confining pressure (Fig. 8a)
PUBLISHED = {1.30: 1.22, 3.40: 1.11}
CONFINING = (Pressure(4e3), Pressure(8e3))  # in addition to none (Fig. 8c)
# inner diameter in m: wall ratio η, published largest passing diameter in mm (section 3.2)
PASSING = {0.94e-3: (3.40, 1.04), 3.5e-3: (1.30, 4.27)}
LATEX_WALLS = (1.5, 1.57, 2.0)  # section 2.2
LATEX_FRICTION = 0.475  # section 2.4.1
WATER = Pressure(5.4e3)  # 540 mm under water (section 2.2)
# E₁ and E₂ of the thin wall as a beam (section 3.3.2)
BEAM = ElasticFoundation(
    circumferential_modulus=Pressure(0.465e6),
    longitudinal_modulus=Pressure(0.02e6),
)
BEAM_SIZE = 1.24  # published ξ_cr of that beam (section 3.3.1)
SLOPES = (0.38, 0.12)  # k₀ and k₁ of a stone's surface (section 2.3)


def ureter_case(
    wall_ratio: float, size_ratio: float, load: Load | None = None, model: Model | None = None
) -> Case:
    """Return the case of a stone in the human ureter with the inputs of the paper."""
    stone = Stone(size_ratio=size_ratio, friction=FRICTION)
    return Case(stone, Ureter(wall_ratio=wall_ratio), load or Load(), model or SeatedBalance())


def latex_case(wall_ratio: float, size_ratio: float, load: Load | None = None) -> Case:
    """Return the case of a steel sphere in a latex tube."""
    stone = Stone(size_ratio=size_ratio, friction=LATEX_FRICTION)
    return Case(stone, Ureter(wall_ratio=wall_ratio, material="latex"), load or Load())
