"""Stated errors of answers compared with their true errors."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from cores import on_all_cores
from page import Check, Section
from robustness import describe, families

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS

SEED, CASES = 20247, 120  # the error estimates were tuned on another seed
COVERED = 0.95
QUANTITIES = ("α₀", "σ(π/2)", "P_ucr")
REFERENCE = LEVELS["reference"].resolution
# Resolution for the true error of `reference`; all cases would take an hour.
BEYOND = Resolution(order=5, closed=20, edge=0.006, growth=1.4, increments=96, path_columns=24)
BEYOND_CASES = 16


@dataclass(frozen=True)
class Comparison:
    """True and stated error of a quantity of an answer: in degrees for α₀, otherwise relative."""

    level: str
    quantity: str
    true: float
    claimed: float
    case: str

    @property
    def covered(self) -> bool:
        return self.true <= self.claimed


def section() -> Section:
    sample = cases()
    jobs = [(case, ("fast", "standard"), REFERENCE) for case in sample]
    jobs += [(case, ("reference",), BEYOND) for case in sample[:BEYOND_CASES]]
    found = on_all_cores("error estimates", compare, jobs)
    unsolved = sum(not comparisons for comparisons in found[:CASES])
    everything = list(itertools.chain.from_iterable(found))
    groups = {
        (level, quantity): [c for c in everything if (c.level, c.quantity) == (level, quantity)]
        for level in LEVELS
        for quantity in QUANTITIES
    }
    missed = sorted((c for c in everything if not c.covered), key=lambda c: -c.true / c.claimed)
    return Section(
        title="Stated and true errors",
        text=(
            f"{CASES} random cases (seed {SEED}) are drawn as in the section *Robustness*; "
            f"{unsolved} of them have no seated state. The true error of `fast` and `standard` is "
            "the difference to the accuracy `reference`. The true error of `reference` is the "
            "difference to a solve with three times as many increments on a finer mesh, for the "
            f"first {BEYOND_CASES} cases. The *stated* error is part of the answer and comes from "
            "its own second solve. The table gives quantiles over the cases; all errors but those "
            "of α₀ are relative. *Covered* is the fraction of cases whose true error is not larger "
            "than the stated one. The stated errors are several times larger than the true ones in "
            "the median, so that coverage is a weak test: they are conservative and not sharp."
        ),
        tables=[
            (
                "",
                ("accuracy", "quantity", "cases", "true: median", "95 %", "stated: median",
                 "95 %", "true/stated: median", "covered"),
                [row(level, quantity, group) for (level, quantity), group in groups.items()],
            ),
            (
                "True errors that are larger than the stated ones:",
                ("accuracy", "quantity", "true", "stated", "case"),
                [
                    [c.level, c.quantity, shown(c, c.true), shown(c, c.claimed), c.case]
                    for c in missed
                ]
                or [["none"] + [""] * 4],
            ),
        ],
        checks=[check(level, quantity, group) for (level, quantity), group in groups.items()],
    )  # fmt: skip


def check(level: str, quantity: str, group: Sequence[Comparison]) -> Check:
    covered = sum(c.covered for c in group)
    least = 10 if level == "reference" else 50
    return Check(
        f"{level}: at least {COVERED:.0%} of the errors of {quantity} are within the stated error",
        f"{covered} of {len(group)}",
        len(group) >= least and covered >= COVERED * len(group),
    )


def row(level: str, quantity: str, group: Sequence[Comparison]) -> list[str]:
    cells = [level, quantity, str(len(group))]
    for values in ([c.true for c in group], [c.claimed for c in group]):
        cells += [shown(group[0], float(np.quantile(values, q))) for q in (0.5, 0.95)]
    width = float(np.median([c.true / c.claimed for c in group]))
    return [*cells, f"{width:.2f}", f"{sum(c.covered for c in group) / len(group):.0%}"]


def shown(comparison: Comparison, value: float) -> str:
    return f"{value:.4f}°" if comparison.quantity == "α₀" else f"{value:.1e}"


def compare(case: sp.Case, levels: Sequence[str], truth: Resolution) -> list[Comparison]:
    """Return stated and true errors at each accuracy; an empty list without a seated state."""
    fine = sp.solve(case, truth)
    found = []
    for level in levels:
        answer = sp.solve(replace(case, numerics=replace(case.numerics, accuracy=level)))
        state, error, limit = answer.contact, answer.error, fine.contact
        if state is None or error is None or limit is None:
            continue
        angle = np.degrees([abs(state.contact_angle - limit.contact_angle), error.contact_angle])
        sigma = limit.equator_contact_pressure
        equator = np.array(
            [abs(state.equator_contact_pressure - sigma), error.equator_contact_pressure]
        )
        pairs = [("α₀", *angle), ("σ(π/2)", *(equator / sigma))]
        if answer.pressure and fine.pressure and error.critical_pressure is not None:
            critical = np.array([abs(answer.pressure - fine.pressure), error.critical_pressure])
            pairs.append(("P_ucr", *(critical / fine.pressure)))
        found += [
            Comparison(level, quantity, float(true), float(claimed), describe(case))
            for quantity, true, claimed in pairs
        ]
    return found


def cases() -> list[sp.Case]:
    """Return one size of each family."""
    return [family[k % len(family)] for k, family in enumerate(families(SEED, CASES))]
