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

from stonepass.errors import BadInput, Outcome
from stonepass.laboratory.cohorts import Row, rows_for
from stonepass.laboratory.person import INPUTS, Person
from stonepass.materials.stability import check
from stonepass.model.answer import Answer
from stonepass.model.case import WALL_RATIO
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
FEWEST = 100  # samples that are possible
DRIVERS_SAMPLES = 1024
SIZES = np.concatenate([np.arange(1.0, 10.01, 0.5)])  # mm, of shares by size
NOT_OF_RESISTANCE = ("dilated_inner_diameter", "dilated_outer_diameter")
LARGE_ERROR = 0.05
SMALL_SHARE = 0.005  # not worth a sentence
FEW_KEPT = 0.5
MORE, FEWER, NEAR = "more than the model expects", "fewer than the model expects", "near the model"
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


@dataclass(frozen=True)
class Driver:
    """How much of the spread of P_ucr an input makes: Sobol's total index, of ranks."""

    name: str
    share: float


@dataclass(frozen=True)
class Samples:
    """The possible ways to be: pressures in Pa, and where they are only lower bounds."""

    critical: Float[np.ndarray, " n"]
    bound: Bool[np.ndarray, " n"]
    present: Float[np.ndarray, " n"] | None
    present_bound: Bool[np.ndarray, " n"] | None
    loose: Bool[np.ndarray, " n"]
    size_ratio: Float[np.ndarray, " n"]
    opening: Float[np.ndarray, " n"] | None

    def below(self, pressure: float) -> Share:
        """The share with P_ucr below a pressure."""
        less = self.critical < pressure
        return Share(float(np.mean(less & ~self.bound)), float(np.mean(less)))

    def below_present(self) -> Share | None:
        """The share with P_ucr below the present pressure."""
        if self.present is None or self.present_bound is None:
            return None
        less = self.critical < self.present
        possible = less | self.present_bound
        return Share(float(np.mean(less & ~self.bound)), float(np.mean(possible)))


@dataclass(frozen=True)
class Assessment:
    """What can be said of one person.

    Attributes
    ----------
    person : Person
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
    kept : float
        Share of the draws that describe a possible wall.
    solves : int
    surface_error : float
        95th percentile of the surface's relative error, from leaving out one solve at a time.
    warnings : tuple of str
    """

    person: Person
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
    kept: float = 1.0
    solves: int = 0
    surface_error: float = 0.0
    warnings: tuple[str, ...] = ()

    def beside(self, row: Row) -> Share | None:
        """The model's share below the limit for the stones of a cohort's row.

        Of a size class: the mean over those of its sizes that this stone may have; of a place: all
        samples.
        """
        if row.sizes is None or not self.by_size:
            return self.below_limit
        low, high = row.sizes
        nearest = min(self.by_size, key=lambda each: abs(each[0] - (low + high) / 2.0))
        some = [share for size, share in self.by_size if low <= size <= high] or [nearest[1]]
        return Share(
            float(np.mean([share.low for share in some])),
            float(np.mean([share.high for share in some])),
        )

    @property
    def central(self) -> float | None:
        """P_ucr in Pa at the measured values themselves."""
        pressure = self.at_values.pressure
        return None if pressure is None else self.person.measured["stiffness"].value * pressure


def contradiction(passed: float, share: Share | None) -> str:
    """Whether the share that passed lies far from the model's share below the limit."""
    if share is None:
        return ""
    if passed > share.high + FAR_APART:
        return MORE
    if passed < share.low - FAR_APART:
        return FEWER
    return NEAR


