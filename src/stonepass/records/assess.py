"""The record of the assessment of one patient."""

from __future__ import annotations

from pydantic import Field

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import Row
from stonepass.clinic.fractions import Fraction, Range, contradiction
from stonepass.clinic.patient import INPUTS
from stonepass.clinic.pressure_limits import describe_limit
from stonepass.records.answer import AnswerRecord, answer_record
from stonepass.records.base import CautionRecord, PartRecord, Record, kilo, warning_records
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = [
    "CAUTION",
    "LENGTHS",
    "AssessInputsRecord",
    "AssessRecord",
    "CohortRecord",
    "FractionRecord",
    "MeasuredRecord",
    "PressureRangeRecord",
    "SizeFractionRecord",
    "SurfaceAccuracyRecord",
    "assess_record",
]

CAUTION = (
    "The fractions describe the uncertainty of the inputs in a model of a passive tube. They are "
    "not probabilities of passage, because the model does not include peristalsis, muscle tone, "
    "time or swelling."
)
LEVEL = 0.90  # probability level of the intervals
LENGTHS = tuple(name for name in INPUTS if "diameter" in name or "thickness" in name)


class PressureRangeRecord(PartRecord):
    """Median and 90 % interval of a pressure in kPa."""

    low: float | None = Field(
        description="5th percentile; null if samples with only a lower bound leave it unknown"
    )
    median: float | None = Field(
        description="median; null if samples with only a lower bound leave it unknown"
    )
    high: float | None = Field(
        description="95th percentile; null if samples with only a lower bound leave it unknown"
    )
    at_least: float | None = Field(
        description=(
            "lower bound of the first of `low`, `median` and `high` that is null; null if all of "
            "them are known"
        )
    )


class FractionRecord(PartRecord):
    """A fraction of the samples, 0 to 1; its ends differ if it is not known exactly."""

    low: float = Field(description="smallest possible value of the fraction")
    high: float = Field(description="largest possible value of the fraction")


class SizeFractionRecord(FractionRecord):
    """The fraction of samples below the pressure limit if the stone had another diameter."""

    diameter_mm: float = Field(description="this diameter of the stone")


class CohortRecord(PartRecord):
    """A passage rate of a published cohort, compared with the model."""

    cohort: str = Field(description="name of the cohort")
    source: str = Field(description="publication")
    read: str = Field(
        description=(
            "`itself` if the number was read in this publication, `quoted` if it was read in "
            "another one that quotes it"
        )
    )
    about: str = Field(description="imaging method, patients and follow-up of the cohort")
    group: str = Field(description="size class or place in the ureter, as printed")
    passed: float | None = Field(description="fraction of these stones that passed")
    days: float | None = Field(description="mean time to passage in days")
    model: FractionRecord | None = Field(
        description="fraction of samples with such a stone that are below the pressure limit"
    )
    comparison: str = Field(description="comparison of both fractions in words")


class MeasuredRecord(PartRecord):
    """A measured quantity with its uncertainty."""

    value: float = Field(description="measured value in `unit`; the middle of a range")
    sd: float | None = Field(description="standard deviation in `unit`; null for a range")
    low: float | None = Field(description="lower end of a range; null with a standard deviation")
    high: float | None = Field(description="upper end of a range; null with a standard deviation")
    unit: str = Field(description="`m`, or empty for a dimensionless number")


class AssessInputsRecord(PartRecord):
    """The inputs of the assessment, as the patient file gave them."""

    file: str = Field(description="name of the patient file")
    measured: dict[str, MeasuredRecord] = Field(
        description="measured quantities by their names in the file"
    )
    material: str = Field(description="name of the material of the wall")
    place: str | None = Field(description="place of the stone in the ureter; null if unknown")
    limit_kPa: float = Field(description="pressure limit")
    limit_source: str = Field(description="meaning and source of the pressure limit")
    samples: int = Field(description="number of Monte Carlo samples")
    seed: int = Field(description="seed of the samples")


class SurfaceAccuracyRecord(PartRecord):
    """The accuracy of the samples and of the response surface."""

    possible: float = Field(
        description="fraction of the drawn samples that describe a possible wall"
    )
    solves: int = Field(description="number of solved cases")
    surface_error: float = Field(
        description="95th percentile of the relative cross-validation error of the response surface"
    )
    median_noise_kPa: float | None = Field(
        description=(
            "standard error of the median of P_ucr for this number of independent samples; null "
            "if it is unknown"
        )
    )
    fraction_noise: float = Field(
        description=(
            "standard error of `critical_below_limit` for this number of independent samples"
        )
    )


