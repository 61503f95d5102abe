"""The record of a measured series compared with the model, and its table as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pydantic import Field

from stonepass.bench.comparison import SeriesComparison
from stonepass.bench.invitro import FittedParameter, InVitro
from stonepass.bench.least_squares import LEVEL
from stonepass.caution import Caution
from stonepass.inputs.measured_pressures import Point
from stonepass.io.csv_file import write_csv
from stonepass.model.answer import Answer
from stonepass.records.base import CautionRecord, PartRecord, Record, kilo, warning_records

__all__ = [
    "AgreementRecord",
    "EstimateRecord",
    "InVitroInputsRecord",
    "InVitroPointRecord",
    "InVitroRecord",
    "JointFitRecord",
    "invitro_record",
    "series_warnings",
    "write_invitro",
]


class EstimateRecord(PartRecord):
    """A fitted number and its 95 % interval."""

    value: float = Field(description="best value")
    low: float | None = Field(
        description="lower end of the interval; null if the data do not bound it"
    )
    high: float | None = Field(
        description="upper end of the interval; null if the data do not bound it"
    )


class JointFitRecord(PartRecord):
    """Friction and stiffness fitted together."""

    friction: EstimateRecord = Field(description="friction coefficient")
    stiffness: EstimateRecord = Field(description="factor on the stiffness of the material")
    correlation: float | None = Field(description="correlation of the two estimates")


class AgreementRecord(PartRecord):
    """The agreement of model and series."""

    bias_kPa: float | None = Field(description="mean of predicted minus measured pressure")
    rmse_kPa: float | None = Field(
        description="root mean square of predicted minus measured pressure"
    )
    r_squared: float | None = Field(
        description=(
            "coefficient of determination, 1 − Σ (predicted − measured)²/Σ (measured − mean)²; "
            "null if all measured pressures are equal"
        )
    )
    compared: int = Field(
        description="number of points for which the model predicts a critical pressure"
    )
    not_compared: dict[str, int] = Field(
        description="number of points without a predicted critical pressure, by outcome"
    )


class InVitroPointRecord(PartRecord):
    """A measured point, compared with the model."""

    size_ratio: float = Field(description="ξ, stone diameter divided by inner diameter of the tube")
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    confining_kPa: float = Field(description="confining pressure P_out")
    measured_kPa: float = Field(description="measured critical pressure")
    sd_kPa: float | None = Field(
        description="standard deviation of the measured pressure; null if not given"
    )
    outcome: str = Field(description="outcome of the model (glossary: outcomes)")
    critical_pressure_kPa: float | None = Field(description="P_ucr of the model")
    critical_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error (±) of `critical_pressure_kPa`"
    )


class InVitroInputsRecord(PartRecord):
    """The settings of the comparison with a measured series."""

    file: str = Field(description="name of the data file")
    material: str = Field(description="name of the material")
    confinement: str = Field(description="how a confining pressure acts: `hydrostatic` or `dead`")
    model: str = Field(description="name of the model")
    seating: str | None = Field(
        description="how the stone is seated; null for a model without a seated state"
    )
    accuracy: str = Field(description="accuracy of the finite elements")


class InVitroRecord(AgreementRecord, Record):
    """A measured series compared with the model, and the fitted friction coefficient."""

    holds: bool = Field(
        description=(
            "false if series and model do not agree, or if the joint fit excludes the stiffness of "
            "the material; the first warnings give the reason"
        )
    )
    friction: float = Field(
        description="friction coefficient at which the model and the points are compared"
    )
    fitted_friction: EstimateRecord = Field(
        description="friction coefficient fitted with the stiffness of the material"
    )
    fitted_agreement: AgreementRecord = Field(
        description="agreement of model and series at the fitted friction coefficient"
    )
    joint: JointFitRecord | None = Field(
        description="friction and stiffness fitted together; null for fewer than four points"
    )
    weighted: bool = Field(
        description="true if the residuals are weighted by the standard deviations of the points"
    )
    level: float = Field(description="confidence level of the intervals")
    points: list[InVitroPointRecord] = Field(description="the points of the series")
    inputs: InVitroInputsRecord = Field(description="data file and settings")
    warnings: list[CautionRecord] = Field(
        description="warnings about the fit and about the answers of the model"
    )


def invitro_record(found: InVitro, file: str) -> InVitroRecord:
    """Make the record of a series.

    Parameters
    ----------
    found : InVitro
        The comparison of the series with the model.
    file : str
        Name of the data file.
    """
    joint, setting = found.joint, found.setting
    return InVitroRecord(
        **dict(_agreement(found.comparison)),
        holds=not found.objections,
        friction=found.comparison.friction,
        fitted_friction=_estimate(found.friction),
        fitted_agreement=_agreement(found.fitted),
        joint=None
        if joint is None
        else JointFitRecord(
            friction=_estimate(joint.friction),
            stiffness=_estimate(joint.stiffness),
            correlation=joint.correlation,
        ),
        weighted=found.weighted,
        level=LEVEL,
        points=_points(found.comparison),
        inputs=InVitroInputsRecord(
            file=file,
            material=setting.material.name,
            confinement=setting.confinement,
            model=setting.model.NAME,
            seating=getattr(setting.model, "seating", None),
            accuracy=setting.numerics.accuracy,
        ),
        warnings=warning_records(series_warnings(found)),
    )


def series_warnings(found: InVitro) -> list[Caution]:
    """Return the warnings of the fit and of the answers, each once."""
    of_answers: Iterable[Caution] = (
        each for answer in found.comparison.answers for each in answer.warnings
    )
    once = {str(each): each for each in of_answers}
    return [*found.warnings, *once.values()]


def write_invitro(found: InVitro, path: Path) -> None:
    """Write the points of a series with the answers of the model as CSV.

    Parameters
    ----------
    found : InVitro
        The comparison; pressures are written in kPa.
    path : Path
        File to write.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    columns = tuple(InVitroPointRecord.model_fields)
    rows = (each.to_dict() for each in _points(found.comparison))
    write_csv(path, columns, ([row[name] for name in columns] for row in rows))


def _estimate(estimate: FittedParameter) -> EstimateRecord:
    return EstimateRecord(value=estimate.value, low=estimate.low, high=estimate.high)


def _agreement(comparison: SeriesComparison) -> AgreementRecord:
    return AgreementRecord(
        bias_kPa=kilo(comparison.bias),
        rmse_kPa=kilo(comparison.rmse),
        r_squared=comparison.r_squared,
        compared=comparison.compared,
        not_compared=comparison.not_compared,
    )


def _points(comparison: SeriesComparison) -> list[InVitroPointRecord]:
    return [_point(*pair) for pair in zip(comparison.points, comparison.answers, strict=True)]


def _point(point: Point, answer: Answer) -> InVitroPointRecord:
    return InVitroPointRecord(
        size_ratio=point.size_ratio,
        wall_ratio=point.wall_ratio,
        confining_kPa=point.confining_pressure / 1e3,
        measured_kPa=point.pressure / 1e3,
        sd_kPa=kilo(point.sd),
        outcome=answer.outcome.name,
        critical_pressure_kPa=kilo(answer.pressure),
        critical_pressure_error_kPa=kilo(answer.error.critical_pressure if answer.error else None),
    )
