"""The assessment of one patient as a value; `clinic.assess` computes it.

Its results are intervals of pressures and fractions of Monte Carlo samples, never a verdict.
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
    """The assessment of one patient.

    Attributes
    ----------
    patient : Patient
    outcome : Outcome
        MOVES; NO_SOLUTION if the model answers too few of the possible cases.
    message : str
    at_values : Answer
        The answer at the measured values, with its discretisation error, for the material's own
        stiffness under P_out over the given stiffness.
    cohorts : tuple of Row
        Rates of published cohorts for such stones.
    critical, present : Range or None
        P_ucr, and the present urine pressure if the dilated segment was measured.
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
        Standard error in Pa of the median of P_ucr due to the number of samples.
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

        For a size class it is the fraction among the samples whose stone belongs to the class, or
        None if they are too few. For a place it is the fraction of all samples.
        """
        if row.sizes is None or self.samples is None:
            return self.below_limit
        low, high = row.sizes
        return self._below_limit_among(
            (self.samples.diameter >= low) & (self.samples.diameter < high)
        )

    @property
    def below_limit_held(self) -> Fraction | None:
        """Fraction below the limit among the samples whose stone is larger than the lumen.

        It is None if these samples are too few.
        """
        return None if self.samples is None else self._below_limit_among(~self.samples.loose)

    def _below_limit_among(self, chosen: Bool[np.ndarray, " n"]) -> Fraction | None:
        assert self.samples is not None
        if chosen.sum() < FEWEST_OF_A_CLASS:
            return None
        return self.samples.below(self.patient.limit, chosen)

    @property
    def fraction_noise(self) -> float:
        """Standard error of the fraction below the limit due to the number of samples."""
        return 0.0 if self.below_limit is None else self.below_limit.noise(self.patient.samples)

    @property
    def central(self) -> float | None:
        """P_ucr in Pa at the measured values."""
        pressure = self.at_values.pressure
        return None if pressure is None else self.patient.measured["stiffness"].value * pressure
