"""The plan of a sweep: what is fixed, what is varied, and the inputs of each case by its index."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import prod
from typing import Any

from stonepass.array_dataclass import array_dataclass
from stonepass.errors import require
from stonepass.studies.sweeps.axes import Axis, Points, SampledRange
from stonepass.studies.sweeps.sampling import Sampling
from stonepass.studies.sweeps.varied_input import VariedInput, described, plain

__all__ = ["CaseInputs", "Sweep", "Variant"]


ACCURACY = "method.accuracy"


@dataclass(frozen=True)
class Variant:
    """A model of a sweep with its label and its options.

    Attributes
    ----------
    label : str
        Name in the column ``model``.
    values : mapping of str to value
        Raw values of the model and its options by key, e.g. ``{"method.model": "direct"}``.
    """

    label: str
    values: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class CaseInputs:
    """The inputs of one case.

    Attributes
    ----------
    index : int
        Index of the case in the sweep.
    label : str
        Label of the model.
    values : dict
        Raw values by key, from which `case_rows.build` makes the case; a constant of the law has
        the key ``ureter.material.NAME``.
    cells : dict
        Values of the varied inputs by column, as they stand in tables.
    """

    index: int
    label: str
    values: dict[str, Any]
    cells: dict[str, Any]


@array_dataclass
@dataclass(frozen=True)
class Sweep:
    """The plan of a sweep over many cases, which are enumerated by index and never listed.

    The cases are all combinations of samples (or points), values of the axes, and models. The model
    changes fastest from case to case, then the last axis, and the sample slowest.

    Attributes
    ----------
    fixed : mapping of str to value
        Raw values by the key of the case file that all cases have.
    axes : tuple of Axis
        Axes of the grid.
    ranges : tuple of SampledRange
        Ranges of the sampled inputs.
    sampling : Sampling, optional
        How the ranges are sampled; None without ranges.
    points : Points, optional
        Explicit points in the place of samples.
    models : tuple of Variant
        Models side by side, at least one.

    See Also
    --------
    read_sweep : reads a plan from a study file or a dictionary.
    """

    fixed: Mapping[str, Any]
    axes: tuple[Axis, ...] = ()
    ranges: tuple[SampledRange, ...] = ()
    sampling: Sampling | None = None
    points: Points | None = None
    models: tuple[Variant, ...] = (Variant("paper"),)

    @property
    def samples(self) -> int:
        """Number of samples or points; 1 without any."""
        if self.points is not None:
            return len(self.points.values) + self.points.first
        return 1 if self.sampling is None else self.sampling.count

    @property
    def sampled(self) -> bool:
        """True if there are samples or points."""
        return self.points is not None or self.sampling is not None

    @property
    def cases(self) -> int:
        """Number of cases."""
        return self.samples * self._per_sample

    @property
    def inputs(self) -> tuple[VariedInput, ...]:
        """The varied inputs: samples or points first, then the axes."""
        drawn = tuple(each.input for each in self.ranges)
        given = () if self.points is None else self.points.inputs
        return (*drawn, *given, *(each.input for each in self.axes))

    @cached_property
    def _per_sample(self) -> int:
        return prod(len(each.values) for each in self.axes) * len(self.models)

    def case(self, index: int) -> CaseInputs:
        """Return the inputs of one case."""
        return next(self.block(index, index + 1))

    def block(self, start: int, stop: int) -> Iterator[CaseInputs]:
        """Yield the inputs of the cases from `start` to `stop`, which is excluded."""
        first, last = start // self._per_sample, -(-stop // self._per_sample)
        drawn = (
            []
            if self.sampling is None
            else self.sampling.points(len(self.ranges), first, last).tolist()
        )
        for index in range(start, stop):
            sample, rest = divmod(index, self._per_sample)
            yield self._case(index, sample, rest, drawn[sample - first] if drawn else [])

    def _case(self, index: int, sample: int, rest: int, drawn: list[float]) -> CaseInputs:
        rest, model = divmod(rest, len(self.models))
        varied: dict[VariedInput, Any] = {}
        for each, fraction in zip(self.ranges, drawn, strict=True):
            varied[each.input] = each.at(fraction)
        if self.points is not None:
            row = self.points.row(sample)
            for given, number in zip(self.points.inputs, row, strict=True):
                varied[given] = given.from_number(number)
        chosen = []
        for axis in reversed(self.axes):
            rest, k = divmod(rest, len(axis.values))
            chosen.append((axis.input, axis.values[k]))
        varied |= dict(reversed(chosen))
        variant = self.models[model]
        cells = {each.column: plain(value) for each, value in varied.items()}
        values = {each.key: value for each, value in varied.items()}
        return CaseInputs(index, variant.label, {**self.fixed, **variant.values, **values}, cells)

    def part(self, start: int, stop: int) -> Sweep:
        """Return the plan with the points that the cases from `start` to `stop` need.

        The indices and inputs of the cases are the same. A worker is sent this smaller plan.
        """
        if self.points is None:
            return self
        first, last = start // self._per_sample, -(-stop // self._per_sample)
        return replace(self, points=self.points.part(first, last))

    def with_accuracy(self, accuracy: str) -> Sweep:
        """Return the plan with another accuracy level of the finite elements for all cases.

        Raises
        ------
        BadInput
            The accuracy is a varied input.
        """
        varied = any(each.key == ACCURACY for each in self.inputs)
        require(not varied, f"'{ACCURACY}'", "varied and given for all cases", "one of the two")
        models = tuple(
            replace(each, values={k: v for k, v in each.values.items() if k != ACCURACY})
            for each in self.models
        )
        return replace(self, fixed={**self.fixed, ACCURACY: accuracy}, models=models)

    def describe(self) -> dict[str, Any]:
        """Return a JSON-ready description, from which the digest of the study follows."""
        return {
            "cases": self.cases,
            "samples": self.samples if self.sampled else None,
            "fixed": {key: described(value) for key, value in sorted(self.fixed.items())},
            "axes": [each.describe() for each in self.axes],
            "ranges": [each.describe() for each in self.ranges],
            "sampling": None
            if self.sampling is None
            else [self.sampling.method, self.sampling.count, self.sampling.seed],
            "points": None if self.points is None else self.points.describe(),
            "models": [
                {
                    "label": each.label,
                    "values": {key: described(value) for key, value in each.values.items()},
                }
                for each in self.models
            ],
            "inputs": [
                {"key": each.key, "column": each.column, "type": each.type} for each in self.inputs
            ],
        }

    @property
    def digest(self) -> str:
        """SHA-256 digest of the description in hexadecimal digits."""
        text = json.dumps(self.describe(), sort_keys=True, allow_nan=False)
        return hashlib.sha256(text.encode()).hexdigest()
