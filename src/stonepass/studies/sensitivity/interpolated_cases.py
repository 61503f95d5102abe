"""Evaluation of a sensitivity study by interpolation between cases that were solved before.

The solved cases may be those of a sweep: samples, a grid, or any other points. The critical
pressure is a cubic radial-basis function of the inputs, scaled to the range of the points. The
outcome is that of the nearest point. The stated error is measured on points that are left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import KDTree

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float, Int
from stonepass.errors import BadInput, require
from stonepass.studies.sensitivity.evaluator import OUTSIDE, Evaluations
from stonepass.studies.sensitivity.size_search import search_sizes
from stonepass.studies.sensitivity.tornado import INNER, STONE_SIZE
from stonepass.studies.sensitivity.uncertain_case import Inputs, UncertainCase

__all__ = ["InterpolatedCases", "require_same_inputs"]

FEWEST = 20  # smallest number of points with a critical pressure
MOST = 2000  # largest number of points from which every value is interpolated
NEIGHBOURS = 60  # number of nearest points from which a value is interpolated with more points
TEST = 10  # one of this number of points is left out to measure the error
SEED = 5  # seed of the choice of the points that are left out
# Part of the range of the points by which a case may lie beyond it. Samples of a sweep do not reach
# the ends of their range.
EDGE = 0.02

Points = Float[np.ndarray, "n d"]


@array_dataclass
@dataclass(frozen=True)
class InterpolatedCases:
    """An evaluator that interpolates between solved cases.

    Attributes
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs.
    points : mapping of str to array (n)
        Values of every uncertain input in the solved cases by key, in SI units.
    solved : Evaluations
        Outcomes, critical pressures and lower bounds of the solved cases.
    name : str
        Origin of the solved cases in words, e.g. "sweep 'study'".

    Raises
    ------
    BadInput
        The points lack an uncertain input or have another one, an input has the same value in all
        of them, or fewer than 20 of them have a critical pressure.

    References
    ----------
    docs/howto/sensitivity.md, "Results of a sweep".
    """

    uncertain: UncertainCase
    points: Mapping[str, Float[np.ndarray, " n"]]
    solved: Evaluations
    name: str

    def __post_init__(self) -> None:
        require_same_inputs(self.uncertain, self.points, self.name)
        for key, values in self.points.items():
            require(len(values) > 0 and float(np.ptp(values)) > 0.0, f"'{key}'",
                    f"constant in the {self.name}", "varied in it")  # fmt: skip
        count = int(np.count_nonzero(self._known))
        require(count >= FEWEST, f"number of critical pressures in the {self.name}", count,
                f"at least {FEWEST}")  # fmt: skip

    @property
    def source(self) -> str:
        """Origin of the values in words."""
        return f"interpolation of the {self.name}"

    def __call__(self, inputs: Inputs) -> Evaluations:
        """Return the critical pressures; for the parameters see `Evaluator`."""
        found = self._interpolated(self._scaled(inputs))
        return replace(found, error=self.largest_error)

    def critical_sizes(self, inputs: Inputs, limit: float) -> Evaluations:
        """Return the critical size ratios; for the parameters see `Evaluator`.

        Raises
        ------
        BadInput
            The size of the stone does not vary in the solved cases.
        """
        key = next((each for each in STONE_SIZE if each in self.points), None)
        if key is None:
            raise BadInput("pressure limit", f"{limit / 1e3:g} kPa",
                           "left out if the size of the stone is no uncertain input")  # fmt: skip
        inner = np.ones(len(inputs[key]))
        if key == STONE_SIZE[0]:
            known = self.uncertain.median_case.ureter.inner_diameter
            inner = inputs[INNER] if INNER in inputs else float(known or 1.0) * inner
        ends = self.points[key].min() / inner.max(), self.points[key].max() / inner.min()

        def pressures(sizes: Float[np.ndarray, " m"], cases: Int[np.ndarray, " m"]) -> Evaluations:
            rows = {name: values[cases] for name, values in inputs.items()}
            return self(rows | {key: sizes * inner[cases]})

        return search_sizes(pressures, len(inner), limit, (float(ends[0]), float(ends[1])))

    @cached_property
    def largest_error(self) -> float:
        """Largest error in Pa at points that are left out of the interpolation."""
        rows = np.flatnonzero(self._known)
        left_out = np.random.default_rng(SEED).random(len(rows)) < 1.0 / TEST
        left_out[0] = True  # at least one of them
        kept, tested = rows[~left_out], rows[left_out]
        low, high = self._at[kept].min(axis=0) - EDGE, self._at[kept].max(axis=0) + EDGE
        covered = (self._at[tested] >= low) & (self._at[tested] <= high)
        tested = tested[covered.all(axis=1)]
        values = self.solved.value.filled(0.0)
        found = _interpolant(self._at[kept], values[kept])(self._at[tested])
        return float(np.max(np.abs(found - values[tested]), initial=0.0))

    def _interpolated(self, at: Points) -> Evaluations:
        inside = np.asarray(np.all((at >= -EDGE) & (at <= 1.0 + EDGE), axis=1))
        _, nearest = self._tree.query(at)
        missing = ~inside | ~self._known[nearest]
        pressure = np.zeros(len(at))
        if not missing.all():
            pressure[~missing] = np.maximum(self._pressure(at[~missing]), 0.0)
        unbounded = ~inside | np.ma.getmaskarray(self.solved.lower_bound)[nearest]
        return Evaluations(
            np.where(inside, self.solved.outcome[nearest], OUTSIDE),
            np.ma.MaskedArray(pressure, missing),
            np.ma.MaskedArray(self.solved.lower_bound.filled(0.0)[nearest], unbounded),
            self.solved.reason,
        )

    @cached_property
    def _known(self) -> Bool[np.ndarray, " n"]:
        return np.asarray(~np.ma.getmaskarray(self.solved.value))

    @cached_property
    def _at(self) -> Points:
        return self._scaled(self.points)

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self._at)

    @cached_property
    def _pressure(self) -> RBFInterpolator:
        return _interpolant(self._at[self._known], self.solved.value.compressed())

    def _scaled(self, inputs: Mapping[str, Float[np.ndarray, " m"]]) -> Points:
        """Return the inputs scaled to 0–1 over the range of the points."""
        columns = []
        for key in self.uncertain.keys:
            low, high = float(self.points[key].min()), float(self.points[key].max())
            columns.append((inputs[key] - low) / (high - low))
        return np.stack(columns, axis=1)


def _interpolant(at: Points, values: Float[np.ndarray, " n"]) -> RBFInterpolator:
    """Return the interpolant; a point that occurs repeatedly is used once."""
    points, first = np.unique(at, axis=0, return_index=True)
    neighbours = None if len(points) <= MOST else NEIGHBOURS
    return RBFInterpolator(points, values[first], neighbours, kernel="cubic", degree=1)


def require_same_inputs(uncertain: UncertainCase, points: Inputs, name: str) -> None:
    """Raise BadInput if the uncertain inputs are not those that vary in some solved cases."""
    mine, its = set(uncertain.keys), set(points)
    if mine != its:
        allowed = f"those of the {name}, {', '.join(sorted(its)) or 'none'}"
        raise BadInput("uncertain inputs", ", ".join(sorted(mine)), allowed)
