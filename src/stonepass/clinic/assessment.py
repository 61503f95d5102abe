"""The assessment of one person: what the pressures may be, given how well the inputs are known.

Inputs are drawn from what was measured (a scrambled Sobol sequence, fixed seed), kept where the
wall they describe could exist, and answered by a response surface through solved cases. So an
answer is an interval and a share, never a verdict (model: section 12).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float
from scipy.stats import qmc, sobol_indices

from stonepass.clinic.cohorts import Row, rows_for
from stonepass.clinic.patient import INPUTS, Patient
from stonepass.errors import BadInput, Outcome
from stonepass.materials.stability import check
from stonepass.model.answer import Answer
from stonepass.model.case import WALL_RATIO, Case
from stonepass.model.far_field import confining_traction
from stonepass.studies.jobs import PooledSolver, Solver
from stonepass.studies.response import (
    OVERSIZE,
    Conditions,
    ResponseSurface,
    lumen_ratios,
    response_surface,
    transmural,
)

__all__ = [
    "FEWER",
    "MORE",
    "Assessment",
    "Driver",
    "Range",
    "Samples",
    "Share",
    "assess",
    "contradiction",
]

INTERVAL = (0.05, 0.5, 0.95)
WIDEST = 1.0 + OVERSIZE[1]  # opening beyond which the present pressure is only known to exceed it
MORE_DRAWS = (0, 2, 4, 6)  # powers of two over the samples asked for
AGREE = 0.02  # of a quantile by lower bounds and without them: then it is told
FEWEST = 100  # samples that are possible
DRIVERS_SAMPLES = 1024
SIZES = np.arange(1.0, 10.01, 0.5)  # mm, of shares by size
NOT_OF_RESISTANCE = ("dilated_inner_diameter", "dilated_outer_diameter")
LARGE_ERROR = 0.05
SMALL_SHARE = 0.005  # not worth a sentence
FEW_POSSIBLE = 0.5
FEWEST_OF_A_CLASS = 30  # samples
MOST_LOST = 0.5  # of the samples may be next to a case without an answer
MORE, FEWER, NEAR = "more than the model expects", "fewer than the model expects", "near the model"
UNDECIDED = "the model does not decide"
FAR_APART = 0.2  # of two shares, to be called a contradiction

Draws = Mapping[str, Float[np.ndarray, " n"]]


@dataclass(frozen=True)
class Range:
    """Median and 90 % interval in Pa.

    An end that lies beyond what the model can tell is None; `at_least` is then what it exceeds.
    """

    low: float | None
    median: float | None
    high: float | None
    at_least: float | None = None


@dataclass(frozen=True)
class Share:
    """A share of the samples: at least `low`; at most `high` where some are not decided."""

    low: float
    high: float

    def told(self) -> str:
        """In words: ``60 %``, ``fewer than 1 %``, ``55 to 62 %`` where some are not decided."""
        low, high = (round(100.0 * each) for each in (self.low, self.high))
        if low != high:
            return f"{low} to {high} %"
        if low == 0:
            return "fewer than 1 %"
        return "more than 99 %" if low == 100 else f"{low} %"


@dataclass(frozen=True)
class Driver:
    """How much of the spread of P_ucr an input makes: Sobol's total index, of ranks."""

    name: str
    share: float


@dataclass(frozen=True)
class Present:
    """Urine pressure in Pa of every sample, and where that is only a lower bound.

    `opening` is r_a/R_a of the dilated segment.
    """

    pressure: Float[np.ndarray, " n"]
    bound: Bool[np.ndarray, " n"]
    opening: Float[np.ndarray, " n"]


@dataclass(frozen=True)
class Samples:
    """The possible ways to be: P_ucr in Pa, and where that is only a lower bound.

    `diameter` is the stone's in mm; `loose` where it is no larger than the lumen.
    """

    critical: Float[np.ndarray, " n"]
    bound: Bool[np.ndarray, " n"]
    loose: Bool[np.ndarray, " n"]
    size_ratio: Float[np.ndarray, " n"]
    diameter: Float[np.ndarray, " n"]

    def below(
        self, pressure: float | Present, chosen: Bool[np.ndarray, " n"] | None = None
    ) -> Share:
        """The share with P_ucr below a pressure, of all samples or of those `chosen`."""
        some = np.ones(len(self.critical), dtype=bool) if chosen is None else chosen
        if isinstance(pressure, Present):
            less = self.critical < pressure.pressure
            possible = less | pressure.bound
        else:
            less = possible = self.critical < pressure
        certain = less & ~self.bound
        return Share(float(np.mean(certain[some])), float(np.mean(possible[some])))


