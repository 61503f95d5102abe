"""Records of the critical pressures by different closures, and their table as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pydantic import Field

from stonepass.io.csv_file import write_csv
from stonepass.records.base import CautionRecord, Record, kilo, warning_records
from stonepass.studies.closures import APPROXIMATE, CLOSURES, ClosureComparison

__all__ = ["ClosuresRecord", "closures_record", "write_map"]

COLUMNS = (
    "size_ratio", "wall_ratio", "friction", "aspect", "material", "outcome",
    *(f"{name}_pressure_kPa" for name in CLOSURES),
    *(f"{name}_error" for name in APPROXIMATE),
)  # fmt: skip


class ClosuresRecord(Record):
    """Critical pressures of one stone by every closure, compared with the direct model."""

    outcome: str = Field(description="outcome of the direct model (glossary: outcomes)")
    message: str = Field(description="the outcome as a sentence")
    size_ratio: float = Field(
        description="ξ, stone diameter divided by inner diameter of the ureter"
    )
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    friction: float = Field(description="μ_f, Coulomb friction coefficient of stone and wall")
    aspect: float = Field(description="κ, length of the stone divided by its diameter")
    material: str = Field(description="name of the material")
    derived_pressure_kPa: float | None = Field(
        description="P_ucr by Eq. 15 with the derived sign of Eq. 5"
    )
    printed_pressure_kPa: float | None = Field(
        description="P_ucr by Eq. 15 with the printed sign of Eq. 5"
    )
    series_pressure_kPa: float | None = Field(
        description="P_ucr by the series of Eqs 13–14, fitted to direct states"
    )
    energy_pressure_kPa: float | None = Field(
        description="P_ucr by the energy balance I(P) = D of the loaded state"
    )
    direct_pressure_kPa: float | None = Field(description="P_ucr of the direct model")
    derived_error: float | None = Field(
        description="`derived_pressure_kPa`/`direct_pressure_kPa` − 1"
    )
    printed_error: float | None = Field(
        description="`printed_pressure_kPa`/`direct_pressure_kPa` − 1"
    )
    series_error: float | None = Field(
        description="`series_pressure_kPa`/`direct_pressure_kPa` − 1"
    )
    energy_error: float | None = Field(
        description="`energy_pressure_kPa`/`direct_pressure_kPa` − 1"
    )
    series_coefficients: list[float] | None = Field(
        description="c₁, c₂, … of the fitted series in t = (ρ_α − ρ₀)/(R_s − ρ₀)"
    )
    warnings: list[CautionRecord] = Field(description="warnings about the answers")


def closures_record(found: ClosureComparison) -> ClosuresRecord:
    """Make the record of a comparison of closures."""
    case, series = found.case, found.series
    pressures = {f"{name}_pressure_kPa": kilo(each) for name, each in found.pressures.items()}
    errors = {f"{name}_error": found.error(name) for name in APPROXIMATE}
    return ClosuresRecord.model_validate(
        {
            "outcome": found.outcome.name,
            "message": found.message,
            "size_ratio": case.size_ratio,
            "wall_ratio": case.wall_ratio,
            "friction": case.stone.friction,
            "aspect": case.stone.aspect,
            "material": case.ureter.material.name,
            **pressures,
            **errors,
            "series_coefficients": None if series is None else list(series.coefficients),
            "warnings": warning_records(found.warnings),
        }
    )


def write_map(found: Iterable[ClosureComparison], path: Path) -> None:
    """Write comparisons as CSV, with one row each and empty cells for missing numbers.

    Parameters
    ----------
    found : iterable of ClosureComparison
        The comparisons; pressures are written in kPa.
    path : Path
        File to write.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    rows = (closures_record(each).to_dict() for each in found)
    write_csv(path, COLUMNS, ([row[name] for name in COLUMNS] for row in rows))
