"""The record of a law fitted to laboratory data."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import Field

from stonepass.bench.law_fit import FittedLaw
from stonepass.materials.known_laws import name_of_law
from stonepass.records.base import CautionRecord, PartRecord, Record, warning_records

__all__ = [
    "FitInputsRecord",
    "FitPointRecord",
    "FitRecord",
    "FittedConstantRecord",
    "InflationInputsRecord",
    "TensileInputsRecord",
    "fit_record",
]


class FittedConstantRecord(PartRecord):
    """A constant of the fitted law."""

    name: str = Field(description="name of the constant")
    value: float = Field(description="fitted or given value in `unit`")
    unit: str = Field(description="`Pa`, `rad` for an angle, or empty for a dimensionless number")
    low: float | None = Field(
        description="lower end of the 95 % interval; null for a given constant or an open interval"
    )
    high: float | None = Field(
        description="upper end of the 95 % interval; null for a given constant or an open interval"
    )
    given: bool = Field(description="true if the constant was given (`--fix`) instead of fitted")


class FitPointRecord(PartRecord):
    """A measured point, compared with the fitted law."""

    stretch: float = Field(description="stretch of a strip, or r_a/R_a of a tube")
    observed_kPa: float = Field(description="measured stress or pressure")
    predicted_kPa: float = Field(description="stress or pressure of the fitted law")
    group: str = Field(description="name of the curve that the point belongs to")


class FitInputsRecord(PartRecord):
    """The settings of a fit."""

    file: str = Field(description="name of the data file")
    relative: bool = Field(
        default=False, description="true if errors are assumed proportional to the predicted values"
    )
    data: list[FitPointRecord] = Field(description="the fitted points")


class TensileInputsRecord(FitInputsRecord):
    """The settings of a fit to strips in tension."""

    width_m: float | None = Field(
        default=None, description="width of the strip at rest; null if not given"
    )
    thickness_m: float | None = Field(
        default=None, description="thickness of the strip at rest; null if not given"
    )
    section_m2: float | None = Field(
        default=None, description="cross-section of the strip at rest in m²; null if not given"
    )
    gauge_length_m: float | None = Field(
        default=None, description="gauge length at rest; null if not given"
    )


class InflationInputsRecord(FitInputsRecord):
    """The settings of a fit to a tube under pressure."""

    inner_diameter_m: float = Field(description="inner diameter of the tube at rest")
    outer_diameter_m: float = Field(description="outer diameter of the tube at rest")


class FitRecord(Record):
    """A law fitted to laboratory data."""

    inputs: TensileInputsRecord | InflationInputsRecord = Field(
        description="data and settings of the fit"
    )
    law: str = Field(description="name of the law")
    constants: list[FittedConstantRecord] = Field(description="constants of the law; moduli in Pa")
    rmse_kPa: float = Field(description="root mean square of the residuals")
    r_squared: float = Field(
        description="coefficient of determination, 1 − Σ residual²/Σ (observed − mean)²"
    )
    intervals_approximate: bool = Field(
        description=(
            "true if the residuals violate an assumption of the 95 % intervals: independent "
            "Gaussian errors of the assumed size"
        )
    )
    correlations: dict[str, float] = Field(
        description=(
            "correlation of each pair of estimates, with the key `one,other`; near ±1 the data "
            "determine only a combination of both constants"
        )
    )
    points: int = Field(description="number of fitted points")
    measured: str = Field(description="measured quantity")
    strain_range: list[float] = Field(description="smallest and largest stretch of the data")
    stable: bool = Field(description="true if the law is stable over the strain range of the data")
    stability: str = Field(description="reason why the law is unstable; empty if it is stable")
    warnings: list[CautionRecord] = Field(description="warnings about the fit")


def fit_record(found: FittedLaw, inputs: Mapping[str, Any]) -> FitRecord:
    """Make the record of a fitted law.

    Parameters
    ----------
    found : FittedLaw
        The fitted law.
    inputs : mapping
        Settings of the fit: the `file`, `relative`, and the lengths at rest in m with the names of
        the keys of `TensileInputsRecord` or `InflationInputsRecord`.
    """
    asked = {**inputs, "data": _data(found)}
    kind = InflationInputsRecord if "inner_diameter_m" in inputs else TensileInputsRecord
    return FitRecord(
        inputs=kind.model_validate(asked),
        law=name_of_law(found.material.law),
        constants=[
            FittedConstantRecord(
                name=each.name,
                value=each.value,
                unit="" if each.unit == "1" else each.unit,
                low=each.low,
                high=each.high,
                given=each.given,
            )
            for each in found.constants
        ],
        rmse_kPa=found.rmse / 1e3,
        r_squared=found.r_squared,
        intervals_approximate=found.approximate,
        correlations={",".join(pair): value for pair, value in found.correlations.items()},
        points=len(found.predicted),
        measured=found.data.measured,
        strain_range=list(found.data.strain_range),
        stable=not found.unstable,
        stability=found.unstable,
        warnings=warning_records(found.warnings),
    )


def _data(found: FittedLaw) -> list[FitPointRecord]:
    data = found.data
    rows = zip(data.abscissa, data.observed, found.predicted, data.groups, strict=True)
    return [
        FitPointRecord(
            stretch=float(stretch),
            observed_kPa=float(observed) / 1e3,
            predicted_kPa=float(predicted) / 1e3,
            group=group,
        )
        for stretch, observed, predicted, group in rows
    ]
