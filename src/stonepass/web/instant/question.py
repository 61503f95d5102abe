"""The question of an instant answer, and the surrogate that can answer it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from stonepass.model.case import Case
from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.box import SLACK
from stonepass.studies.surrogates.store import load_surrogate, shipped_surrogates
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.units import Pressure

__all__ = [
    "Held",
    "InstantQuestion",
    "Obstacle",
    "largest_load",
    "named_surrogate",
    "obstacles",
    "surrogate_for",
]


@dataclass(frozen=True)
class Held:
    """The inputs that stay the same in a curve or a map over the sizes of stone and wall.

    Attributes
    ----------
    friction : float
        Friction coefficient.
    confining_pressure : float
        Confining pressure in Pa.
    stiffness : float
        Stiffness of the wall relative to the material.
    """

    friction: float
    confining_pressure: float
    stiffness: float

    def answers(self, surrogate: Surrogate, size_ratio: Any, wall_ratio: Any) -> SurrogateAnswers:
        """Return the answers of a surrogate for numbers or arrays of sizes."""
        return surrogate.evaluate(size_ratio=size_ratio, wall_ratio=wall_ratio, **asdict(self))

    def inside(self, surrogate: Surrogate, wall_ratio: float | None = None) -> bool:
        """Return True if these inputs are in the box of a surrogate, for one wall or for some."""
        low, high = surrogate.box.friction
        thin, thick = surrogate.box.wall_ratio
        wall = thick if wall_ratio is None else wall_ratio
        most = self.stiffness * largest_load(surrogate, wall)
        slack = 1.0 + SLACK
        return (
            low <= self.friction <= high
            and thin <= wall * slack
            and wall <= thick * slack
            and self.confining_pressure <= most * slack
        )


@dataclass(frozen=True)
class InstantQuestion:
    """A case, the stiffness of its wall, and a pressure limit.

    Attributes
    ----------
    case : Case
    stiffness : float
        Stiffness of the wall relative to the material of the case.
    limit : Pressure or None
        Pressure limit in Pa, for the largest stone that moves.
    include : frozenset of str
        Parts of the answer that cost more: ``curve``, ``map``, ``section``.
    """

    case: Case
    stiffness: float = 1.0
    limit: Pressure | None = None
    include: frozenset[str] = frozenset()

    @property
    def held(self) -> Held:
        """The inputs that do not depend on the sizes of stone and wall."""
        load = float(self.case.load.confining_pressure)
        return Held(self.case.stone.friction, load, self.stiffness)


@dataclass(frozen=True)
class Obstacle:
    """A reason why no surrogate can answer a question.

    Attributes
    ----------
    key : str
        The input that is the reason.
    sentence : str
        The reason in words.
    """

    key: str
    sentence: str


def surrogate_for(case: Case) -> Surrogate | None:
    """Return the surrogate of the package for the material and the model of a case, or None."""
    name = (case.ureter.material.reference, case.model.NAME)
    return named_surrogate(*name) if name in shipped_surrogates() else None


def largest_load(surrogate: Surrogate, wall_ratio: float) -> float:
    """Return the largest confining pressure in Pa for a wall with the stiffness of the material."""
    factor = float(surrogate.stable(np.array([wall_ratio]))[0])
    return factor * float(surrogate.case.load.confining_pressure)


@lru_cache(maxsize=16)
def named_surrogate(material: str, model: str) -> Surrogate:
    """Return a surrogate of the package; it is read from its file once."""
    return load_surrogate(material, model)


def obstacles(case: Case, surrogate: Surrogate | None) -> list[Obstacle]:
    """Return the reasons why a surrogate does not describe a case, apart from its box.

    Parameters
    ----------
    case : Case
        The case of a question.
    surrogate : Surrogate or None
        The surrogate of its material and model.
    """
    if surrogate is None:
        return [_without_surrogate(case)]
    known, load = surrogate.case, case.load
    differs = {
        "method.model": (case.model != known.model, "the default options of the model"),
        "method.half_length": (
            case.numerics.half_length != known.numerics.half_length,
            f"a half-length of {known.numerics.half_length:g}",
        ),
        "stone.aspect": (case.stone.shape != known.stone.shape, "a sphere"),
        "load.prestretch": (
            load.prestretch != known.load.prestretch,
            f"a pre-stretch of {known.load.prestretch:g}",
        ),
        "load.confinement": (
            load.confining_pressure > 0.0 and load.confinement != known.load.confinement,
            f"a confining pressure that acts as '{known.load.confinement}'",
        ),
    }
    return [
        Obstacle(key, f"The instant answer is for {what} only; solve by finite elements instead.")
        for key, (differing, what) in differs.items()
        if differing
    ]


def _without_surrogate(case: Case) -> Obstacle:
    material, model = case.ureter.material.reference, case.model.NAME
    materials = sorted({name for name, each in shipped_surrogates() if each == model})
    if not materials:
        models = sorted({each for _, each in shipped_surrogates()})
        words = " and ".join(f"'{each}'" for each in models)
        return Obstacle(
            "method.model",
            f"The instant answer exists for the model {words} only; solve by finite elements "
            "instead.",
        )
    words = "material" if len(materials) == 1 else "materials"
    words += " " + " and ".join(f"'{each}'" for each in materials)
    name = f"'{material}'" if material else "your own constants"
    return Obstacle(
        "ureter.material",
        f"With the model '{model}' the instant answer exists for the {words} only, and not for "
        f"{name}; solve by finite elements instead.",
    )
