"""How finely a case is solved, apart from the model that answers it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS, Level

__all__ = ["Numerics"]

HALF_LENGTH = (3.0, 100.0)


@dataclass(frozen=True)
class Numerics:
    """Mesh and length of the tube in the finite elements.

    Parameters
    ----------
    accuracy : {"standard", "fast", "reference"}
        How fine the meshes are; every answer carries an estimate of its discretisation error.
    half_length : float
        L/R_a, half the length of the tube in inner radii, 3 to 100; its ends keep their place.
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
    def level(self) -> Level:
        """Both resolutions of this accuracy, and how their difference becomes an error."""
        return LEVELS[self.accuracy]

    @property
    def resolution(self) -> Resolution:
        """The finer resolution, that of the answer."""
        return self.level.resolution

    def check(self, extent: float) -> None:
        """Refuse a tube that is too short for a stone that reaches `extent` R_a from its middle."""
        least = 2.0 * extent
        require(
            self.half_length >= least,
            "half_length",
            self.half_length,
            f"at least twice the stone's largest extent from its widest place, {least:.4g}",
        )
