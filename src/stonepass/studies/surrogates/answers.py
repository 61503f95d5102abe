"""The answers of a surrogate for many conditions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float, Int
from stonepass.errors import Outcome, require
from stonepass.io.csv_file import write_csv
from stonepass.io.optional_imports import library
from stonepass.studies.surrogates.solved import NO_SOLUTION, OUTCOMES, UNITS, Solved

__all__ = ["SurrogateAnswers"]

# Ending of the key and factor of a number with a given unit, in rows.
_SHOWN = {"rad": ("_deg", 180.0 / np.pi), "Pa": ("_kPa", 1e-3), "": ("", 1.0)}


@array_dataclass
@dataclass(frozen=True, repr=False)
class SurrogateAnswers:
    """The answers of a surrogate for n conditions.

    Attributes
    ----------
    inputs : mapping of str to array (n)
        The inputs of `Surrogate.evaluate` by name, in SI units.
    outcome : array (n) of int
        Places in `OUTCOMES`, the tuple of possible outcomes.
    pressure : masked array (n)
        P_ucr in Pa; masked where it does not exist.
    error : masked array (n)
        Claimed error of P_ucr in Pa; masked where P_ucr is.
    lower_bound : array (n)
        Pressure in Pa that P_ucr exceeds: the end of the closure for the outcome BEYOND_CLOSURE,
        and the largest pressure of a surrogate of the direct model; otherwise 0.
    outside : array (n) of bool
        True for a condition that the surrogate does not cover; its outcome is NO_SOLUTION.
    quantities : mapping of str to masked array (n)
        Further results by name: ``contact_angle`` in rad; for the direct model also
        ``leak_pressure`` and ``friction_work`` in Pa (the dissipation D divided by π R_s²), and
        ``opened_radius``, r_a/R_a of the tube under P_ucr.
    """

    OUTCOMES: ClassVar[tuple[Outcome, ...]] = OUTCOMES

    inputs: Mapping[str, Float[np.ndarray, " n"]]
    outcome: Int[np.ndarray, " n"]
    pressure: Any
    error: Any
    lower_bound: Float[np.ndarray, " n"]
    outside: Bool[np.ndarray, " n"]
    quantities: Mapping[str, Any]

    @classmethod
    def of(cls, inputs: Mapping[str, Float[np.ndarray, " n"]], solved: Solved) -> SurrogateAnswers:
        """Return the answers with all missing numbers masked."""
        quantities = {name: np.ma.masked_invalid(each) for name, each in solved.quantities.items()}
        pressure = np.ma.masked_invalid(solved.pressure)
        error = np.ma.array(quantities.pop("error"), mask=np.ma.getmaskarray(pressure))
        outcome = solved.outcome.astype(np.int8)
        outside = outcome == NO_SOLUTION
        return cls(inputs, outcome, pressure, error, solved.lower_bound, outside, quantities)

    @property
    def outcomes(self) -> list[Outcome]:
        """The outcome of every condition."""
        return [OUTCOMES[k] for k in self.outcome]

    @property
    def censored(self) -> Bool[np.ndarray, " n"]:
        """True where only a lower bound of P_ucr is known."""
        return self.lower_bound > 0.0

    @property
    def answered(self) -> Bool[np.ndarray, " n"]:
        """True where the outcome is an answer (see `Outcome.answered`)."""
        return np.array([each.answered for each in OUTCOMES])[self.outcome]

    def to_rows(self) -> list[dict[str, Any]]:
        """Return one dictionary per condition; a number that does not exist is None.

        Pressures are in kPa and angles in degrees; units are part of the keys.
        """
        columns = self._columns()
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]

    def _columns(self) -> dict[str, Any]:
        """Return the columns of `to_rows` as lists."""
        columns: dict[str, Any] = {}
        for name, values in self.inputs.items():
            pressure = name.endswith("pressure")
            columns[f"{name}_kPa" if pressure else name] = _plain(values, 1e-3 if pressure else 1.0)
        columns |= {
            "outcome": [OUTCOMES[k].name for k in self.outcome],
            "outside": self.outside.tolist(),
            "critical_pressure_kPa": _plain(self.pressure, 1e-3),
            "critical_pressure_error_kPa": _plain(self.error, 1e-3),
            "lower_bound_kPa": _plain(self.lower_bound, 1e-3),
        }
        for name, values in self.quantities.items():
            unit, factor = _SHOWN[UNITS[name]]
            columns[name + unit] = _plain(values, factor)
        return columns

    def save(self, path: str | Path) -> None:
        """Write `to_rows` as CSV; an existing file is replaced.

        Parameters
        ----------
        path : str or Path
            A file with the ending .csv.

        Raises
        ------
        BadInput
            The file has another ending or cannot be written.
        """
        require(Path(path).suffix == ".csv", "file", path, "a file with the ending .csv")
        columns = self._columns()
        write_csv(Path(path), columns, zip(*columns.values(), strict=True))

    def to_frame(self) -> Any:
        """Return a pandas table with one row per condition; units are in the column names."""
        pandas = library("pandas", "make a table of answers", "studies")
        names = [each.name for each in OUTCOMES]
        inputs = {f"{name}_Pa" if name.endswith("pressure") else name: each for name, each in
                  self.inputs.items()}  # fmt: skip
        outcome = {"outcome": pandas.Categorical.from_codes(self.outcome, names)}
        numbers = {"critical_pressure_Pa": self.pressure, "critical_pressure_error_Pa": self.error,
                   "lower_bound_Pa": self.lower_bound}  # fmt: skip
        numbers |= {f"{name}_{UNITS[name]}".rstrip("_"): each for name, each in
                    self.quantities.items()}  # fmt: skip
        filled = {name: np.ma.filled(each, np.nan) for name, each in numbers.items()}
        return pandas.DataFrame(inputs | outcome | {"outside": self.outside} | filled)

    def __len__(self) -> int:
        return len(self.outcome)

    def __repr__(self) -> str:
        counts = Counter(self.outcome.tolist())
        parts = [f"{OUTCOMES[k].name} {counts[k]:,}" for k in sorted(counts)]
        what = "1 condition" if len(self) == 1 else f"{len(self):,} conditions"
        return f"<SurrogateAnswers: {'; '.join([what, ', '.join(parts)]) if parts else what}>"


def _plain(values: Any, factor: float) -> list[float | None]:
    """Return numbers in another unit as a list, with None in the place of masked ones."""
    listed: list[float | None] = np.ma.masked_array(values * factor).tolist()
    return listed
