"""Arrays of the quantities that differ between many cases, and the far field of all of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

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
from stonepass.model.load import Load
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.units import Pressure

__all__ = ["Conditions", "case_at", "joined", "lumen_ratios", "transmural", "urine_pressures"]


@array_dataclass
@dataclass(frozen=True)
class Conditions:
    """The quantities that differ between n cases of one material, load and method.

    Attributes
    ----------
    size_ratio : array (n)
        Size ratio ξ = R_s/R_a.
    wall_ratio : array (n)
        Wall ratio η = R_b/R_a.
    friction : array (n)
        Friction coefficient μ_f.
    load_factor : array (n)
        Factor on the confining pressure of the common case.
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


def case_at(case: Case, at: Conditions, k: int) -> Case:
    """Return the k-th case of some conditions; material, load, model and numerics are kept."""
    load = Load(
        Pressure(at.load_factor[k] * case.load.confining_pressure),
        case.load.confinement,
        case.load.prestretch,
    )
    stone = Stone(None, float(at.friction[k]), float(at.size_ratio[k]), shape=case.stone.shape)
    ureter = Ureter(material=case.ureter.material, wall_ratio=float(at.wall_ratio[k]))
    return replace(case, stone=stone, ureter=ureter, load=load)


def joined(one: Conditions, other: Conditions) -> Conditions:
    """Return the rows of two sets of conditions, those of the first one first."""
    return Conditions(
        np.concatenate([one.size_ratio, other.size_ratio]),
        np.concatenate([one.wall_ratio, other.wall_ratio]),
        np.concatenate([one.friction, other.friction]),
        np.concatenate([one.load_factor, other.load_factor]),
    )


def transmural(
    case: Case, inner_ratio: Float[np.ndarray, " n"], wall_ratio: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Compute the transmural pressure of many tubes by the far field.

    Parameters
    ----------
    case : Case
        Its material, pre-stretch and model are used; the model decides whether the far field
        includes the ground matrix.
    inner_ratio : array (n)
        Inner radius ratio r_a/R_a.
    wall_ratio : array (n)
        Wall ratio η.

    Returns
    -------
    array (n)
        Pressure inside minus outside in Pa.

    References
    ----------
    Liu et al. 2022, Eq. 12; docs/theory.md, "Far field".
    """
    law = far_field_law(case, ground=case.model.far_field_ground)
    return np.asarray(inflation(inner_ratio, wall_ratio, law, case.load.prestretch))


def urine_pressures(
    case: Case,
    inner_ratio: Float[np.ndarray, " n"],
    wall_ratio: Float[np.ndarray, " n"],
    load_factor: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " n"]:
    """Compute the urine pressure that holds many tubes at an inner radius.

    The ground matrix of the law is included.

    Parameters
    ----------
    case : Case
        Its material and load are used.
    inner_ratio : array (n)
        Inner radius ratio r_a/R_a.
    wall_ratio : array (n)
        Wall ratio η.
    load_factor : array (n)
        Factor on the confining pressure of the case.

    Returns
    -------
    array (n)
        Urine pressure in Pa.

    References
    ----------
    Liu et al. 2022, Eq. 12; docs/theory.md, "Far field".
    """
    law, load = case.ureter.material.law, case.load
    across = np.asarray(inflation(inner_ratio, wall_ratio, law, load.prestretch))
    if load.confining_pressure == 0.0:
        return across
    return across + load_factor * np.asarray(confining_traction(inner_ratio, wall_ratio, load))


def lumen_ratios(
    case: Case, wall_ratio: Float[np.ndarray, " n"], load_factor: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Compute the lumen of many tubes under the load, without stone and urine pressure.

    Parameters
    ----------
    case : Case
        Its material and load are used.
    wall_ratio : array (n)
        Wall ratio η.
    load_factor : array (n)
        Factor on the confining pressure of the case.

    Returns
    -------
    array (n)
        Inner radius ratio r_a/R_a; NaN if the load closes the lumen.

    References
    ----------
    docs/theory.md, "Far field".
    """
    load = case.load
    if load.confining_pressure == 0.0 and load.prestretch == 1.0:
        return np.ones(len(wall_ratio))

    def urine(ratio: np.ndarray, eta: np.ndarray, factor: np.ndarray) -> np.ndarray:
        return urine_pressures(case, ratio, eta, factor)

    widest = 1.2 / np.sqrt(load.prestretch)
    ends = (np.full(len(wall_ratio), SMALLEST_LUMEN), np.full(len(wall_ratio), widest))
    found = elementwise.find_root(urine, ends, args=(wall_ratio, load_factor))
    return np.where(found.success, found.x, np.nan)
