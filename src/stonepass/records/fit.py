"""A fitted law as a record."""

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

    name: str = Field(description="what the law calls it")
    value: float = Field(description="its best value, in its unit")
    unit: str = Field(description="`Pa`, `rad` for an angle, or empty for a plain number")
    low: float | None = Field(
        description="lower end of its 95 % interval; null where it was given or is not bounded"
    )
    high: float | None = Field(
        description="upper end of its 95 % interval; null where it was given or is not bounded"
    )
    given: bool = Field(description="whether it was given (`--fix`) instead of fitted")


class FitPointRecord(PartRecord):
    """A measured point beside the fitted law."""

    stretch: float = Field(description="stretch of a strip, or r_a/R_a of a tube")
    observed_kPa: float = Field(description="what was measured")
    predicted_kPa: float = Field(description="what the fitted law says")
    group: str = Field(description="name of the curve that the point belongs to")


class FitInputsRecord(PartRecord):
    """The settings of a fit."""

    file: str = Field(description="name of the data file")
    relative: bool = Field(
        default=False, description="whether errors are taken in proportion to what was measured"
    )
    data: list[FitPointRecord] = Field(description="the points that were fitted")


class TensileInputsRecord(FitInputsRecord):
    """The settings of a fit to strips in tension."""

    width_m: float | None = Field(
        default=None, description="width of the strip at rest, where given"
    )
    thickness_m: float | None = Field(
        default=None, description="thickness of the strip at rest, where given"
    )
    section_m2: float | None = Field(
        default=None, description="section of the strip at rest in m², where given"
    )
    gauge_length_m: float | None = Field(
        default=None, description="length at rest that extensions belong to, where given"
    )


class InflationInputsRecord(FitInputsRecord):
    """The settings of a fit to a tube under pressure."""

    inner_diameter_m: float = Field(description="inner diameter of the tube at rest")
    outer_diameter_m: float = Field(description="outer diameter of the tube at rest")


class FitRecord(Record):
    """A law fitted to bench data."""

    inputs: TensileInputsRecord | InflationInputsRecord = Field(description="what was asked")
    law: str = Field(description="name of the law")
    constants: list[FittedConstantRecord] = Field(description="its constants, moduli in Pa")
    rmse_kPa: float = Field(description="root mean square of the residuals")
    r_squared: float = Field(description="1 − Σ residual²/Σ (observed − mean)²")
    intervals_approximate: bool = Field(
        description=(
            "whether the residuals are not those that the 95 % intervals assume: independent, "
            "Gaussian and of equal spread about the law"
        )
    )
    correlations: dict[str, float] = Field(
        description="of pairs `one,other` of estimates; near ±1 they trade off"
    )
    points: int = Field(description="how many points were fitted")
    measured: str = Field(description="what was measured")
    strain_range: list[float] = Field(description="smallest and largest stretch of the data")
    stable: bool = Field(
        description="whether the law describes a solid over the range of its law file"
    )
    stability: str = Field(description="why it does not; empty where it does")
    warnings: list[CautionRecord] = Field(description="where the fit must be read with care")


def fit_record(found: FittedLaw, inputs: Mapping[str, Any]) -> FitRecord:
    """Make the record of a fitted law.

    Parameters
    ----------
    found : FittedLaw
    inputs : mapping
        What was asked: the `file`, `relative`, and the lengths at rest in m by the names of
        `TensileInputsRecord` or `InflationInputsRecord`.
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