@dataclass(frozen=True)
class Assessment:
    """What can be said of one person.

    Attributes
    ----------
    person : Patient
    outcome : Outcome
        MOVES; NO_SOLUTION where the model answers too few of the possible cases.
    message : str
    at_values : Answer
        The whole answer at the measured values themselves, with its solver error, for the
        material's own stiffness under P_out over the stiffness that was given.
    critical, present : Range or None
        P_ucr, and the present urine pressure where the dilated segment was measured.
    below_limit, below_present : Share or None
        Of samples whose P_ucr is below the pressure limit, below the present pressure.
    loose : float
        Share of samples in which the stone is no larger than the lumen; they count with P_ucr = 0.
    drivers : tuple of Driver
        Largest first.
    by_size : tuple of (float, Share)
        Stone diameters in mm, and the share below the limit if the stone had that size.
    cohorts : tuple of Row
    samples : Samples or None
    at_present : Present or None
    possible : float
        Share of the draws that describe a possible wall.
    solves : int
    surface_error : float
        95th percentile of the surface's relative error, from leaving out one solve at a time.
    warnings : tuple of str
    """

    person: Patient
    outcome: Outcome
    message: str
    at_values: Answer
    cohorts: tuple[Row, ...]
    critical: Range | None = None
    present: Range | None = None
    below_limit: Share | None = None
    below_present: Share | None = None
    loose: float = 0.0
    drivers: tuple[Driver, ...] = ()
    by_size: tuple[tuple[float, Share], ...] = ()
    samples: Samples | None = None
    at_present: Present | None = None
    possible: float = 1.0
    solves: int = 0
    surface_error: float = 0.0
    warnings: tuple[str, ...] = ()

    def beside(self, row: Row) -> Share | None:
        """The model's share below the limit for the stones of a cohort's row.

        Of a size class: the samples whose stone belongs to it; None where they are too few. Of a
        place: all samples.
        """
        if row.sizes is None or self.samples is None:
            return self.below_limit
        low, high = row.sizes
        chosen = (self.samples.diameter >= low) & (self.samples.diameter < high)
        if chosen.sum() < FEWEST_OF_A_CLASS:
            return None
        return self.samples.below(self.person.limit, chosen)

    @property
    def central(self) -> float | None:
        """P_ucr in Pa at the measured values themselves."""
        pressure = self.at_values.pressure
        return None if pressure is None else self.person.measured["stiffness"].value * pressure


def contradiction(passed: float, share: Share | None) -> str:
    """Whether the share that passed lies far from the model's share below the limit."""
    if share is None:
        return ""
    if share.high - share.low > FAR_APART:
        return UNDECIDED
    if passed > share.high + FAR_APART:
        return MORE
    if passed < share.low - FAR_APART:
        return FEWER
    return NEAR


def assess(person: Patient, solver: Solver | None = None) -> Assessment:
    """Assess one person.

    Raises
    ------
    BadInput
        An unstable material, or measurements that hardly any wall could have together.
    """
    solver = solver or PooledSolver()
    check(person.material)
    case = person.case()
    drawn, possible = _drawn(person)
    at_values = solver.answers([case])[0]
    under_load = replace(case, load=person.load)  # each sample divides it by its own stiffness
    conditions = _conditions(person, drawn)
    present = _present(person, under_load, drawn)
    surface = response_surface(under_load, conditions, solver)
    known = Assessment(
        person=person,
        outcome=Outcome.NO_SOLUTION,
        message="",
        at_values=at_values,
        cohorts=_cohorts(person),
        present=None if present is None else _range(present.pressure, present.bound),
        at_present=present,
        possible=possible,
        solves=surface.tried + 1,
    )
    lost = f"{len(surface.lost.friction)} of {surface.tried} cases that the inputs span"
    samples = _samples(person, surface, drawn) if surface.usable else None
    if samples is None or float(np.mean(samples.bound & (samples.critical == 0.0))) > MOST_LOST:
        why = surface.reason.removeprefix(Outcome.NO_SOLUTION.value[:-1]).lstrip(": ")
        message = f"{Outcome.NO_SOLUTION.value[:-1]} for {lost}; mostly: {why}"
        return replace(known, message=message, warnings=_warnings(known))
    below = samples.below(person.limit)
    found = replace(
        known,
        outcome=Outcome.MOVES,
        message=(
            f"In {below.told()} of the ways in which the inputs may be, the critical pressure is "
            f"below the pressure limit, {person.limit / 1e3:.4g} kPa."
        ),
        critical=_range(samples.critical, samples.bound),
        below_limit=below,
        below_present=None if present is None else samples.below(present),
        loose=float(np.mean(samples.loose)),
        drivers=_drivers(person, surface, samples),
        by_size=_by_size(person, surface, drawn),
        samples=samples,
        surface_error=float(np.quantile(surface.errors, 0.95)),
    )
    return replace(found, warnings=_warnings(found))


