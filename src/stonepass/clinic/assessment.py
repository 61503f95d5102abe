"""The assessment of one patient, as a value: what the pressures may be, beside what cohorts saw.

An answer is an interval and a fraction of Monte Carlo samples, never a verdict.
`clinic.assess` computes it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool
from stonepass.caution import Caution
from stonepass.clinic.cohorts import Row
from stonepass.clinic.fractions import Fraction, Present, Range, Samples
from stonepass.clinic.patient import Patient
from stonepass.errors import Outcome
from stonepass.model.answer import Answer
from stonepass.result import Result
from stonepass.studies.sensitivity_indices import SensitivityIndex

__all__ = ["Assessment"]

FEWEST_OF_A_CLASS = 30  # samples


@array_dataclass
@dataclass(frozen=True, repr=False)
class Assessment(Result):
    """What can be said of one patient.

    Attributes
    ----------
    patient : Patient
    outcome : Outcome
        MOVES; NO_SOLUTION where the model answers too few of the possible cases.
    message : str
    at_values : Answer
        The whole answer at the measured values themselves, with its solver error, for the
        material's own stiffness under P_out over the stiffness that was given.
    cohorts : tuple of Row
        What published cohorts say of such stones.
    critical, present : Range or None
        P_ucr, and the present urine pressure where the dilated segment was measured.
    below_limit, below_present : Fraction or None
        Fractions of samples with P_ucr below the pressure limit, and below the present pressure.
    loose : float
        Fraction of samples in which the stone is no larger than the lumen; they count with
        P_ucr = 0.
    sensitivity : tuple of SensitivityIndex
        Sensitivity indices of the rank of P_ucr, by the names in `patient.INPUTS`; largest first.
    by_size : tuple of (float, Fraction)
        Stone diameters in mm, and the fraction below the limit if the stone had that size.
    median_noise : float or None
        Standard error of the median of P_ucr by the number of samples, in Pa.
    samples : Samples or None
    at_present : Present or None
    possible : float
        Fraction of the draws that describe a possible wall.
    solves : int
    surface_error : float
        95th percentile of the surface's relative error, from leaving out one solve at a time.
    warnings : tuple of Caution
    """

    patient: Patient
    outcome: Outcome
    message: str
    at_values: Answer
    cohorts: tuple[Row, ...]
    critical: Range | None = None
    present: Range | None = None
    below_limit: Fraction | None = None
    below_present: Fraction | None = None
    loose: float = 0.0
    sensitivity: tuple[SensitivityIndex, ...] = ()
    by_size: tuple[tuple[float, Fraction], ...] = ()
    median_noise: float | None = None
    samples: Samples | None = None
    at_present: Present | None = None
    possible: float = 1.0
    solves: int = 0
    surface_error: float = 0.0
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return the interval of the critical pressure in one line."""
        found = self.critical
        if found is None:
            return f"{self.outcome.name}: {self.message}"
        low, median, high = (
            "unknown" if each is None else f"{each / 1e3:.3g}"
            for each in (found.low, found.median, found.high)
        )
        return f"{self.outcome.name}, P_ucr {median} kPa in the median, {low} to {high} kPa"

    def beside(self, row: Row) -> Fraction | None:
        """Return the model's fraction below the limit for the stones of a cohort's row.

        For a size class, of the samples whose stone belongs to it; None where they are too few.
        For a place, of all samples.
        """
        if row.sizes is None or self.samples is None:
            return self.below_limit
        low, high = row.sizes
        return self._below_limit_among(
            (self.samples.diameter >= low) & (self.samples.diameter < high)
        )

    @property
    def below_limit_held(self) -> Fraction | None:
        """Fraction below the limit among the samples in which the stone is held.

        It is held where it is larger than the lumen; None where that is so in too few samples.
        """
        return None if self.samples is None else self._below_limit_among(~self.samples.loose)

    def _below_limit_among(self, chosen: Bool[np.ndarray, " n"]) -> Fraction | None:
        assert self.samples is not None
        if chosen.sum() < FEWEST_OF_A_CLASS:
            return None
        return self.samples.below(self.patient.limit, chosen)

    @property
    def fraction_noise(self) -> float:
        """Standard error of the fraction below the limit by the number of samples."""
        return 0.0 if self.below_limit is None else self.below_limit.noise(self.patient.samples)

    @property
    def central(self) -> float | None:
        """P_ucr in Pa at the measured values themselves."""
        pressure = self.at_values.pressure
        return None if pressure is None else self.patient.measured["stiffness"].value * pressure
