"""Monte Carlo samples of a patient's measurements that describe a possible wall."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.clinic.patient import Patient
from stonepass.errors import BadInput
from stonepass.model.ureter import WALL_RATIO
from stonepass.studies.conditions import Conditions
from stonepass.studies.sampling import Draws, draw

__all__ = ["conditions", "draw_patient", "held_wall_ratio"]

FEWEST = 100  # smallest number of accepted samples


def draw_patient(patient: Patient) -> tuple[Draws, float]:
    """Draw samples of all inputs of a patient.

    A sample is rejected if its wall ratio is outside the bounds of a case. If both diameters of the
    dilated segment were measured, it is accepted with a probability proportional to the likelihood
    of its outer diameter, given the constant volume of the wall. If few samples are accepted, more
    are drawn.

    Parameters
    ----------
    patient : Patient
        The measured quantities, the number of samples and the seed.

    Returns
    -------
    draws : mapping of str to array (n)
        The inputs by their names in `patient.INPUTS`, in SI units. n is at most
        `patient.samples`.
    possible : float
        Fraction of all drawn samples whose wall ratio is possible, 0 to 1.

    Raises
    ------
    BadInput
        Fewer than 100 samples are accepted, or both diameters of the dilated segment are given and
        the outer one is exact.

    References
    ----------
    docs/assess.md, "What is done".
    """

    def keep(draws: Draws, chance: Float[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
        if "dilated_outer_diameter" not in draws:
            return _possible(draws)
        return _possible(draws) & (chance < _agreement(patient, draws))

    draws, kept = draw(patient.measured, patient.samples, patient.seed, keep)
    if kept.sum() < FEWEST:
        raise BadInput(
            "number of Monte Carlo samples whose diameters are consistent with a constant volume "
            "of the wall",
            f"{kept.sum()} of {len(kept)}",
            f"at least {FEWEST}",
            "check the diameters and their uncertainties",
        )
    chosen = {name: values[kept][: patient.samples] for name, values in draws.items()}
    return chosen, float(_possible(draws).mean())


def conditions(draws: Draws) -> Conditions:
    """Return size ratio, wall ratio, friction and load factor of samples.

    A wall that is s times as stiff as the material is computed with the stiffness of the material
    under the load P_out/s, so that the load factor is 1/s (docs/theory.md, "A stiffer wall").
    """
    return Conditions(
        draws["stone_diameter"] / draws["inner_diameter"],
        held_wall_ratio(draws),
        draws["friction"],
        1.0 / draws["stiffness"],
    )


def held_wall_ratio(draws: Draws) -> Float[np.ndarray, " n"]:
    """Return the wall ratio η of samples, clipped to the bounds of a case."""
    return np.clip(_wall_ratio(draws), *WALL_RATIO)


def _possible(draws: Draws) -> Bool[np.ndarray, " n"]:
    wall = _wall_ratio(draws)
    return (wall >= WALL_RATIO[0]) & (wall <= WALL_RATIO[1])


def _wall_ratio(draws: Draws) -> Float[np.ndarray, " n"]:
    inner = draws["inner_diameter"]
    if "outer_diameter" in draws:
        return draws["outer_diameter"] / inner
    return 1.0 + 2.0 * draws["wall_thickness"] / inner


def _agreement(patient: Patient, draws: Draws) -> Float[np.ndarray, " n"]:
    """Return the relative likelihood of the measured outer diameter of the dilated segment.

    The outer diameter of a sample follows from its inner diameter and the constant volume of the
    wall. The likelihood is 1 if it is equal to the measured one.
    """
    inner = draws["inner_diameter"]
    section = (_wall_ratio(draws) ** 2 - 1.0) * inner**2 / patient.load.prestretch
    outer = np.sqrt(np.maximum(draws["dilated_inner_diameter"] ** 2 + section, 0.0))
    measured = patient.measured["dilated_outer_diameter"]
    if measured.sd is None:
        return ((outer >= measured.low) & (outer <= measured.high)).astype(float)
    if measured.sd == 0.0:
        raise BadInput("dilated outer diameter", "exact", "uncertain if the dilated inner diameter "
                       "is given too", "give its uncertainty, or only one of both"
                       )  # fmt: skip
    return np.exp(-0.5 * ((outer - measured.value) / measured.sd) ** 2)
