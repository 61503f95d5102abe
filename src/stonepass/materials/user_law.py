"""A law written by the user as a Python function."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass
from typing import Any

from stonepass.errors import BadInput
from stonepass.materials.protocol import NAMESPACE

__all__ = ["UserLaw"]


@dataclass(frozen=True)
class UserLaw:
    """A strain energy written by the user: ``energy(C_rr, C_tt, C_zz, C_rz, xp)`` in J/m³."""

    function: Callable[..., Any]
    label: str

    def energy(self, C_rr: Any, C_tt: Any, C_zz: Any, C_rz: Any, xp: Any) -> Any:
        """Call the user's function; whatever it raises becomes one sentence."""
        try:
            with redirect_stdout(sys.stderr):  # stdout is for answers
                value = self.function(C_rr, C_tt, C_zz, C_rz, xp)
        except Exception as problem:
            raise BadInput(
                f"law '{self.label}'",
                f"raising {type(problem).__name__}: {problem}",
                "a function energy(C_rr, C_tt, C_zz, C_rz, xp) that returns J/m³",
                "it may use + - * / ** and xp." + ", xp.".join(NAMESPACE),
            ) from problem
        if value is None:
            raise BadInput(f"value of law '{self.label}'", "None", "an energy in J/m³")
        return value

    def without_ground_matrix(self) -> UserLaw:
        """Return itself: a user's law is one piece."""
        return self