def assess(person: Person, solver: Solver | None = None) -> Assessment:
    """Assess one person.

    Raises
    ------
    BadInput
        An unstable material, or measurements that hardly any wall could have together.
    """
    solver = solver or PooledSolver()
    check(person.material)
    case = person.case()
    drawn, kept = _drawn(person)
    at_values = solver.answers([case])[0]
    cohorts = _cohorts(person)
    under_load = replace(case, load=person.load)  # each sample divides it by its own stiffness
    surface = response_surface(under_load, _conditions(person, drawn), solver)
    if not surface.usable:
        message = (
            f"{Outcome.NO_SOLUTION.value[:-1]} for {len(surface.lost.friction)} of "
            f"{surface.tried} cases that the inputs span, in most of them since: {surface.reason}"
        )
        return Assessment(
            person, Outcome.NO_SOLUTION, message, at_values, cohorts, kept=kept,
            solves=surface.tried + 1,
        )  # fmt: skip
    samples = _samples(person, surface, drawn)
    error = float(np.quantile(surface.errors, 0.95))
    assessment = Assessment(
        person=person,
        outcome=Outcome.MOVES,
        message=_message(samples.below(person.limit), person.limit),
        at_values=at_values,
        cohorts=cohorts,
        critical=_range(samples.critical, samples.bound),
        present=None if samples.present is None else _range(samples.present, samples.present_bound),
        below_limit=samples.below(person.limit),
        below_present=samples.below_present(),
        loose=float(np.mean(samples.loose)),
        drivers=_drivers(person, surface, samples),
        by_size=_by_size(person, surface, drawn),
        samples=samples,
        kept=kept,
        solves=surface.tried + 1,
        surface_error=error,
        warnings=_warnings(person, samples, kept, error),
    )
    return assessment


def _drawn(person: Person) -> tuple[Draws, float]:
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
        possible = _possible(person, drawn, unit[:, -1])
        if possible.sum() >= person.samples:
            break
    if possible.sum() < FEWEST:
        raise BadInput(
            "diameters",
            f"possible together in {possible.sum()} of {len(possible)} draws",
            "such that a wall of constant volume may have them",
            "check them and their uncertainties",
        )
    kept = {name: values[possible][: person.samples] for name, values in drawn.items()}
    return kept, float(possible.mean())


def _possible(
    person: Person, drawn: Draws, chance: Float[np.ndarray, " n"]
) -> Bool[np.ndarray, " n"]:
    wall = _wall_ratio(drawn)
    possible = (wall >= WALL_RATIO[0]) & (wall <= WALL_RATIO[1])
    if "dilated_outer_diameter" in drawn:
        possible &= chance < _agreement(person, drawn)
    return possible


def _wall_ratio(drawn: Draws) -> Float[np.ndarray, " n"]:
    inner = drawn["inner_diameter"]
    if "outer_diameter" in drawn:
        return drawn["outer_diameter"] / inner
    return 1.0 + 2.0 * drawn["wall_thickness"] / inner


def _agreement(person: Person, drawn: Draws) -> Float[np.ndarray, " n"]:
    """How likely the measured outer diameter of the dilated segment is, by the wall's volume.

    Over the likelihood of a perfect agreement.
    """
    inner = drawn["inner_diameter"]
    section = (_wall_ratio(drawn) ** 2 - 1.0) * inner**2 / person.load.prestretch
    outer = np.sqrt(drawn["dilated_inner_diameter"] ** 2 + section)
    measured = person.measured["dilated_outer_diameter"]
    if measured.sd is None:
        return ((outer >= measured.low) & (outer <= measured.high)).astype(float)
    if measured.sd == 0.0:
        raise BadInput("dilated outer diameter", "exact", "uncertain beside the inner one",
                       "give its uncertainty, or leave one of the two out")  # fmt: skip
    return np.exp(-0.5 * ((outer - measured.value) / measured.sd) ** 2)


def _conditions(person: Person, drawn: Draws) -> Conditions:
    return Conditions(
        drawn["stone_diameter"] / drawn["inner_diameter"],
        np.clip(_wall_ratio(drawn), *WALL_RATIO),
        drawn["friction"],
        1.0 / drawn["stiffness"],
    )


def _critical(
    person: Person, surface: ResponseSurface, drawn: Draws
) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
    """P_ucr in Pa of many draws: s P_ucr(P_out/s) for a wall s times as stiff."""
    found, bound = surface(_conditions(person, drawn))
    return drawn["stiffness"] * found, bound