def _drawn(person: Patient) -> tuple[Draws, float]:
    """Draws of every input that a wall could have, and which share of all draws they are.

    With both diameters of the dilated segment, draws are kept in proportion to how well the outer
    one meets the volume of the wall. Where few are kept more are drawn.
    """
    names = list(person.measured)
    tiny = np.finfo(float).eps
    power = int(np.ceil(np.log2(person.samples)))
    for more in MORE_DRAWS:
        engine = qmc.Sobol(len(names) + 1, seed=person.seed)
        unit = np.clip(engine.random_base2(power + more), tiny, 1.0 - tiny)
        drawn = {name: person.measured[name].drawn(unit[:, k]) for k, name in enumerate(names)}
        wall = _wall_ratio(drawn)
        possible = (wall >= WALL_RATIO[0]) & (wall <= WALL_RATIO[1])
        kept = possible
        if "dilated_outer_diameter" in drawn:
            kept = possible & (unit[:, -1] < _agreement(person, drawn))
        if kept.sum() >= person.samples:
            break
    if kept.sum() < FEWEST:
        raise BadInput(
            "diameters",
            f"such that {kept.sum()} of {len(kept)} draws agree with one another",
            f"such that a wall of constant volume may have them, in at least {FEWEST} draws",
            "check them and their uncertainties",
        )
    chosen = {name: values[kept][: person.samples] for name, values in drawn.items()}
    return chosen, float(possible.mean())


def _wall_ratio(drawn: Draws) -> Float[np.ndarray, " n"]:
    inner = drawn["inner_diameter"]
    if "outer_diameter" in drawn:
        return drawn["outer_diameter"] / inner
    return 1.0 + 2.0 * drawn["wall_thickness"] / inner


def _agreement(person: Patient, drawn: Draws) -> Float[np.ndarray, " n"]:
    """How likely the measured outer diameter of the dilated segment is, by the wall's volume.

    Over the likelihood of a perfect agreement.
    """
    inner = drawn["inner_diameter"]
    section = (_wall_ratio(drawn) ** 2 - 1.0) * inner**2 / person.load.prestretch
    outer = np.sqrt(np.maximum(drawn["dilated_inner_diameter"] ** 2 + section, 0.0))
    measured = person.measured["dilated_outer_diameter"]
    if measured.sd is None:
        return ((outer >= measured.low) & (outer <= measured.high)).astype(float)
    if measured.sd == 0.0:
        raise BadInput("dilated outer diameter", "exact", "uncertain beside the inner one",
                       "give its uncertainty, or leave one of the two out")  # fmt: skip
    return np.exp(-0.5 * ((outer - measured.value) / measured.sd) ** 2)


def _conditions(person: Patient, drawn: Draws) -> Conditions:
    return Conditions(
        drawn["stone_diameter"] / drawn["inner_diameter"],
        np.clip(_wall_ratio(drawn), *WALL_RATIO),
        drawn["friction"],
        1.0 / drawn["stiffness"],
    )


