"""Many cases of one material and method as columns, and their far field in one evaluation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import elementwise

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.model.case import Case
from stonepass.model.far_field import (
    SMALLEST_LUMEN,
    confining_traction,
    far_field_law,
    inflation,
)

__all__ = ["Conditions", "lumen_ratios", "transmural"]


@array_dataclass
@dataclass(frozen=True)
class Conditions:
    """What differs between many cases.

    Attributes
    ----------
    size_ratio : array (n)
        ξ.
    wall_ratio : array (n)
        η.
    friction : array (n)
    load_factor : array (n)
        Factor on the confining pressure of the case that they share.
    """

    size_ratio: Float[np.ndarray, " n"]
    wall_ratio: Float[np.ndarray, " n"]
    friction: Float[np.ndarray, " n"]
    load_factor: Float[np.ndarray, " n"]

    def where(self, chosen: Bool[np.ndarray, " n"]) -> Conditions:
        """Return the rows for which `chosen` is true."""
        return Conditions(
            self.size_ratio[chosen],
            self.wall_ratio[chosen],
            self.friction[chosen],
            self.load_factor[chosen],
        )


def transmural(
    case: Case, inner_ratio: Float[np.ndarray, " n"], wall_ratio: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return the pressure in Pa across many walls, by the far field of the case's method.

    Parameters
    ----------
    case : Case
        Material, pre-stretch and the far field of its model.
    inner_ratio : array (n)
        r_a/R_a.
    wall_ratio : array (n)
        η.
    """
    law = far_field_law(case, ground=case.model.far_field_ground)
    return np.asarray(inflation(inner_ratio, wall_ratio, law, case.load.prestretch))


def lumen_ratios(
    case: Case, wall_ratio: Float[np.ndarray, " n"], load_factor: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return r_a/R_a that the load leaves open in many walls; NaN where it closes them.

    Parameters
    ----------
    case : Case
        Material and load.
    wall_ratio : array (n)
        η.
    load_factor : array (n)
        Factor on the confining pressure of the case.
    """
    load, law = case.load, case.ureter.material.law
    if load.confining_pressure == 0.0 and load.prestretch == 1.0:
        return np.ones(len(wall_ratio))

    def urine(ratio: np.ndarray, eta: np.ndarray, factor: np.ndarray) -> np.ndarray:
        across = inflation(ratio, eta, law, load.prestretch)
        return np.asarray(across + factor * confining_traction(ratio, eta, load))

    widest = 1.2 / np.sqrt(load.prestretch)
    ends = (np.full(len(wall_ratio), SMALLEST_LUMEN), np.full(len(wall_ratio), widest))
    found = elementwise.find_root(urine, ends, args=(wall_ratio, load_factor))
    return np.where(found.success, found.x, np.nan)
