"""The result of an assessment: intervals of pressures, fractions of samples, published cohorts.

The result is never a yes or no, but an interval and a fraction of the Monte Carlo samples. The
function `clinic.assess.assess` computes it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool
from stonepass.caution import Caution
from stonepass.clinic.cohorts import Row
from stonepass.clinic.patient import Patient
from stonepass.clinic.samples import Present, Samples
from stonepass.errors import Outcome
from stonepass.model.answer import Answer
from stonepass.result import Result
from stonepass.studies.censored_samples import Fraction, PercentileRange
from stonepass.studies.sensitivity_indices import SensitivityIndex

__all__ = ["Assessment"]

FEWEST_OF_A_CLASS = 30  # smallest number of samples for which a fraction is computed


@array_dataclass
@dataclass(frozen=True, repr=False)
class Assessment(Result):
    """The assessment of one patient's stone.

    Attributes
    ----------
    patient : Patient
        The measured quantities.
    outcome : Outcome
        MOVES, or NO_SOLUTION if the model has an answer for too few of the possible cases.
    message : str
        The outcome as a sentence.
    cohorts : tuple of Row
        Published passage rates of stones of this size and place.
    at_values : Answer or None
        Answer at the measured values, except that the wall has the stiffness of the material, and
        the confining pressure is divided by the measured relative stiffness s. P_ucr at the
        measured values is s times the pressure of this answer. It is None if nothing was solved,
        because a surrogate of the package covers the inputs.
    central : float or None
        P_ucr in Pa at the measured values; None if it is not known.
    critical : PercentileRange or None
        Median and 90 % interval of the critical pressure P_ucr in Pa.
    present : PercentileRange or None
        Median and 90 % interval of the present urine pressure in Pa; None if the dilated segment
        was not measured.
    below_limit : Fraction or None
        Fraction of samples with P_ucr below the pressure limit.
    below_present : Fraction or None
        Fraction of samples with P_ucr below the present pressure.
    loose : float
        Fraction of samples in which the stone is not larger than the lumen, so that P_ucr = 0.
    sensitivity : tuple of SensitivityIndex
        Sobol' total indices for the rank of P_ucr, in descending order.
    by_size : tuple of (float, Fraction)
        Stone diameters in mm, and the fraction below the limit if the stone had this diameter.
    median_noise : float or None
        Standard error of the median of P_ucr in Pa that is due to the number of samples.
    samples : Samples or None
        The samples; None if the model has an answer for too few cases.
    at_present : Present or None
        Present urine pressure of the samples.
    possible : float
        Fraction of the drawn samples that describe a possible wall, 0 to 1.
    solves : int
        Number of solved cases; 0 if a surrogate of the package covers the inputs.
    surface_error : float
        95th percentile of the relative error of P_ucr of the samples: of the response surface by
        leaving out one case at a time, or of the surrogate by held-out cases.
    warnings : tuple of Caution
        Warnings about assumptions, extrapolation and contradictions.

    References
    ----------
    docs/assess.md, "What is done".
    """

    patient: Patient
    outcome: Outcome
    message: str
    cohorts: tuple[Row, ...]
    at_values: Answer | None = None
    central: float | None = None
    critical: PercentileRange | None = None
    present: PercentileRange | None = None
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
        """Return the fraction of samples below the limit that corresponds to a row of a cohort.

        For a size class only samples with a stone of this class count; None is returned for fewer
        than 30 of them. For a place in the ureter all samples count.
        """
        if row.sizes is None or self.samples is None:
            return self.below_limit
        low, high = row.sizes
        return self._below_limit_among(
            (self.samples.diameter >= low) & (self.samples.diameter < high)
        )

    @property
    def below_limit_held(self) -> Fraction | None:
        """Fraction below the limit among the samples in which the stone is larger than the lumen.

        It is None if there are fewer than 30 such samples.
        """
        return None if self.samples is None else self._below_limit_among(~self.samples.loose)

    def _below_limit_among(self, chosen: Bool[np.ndarray, " n"]) -> Fraction | None:
        assert self.samples is not None
        if chosen.sum() < FEWEST_OF_A_CLASS:
            return None
        return self.samples.below(self.patient.limit, chosen)

    @property
    def fraction_noise(self) -> float:
        """Standard error of the fraction below the limit that is due to the number of samples.

        It is 0 if there is no such fraction.
        """
        return 0.0 if self.below_limit is None else self.below_limit.noise(self.patient.samples)
