"""The seated state by stonepass and by CalculiX: times, and errors relative to our reference."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from cases import tube
from measure import Decks, Row, calculix, cpu_seconds, stonepass
from rival import CASES, KINDS, Run, case, search

import stonepass as sp
from stonepass.export.inp import write_inp
from stonepass.export.results import read_contact
from stonepass.export.seating import seating
from stonepass.model.accuracy import LEVELS
from stonepass.model.closure import Closure
from stonepass.model.critical_state import balance_pressure
from stonepass.model.far_field import far_field_law
from stonepass.model.states.seated_state import Contact, SeatedState

FINE = 0.025
# Errors up to which a tuned deck counts: of α₀ in degrees, of σ(π/2) and P_ucr relative.
ALLOWED = (0.5, 0.02, 0.01)
OURS = ("fast", "standard")
ALONE = ", state alone"
# Between the parts of the name of a ratio, and after the name of that to which a target applies.
SEPARATOR, MARK = " | ", " *"
# By seating and element: smallest ratio of the processor times of CalculiX and stonepass.
TARGETS = {
    ("frictionless", "CAX8"): 100.0,
    ("frictionless", "CAX8R"): 30.0,
    ("pressed", "CAX8"): 30.0,
    ("pressed", "CAX8R"): None,
}
# Lengths of the increments over those of the deck; longer ones are faster if they converge.
INCREMENTS = (2.0, 1.0)


@dataclass(frozen=True)
class Solved:
    """Processor time in s, and results: α₀ in degrees, σ(π/2) and P_ucr in Pa."""

    who: str
    cpu: float
    numbers: tuple[float, float, float]

    def errors(self, exact: Solved) -> tuple[float, float, float]:
        """Return the error of α₀ in degrees, and the relative errors of σ(π/2) and P_ucr."""
        mine, right = np.array(self.numbers), np.array(exact.numbers)
        off = np.abs(mine - right) / np.array([1.0, right[1], right[2]])
        return tuple(off.tolist())


def latex(kind: str, accuracy: str = "standard") -> sp.Case:
    """Return the case of the paper's latex tube and a stone 1.2 times its lumen."""
    return tube(kind, "latex", 1.5, 1.2, 0.475, accuracy=accuracy)


def peers(decks: Decks) -> Iterator[tuple[str, list[Solved], Solved]]:
    """Yield the seating, its solutions by both programs, and the reference."""
    for kind in ("frictionless", "pressed"):
        exact = ours(kind, "reference", repeats=1)
        found = [ours(kind, level, alone=alone) for level in OURS for alone in (True, False)]
        if calculix() is not None:
            found += [theirs(kind, element, decks) for element in ("CAX8", "CAX8R")]
        yield kind, found, exact


def ours(kind: str, level: str, *, alone: bool = False, repeats: int = 7) -> Solved:
    """Solve with the error estimate, or without it if `alone`, since CalculiX has none."""
    return _solved(latex(kind, level), f"stonepass, {level}", alone=alone, repeats=repeats)


def _solved(asked: sp.Case, who: str, *, alone: bool = False, repeats: int = 7) -> Solved:
    only = LEVELS[asked.numerics.accuracy].resolution if alone else None
    answer = sp.solve(asked, only)
    assert isinstance(answer.contact, SeatedState)
    seconds = cpu_seconds(lambda: sp.solve(asked, only), repeats)
    return Solved(f"{who}{ALONE if alone else ''}", seconds, _numbers(answer.contact))


@dataclass(frozen=True)
class Duel:
    """The fastest tuned deck of one case, compared with stonepass.

    Attributes
    ----------
    name, kind : str
        Case and seating.
    tried, ended : int
        Number of decks that were run, and of those whose errors are within `ALLOWED`.
    best : Solved
        The fastest of them.
    settings : str
        Its settings.
    mine : list of Solved
        Solutions of stonepass at every accuracy, with and without the error estimate.
    exact : Solved
        The solution of stonepass at the accuracy `reference`.
    """

    name: str
    kind: str
    tried: int
    ended: int
    best: Solved
    settings: str
    mine: list[Solved]
    exact: Solved

    def ratios(self) -> Iterator[tuple[str, float]]:
        """Yield the ratio of processor times for each of our solutions without a larger error."""
        for each in self.mine:
            pairs = zip(each.errors(self.exact), self.best.errors(self.exact), strict=True)
            if all(a <= b for a, b in pairs):
                yield each.who, self.best.cpu / each.cpu


