"""The reason why a surrogate does not cover a condition."""

from __future__ import annotations

import numpy as np

from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.box import SLACK
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["why_outside"]


def why_outside(surrogate: Surrogate, answers: SurrogateAnswers, row: int) -> str:
    """Return what takes a condition out of the range of a surrogate, as a clause.

    Parameters
    ----------
    surrogate : Surrogate
    answers : SurrogateAnswers
        Its answers.
    row : int
        Number of a condition, from 0.
    """
    size, wall, friction, confining, stiffness = (
        float(answers.inputs[name][row])
        for name in ("size_ratio", "wall_ratio", "friction", "confining_pressure", "stiffness")
    )
    box = surrogate.box
    if size > box.size_ratio * (1.0 + SLACK):
        return f"the size ratio is {size:g}, but at most {box.size_ratio:g}"
    for name, value, (low, high) in (
        ("wall ratio", wall, box.wall_ratio),
        ("friction coefficient", friction, box.friction),
    ):
        if not low * (1.0 - SLACK) <= value <= high * (1.0 + SLACK):
            return f"the {name} is {value:g}, but from {low:g} to {high:g}"
    most = stiffness * float(surrogate.case.load.confining_pressure)
    most *= float(surrogate.stable(np.array([wall]))[0])
    if confining > most * (1.0 + SLACK):
        shown, largest = (f"{each / 1e3:.4g} kPa" for each in (confining, most))
        return f"the confining pressure is {shown}, but at most {largest} for this wall"
    return "the critical pressure is too large, or no state is known there"
