"""The interface of a material law: a strain energy that is written once, in plain arithmetic.

The same formula is evaluated with NumPy, with automatic differentiation and in the finite elements.
Therefore a law may use only the operators ``+ - * / **`` and the functions of the namespace ``xp``
that is passed to it: ``exp log sqrt sin cos tan sinh cosh tanh arctan maximum minimum abs``. The
page docs/laws.md shows how to add a law.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.errors import BadInput, require
from stonepass.strain import CauchyGreen, Place
from stonepass.units import Values

__all__ = ["NAMESPACE", "ClosedForm", "Law", "Material", "MayBeDefective", "names_a_file"]

LARGEST_STRETCH = 15.0  # upper bound of a strain range; no rubber can be stretched further
NAMESPACE = (
    "exp", "log", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "arctan",
    "maximum", "minimum", "abs",
)  # fmt: skip


@runtime_checkable
class Law(Protocol):
    """A hyperelastic, incompressible material law of the wall.

    A law must be immutable and hashable by its constants, as a frozen dataclass is, because results
    that depend only on the law are cached under its hash. It declares its constants with
    `materials.constants.constant`.
    """

    def __hash__(self) -> int: ...

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy density in J per m³ of reference volume (= Pa).

        Parameters
        ----------
        C : CauchyGreen
            Components of the right Cauchy–Green tensor in the cylindrical reference frame, as
            numbers, arrays of one shape, or symbols of the finite elements.
        place : Place
            Reference coordinates R and Z in inner radii. The energy must not depend on Z if the
            energy balances of the far field are to hold (`model.energy_balance`).
        xp : namespace
            Array namespace for the type of `C`, with the functions in `NAMESPACE`.

        Returns
        -------
        number, array or symbol
            The energy density, of the same kind and shape as the components of `C`.
        """
        ...


@runtime_checkable
class ClosedForm(Protocol):
    """A law whose inflation pressure at unit axial stretch is known in closed form."""

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Return the transmural pressure of a uniform tube.

        Parameters
        ----------
        inner_ratio : float or array
            Deformed inner radius r_a/R_a, positive.
        wall_ratio : float or array
            R_b/R_a, above 1.

        Returns
        -------
        float or array
            Pressure difference between inside and outside in Pa (paper, Eq. 12).
        """
        ...


@runtime_checkable
class MayBeDefective(Protocol):
    """A law that can determine from its constants alone whether it is unstable."""

    @property
    def defect(self) -> tuple[str, str] | None:
        """Reason of the instability, and remedy; None if no defect is known."""
        ...


@dataclass(frozen=True)
class Material:
    """A law with its constants, and their source.

    Attributes
    ----------
    name : str
        Name on the command line (``--material NAME``) and in results.
    law : Law
        The strain energy, with constants in SI units.
    source, test, verified : str
        Publication of the constants, test by which they were measured, and extent to which the
        authors of this software could verify them.
    strain_range : (float, float)
        Smallest and largest circumferential stretch for which the constants were used, with
        0 < low ≤ 1 < high ≤ 15. Answers outside this range carry a warning.
    reference : str
        Where the material was read from: a name in the catalogue, ``law.toml`` or ``file.py:name``;
        empty if it was created in Python.

    Raises
    ------
    BadInput
        The law is not hashable, or the strain range is out of bounds.
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
    """Return True if the name of a material refers to a file, ``law.toml`` or ``file.py:name``."""
    return text.endswith(".toml") or ".py:" in text or text.endswith(".py")
