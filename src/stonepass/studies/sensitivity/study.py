"""A sensitivity study: the uncertain case, the method, the pressure limit and the samples."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.errors import Misplaced, refuse_unknown, require
from stonepass.model.pressure_limit import read_limit
from stonepass.model.problem import require_kind
from stonepass.studies.seed import SEED, check_seed
from stonepass.studies.sensitivity.uncertain_case import UncertainCase
from stonepass.units import Pressure, Quantity

__all__ = ["METHODS", "SensitivityStudy"]

# Methods, and the meaning, the default and the bounds of the number of samples.
METHODS = {
    "sobol": ("base samples, a power of two", 1024, (32, 65_536)),
    "morris": ("trajectories", 10, (4, 10_000)),
}


@dataclass(frozen=True)
class SensitivityStudy:
    """The question how sensitive the critical pressure is to each of some uncertain inputs.

    Parameters
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs (see `uncertain_case`).
    method : {"sobol", "morris"}, optional
        Sobol' indices or elementary effects of Morris. By default elementary effects if every case
        must be solved with finite elements, else Sobol' indices.
    limit : str, Pressure or pint.Quantity, optional
        Pressure limit, 1 Pa to 1 MPa; text has a unit, e.g. ``"12 kPa"``. With a limit the study
        also has the sensitivity of the critical size, and of the outcome that the stone moves.
    samples : int, optional
        For Sobol' indices the number of base samples, a power of two from 32 to 65536 (1024 by
        default); d inputs need 2 d + 2 cases for each of them. For Morris the number of
        trajectories, 4 to 10000 (10 by default); each of them needs d + 1 cases.
    seed : int
        Seed of the samples, 0 to 2³² − 2.
    surrogate : str, optional
        Material of a surrogate of the package, e.g. ``"ureter"``, or the JSON file of a surrogate,
        which then answers the cases in the place of the model.
    sweep : str, optional
        Folder of the results of a sweep over the uncertain inputs, which are interpolated.

    Raises
    ------
    BadInput
        A value is of the wrong kind or out of bounds, or both a surrogate and a sweep are given.

    References
    ----------
    docs/howto/sensitivity.md
    """

    uncertain: UncertainCase
    method: str | None = None
    limit: str | Pressure | Quantity | None = None
    samples: int | None = None
    seed: int = SEED.default
    surrogate: str | None = None
    sweep: str | None = None

    def __post_init__(self) -> None:
        require_kind("uncertain", self.uncertain, UncertainCase, "uncertain_case(case, {…})")
        if self.surrogate is not None and self.sweep is not None:
            raise Misplaced("surrogate", "a sweep", "", "give one of the two")
        method = self.method or self._default_method()
        if method not in METHODS:
            refuse_unknown("method", str(method), list(METHODS))
        meaning, default, (low, high) = METHODS[method]
        count = default if self.samples is None else self.samples
        whole = isinstance(count, int) and not isinstance(count, bool) and low <= count <= high
        right = whole and (method != "sobol" or count & (count - 1) == 0)
        require(right, "samples", count, f"a number of {meaning}, from {low} to {high}")
        check_seed(self.seed)
        limit = None if self.limit is None else read_limit(self.limit)
        for name, value in (("method", method), ("samples", count), ("limit", limit)):
            object.__setattr__(self, name, value)

    def _default_method(self) -> str:
        return "morris" if self.needs_elements else "sobol"

    @property
    def needs_elements(self) -> bool:
        """True if every case must be solved with finite elements."""
        if self.surrogate is not None or self.sweep is not None:
            return False
        return self.uncertain.median_case.model.NEEDS_ELEMENTS

    @property
    def cases(self) -> int:
        """Number of cases of the samples, without those of the tornado."""
        count = len(self.uncertain.inputs)
        assert self.samples is not None
        return self.samples * (2 * count + 2 if self.method == "sobol" else count + 1)