def duels(decks: Decks) -> Iterator[Duel]:
    """Yield the fastest tuned deck of every case, with the solutions of stonepass."""
    exact = {
        (name, kind): _solved(case(name, kind, "reference"), "stonepass, reference", repeats=1)
        for name in CASES
        for kind in KINDS
    }

    def usable(name: str, kind: str, run: Run) -> bool:
        if run.contact is None:
            return False
        found = Solved("", run.cpu, _numbers(run.contact))
        pairs = zip(found.errors(exact[name, kind]), ALLOWED, strict=True)
        return all(error <= allowed for error, allowed in pairs)

    for name, kind, runs in search(decks, usable):
        good = [each for each in runs if usable(name, kind, each)]
        if not good:
            continue
        best = min(good, key=lambda each: each.cpu)
        assert best.contact is not None
        mine = [
            _solved(case(name, kind, level), f"stonepass, {level}", alone=alone)
            for level in OURS
            for alone in (True, False)
        ]
        found = Solved(f"CalculiX, {best.settings.element}", best.cpu, _numbers(best.contact))
        yield Duel(name, kind, len(runs), len(good), found, str(best.settings), mine,
                   exact[name, kind])  # fmt: skip


def duel_rows(fought: list[Duel]) -> Iterator[Row]:
    """Yield smallest and largest ratio by seating, with and without our error estimate."""
    for kind in KINDS:
        for alone in (True, False):
            found = [
                (ratio, duel.name)
                for duel in fought
                if duel.kind == kind
                for who, ratio in duel.ratios()
                if (ALONE in who) is alone
            ]
            what = "state alone" if alone else "with the error estimate"
            for word, (ratio, name) in (("least", min(found)), ("most", max(found))):
                text = f"{kind}, tuned CalculiX over ours, {what}, {word}: {name}"
                yield Row("duels", text, ratio, "×")


def theirs(kind: str, element: str, decks: Decks) -> Solved:
    """Run the exported deck with the longest increments that converge."""
    model = seating(latex(kind), FINE)
    for times in INCREMENTS:
        job = f"{kind}_{element}_{times:g}"
        deck = write_inp(model, element, increment=times * model.increment)
        print(f"  ccx {job} …", file=sys.stderr, flush=True)
        spent = decks.run(job, deck)
        if spent.code == 0:
            contact = read_contact(model, decks.folder / f"{job}.dat")
            return Solved(f"CalculiX, {element}", spent.cpu, _numbers(contact))
    raise SystemExit(f"ccx did not converge for {kind} {element}; its decks are in {decks.folder}")


def _numbers(contact: Contact) -> tuple[float, float, float]:
    pressure = balance_pressure(contact, Closure(far_field_law(contact.case, ground=False)))
    assert pressure is not None
    angle = float(np.degrees(contact.contact_angle))
    return angle, contact.equator_contact_pressure, pressure


def ratios(kind: str, found: list[Solved], exact: Solved) -> Iterator[Row]:
    """Yield ratios of processor times; the target is for our fastest without a larger error."""
    mine = [each for each in found if each.who.startswith("stonepass")]
    for other in (each for each in found if not each.who.startswith("stonepass")):
        element = other.who.rpartition(" ")[2]
        as_good = [
            each
            for each in mine
            if all(a <= b for a, b in zip(each.errors(exact), other.errors(exact), strict=True))
        ]
        best = min(as_good, key=lambda each: each.cpu, default=None)
        for each in mine:
            chosen = each is best
            yield Row(
                "peers",
                _compared(kind, element, each) + (MARK if chosen else ""),
                other.cpu / each.cpu,
                "×",
                TARGETS[kind, element] if chosen else None,
                at_least=True,
            )
        if best is None:
            what = SEPARATOR.join([kind, element, "none is as accurate", ""])
            yield Row("peers", what, 0.0, "×", TARGETS[kind, element], at_least=True)


def _compared(kind: str, element: str, mine: Solved) -> str:
    """Return seating, element of CalculiX, our accuracy, and whether we estimate the error."""
    accuracy = mine.who.removeprefix("stonepass, ").removesuffix(ALONE)
    return SEPARATOR.join([kind, element, accuracy, "no" if ALONE in mine.who else "yes"])


def cold_ratios(kind: str, found: list[Solved]) -> Iterator[Row]:
    """Yield ratios to a whole command of stonepass, which loads its libraries for one answer."""
    command = ("pressure", "--xi", "1.2", "--eta", "1.5", "--material", "latex",
               "--friction", "0.475", "--seating", kind)  # fmt: skip
    cold = stonepass(*command, "--no-cache").cpu
    for other in (each for each in found if not each.who.startswith("stonepass")):
        element = other.who.rpartition(" ")[2]
        what = SEPARATOR.join([kind, element, "standard, cold command", "yes"])
        yield Row("peers", what, other.cpu / cold, "×")
