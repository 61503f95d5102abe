"""The record of the assessment of one patient."""

from __future__ import annotations

from pydantic import Field

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import Row
from stonepass.clinic.contradiction import contradiction
from stonepass.clinic.decisions import decisions
from stonepass.clinic.patient import INPUTS
from stonepass.clinic.pressure_limits import describe_limit
from stonepass.records.answer import AnswerRecord, answer_record
from stonepass.records.base import CautionRecord, PartRecord, Record, kilo, warning_records
from stonepass.studies.censored_samples import Fraction, PercentileRange
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
    "The fractions express the uncertainty of the inputs in a model of a passive tube. They are "
    "not probabilities of passage: peristalsis, muscle tone, time and swelling are not in the "
    "model."
)
LEVEL = 0.90  # probability level of the intervals
LENGTHS = tuple(name for name in INPUTS if "diameter" in name or "thickness" in name)


class PressureRangeRecord(PartRecord):
    """Median and 90 % interval of a pressure in kPa."""

    low: float | None = Field(description="5th percentile; null if the model cannot determine it")
    median: float | None = Field(description="median; null if the model cannot determine it")
    high: float | None = Field(description="95th percentile; null if the model cannot determine it")
    at_least: float | None = Field(
        description=(
            "lower bound of the first of `low`, `median` and `high` that is null; null if all of "
            "them are known"
        )
    )


class FractionRecord(PartRecord):
    """A fraction of the samples; its ends differ if some samples are undecided."""

    low: float = Field(description="smallest possible value of the fraction")
    high: float = Field(description="largest possible value of the fraction")


class SizeFractionRecord(FractionRecord):
    """The fraction of samples below the pressure limit if the stone had another size."""

    diameter_mm: float = Field(description="this diameter of the stone")


class CohortRecord(PartRecord):
    """A passage rate of a published cohort, compared with the model."""

    cohort: str = Field(description="name of the cohort")
    source: str = Field(description="citation as far as it is known")
    read: str = Field(
        description="`itself` if the source was read, `quoted` if its numbers were read elsewhere"
    )
    about: str = Field(description="which stones were observed, how and for how long")
    group: str = Field(description="size class or place, as printed")
    passed: float | None = Field(description="fraction of these stones that passed")
    count: int | None = Field(description="number of stones in the class; null if not known")
    passed_low: float | None = Field(
        description="lower end of the 95 % interval of `passed`; null if `count` is not known"
    )
    passed_high: float | None = Field(
        description="upper end of the 95 % interval of `passed`; null if `count` is not known"
    )
    days: float | None = Field(description="mean time to pass in days")
    model: FractionRecord | None = Field(
        description=(
            "fraction of the samples with P_ucr below the pressure limit, among the samples whose "
            "stone belongs to `group` (all samples if `group` is a place)"
        )
    )
    comparison: str = Field(description="difference of the two fractions in words")


class MeasuredRecord(PartRecord):
    """A measured quantity with its uncertainty."""

    value: float = Field(description="measured value in `unit`; the middle of a range")
    sd: float | None = Field(description="standard deviation in `unit`; null for a range")
    low: float | None = Field(description="lower end of a range; null with a standard deviation")
    high: float | None = Field(description="upper end of a range; null with a standard deviation")
    unit: str = Field(description="`m`, or empty for a dimensionless number")


class AssessInputsRecord(PartRecord):
    """The inputs of the assessment, as the patient file gave them."""

    title: str = Field(description="name of the case; may be empty")
    file: str = Field(description="name of the patient's file")
    measured: dict[str, MeasuredRecord] = Field(
        description="measured numbers, by their names in the file"
    )
    material: str = Field(description="name of the material of the wall")
    place: str | None = Field(description="place of the stone in the ureter, if known")
    limit_kPa: float = Field(description="pressure limit")
    limit_source: str = Field(description="meaning and source of the limit")
    samples: int = Field(description="number of Monte Carlo samples")
    seed: int = Field(description="seed of the samples")


