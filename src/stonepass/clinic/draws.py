"""Random draws of the measurements of a patient; draws of impossible walls are left out."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.clinic.patient import Patient
from stonepass.errors import BadInput
from stonepass.model.ureter import WALL_RATIO
from stonepass.studies.conditions import Conditions
from stonepass.studies.sampling import Draws, draw

__all__ = ["conditions", "draw_patient", "held_wall_ratio"]

FEWEST = 100  # samples that are possible


def draw_patient(patient: Patient) -> tuple[Draws, float]:
    """Draw every input of a patient.

    If both diameters of the dilated segment were measured, a draw is kept with the likelihood of
    its outer diameter, which the volume of the wall determines. If few draws are kept, more are
    made.

    Returns
    -------
    draws : mapping of str to array (n)
        The inputs by their names in `patient.INPUTS`, in SI units; n is at most
        `patient.samples`.
    possible : float
        Fraction of all draws whose wall ratio a ureter can have.

    Raises
    ------
    BadInput
        Almost no wall is compatible with these measurements.
    """

    def keep(draws: Draws, chance: Float[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
        if "dilated_outer_diameter" not in draws:
            return _possible(draws)
        return _possible(draws) & (chance < _agreement(patient, draws))

    draws, kept = draw(patient.measured, patient.samples, patient.seed, keep)
    if kept.sum() < FEWEST:
        raise BadInput(
            "diameters",
            f"such that {kept.sum()} of {len(kept)} draws agree with one another",
            f"such that a wall of constant volume may have them, in at least {FEWEST} draws",
            "check them and their uncertainties",
        )
    chosen = {name: values[kept][: patient.samples] for name, values in draws.items()}
    return chosen, float(_possible(draws).mean())


def conditions(draws: Draws) -> Conditions:
    """Return ξ, η, friction and load factor of draws.

    A wall s times as stiff under P_out is answered as one of the material's own stiffness under
    P_out/s, so the load factor is 1/s.
    """
    return Conditions(
        draws["stone_diameter"] / draws["inner_diameter"],
        held_wall_ratio(draws),
        draws["friction"],
        1.0 / draws["stiffness"],
    )


def held_wall_ratio(draws: Draws) -> Float[np.ndarray, " n"]:
    """Return the wall ratio η, held to the bounds that a case may have."""
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
    """Return the likelihood of the measured outer diameter of the dilated segment.

    The wall's volume gives the outer diameter from the inner one. The likelihood is relative to
    that of a perfect agreement.
    """
    inner = draws["inner_diameter"]
    section = (_wall_ratio(draws) ** 2 - 1.0) * inner**2 / patient.load.prestretch
    outer = np.sqrt(np.maximum(draws["dilated_inner_diameter"] ** 2 + section, 0.0))
    measured = patient.measured["dilated_outer_diameter"]
    if measured.sd is None:
        return ((outer >= measured.low) & (outer <= measured.high)).astype(float)
    if measured.sd == 0.0:
        raise BadInput("dilated outer diameter", "exact", "uncertain beside the inner one",
                       "give its uncertainty, or leave one of the two out")  # fmt: skip
    return np.exp(-0.5 * ((outer - measured.value) / measured.sd) ** 2)
