"""The load on the tube besides stone and urine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from stonepass.declaration import Kind, declared, described, set_inputs
from stonepass.units import Pressure

__all__ = ["CONFINING", "PRESTRETCH", "Load"]

CONFINING = (0.0, 1e5)  # Pa
PRESTRETCH = (0.8, 1.6)


@dataclass(frozen=True, init=False)
class Load:
    """What acts on the tube besides stone and urine.

    Parameters
    ----------
    confining_pressure : str or Pressure
        P_out on the outer wall, 0 to 100 kPa.
    confinement : {"dead", "hydrostatic"}
        Whether the radial resultant of P_out is kept as the tube widens (dead load; paper, Eq. 10)
        or the pressure itself follows the wall (a water bath).
    prestretch : float
        Axial stretch λ_z put on the tube before everything else; R_a, R_b are before it.
    """

    SECTION: ClassVar[str] = "load"

    confining_pressure: Pressure = declared(
        Kind.PRESSURE,
        "--confining",
        "Confining pressure on the outer wall, e.g. 5.4kPa.",
        default=Pressure(0.0),
        title="confining pressure",
        bounds=CONFINING,
        metavar="PRESSURE",
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
        confining_pressure: str | Pressure | None = None,
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
        """Whether the confining pressure follows the deformed wall."""
        return self.confinement == "hydrostatic"