def _samples(person: Person, surface: ResponseSurface, drawn: Draws) -> Samples:
    critical, bound = _critical(person, surface, drawn)
    at = _conditions(person, drawn)
    present, wide, opening = None, None, None
    if person.dilated:
        opening = drawn["dilated_inner_diameter"] / drawn["inner_diameter"]
        wide = opening > WIDEST
        held = np.minimum(opening, WIDEST)
        across = drawn["stiffness"] * transmural(surface.case, held, at.wall_ratio)
        outside = np.asarray(confining_traction(held, at.wall_ratio, person.load))
        # No lower than what keeps the tube open: a narrower one was not measured, but misread.
        present = np.maximum(across, 0.0) + outside
    lumen = lumen_ratios(surface.case, at.wall_ratio, at.load_factor)
    loose = at.size_ratio <= lumen
    return Samples(critical, bound, present, wide, loose, at.size_ratio, opening)


def _range(values: Float[np.ndarray, " n"], bound: Bool[np.ndarray, " n"] | None = None) -> Range:
    """Quantiles; one that falls among lower bounds is not known."""
    known = values if bound is None else np.where(bound, np.inf, values)
    ends = np.quantile(known, INTERVAL, method="higher")
    told = [float(end) if np.isfinite(end) else None for end in ends]
    low, median, high = told
    if None not in told:
        return Range(low, median, high)
    least = float(np.quantile(values, INTERVAL[told.index(None)], method="lower"))
    return Range(low, median, high, least)


def _drivers(person: Person, surface: ResponseSurface, samples: Samples) -> tuple[Driver, ...]:
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
    person: Person, surface: ResponseSurface, drawn: Draws
) -> tuple[tuple[float, Share], ...]:
    found = []
    for size in SIZES:
        fixed = {**drawn, "stone_diameter": np.full(len(drawn["friction"]), size / 1e3)}
        critical, bound = _critical(person, surface, fixed)
        less = critical < person.limit
        found.append((float(size), Share(float(np.mean(less & ~bound)), float(np.mean(less)))))
    return tuple(found)


def _cohorts(person: Person) -> tuple[Row, ...]:
    stone = person.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    low, high = 1e3 * (stone.value - spread), 1e3 * (stone.value + spread)
    return tuple(rows_for(low, high, person.place))


def _message(below: Share, limit: float) -> str:
    told = (
        f"{below.low:.0%}"
        if below.high - below.low < SMALL_SHARE
        else f"{below.low:.0%} to {below.high:.0%}"
    )
    return (
        f"In {told} of the ways in which the inputs may be, the stone moves at less than the "
        f"pressure limit, {limit / 1e3:.4g} kPa."
    )


def _warnings(person: Person, samples: Samples, kept: float, error: float) -> tuple[str, ...]:
    material, told = person.material, list(person.assumed)
    highest = material.strain_range[1]
    known = f"but the constants of material '{material.name}' were used up to {highest:g} only"
    far = float(np.mean(samples.size_ratio > highest))
    if far > SMALL_SHARE:
        told.append(f"in {far:.0%} of the samples the stone stretches the wall beyond {highest:g} "
                    f"times its circumference, {known}")  # fmt: skip
    if samples.opening is not None:
        wide = float(np.mean(samples.opening > highest))
        if wide > SMALL_SHARE:
            told.append(f"in {wide:.0%} of the samples the dilated segment is wider than "
                        f"{highest:g} times the ureter, {known}: the present pressure is "
                        "extrapolated, and a wall that has crept makes it too high")  # fmt: skip
        narrow = float(np.mean(samples.opening < 1.0))
        if narrow > SMALL_SHARE:
            told.append(f"in {narrow:.0%} of the samples the dilated segment is no wider than the "
                        "ureter; its transmural pressure counts as 0")  # fmt: skip
    undecided = float(np.mean(samples.bound))
    if undecided > SMALL_SHARE:
        told.append(f"in {undecided:.0%} of the samples only a lower bound of the critical "
                    "pressure is known: the stone is larger, or the friction higher, than the "
                    "model answers")  # fmt: skip
    if kept < FEW_KEPT:
        told.append(f"{1.0 - kept:.0%} of the draws describe no possible wall and were left out: "
                    "the diameters are known too badly, and what is left is narrower than they "
                    "say")  # fmt: skip
    if error > LARGE_ERROR:
        told.append(f"the response surface is off by up to {error:.0%}")
    return tuple(told)
