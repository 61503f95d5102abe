"""The load on the tube in addition to stone and urine: confining pressure and pre-stretch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, declared, described, set_inputs
from stonepass.units import Pressure, Quantity

__all__ = ["CONFINING", "PRESTRETCH", "Load"]

CONFINING = (0.0, 1e5)  # Pa
PRESTRETCH = (0.8, 1.6)


@dataclass(frozen=True, init=False)
class Load:
    """The load on the tube in addition to stone and urine.

    Parameters
    ----------
    confining_pressure : str, Pressure or pint.Quantity
        Pressure P_out on the outer wall, 0 to 100 kPa; text has a unit, e.g. ``"5.4 kPa"``. The
        attribute is in Pa. The default is 0.
    confinement : {"dead", "hydrostatic"}
        Behaviour of the confining pressure when the tube widens. A dead load, the default, keeps
        its radial resultant (paper, Eq. 10). A hydrostatic pressure, like that of a water bath,
        keeps its value and stays normal to the deformed wall. See "Far field" in docs/theory.md.
    prestretch : float
        Axial stretch λ_z, 0.8 to 1.6, which is applied before all other loads; 1 by default. The
        radii R_a and R_b are those of the tube before it is stretched.

    Raises
    ------
    BadInput
        A value is out of bounds, or a pressure has no unit.
    """

    SECTION: ClassVar[str] = "load"

    confining_pressure: Pressure = declared(
        Kind.PRESSURE,
        "--confining",
        "Confining pressure on the outer wall, e.g. 5.4kPa.",
        default=Pressure(0.0),
        title="confining pressure",
        bounds=CONFINING,
    )
    confinement: str = declared(
        Kind.CHOICE,
        "--confinement",
        "How the confining pressure acts: as a dead load (its resultant is kept), or as a "
        "hydrostatic follower pressure (it stays normal to the deformed wall).",
        default="dead",
        choices=("dead", "hydrostatic"),
    )
    prestretch: float = declared(
        Kind.NUMBER,
        "--prestretch",
        "Axial pre-stretch of the tube.",
        default=1.0,
        bounds=PRESTRETCH,
    )

    def __init__(
        self,
        confining_pressure: str | Pressure | Quantity | None = None,
        confinement: str | None = None,
        prestretch: float | None = None,
    ) -> None:
        set_inputs(
            self,
            confining_pressure=confining_pressure,
            confinement=confinement,
            prestretch=prestretch,
        )

    __repr__ = described

    @property
    def hydrostatic(self) -> bool:
        """True if the confining pressure keeps its value and stays normal to the deformed wall."""
        return self.confinement == "hydrostatic"
