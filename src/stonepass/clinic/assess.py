"""From one patient's measurements to an assessment, by Monte Carlo samples.

Inputs are drawn from what was measured (a scrambled Sobol sequence, fixed seed), kept where the
wall they describe could exist, and answered by a response surface through solved cases
(docs/assess.md).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.clinic.assessment import Assessment
from stonepass.clinic.assessment_warnings import assessment_warnings
from stonepass.clinic.cohorts import Row, rows_for
from stonepass.clinic.draws import conditions, draw_patient, held_wall_ratio
from stonepass.clinic.fractions import Fraction, Present, Samples, interval, median_noise
from stonepass.clinic.patient import INPUTS, Patient
from stonepass.errors import Outcome
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.far_field import confining_traction
from stonepass.studies.case_solver import CaseSolver, JobSolver
from stonepass.studies.conditions import lumen_ratios, transmural
from stonepass.studies.response import OVERSIZE, ResponseSurface, response_surface
from stonepass.studies.sampling import Draws
from stonepass.studies.sensitivity_indices import SensitivityIndex, rank_sensitivity

__all__ = ["assess"]

WIDEST = 1.0 + OVERSIZE[1]  # opening beyond which the present pressure is only known to exceed it
SIZES = np.arange(1.0, 10.01, 0.5)  # mm, of fractions by size
NOT_OF_RESISTANCE = ("dilated_inner_diameter", "dilated_outer_diameter")
MOST_LOST = 0.5  # of the samples may be next to a case without an answer


def assess(patient: Patient, solver: CaseSolver | None = None) -> Assessment:
    """Assess one patient.

    Parameters
    ----------
    patient : Patient
    solver : CaseSolver, optional
        By default the cases are solved in this process, without a cache.

    Raises
    ------
    BadInput
        An unstable material, or measurements that hardly any wall could have together.
    """
    solver = solver or JobSolver(progress=True)
    check(patient.material)
    case = patient.case()
    draws, possible = draw_patient(patient)
    at_values = solver.answers([case])[0]
    under_load = replace(case, load=patient.load)  # each sample divides it by its own stiffness
    present = _present(patient, under_load, draws)
    surface = response_surface(under_load, conditions(draws), solver)
    known = Assessment(
        patient=patient,
        outcome=Outcome.NO_SOLUTION,
        message="",
        at_values=at_values,
        cohorts=_cohorts(patient),
        present=None if present is None else interval(present.pressure, present.censored),
        at_present=present,
        possible=possible,
        solves=surface.tried + 1,
    )
    samples = _samples(surface, draws) if surface.usable else None
    if samples is None or float(np.mean(samples.censored & (samples.critical == 0.0))) > MOST_LOST:
        return replace(known, message=_lost(surface), warnings=assessment_warnings(known))
    below = samples.below(patient.limit)
    found = replace(
        known,
        outcome=Outcome.MOVES,
        critical=interval(samples.critical, samples.censored),
        median_noise=median_noise(samples.critical, samples.censored),
        below_limit=below,
        below_present=None if present is None else samples.below(present),
        loose=float(np.mean(samples.loose)),
        sensitivity=_sensitivity(patient, surface, samples),
        by_size=_by_size(patient, surface, draws),
        samples=samples,
        surface_error=float(np.quantile(surface.errors, 0.95)),
    )
    return replace(found, message=_headline(found, below), warnings=assessment_warnings(found))


def _headline(found: Assessment, below: Fraction) -> str:
    """Say the fraction below the limit, of the samples in which the stone is held at all."""
    pressure = f"{found.patient.limit / 1e3:.4g} kPa"
    limit = f"the critical pressure is below the pressure limit, {pressure}"
    if found.loose == 0.0:
        return f"In {below.describe()} of the Monte Carlo samples {limit}."
    apart, held = Fraction(found.loose, found.loose).describe(), found.below_limit_held
    if held is None:
        return f"In {apart} of the Monte Carlo samples the stone is no larger than the lumen."
    return (
        f"In {held.describe()} of the Monte Carlo samples in which the stone is held {limit}; in "
        f"{apart} of all samples it is no larger than the lumen, and so not held."
    )


def _lost(surface: ResponseSurface) -> str:
    """Why too few cases have an answer."""
    lost = f"{len(surface.lost.friction)} of {surface.tried} cases that the inputs span"
    return f"{Outcome.NO_SOLUTION.value} for {lost}; mostly: {surface.reason}."


def _critical(
    surface: ResponseSurface, draws: Draws
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """P_ucr in Pa of many draws, s P_ucr(P_out/s) for a wall s times as stiff; where censored."""
    found, censored = surface(conditions(draws))
    return draws["stiffness"] * found, censored


def _samples(surface: ResponseSurface, draws: Draws) -> Samples:
    critical, censored = _critical(surface, draws)
    at = conditions(draws)
    lumen = lumen_ratios(surface.case, at.wall_ratio, at.load_factor)
    loose = at.size_ratio <= lumen
    return Samples(critical, censored, loose, at.size_ratio, 1e3 * draws["stone_diameter"])


def _present(patient: Patient, case: Case, draws: Draws) -> Present | None:
    """Urine pressure by the far field at the dilated diameter; None where it was not measured."""
    if not patient.dilated:
        return None
    wall = held_wall_ratio(draws)
    opening = draws["dilated_inner_diameter"] / draws["inner_diameter"]
    held = np.minimum(opening, WIDEST)
    across = draws["stiffness"] * transmural(case, held, wall)
    outside = np.asarray(confining_traction(held, wall, patient.load))
    # No lower than what keeps the tube open: a narrower one was not measured, but misread.
    return Present(np.maximum(across, 0.0) + outside, opening > WIDEST, opening)


def _sensitivity(
    patient: Patient, surface: ResponseSurface, samples: Samples
) -> tuple[SensitivityIndex, ...]:
    """Total indices of the inputs that resistance depends on, for the rank of P_ucr."""
    uncertain = {
        name: each
        for name, each in patient.measured.items()
        if not each.exact and name not in NOT_OF_RESISTANCE
    }

    def critical(draws: Draws) -> Float[np.ndarray, " n"]:
        count = len(next(iter(draws.values())))
        others = {name: np.full(count, each.value) for name, each in patient.measured.items()}
        return _critical(surface, {**others, **draws})[0]

    found = rank_sensitivity(critical, uncertain, samples.critical, patient.seed)
    return tuple(replace(each, name=INPUTS[each.name]) for each in found)


def _by_size(
    patient: Patient, surface: ResponseSurface, draws: Draws
) -> tuple[tuple[float, Fraction], ...]:
    found = []
    for size in SIZES:
        fixed = {**draws, "stone_diameter": np.full(len(draws["friction"]), size / 1e3)}
        critical, censored = _critical(surface, fixed)
        less = critical < patient.limit
        certain = float(np.mean(less & ~censored))
        found.append((float(size), Fraction(certain, float(np.mean(less)))))
    return tuple(found)


def _cohorts(patient: Patient) -> tuple[Row, ...]:
    stone = patient.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    low, high = 1e3 * (stone.value - spread), 1e3 * (stone.value + spread)
    return tuple(rows_for(low, high, patient.place))