class AssessRecord(Record):
    """The assessment of one patient: intervals of pressures, and published cohorts."""

    outcome: str = Field(
        description=(
            "`MOVES`, or `NO_SOLUTION` if the model has an answer for too few of the possible cases"
        )
    )
    message: str = Field(description="the outcome as a sentence")
    critical_pressure_kPa: PressureRangeRecord | None = Field(
        description="median and 90 % interval of P_ucr"
    )
    critical_pressure_at_values_kPa: float | None = Field(
        description="P_ucr at the measured values"
    )
    at_values: AnswerRecord = Field(
        description=(
            "answer at the measured values, for the stiffness of the material and the confining "
            "pressure divided by the measured relative stiffness"
        )
    )
    present_pressure_kPa: PressureRangeRecord | None = Field(
        description=(
            "median and 90 % interval of the present urine pressure P_u; null if no dilated "
            "segment was measured"
        )
    )
    critical_below_limit: FractionRecord | None = Field(
        description="fraction of samples whose P_ucr is below the pressure limit"
    )
    critical_below_limit_where_held: FractionRecord | None = Field(
        description=(
            "this fraction among the samples in which the stone is larger than the lumen; null "
            "if there are too few of them"
        )
    )
    critical_below_present: FractionRecord | None = Field(
        description="fraction of samples whose P_ucr is below the present pressure"
    )
    no_larger_than_lumen: float = Field(
        description=(
            "fraction of samples in which the stone is no larger than the lumen, so that P_ucr is 0"
        )
    )
    sensitivity: dict[str, float] = Field(
        description="Sobol's total index of each input for the rank of P_ucr, in descending order"
    )
    by_size: list[SizeFractionRecord] = Field(
        description="fraction of samples below the limit if the stone had another diameter"
    )
    cohorts: list[CohortRecord] = Field(
        description="published passage rates of stones of this size and place"
    )
    inputs: AssessInputsRecord = Field(description="the inputs of the assessment")
    accuracy: SurfaceAccuracyRecord = Field(
        description="accuracy of the samples and of the response surface"
    )
    level: float = Field(description="probability level of the intervals")
    warnings: list[CautionRecord] = Field(
        description="warnings about assumptions, extrapolation and contradictions"
    )
    caution: str = Field(description="what the fractions do not mean")


def assess_record(found: Assessment, file: str) -> AssessRecord:
    """Make the record of an assessment; `file` is the name of the patient file."""
    return AssessRecord(
        outcome=found.outcome.name,
        message=found.message,
        critical_pressure_kPa=_range(found.critical),
        critical_pressure_at_values_kPa=kilo(found.central),
        at_values=answer_record(found.at_values),
        present_pressure_kPa=_range(found.present),
        critical_below_limit=_fraction(found.below_limit),
        critical_below_limit_where_held=_fraction(found.below_limit_held),
        critical_below_present=_fraction(found.below_present),
        no_larger_than_lumen=found.loose,
        sensitivity={each.name: each.total for each in found.sensitivity},
        by_size=[
            SizeFractionRecord(diameter_mm=size, low=each.low, high=each.high)
            for size, each in found.by_size
        ],
        cohorts=[_cohort(row, found.beside(row)) for row in found.cohorts],
        inputs=_inputs(found, file),
        accuracy=SurfaceAccuracyRecord(
            possible=found.possible,
            solves=found.solves,
            surface_error=found.surface_error,
            median_noise_kPa=kilo(found.median_noise),
            fraction_noise=found.fraction_noise,
        ),
        level=LEVEL,
        warnings=warning_records(found.warnings),
        caution=CAUTION,
    )


def _inputs(found: Assessment, file: str) -> AssessInputsRecord:
    patient = found.patient
    return AssessInputsRecord(
        file=file,
        measured={name: _measured(name, each) for name, each in patient.measured.items()},
        material=patient.material.name,
        place=patient.place,
        limit_kPa=patient.limit / 1e3,
        limit_source=describe_limit(patient.limit),
        samples=patient.samples,
        seed=patient.seed,
    )


def _measured(name: str, quantity: UncertainQuantity) -> MeasuredRecord:
    ranged = quantity.sd is None
    return MeasuredRecord(
        value=quantity.value,
        sd=quantity.sd,
        low=quantity.low if ranged else None,
        high=quantity.high if ranged else None,
        unit="m" if name in LENGTHS else "",
    )


def _cohort(row: Row, beside: Fraction | None) -> CohortRecord:
    return CohortRecord(
        cohort=row.cohort.name,
        source=row.cohort.source,
        read=row.cohort.read,
        about=row.cohort.about,
        group=row.group,
        passed=row.passed,
        days=row.days,
        model=_fraction(beside),
        comparison="" if row.passed is None else contradiction(row.passed, beside),
    )


def _range(found: Range | None) -> PressureRangeRecord | None:
    if found is None:
        return None
    return PressureRangeRecord(
        low=kilo(found.low),
        median=kilo(found.median),
        high=kilo(found.high),
        at_least=kilo(found.at_least),
    )


def _fraction(fraction: Fraction | None) -> FractionRecord | None:
    return None if fraction is None else FractionRecord(low=fraction.low, high=fraction.high)
