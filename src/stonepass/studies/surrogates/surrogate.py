"""A surrogate: the answers of a model over a box of inputs, in microseconds, with their error."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.errors import BadInput
from stonepass.fe.core.threads import one_thread
from stonepass.model.case import Case
from stonepass.studies.conditions import Conditions
from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.box import SLACK, Box
from stonepass.studies.surrogates.held_functions import HeldFunctions
from stonepass.studies.surrogates.held_stone import HeldStone
from stonepass.studies.surrogates.learnt import LearntFunctions
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.seated_contact import SeatedContact
from stonepass.studies.surrogates.solved import LOOSE, NO_SOLUTION, UNITS, Solved
from stonepass.studies.surrogates.stable_loads import StableLoads
from stonepass.units import pressure

__all__ = ["Surrogate"]

LARGEST = 1e12  # largest number that an evaluation takes, so that no product overflows
CHUNK = 32_768  # number of conditions that are evaluated at a time, which bounds the memory
Given = Any  # a number or an array of numbers


@array_dataclass
@dataclass(frozen=True, repr=False)
class Surrogate:
    """The answers of one model, material and kind of load over a box of inputs.

    Attributes
    ----------
    case : Case
        Material, kind of load, model and numerics. Its confining pressure is the largest one of the
        box; size, wall and friction of the case do not matter.
    box : Box
        The range of the inputs.
    physics : SeatedContact or HeldStone
        Gives the answer for values of the learnt functions, of the paper's or the direct model.
    learnt : LearntFunctions or HeldFunctions
        The learnt functions of the conditions.
    error : SparsePolynomial
        Natural logarithm of the claimed relative error of P_ucr.
    floor : float
        Claimed absolute error of P_ucr in Pa, which is added to the relative one.
    lumen : SparsePolynomial or None
        Lumen r_a/R_a as a function of the coordinates of wall and load; None without a load, for
        which it is 1.
    stable : StableLoads
        The largest load factors for which the tubes of the box are stable.
    about : mapping
        How the surrogate was built and checked: version, fingerprint, number of cases, measured
        errors, and the command that builds it again.
    """

    case: Case
    box: Box
    physics: SeatedContact | HeldStone
    learnt: LearntFunctions | HeldFunctions
    error: SparsePolynomial
    floor: float
    stable: StableLoads
    lumen: SparsePolynomial | None = None
    about: Mapping[str, Any] = field(default_factory=dict)

    def evaluate(
        self,
        *,
        size_ratio: Given,
        wall_ratio: Given,
        friction: Given,
        confining_pressure: Given = 0.0,
        stiffness: Given = 1.0,
    ) -> SurrogateAnswers:
        """Return the answers for arrays of inputs.

        All inputs may be numbers or arrays; they are broadcast to one shape and flattened.

        Parameters
        ----------
        size_ratio, wall_ratio, friction : float or array
            Size ratio ξ, wall ratio η and friction coefficient μ_f.
        confining_pressure : str, float or array
            Confining pressure P_out: text with a unit such as ``"2 kPa"``, or numbers in Pa.
        stiffness : float or array
            Stiffness of the wall relative to the material, above 0. P_ucr of a wall that is s times
            as stiff is s times P_ucr of the material under the confining pressure P_out/s.

        Returns
        -------
        SurrogateAnswers
            A condition outside the box has the outcome NO_SOLUTION. For the direct model, so has
            one whose P_ucr exceeds 0.95 times the pressure that opens the tube to the width of the
            stone; this pressure is then the lower bound.

        Raises
        ------
        BadInput
            An input is not finite, or is not positive where it has to be.

        Examples
        --------
        >>> import stonepass as sp
        >>> found = sp.load_surrogate("ureter").evaluate(
        ...     size_ratio=[0.9, 1.1, 1.2], wall_ratio=1.3, friction=0.5)
        >>> [outcome.name for outcome in found.outcomes]
        ['LOOSE', 'MOVES', 'MOVES']
        """
        given = {"size_ratio": size_ratio, "wall_ratio": wall_ratio, "friction": friction,
                 "confining_pressure": confining_pressure, "stiffness": stiffness}  # fmt: skip
        if isinstance(confining_pressure, str):
            given["confining_pressure"] = float(pressure(confining_pressure, "confining_pressure"))
        inputs = _checked(given)
        size, wall, mu, confining, stiff = inputs.values()
        most = self.case.load.confining_pressure
        relative = confining / stiff
        # Without a load in the box, any confining pressure is outside of it.
        factor = relative / most if most > 0.0 else np.where(relative > 0.0, np.inf, 0.0)
        asked = Conditions(size, wall, mu, factor)
        found = self.solve(asked)
        critical, bound = stiff * found.pressure, stiff * found.lower_bound
        quantities = {
            name: stiff * values if UNITS[name] == "Pa" else values
            for name, values in found.quantities.items()
        }
        scaled = Solved(found.outcome, critical, bound, quantities)
        return SurrogateAnswers.of(inputs, scaled)

    def solve(self, asked: Conditions) -> Solved:
        """Return the results of n conditions; the load factor 1 is the load of the case.

        Parameters
        ----------
        asked : Conditions
            Size ratio, wall ratio, friction and load factor.
        """
        count = len(asked.size_ratio)
        pieces = [slice(k, k + CHUNK) for k in range(0, count, CHUNK)] or [slice(0, 0)]
        parts = _in_threads(lambda piece: self._solve(_part(asked, piece)), pieces)
        names = parts[0].quantities
        return Solved(
            np.concatenate([each.outcome for each in parts]),
            np.concatenate([each.pressure for each in parts]),
            np.concatenate([each.lower_bound for each in parts]),
            {name: np.concatenate([each.quantities[name] for each in parts]) for name in names},
        )

    def _solve(self, asked: Conditions) -> Solved:
        inside = self.contains(asked)
        held = self.box.clipped(asked)
        lumen = self._lumen(held)
        loose = asked.size_ratio <= lumen
        stuck = inside & ~loose
        at = self.box.setting(self.case, held, lumen, self.stable.narrowest).where(stuck)
        learnt = self.learnt if asked.load_factor.any() else self._without_load
        found = self.physics.solve(self.case, at, learnt(at))
        claim = found.pressure * np.exp(self.error(at.unit)[:, 0]) + self.floor
        missing = np.where(inside, 0.0, np.nan)  # P_ucr of a loose stone is 0
        return Solved(
            _filled(np.where(inside, LOOSE, NO_SOLUTION), stuck, found.outcome),
            _filled(missing, stuck, found.pressure),
            _filled(np.zeros(len(stuck)), stuck, found.lower_bound),
            {name: _filled(np.full(len(stuck), np.nan), stuck, each) for name, each in
             found.quantities.items()} | {"error": _filled(missing, stuck, claim)},
        )  # fmt: skip

    def __repr__(self) -> str:
        name, load = self.case.ureter.material.name, self.case.load.confining_pressure / 1e3
        low, high = self.box.wall_ratio
        return (
            f"<Surrogate: model {self.case.model.NAME}, {name}; ξ up to {self.box.size_ratio:g}, "
            f"η {low:g} to {high:g}, friction {self.box.friction[0]:g} to "
            f"{self.box.friction[1]:g}, confining pressure up to {load:g} kPa>"
        )

    @property
    def terms(self) -> int:
        """Number of terms of the polynomials of the learnt functions."""
        parts = (self.learnt.base, self.learnt.correction)
        return sum(len(each.degrees) for each in parts if each is not None)

    def contains(self, asked: Conditions) -> Bool[np.ndarray, " n"]:
        """Return which of n conditions are inside the box and have a load that keeps them stable.

        The lower end of the size is ignored.
        """
        most = self.stable(asked.wall_ratio) * (1.0 + SLACK)
        return self.box.contains(asked) & (asked.load_factor <= most)

    @cached_property
    def _without_load(self) -> LearntFunctions | HeldFunctions:
        """The learnt functions of tubes without a confining pressure, which are faster."""
        return self.learnt if self.lumen is None else self.learnt.without_load()

    def _lumen(self, at: Conditions) -> Float[np.ndarray, " n"]:
        natural = self.case.load.prestretch == 1.0
        if self.lumen is None or (natural and not at.load_factor.any()):
            return np.ones(len(at.size_ratio))
        found = self.lumen(np.stack([self.box.wall_coordinate(at), at.load_factor], axis=1))[:, 0]
        return np.where(at.load_factor == 0.0, 1.0, found) if natural else found


def _checked(given: Mapping[str, Given]) -> dict[str, Float[np.ndarray, " n"]]:
    """Return the inputs as flat arrays of one length; refuse numbers that are not possible."""
    arrays = {}
    for name, value in given.items():
        try:
            if np.ma.is_masked(value) or np.iscomplexobj(value):
                raise TypeError
            arrays[name] = np.asarray(value, dtype=float)
        except (TypeError, ValueError, OverflowError):
            allowed = "a number or an array of real numbers, none of them masked"
            raise BadInput(name, value, allowed) from None
        positive = name in ("size_ratio", "wall_ratio", "stiffness")
        good = (arrays[name] > 0.0) if positive else (arrays[name] >= 0.0)
        good &= arrays[name] <= LARGEST
        if not good.all():
            worst = float(arrays[name][~good].flat[0])
            low = "above 0" if positive else "0 or more"
            raise BadInput(name, worst, f"{low} and at most {LARGEST:g}")
    try:
        together = np.broadcast_arrays(*arrays.values())
    except ValueError:
        shapes = ", ".join(f"{name} {each.shape}" for name, each in arrays.items() if each.ndim)
        raise BadInput("inputs", shapes, "arrays of one shape") from None
    flat = [np.ascontiguousarray(each).ravel() for each in together]
    return dict(zip(arrays, flat, strict=True))


def _filled(values: np.ndarray, chosen: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return a copy of `values` with `others` in the chosen rows."""
    found = values.copy()
    found[chosen] = others
    return found


def _part(asked: Conditions, piece: slice) -> Conditions:
    return Conditions(
        asked.size_ratio[piece],
        asked.wall_ratio[piece],
        asked.friction[piece],
        asked.load_factor[piece],
    )


def _in_threads(work: Callable[[slice], Solved], pieces: list[slice]) -> list[Solved]:
    """Apply `work` to every piece, in threads if there are several; NumPy runs in parallel."""
    cores = os.cpu_count() or 1
    if len(pieces) < 2 * cores or cores == 1:
        return [work(each) for each in pieces]
    # Matrix products would otherwise start threads of their own in each of these threads.
    with one_thread(), ThreadPoolExecutor(cores) as pool:
        return list(pool.map(work, pieces))
