"""A measured series beside the model as a record, and its points as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pydantic import Field

from stonepass.bench.comparison import Comparison
from stonepass.bench.invitro import Estimate, InVitro
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

    value: float = Field(description="the number that fits best")
    low: float | None = Field(description="lower end; null where the data do not bound it")
    high: float | None = Field(description="upper end; null where the data do not bound it")


class JointFitRecord(PartRecord):
    """Friction and stiffness fitted together."""

    friction: EstimateRecord = Field(description="friction with the stiffness unknown")
    stiffness: EstimateRecord = Field(description="stiffness as a factor on the material's")
    correlation: float | None = Field(description="correlation of the two estimates")


class AgreementRecord(PartRecord):
    """How near model and series are."""

    bias_kPa: float | None = Field(description="mean of model less measured")
    rmse_kPa: float | None = Field(description="root mean square of model less measured")
    r_squared: float | None = Field(
        description=(
            "1 − Σ (model − measured)²/Σ (measured − mean)²; null for points of one pressure"
        )
    )
    compared: int = Field(description="points whose stone is held and has an answer")
    not_compared: dict[str, int] = Field(description="number of the other points, by outcome")


class InVitroPointRecord(PartRecord):
    """A measured point beside the model."""

    size_ratio: float = Field(description="ξ, stone diameter over inner diameter")
    wall_ratio: float = Field(description="η, outer diameter over inner diameter")
    confining_kPa: float = Field(description="confining pressure P_out")
    measured_kPa: float = Field(description="measured critical pressure")
    sd_kPa: float | None = Field(description="its standard deviation, where given")
    outcome: str = Field(description="how the model's question ended (glossary: outcomes)")
    critical_pressure_kPa: float | None = Field(description="P_ucr of the model")
    critical_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error of it"
    )


class InVitroInputsRecord(PartRecord):
    """The settings of the comparison with a measured series."""

    file: str = Field(description="name of the file of the points")
    material: str = Field(description="name of the material")
    confinement: str = Field(description="how a confining pressure acts: `hydrostatic` or `dead`")
    model: str = Field(description="name of the model")
    seating: str | None = Field(description="seating of the stone; null in a model without one")
    accuracy: str = Field(description="how finely the finite elements were solved")


class InVitroRecord(AgreementRecord, Record):
    """A measured series beside the model, and the friction coefficient that fits."""

    holds: bool = Field(
        description=(
            "false where series and model do not agree, or the joint fit excludes the wall's "
            "stiffness; the first warnings say which"
        )
    )
    friction: float = Field(description="friction at which model and points are compared")
    fitted_friction: EstimateRecord = Field(
        description="friction that fits, with the material's own stiffness"
    )
    fitted_agreement: AgreementRecord = Field(description="agreement at that friction")
    joint: JointFitRecord | None = Field(
        description="friction and stiffness fitted together; null for fewer than four points"
    )
    weighted: bool = Field(
        description="whether the points' standard deviations weigh the residuals"
    )
    level: float = Field(description="confidence level of the intervals")
    points: list[InVitroPointRecord] = Field(description="the series, point by point")
    inputs: InVitroInputsRecord = Field(description="what was asked")
    warnings: list[CautionRecord] = Field(
        description="where the fit, or an answer of the model, must be read with care"
    )


def invitro_record(found: InVitro, file: str) -> InVitroRecord:
    """Make the record of a series; `file` is the name of the file of its points."""
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
    """Return what the fit warns of, and what the answers warn of, each once."""
    of_answers: Iterable[Caution] = (
        each for answer in found.comparison.answers for each in answer.warnings
    )
    once = {str(each): each for each in of_answers}
    return [*found.warnings, *once.values()]


def write_invitro(found: InVitro, path: Path) -> None:
    """Write the points with the model's answers as CSV."""
    columns = tuple(InVitroPointRecord.model_fields)
    rows = (each.to_dict() for each in _points(found.comparison))
    write_csv(path, columns, ([row[name] for name in columns] for row in rows))


def _estimate(estimate: Estimate) -> EstimateRecord:
    return EstimateRecord(value=estimate.value, low=estimate.low, high=estimate.high)


def _agreement(comparison: Comparison) -> AgreementRecord:
    return AgreementRecord(
        bias_kPa=kilo(comparison.bias),
        rmse_kPa=kilo(comparison.rmse),
        r_squared=comparison.r_squared,
        compared=comparison.compared,
        not_compared=comparison.not_compared,
    )


def _points(comparison: Comparison) -> list[InVitroPointRecord]:
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
