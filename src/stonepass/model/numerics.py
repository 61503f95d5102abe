"""The numerics of a case: accuracy of the finite elements, and length of the modelled tube."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS, AccuracyLevel

__all__ = ["Numerics"]

HALF_LENGTH = (3.0, 100.0)


@dataclass(frozen=True)
class Numerics:
    """Accuracy of the finite elements, and length of the modelled tube.

    Parameters
    ----------
    accuracy : {"standard", "fast", "reference"}
        Accuracy level, which determines meshes and increments. Every finite-element answer contains
        an estimate of its discretisation error. See "How far a number is from the limit" in
        docs/theory.md.
    half_length : float
        Half-length L/R_a of the tube in inner radii, 3 to 100. The ends of the tube are held
        axially at the pre-stretch.

    Raises
    ------
    BadInput
        A value is not allowed.
    """

    SECTION: ClassVar[str] = "method"

    accuracy: str = declared(
        Kind.CHOICE,
        "--accuracy",
        "How fine the meshes are.",
        default="standard",
        choices=("fast", "standard", "reference"),
    )
    half_length: float = declared(
        Kind.NUMBER,
        "--half-length",
        "Half the length of the tube in inner radii.",
        default=10.0,
        bounds=HALF_LENGTH,
    )

    __repr__ = described

    def __post_init__(self) -> None:
        check_inputs(self)

    @property
    def level(self) -> AccuracyLevel:
        """The accuracy level: both resolutions, and the rule of the error estimate."""
        return LEVELS[self.accuracy]

    @property
    def resolution(self) -> Resolution:
        """The finer of the two resolutions; the answer is computed with it."""
        return self.level.resolution

    def check(self, extent: float) -> None:
        """Refuse a tube that is too short for a stone.

        Parameters
        ----------
        extent : float
            Axial distance from the widest place of the stone to its farther pole, but at least R_s,
            in inner radii.

        Raises
        ------
        BadInput
            The half-length is less than twice `extent`.
        """
        least = 2.0 * extent
        require(
            self.half_length >= least,
            "half_length",
            self.half_length,
            f"at least twice the stone's largest extent from its widest place, {least:.4g}",
        )
