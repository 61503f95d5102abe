"""What a material law is: a strain energy written once, in plain arithmetic.

The same formula serves NumPy (far field, tests) and the finite elements, so a law may use only
``+ - * / **`` and the functions of the namespace ``xp`` that is handed to it:
``exp log sqrt sin cos tan sinh cosh tanh arctan maximum minimum abs``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.errors import BadInput, require
from stonepass.strain import CauchyGreen, Place
from stonepass.units import Values

__all__ = ["NAMESPACE", "ClosedForm", "Law", "Material", "MayBeDefective", "names_a_file"]

LARGEST_STRETCH = 15.0  # that a range may state; no rubber goes farther
NAMESPACE = (
    "exp", "log", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "arctan",
    "maximum", "minimum", "abs",
)  # fmt: skip


@runtime_checkable
class Law(Protocol):
    """A hyperelastic, incompressible wall.

    A law is a value: what follows from it alone is computed once and kept by its hash. So it must
    hash by its constants, as a frozen dataclass does, and never change. It declares its constants
    with `materials.constants.constant`.
    """

    def __hash__(self) -> int: ...

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Strain energy in J/m³ of reference volume.

        Parameters
        ----------
        C : CauchyGreen
            Components of the right Cauchy–Green tensor in the cylindrical reference frame.
        place : Place
            Reference coordinates in inner radii. The law has to be the same all along the tube
            (no Z) where energy balances of the far field are used.
        xp : namespace
            Array namespace to use.
        """
        ...


@runtime_checkable
class ClosedForm(Protocol):
    """A law whose inflation pressure at unit axial stretch is known in closed form."""

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Transmural pressure in Pa at r_a/R_a = `inner_ratio`, R_b/R_a = `wall_ratio`."""
        ...


@runtime_checkable
class MayBeDefective(Protocol):
    """A law that can tell from its constants alone that it describes no solid."""

    @property
    def defect(self) -> tuple[str, str] | None:
        """Reason and remedy, or None where nothing is wrong."""
        ...


@dataclass(frozen=True)
class Material:
    """A law with constants, and where they come from.

    Attributes
    ----------
    name : str
        The word at the door (``--material NAME``).
    law : Law
        The strain energy with its constants in SI.
    source, test, verified : str
        Who published the constants, by which test, and how far we could verify them.
    strain_range : (float, float)
        Circumferential stretches the constants were used for; outside, answers carry a warning.
    reference : str
        How to find it again: a catalogue name, ``law.toml`` or ``file.py:name``; empty where it
        was made in Python.
    """

    name: str
    law: Law
    source: str
    test: str
    verified: str
    strain_range: tuple[float, float]
    reference: str = ""

    def __repr__(self) -> str:
        return f"Material({self.name!r}, {self.law!r})"

    def __post_init__(self) -> None:
        try:
            hash(self.law)
        except TypeError as problem:
            raise BadInput(
                "law",
                type(self.law).__name__,
                "hashable by its constants",
                "make it a frozen dataclass",
            ) from problem
        low, high = self.strain_range
        require(
            0.0 < low <= 1.0 < high <= LARGEST_STRETCH,
            "strain_range",
            list(self.strain_range),
            "two circumferential stretches [low, high] with 0 < low <= 1 < high <= "
            f"{LARGEST_STRETCH:g}",
        )


def names_a_file(text: str) -> bool:
    """Whether the name of a material is that of a file, ``law.toml`` or ``file.py:name``."""
    return text.endswith(".toml") or ".py:" in text or text.endswith(".py")
