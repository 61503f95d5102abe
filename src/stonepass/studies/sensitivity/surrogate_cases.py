"""Evaluation of a sensitivity study by a surrogate, within its range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from stonepass.array_types import Bool, Float, Int
from stonepass.errors import BadInput
from stonepass.model.case import Case
from stonepass.model.stone import SIZE_RATIO
from stonepass.model.ureter import WALL_RATIO
from stonepass.studies.sensitivity.evaluator import BAD_INPUT, OUTCOMES, OUTSIDE, Evaluations
from stonepass.studies.sensitivity.size_search import search_sizes
from stonepass.studies.sensitivity.uncertain_case import Inputs, UncertainCase

__all__ = ["AnsweringSurrogate", "SurrogateCases"]

# Inputs that a surrogate can vary; the others must be those of the surrogate.
VARIED = (
    "stone.diameter",
    "stone.size_ratio",
    "stone.friction",
    "ureter.inner_diameter",
    "ureter.outer_diameter",
    "ureter.wall_thickness",
    "ureter.wall_ratio",
    "load.confining_pressure",
)
Array = Float[np.ndarray, " n"]


@runtime_checkable
class AnsweringSurrogate(Protocol):
    """The interface through which a sensitivity study asks a surrogate."""

    @property
    def case(self) -> Case:
        """A case with the material, kind of load, model and shape of the surrogate."""

    def evaluate(
        self, *, size_ratio: Any, wall_ratio: Any, friction: Any, confining_pressure: Any
    ) -> Any:
        """Return outcomes, pressures, lower bounds and errors for arrays of inputs."""


@dataclass(frozen=True)
class SurrogateCases:
    """An evaluator that asks a surrogate.

    Attributes
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs. Its material, model, shape and kind of load must be
        those of the surrogate.
    surrogate : AnsweringSurrogate
        The surrogate.
    name : str
        Name of the surrogate.

    Raises
    ------
    BadInput
        The surrogate does not describe the case, or an uncertain input is none of its inputs.
    """

    uncertain: UncertainCase
    surrogate: AnsweringSurrogate
    name: str = ""

    def __post_init__(self) -> None:
        for key in self.uncertain.keys:
            if key not in VARIED:
                allowed = "one of " + ", ".join(VARIED) + " for a surrogate"
                raise BadInput("uncertain input", key, allowed, "or solve every case")
        asked, known = self.uncertain.median_case, self.surrogate.case
        parts = {
            "model": (asked.model, known.model),
            "law of the wall": (asked.ureter.material.law, known.ureter.material.law),
            "shape of the stone": (asked.stone.shape, known.stone.shape),
            "pre-stretch": (asked.load.prestretch, known.load.prestretch),
        }
        if asked.load.confining_pressure or "load.confining_pressure" in self.uncertain.keys:
            parts["confinement"] = (asked.load.confinement, known.load.confinement)
        for part, (mine, its) in parts.items():
            if mine != its:
                raise BadInput(part, mine, f"that of the surrogate, {its}", "or solve every case")

    @property
    def source(self) -> str:
        """Origin of the values in words."""
        name = f" '{self.name}'" if self.name else ""
        return f"surrogate{name} of the model '{self.surrogate.case.model.NAME}'"

    def __call__(self, inputs: Inputs) -> Evaluations:
        """Return the critical pressures; for the parameters see `Evaluator`."""
        return self._pressures(inputs, self._size_ratio(inputs))

    def critical_sizes(self, inputs: Inputs, limit: float) -> Evaluations:
        """Return the critical size ratios; for the parameters see `Evaluator`."""
        count = len(next(iter(inputs.values())))

        def pressures(sizes: Array, cases: Int[np.ndarray, " m"]) -> Evaluations:
            return self._pressures({key: each[cases] for key, each in inputs.items()}, sizes)

        return search_sizes(pressures, count, limit)

    def _pressures(self, inputs: Inputs, size_ratio: Array) -> Evaluations:
        wall_ratio = self._wall_ratio(inputs)
        possible = _within(size_ratio, SIZE_RATIO) & _within(wall_ratio, WALL_RATIO)
        found = self.surrogate.evaluate(
            size_ratio=np.where(possible, size_ratio, 1.0),
            wall_ratio=np.where(possible, wall_ratio, WALL_RATIO[1]),
            friction=self._of(inputs, "stone.friction"),
            confining_pressure=self._of(inputs, "load.confining_pressure"),
        )
        codes = np.array([OUTCOMES.index(each) for each in found.OUTCOMES])[found.outcome]
        outcome = np.where(found.outside, OUTSIDE, codes)
        missing = np.ma.getmaskarray(found.pressure) | ~possible
        bound = np.asarray(found.lower_bound)
        error = np.ma.masked_array(found.error, missing).max()
        return Evaluations(
            np.where(possible, outcome, BAD_INPUT),
            np.ma.masked_array(found.pressure.filled(0.0), missing),
            np.ma.masked_array(bound, ~missing | ~possible | (bound <= 0.0)),
            "" if possible.all() else "size ratio or wall ratio out of bounds",
            None if error is np.ma.masked else float(error),
        )

    def _size_ratio(self, inputs: Inputs) -> Array:
        if self._has(inputs, "stone.size_ratio"):
            return self._of(inputs, "stone.size_ratio")
        return self._of(inputs, "stone.diameter") / self._of(inputs, "ureter.inner_diameter")

    def _wall_ratio(self, inputs: Inputs) -> Array:
        if self._has(inputs, "ureter.wall_ratio"):
            return self._of(inputs, "ureter.wall_ratio")
        inner = self._of(inputs, "ureter.inner_diameter")
        if self._has(inputs, "ureter.outer_diameter"):
            return self._of(inputs, "ureter.outer_diameter") / inner
        return 1.0 + 2.0 * self._of(inputs, "ureter.wall_thickness") / inner

    def _has(self, inputs: Inputs, key: str) -> bool:
        return key in inputs or key in self.uncertain.fixed

    def _of(self, inputs: Inputs, key: str) -> Array:
        """Return the values of an input, which is either uncertain or fixed."""
        if key in inputs:
            return inputs[key]
        section, _, name = key.partition(".")
        value = getattr(getattr(self.uncertain.median_case, section), name)
        return np.full(len(next(iter(inputs.values()))), float(value))


def _within(values: Array, bounds: tuple[float, float]) -> Bool[np.ndarray, " n"]:
    return (values >= bounds[0]) & (values <= bounds[1])