class SurfaceAccuracyRecord(PartRecord):
    """The accuracy of the samples and of their critical pressures."""

    possible: float = Field(description="fraction of the draws that describe a possible wall")
    solves: int = Field(
        description="number of solved cases; 0 if a surrogate of the package covers the inputs"
    )
    surface_error: float = Field(
        description=(
            "95th percentile of the relative error of P_ucr of the samples: of the response "
            "surface by leaving out one case at a time, or of the surrogate by held-out cases"
        )
    )
    median_noise_kPa: float | None = Field(
        description=(
            "standard error of the median of P_ucr due to the number of samples, as if they were "
            "independent; null if it is not known"
        )
    )
    fraction_noise: float = Field(
        description="standard error of the fraction below the limit due to the number of samples"
    )


class AssessRecord(Record):
    """The assessment of one patient: intervals of pressures, and published cohorts."""

    outcome: str = Field(
        description="`MOVES`, or `NO_SOLUTION` if the model answers too few possible cases"
    )
    message: str = Field(description="the outcome as a sentence")
    critical_pressure_kPa: PressureRangeRecord | None = Field(
        description="median and 90 % interval of P_ucr"
    )
    critical_pressure_at_values_kPa: float | None = Field(
        description="P_ucr at the measured values"
    )
    at_values: AnswerRecord | None = Field(
        description=(
            "solved answer at the measured values, except that the wall has the stiffness of "
            "the material and the confining pressure is divided by the measured relative "
            "stiffness s; P_ucr at the measured values is s times the pressure of this answer; "
            "null if nothing was solved, because a surrogate of the package covers the inputs"
        )
    )
    present_pressure_kPa: PressureRangeRecord | None = Field(
        description="present urine pressure P_u; null if no dilated segment was measured"
    )
    critical_below_limit: FractionRecord | None = Field(
        description="fraction of samples whose P_ucr is below the pressure limit"
    )
    critical_below_limit_where_held: FractionRecord | None = Field(
        description=(
            "this fraction among the samples in which the stone is larger than the lumen; null if "
            "these are too few"
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
        description="Sobol' total index of each input for the rank of P_ucr, in descending order"
    )
    by_size: list[SizeFractionRecord] = Field(
        description="fraction below the limit for other sizes of the stone"
    )
    cohorts: list[CohortRecord] = Field(
        description="published passage rates of stones of this size and place"
    )
    inputs: AssessInputsRecord = Field(description="measurements and settings of the assessment")
    accuracy: SurfaceAccuracyRecord = Field(
        description="accuracy of the samples and of their critical pressures"
    )
    level: float = Field(description="probability level of the intervals")
    cannot_decide: list[str] = Field(
        description="questions that these measurements do not decide, as sentences"
    )
    decided: list[str] = Field(
        description="questions that they decide within the model, as sentences"
    )
    warnings: list[CautionRecord] = Field(
        description="assumptions, extrapolations and contradictions"
    )
    caution: str = Field(description="limits of the meaning of the fractions")


def assess_record(found: Assessment, file: str) -> AssessRecord:
    """Make the record of an assessment.

    Parameters
    ----------
    found : Assessment
        The assessment.
    file : str
        Name of the patient file.
    """
    asked = decisions(found)
    return AssessRecord(
        outcome=found.outcome.name,
        message=found.message,
        critical_pressure_kPa=_range(found.critical),
        critical_pressure_at_values_kPa=kilo(found.central),
        at_values=None if found.at_values is None else answer_record(found.at_values),
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
        cannot_decide=[each.sentence for each in asked if not each.decided],
        decided=[each.sentence for each in asked if each.decided],
        warnings=warning_records(found.warnings),
        caution=CAUTION,
    )


def _inputs(found: Assessment, file: str) -> AssessInputsRecord:
    patient = found.patient
    return AssessInputsRecord(
        title=patient.title,
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
        count=row.count,
        passed_low=None if row.interval is None else row.interval[0],
        passed_high=None if row.interval is None else row.interval[1],
        days=row.days,
        model=_fraction(beside),
        comparison="" if row.passed is None else contradiction(row.passed, beside),
    )


def _range(found: PercentileRange | None) -> PressureRangeRecord | None:
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
