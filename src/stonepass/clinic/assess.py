"""Assessment of one patient's stone by Monte Carlo samples of the measured quantities.

Samples of the inputs follow a scrambled Sobol sequence with a fixed seed. Samples that describe no
possible wall are rejected. The critical pressures of the other samples come from a surrogate of the
package, or from a response surface through solved cases if no surrogate covers them
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
from stonepass.clinic.patient import INPUTS, Patient
from stonepass.clinic.samples import Present, Samples
from stonepass.errors import Outcome
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.far_field import confining_traction
from stonepass.studies.case_solver import CaseSolver, JobSolver
from stonepass.studies.censored_samples import Fraction, fraction_below, interval, median_noise
from stonepass.studies.conditions import lumen_ratios, transmural
from stonepass.studies.critical_pressures import CriticalPressures
from stonepass.studies.response import OVERSIZE, ResponseSurface, response_surface
from stonepass.studies.sampling import Draws
from stonepass.studies.sensitivity_indices import SensitivityIndex, rank_sensitivity
from stonepass.studies.surrogates.covering import covering_surrogate

__all__ = ["assess"]

# Largest r_a/R_a at which the present pressure is computed. In wider samples the pressure at this
# radius is a lower bound.
WIDEST = 1.0 + OVERSIZE[1]
SIZES = np.arange(1.0, 10.01, 0.5)  # stone diameters in mm at which the fraction is computed
SAMPLES = "the simulated input combinations"  # name of the samples in sentences
# Inputs without influence on the critical pressure.
NOT_OF_RESISTANCE = ("dilated_inner_diameter", "dilated_outer_diameter")
MOST_LOST = 0.5  # largest fraction of samples whose nearest case has no answer


def assess(
    patient: Patient, solver: CaseSolver | None = None, *, surrogates: bool = True
) -> Assessment:
    """Assess the stone of one patient.

    Parameters
    ----------
    patient : Patient
        Measured quantities with their uncertainties, and the pressure limit.
    solver : CaseSolver, optional
        Solves about fifty cases if no surrogate of the package covers the inputs; by default in
        this process, without a cache.
    surrogates : bool
        False if the cases are solved although a surrogate covers them.

    Returns
    -------
    Assessment
        Its outcome is NO_SOLUTION if the model has an answer for too few of the possible cases.

    Raises
    ------
    BadInput
        The material is unstable, the model does not use finite elements, or fewer than 100 samples
        of the measurements describe a possible wall (see `draws.draw_patient`).

    References
    ----------
    Liu et al. 2022, section 4; docs/assess.md, "What is done".
    """
    check(patient.material)
    draws, possible = draw_patient(patient)
    # `conditions` divides the confining pressure of each sample by the stiffness of that sample.
    under_load = replace(patient.case(), load=patient.load)
    at = conditions(draws)
    present = _present(patient, under_load, draws)
    known = Assessment(
        patient=patient,
        outcome=Outcome.NO_SOLUTION,
        message="",
        cohorts=_cohorts(patient),
        present=None if present is None else interval(present.pressure, present.censored),
        at_present=present,
        possible=possible,
    )
    source = covering_surrogate(under_load, at) if surrogates else None
    if source is not None:
        return _assessed(known, source, draws)
    solver = solver or JobSolver(progress=True)
    at_values = solver.answers([patient.case()])[0]
    surface = response_surface(under_load, at, solver)
    known = replace(known, at_values=at_values, solves=surface.tried + 1, message=_lost(surface))
    if not surface.usable:
        return replace(known, warnings=assessment_warnings(known))
    return _assessed(known, surface, draws)


def _assessed(known: Assessment, source: CriticalPressures, draws: Draws) -> Assessment:
    """Return the assessment with the critical pressures of all samples."""
    patient, present = known.patient, known.at_present
    samples = _samples(source, draws)
    if float(np.mean(samples.censored & (samples.critical == 0.0))) > MOST_LOST:
        return replace(known, warnings=assessment_warnings(known))
    below = samples.below(patient.limit)
    found = replace(
        known,
        outcome=Outcome.MOVES,
        central=_central(known, source),
        critical=interval(samples.critical, samples.censored),
        median_noise=median_noise(samples.critical, samples.censored),
        below_limit=below,
        below_present=None if present is None else samples.below(present),
        loose=float(np.mean(samples.loose)),
        sensitivity=_sensitivity(patient, source, samples),
        by_size=_by_size(patient, source, draws),
        samples=samples,
        surface_error=source.error,
    )
    return replace(found, message=_headline(found, below), warnings=assessment_warnings(found))


def _headline(found: Assessment, below: Fraction) -> str:
    """Return the outcome as a sentence: the fraction below the limit where the stone is held."""
    pressure = f"{found.patient.limit / 1e3:.4g} kPa"
    limit = f"the critical pressure is below the limit of {pressure}"
    if found.loose == 0.0:
        return f"In {below.describe()} of {SAMPLES} {limit}."
    apart, held = Fraction(found.loose, found.loose).describe(), found.below_limit_held
    if held is None:
        return f"In {apart} of {SAMPLES} the stone is no larger than the lumen."
    return (
        f"In {held.describe()} of {SAMPLES} in which the stone is held, {limit}; in {apart} of all "
        "combinations the stone is no larger than the lumen and is not held."
    )


def _lost(surface: ResponseSurface) -> str:
    """Return the outcome as a sentence if too few cases have an answer."""
    lost = f"{len(surface.lost.friction)} of {surface.tried} cases in the range of the inputs"
    return f"{Outcome.NO_SOLUTION.value} for {lost}; the most frequent reason: {surface.reason}."


def _critical(
    source: CriticalPressures, draws: Draws
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """Return P_ucr in Pa of n samples, and which values are only lower bounds.

    For a wall that is s times as stiff P_ucr is s P_ucr(P_out/s), see "A stiffer wall" in
    docs/theory.md.
    """
    found, censored = source(conditions(draws))
    return draws["stiffness"] * found, censored


def _samples(source: CriticalPressures, draws: Draws) -> Samples:
    critical, censored = _critical(source, draws)
    at = conditions(draws)
    lumen = lumen_ratios(source.case, at.wall_ratio, at.load_factor)
    loose = at.size_ratio <= lumen
    return Samples(critical, censored, loose, at.size_ratio, 1e3 * draws["stone_diameter"])


def _present(patient: Patient, case: Case, draws: Draws) -> Present | None:
    """Return the present urine pressure of the samples from the dilated diameter and the far field.

    None is returned if the dilated segment was not measured.
    """
    if not patient.dilated:
        return None
    wall = held_wall_ratio(draws)
    opening = draws["dilated_inner_diameter"] / draws["inner_diameter"]
    held = np.minimum(opening, WIDEST)
    across = draws["stiffness"] * transmural(case, held, wall)
    outside = np.asarray(confining_traction(held, wall, patient.load))
    # A dilated segment that is narrower than the tube at rest is a measuring error, so that the
    # transmural pressure is at least 0.
    return Present(np.maximum(across, 0.0) + outside, opening > WIDEST, opening)


def _central(known: Assessment, source: CriticalPressures) -> float | None:
    """Return P_ucr in Pa at the measured values: by a solve if there is one, else by the source."""
    measured = known.patient.measured
    if known.at_values is not None:
        pressure = known.at_values.pressure
        return None if pressure is None else measured["stiffness"].value * pressure
    values = {name: np.array([each.value]) for name, each in measured.items()}
    critical, censored = _critical(source, values)
    return None if censored[0] else float(critical[0])


def _sensitivity(
    patient: Patient, source: CriticalPressures, samples: Samples
) -> tuple[SensitivityIndex, ...]:
    """Return the total sensitivity indices of the inputs for the rank of P_ucr."""
    uncertain = {
        name: each
        for name, each in patient.measured.items()
        if not each.exact and name not in NOT_OF_RESISTANCE
    }

    def critical(draws: Draws) -> Float[np.ndarray, " n"]:
        count = len(next(iter(draws.values())))
        others = {name: np.full(count, each.value) for name, each in patient.measured.items()}
        return _critical(source, {**others, **draws})[0]

    found = rank_sensitivity(critical, uncertain, samples.critical, patient.seed)
    return tuple(replace(each, name=INPUTS[each.name]) for each in found)


def _by_size(
    patient: Patient, source: CriticalPressures, draws: Draws
) -> tuple[tuple[float, Fraction], ...]:
    found = []
    for size in SIZES:
        fixed = {**draws, "stone_diameter": np.full(len(draws["friction"]), size / 1e3)}
        critical, censored = _critical(source, fixed)
        found.append((float(size), fraction_below(critical, censored, patient.limit)))
    return tuple(found)


def _cohorts(patient: Patient) -> tuple[Row, ...]:
    stone = patient.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    low, high = 1e3 * (stone.value - spread), 1e3 * (stone.value + spread)
    return tuple(rows_for(low, high, patient.place))