def _critical(
    person: Patient, surface: ResponseSurface, drawn: Draws
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """P_ucr in Pa of many draws: s P_ucr(P_out/s) for a wall s times as stiff."""
    found, bound = surface(_conditions(person, drawn))
    return drawn["stiffness"] * found, bound


def _samples(person: Patient, surface: ResponseSurface, drawn: Draws) -> Samples:
    critical, bound = _critical(person, surface, drawn)
    at = _conditions(person, drawn)
    lumen = lumen_ratios(surface.case, at.wall_ratio, at.load_factor)
    loose = at.size_ratio <= lumen
    return Samples(critical, bound, loose, at.size_ratio, 1e3 * drawn["stone_diameter"])


def _present(person: Patient, case: Case, drawn: Draws) -> Present | None:
    """Urine pressure by the far field at the dilated diameter; None where it was not measured."""
    if not person.dilated:
        return None
    wall = np.clip(_wall_ratio(drawn), *WALL_RATIO)
    opening = drawn["dilated_inner_diameter"] / drawn["inner_diameter"]
    held = np.minimum(opening, WIDEST)
    across = drawn["stiffness"] * transmural(case, held, wall)
    outside = np.asarray(confining_traction(held, wall, person.load))
    # No lower than what keeps the tube open: a narrower one was not measured, but misread.
    return Present(np.maximum(across, 0.0) + outside, opening > WIDEST, opening)


def _range(values: Float[np.ndarray, " n"], bound: Bool[np.ndarray, " n"]) -> Range:
    """Quantiles; one is told only where lower bounds, however far they are exceeded, leave it."""
    least = np.quantile(values, INTERVAL, method="higher")
    most = np.quantile(np.where(bound, np.inf, values), INTERVAL, method="higher")
    low, median, high = (
        float(other) if other <= (1.0 + AGREE) * known else None
        for known, other in zip(least, most, strict=True)
    )
    ends = (low, median, high)
    if None not in ends:
        return Range(low, median, high)
    return Range(low, median, high, float(least[ends.index(None)]))


def _drivers(person: Patient, surface: ResponseSurface, samples: Samples) -> tuple[Driver, ...]:
    """Sobol's total indices of the rank of P_ucr among the samples, which no tail can dominate."""
    names = [
        name
        for name, each in person.measured.items()
        if not each.exact and name not in NOT_OF_RESISTANCE
    ]
    if len(names) < 2:
        return tuple(Driver(INPUTS[name], 1.0) for name in names)
    ordered = np.sort(samples.critical)
    if ordered[0] == ordered[-1]:
        return ()

    def rank(inputs: Float[np.ndarray, "d n"]) -> Float[np.ndarray, " n"]:
        count = inputs.shape[1]
        drawn = {name: np.full(count, each.value) for name, each in person.measured.items()} | dict(
            zip(names, inputs, strict=True)
        )
        critical, _ = _critical(person, surface, drawn)
        return np.searchsorted(ordered, critical) / len(ordered)

    found = sobol_indices(
        func=rank,
        n=DRIVERS_SAMPLES,
        dists=[person.measured[name].distribution for name in names],
        rng=person.seed,
    )
    shares = np.clip(found.total_order, 0.0, 1.0)
    drivers = [Driver(INPUTS[n], float(s)) for n, s in zip(names, shares, strict=True)]
    return tuple(sorted(drivers, key=lambda each: -each.share))


def _by_size(
    person: Patient, surface: ResponseSurface, drawn: Draws
) -> tuple[tuple[float, Share], ...]:
    found = []
    for size in SIZES:
        fixed = {**drawn, "stone_diameter": np.full(len(drawn["friction"]), size / 1e3)}
        critical, bound = _critical(person, surface, fixed)
        less = critical < person.limit
        found.append((float(size), Share(float(np.mean(less & ~bound)), float(np.mean(less)))))
    return tuple(found)


def _cohorts(person: Patient) -> tuple[Row, ...]:
    stone = person.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    low, high = 1e3 * (stone.value - spread), 1e3 * (stone.value + spread)
    return tuple(rows_for(low, high, person.place))


def _warnings(found: Assessment) -> tuple[str, ...]:
    person, samples, present = found.person, found.samples, found.at_present
    material, told = person.material, list(person.assumed)
    highest = material.strain_range[1]
    known = f"but the constants of material '{material.name}' were used up to {highest:g} only"

    def tell(chosen: Bool[np.ndarray, " n"], sentence: str) -> None:
        """Add a sentence where it concerns more than a few samples."""
        share = float(np.mean(chosen))
        if share > SMALL_SHARE:
            told.append(f"in {share:.0%} of the samples {sentence}")

    if person.load.confining_pressure > 0.0 or person.load.prestretch != 1.0:
        told.append("diameters of the ureter are taken as those without load, but imaging shows "
                    "them under it")  # fmt: skip
    if samples is not None:
        tell(
            samples.size_ratio > highest,
            f"the stone stretches the wall beyond {highest:g} times its circumference, {known}",
        )
        tell(
            samples.loose,
            "the stone is no larger than the lumen; one that obstructs is held, so "
            "these say that the sizes are known too badly, or that something else holds it",
        )
        tell(samples.bound, "only a lower bound of the critical pressure is known: the stone is "
             "larger, or the friction higher, than the model answers")  # fmt: skip
    if present is not None:
        tell(
            present.opening > highest,
            f"the dilated segment is wider than {highest:g} times the ureter, {known}: the "
            "present pressure is extrapolated, and a wall that has crept makes it too high",
        )
        tell(present.opening < 1.0, "the dilated segment is no wider than the ureter; its "
             "transmural pressure counts as 0")  # fmt: skip
    if found.below_present is not None and found.below_present.low > SMALL_SHARE:
        told.append(
            f"in {found.below_present.told()} of the samples the present pressure exceeds the "
            "critical one although the stone is there: these inputs contradict one another, or "
            "what holds the stone is not in the model"
        )
    if found.possible < FEW_POSSIBLE:
        told.append(f"{1.0 - found.possible:.0%} of the draws describe no possible wall and were "
                    "left out: the diameters are known too badly, and what is left is narrower "
                    "than they say")  # fmt: skip
    if found.surface_error > LARGE_ERROR:
        told.append(f"the response surface is off by up to {found.surface_error:.0%}")
    return tuple(told)
