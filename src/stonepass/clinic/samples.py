"""Monte Carlo samples of one patient: critical pressure and present urine pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.studies.censored_samples import Fraction, fraction_below

__all__ = ["Present", "Samples"]


@array_dataclass
@dataclass(frozen=True)
class Present:
    """Present urine pressure of n samples, from the diameter of the dilated segment.

    Attributes
    ----------
    pressure : array (n)
        Urine pressure in Pa.
    censored : array (n) of bool
        True for a sample whose pressure is only a lower bound.
    opening : array (n)
        Radius ratio r_a/R_a of the dilated segment.

    References
    ----------
    docs/theory.md, "Far field".
    """

    pressure: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    opening: Float[np.ndarray, " n"]


@array_dataclass
@dataclass(frozen=True)
class Samples:
    """The n Monte Carlo samples of a patient.

    Attributes
    ----------
    critical : array (n)
        Critical pressure P_ucr in Pa.
    censored : array (n) of bool
        True for a sample whose P_ucr is only a lower bound.
    loose : array (n) of bool
        True for a sample in which the stone is not larger than the lumen, so that P_ucr = 0.
    size_ratio : array (n)
        Size ratio ξ.
    diameter : array (n)
        Diameter of the stone in mm.

    References
    ----------
    docs/assess.md, "What is done".
    """

    critical: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    loose: Bool[np.ndarray, " n"]
    size_ratio: Float[np.ndarray, " n"]
    diameter: Float[np.ndarray, " n"]

    def below(
        self, pressure: float | Present, chosen: Bool[np.ndarray, " n"] | None = None
    ) -> Fraction:
        """Return the fraction of samples whose P_ucr is below a pressure.

        Parameters
        ----------
        pressure : float or Present
            A pressure in Pa for all samples, or one for each sample.
        chosen : array (n) of bool, optional
            The samples that count; by default all of them.

        References
        ----------
        docs/assess.md, "What is done".
        """
        some = np.ones(len(self.critical), dtype=bool) if chosen is None else chosen
        critical, censored = self.critical[some], self.censored[some]
        if isinstance(pressure, Present):
            return fraction_below(
                critical, censored, pressure.pressure[some], pressure.censored[some]
            )
        return fraction_below(critical, censored, pressure)
