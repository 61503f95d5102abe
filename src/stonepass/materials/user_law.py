"""A law written by the user as a Python function."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass
from inspect import Parameter, signature
from types import SimpleNamespace
from typing import Any

import numpy as np

from stonepass.errors import BadInput
from stonepass.materials.protocol import NAMESPACE
from stonepass.strain import CauchyGreen, Place

__all__ = ["UserLaw"]


OLD_PARAMETERS = 5


@dataclass(frozen=True)
class UserLaw:
    """A strain energy written by the user: ``energy(C, place, xp)`` in J/m³.

    Raises
    ------
    BadInput
        The function has five parameters, as in earlier versions.
    """

    function: Callable[..., Any]
    label: str

    def __post_init__(self) -> None:
        try:
            parameters = signature(self.function).parameters.values()
        except (TypeError, ValueError):  # a function that is not written in Python
            return
        if sum(each.default is Parameter.empty for each in parameters) == OLD_PARAMETERS:
            raise BadInput(
                f"law '{self.label}'",
                "a function of five arguments, as in earlier versions",
                "written energy(C, place, xp) with C.rr, C.tt, C.zz, C.rz, C.rt, C.tz and "
                "place.R, place.Z",
            )

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Call the user's function; whatever it raises becomes one sentence."""
        try:
            with redirect_stdout(sys.stderr):  # stdout is for answers
                value = self.function(C, place, _allowed(xp))
        except Exception as problem:
            raise self.refusal(problem) from problem
        if value is None:
            raise BadInput(f"value of law '{self.label}'", "None", "an energy in J/m³")
        if getattr(value, "dtype", None) == np.dtype(object):
            raise self.refusal(TypeError("a function of NumPy was used in place of one of xp"))
        return value

    def refusal(self, problem: Exception) -> BadInput:
        """Turn what the function raises, or its derivatives, into one sentence."""
        return BadInput(
            f"law '{self.label}'",
            f"raising {type(problem).__name__}: {problem}",
            "a function energy(C, place, xp) that returns J/m³",
            "it may use + - * / ** and xp." + ", xp.".join(NAMESPACE) + ", and no comparisons",
        )


def _allowed(xp: Any) -> SimpleNamespace:
    """Return the functions of an array namespace that every one of them has."""
    return SimpleNamespace(**{name: getattr(xp, name) for name in NAMESPACE})
