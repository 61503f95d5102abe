"""A law that the user has written as a Python function."""

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
    """A strain energy that the user has written as a Python function.

    See "Your own law" in docs/laws.md.

    Attributes
    ----------
    function : callable
        ``function(C, place, xp)`` returns the energy density in J/m³, see `Law.energy`.
    label : str
        Name of the law in messages.

    Raises
    ------
    BadInput
        The function has five parameters, as in earlier versions of this package.
    """

    function: Callable[..., Any]
    label: str

    def __post_init__(self) -> None:
        try:
            parameters = signature(self.function).parameters.values()
        except (TypeError, ValueError):  # functions written in C may have no signature
            return
        if sum(each.default is Parameter.empty for each in parameters) == OLD_PARAMETERS:
            raise BadInput(
                f"law '{self.label}'",
                "a function of five arguments, as in earlier versions",
                "written energy(C, place, xp) with C.rr, C.tt, C.zz, C.rz, C.rt, C.tz and "
                "place.R, place.Z",
            )

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`.

        Raises
        ------
        BadInput
            The function raises an exception or does not return an energy.
        """
        try:
            with redirect_stdout(sys.stderr):  # standard output is reserved for results
                value = self.function(C, place, _allowed(xp))
        except Exception as problem:
            raise self.refusal(problem) from problem
        if value is None:
            raise BadInput(f"value of law '{self.label}'", "None", "an energy in J/m³")
        if getattr(value, "dtype", None) == np.dtype(object):
            raise self.refusal(TypeError("a function of NumPy was used instead of one of xp"))
        return value

    def refusal(self, problem: Exception) -> BadInput:
        """Convert an exception of the function or of its derivatives into an error message."""
        return BadInput(
            f"law '{self.label}'",
            f"raising {type(problem).__name__}: {problem}",
            "a function energy(C, place, xp) that returns J/m³",
            "it may use + - * / ** and xp." + ", xp.".join(NAMESPACE) + ", but no comparisons",
        )


def _allowed(xp: Any) -> SimpleNamespace:
    """Return the functions of `xp` that all array namespaces provide (`NAMESPACE`)."""
    return SimpleNamespace(**{name: getattr(xp, name) for name in NAMESPACE})
