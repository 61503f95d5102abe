"""The results of a sweep, read from their folder when they are needed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput, StonepassError, refuse_unknown
from stonepass.io.optional_imports import library
from stonepass.io.text_file import check_writable
from stonepass.result import Result
from stonepass.studies.sweeps.case_rows import COLUMNS
from stonepass.studies.sweeps.ledger import Ledger, read_ledger
from stonepass.studies.sweeps.points_file import EXTRA
from stonepass.studies.sweeps.recovery import flaw_of
from stonepass.studies.sweeps.shards import READ, arrow_type
from stonepass.studies.sweeps.tables import labelled, write_csv_table, write_parquet_table

__all__ = ["TABLES", "SweepResults", "read_results"]

TABLES = (".csv", ".parquet", ".nc")
OTHERS = (".json", ".svg", ".png", ".pdf")  # endings of the summary and of pictures


@dataclass(frozen=True, repr=False)
class SweepResults(Result):
    """The results of a sweep; a sequence of rows, which stay on disk until they are needed.

    Attributes
    ----------
    folder : Path
        Folder of the results.
    ledger : Ledger
        The ledger when the results were opened.
    """

    folder: Path
    ledger: Ledger

    def __len__(self) -> int:
        """Return the number of finished cases, which is the number of rows."""
        return self.ledger.finished

    @property
    def cases(self) -> int:
        """Number of cases of the study, whether or not they are finished."""
        return self.ledger.cases

    @property
    def inputs(self) -> tuple[str, ...]:
        """Columns of the varied inputs."""
        return tuple(each["column"] for each in self.ledger.plan["inputs"])

    @property
    def models(self) -> tuple[str, ...]:
        """Labels of the models."""
        return tuple(each["label"] for each in self.ledger.plan["models"])

    @property
    def columns(self) -> dict[str, str]:
        """Types of all columns by name, in the order of the table."""
        types = self.ledger.columns
        first = ["index", "fingerprint", *self.inputs]
        common = [*first, *(name for name in COLUMNS if name not in first)]
        own = sorted(types.keys() - set(common))
        return {name: types[name] for name in (*common, *own) if name in types}

    @property
    def counts(self) -> dict[str, dict[str, int]]:
        """Number of rows by model and outcome."""
        found: dict[str, dict[str, int]] = {label: {} for label in self.models}
        for entry in self.ledger.entries:
            for model, outcome, count in entry.counts:
                of_model = found.setdefault(model, {})
                of_model[outcome] = of_model.get(outcome, 0) + count
        return found

    @property
    def seconds(self) -> float:
        """Time in s in which all finished cases were solved, summed over the workers."""
        return sum(each.seconds for each in self.ledger.entries)

    def summary(self) -> str:
        """Return the number of rows, the outcomes and the varied inputs in one line."""
        outcomes: dict[str, int] = {}
        for of_model in self.counts.values():
            for outcome, count in of_model.items():
                outcomes[outcome] = outcomes.get(outcome, 0) + count
        told = ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items()))
        return (
            f"{len(self)} of {self.cases} cases{': ' if told else ''}{told}; varied "
            f"{', '.join(self.inputs) or 'model'}; model {', '.join(self.models)}"
        )

    def dataset(self) -> Any:
        """Return the rows as a ``pyarrow.dataset.Dataset`` in the order of the cases.

        Raises
        ------
        StonepassError
            A file of results is missing or damaged.
        """
        pyarrow, datasets = (library(name, READ, EXTRA) for name in ("pyarrow", "pyarrow.dataset"))
        schema = pyarrow.schema([(n, arrow_type(kind)) for n, kind in self.columns.items()])
        paths = self._paths
        # An empty list of files would be taken for a folder.
        if not paths:
            return datasets.dataset(schema.empty_table())
        # Reading ahead serves remote files, and costs a third of the time with small local ones.
        options = datasets.ParquetFragmentScanOptions(pre_buffer=False)
        files = datasets.ParquetFileFormat(default_fragment_scan_options=options)
        return datasets.dataset(paths, schema=schema, format=files)

    def table(self, columns: Iterable[str] | None = None, filter: Any = None) -> Any:
        """Return rows as a ``pyarrow.Table``, with null where there is no number.

        Parameters
        ----------
        columns : iterable of str, optional
            Names of columns; all by default.
        filter : pyarrow.dataset.Expression, optional
            Condition on the rows, e.g. ``pyarrow.dataset.field("outcome") == "MOVES"``.

        Raises
        ------
        BadInput
            A column is unknown.
        StonepassError
            A file of results is missing or damaged.
        """
        try:
            return self.dataset().to_table(columns=self._known(columns), filter=filter)
        except OSError as problem:
            raise self._damaged(str(problem)) from problem

    def batches(self, columns: Iterable[str] | None = None) -> Iterator[Any]:
        """Yield the rows in parts, each a ``pyarrow.RecordBatch``, so that memory is bounded."""
        yield from self.dataset().to_batches(columns=self._known(columns))

    def to_frame(self, columns: Iterable[str] | None = None, filter: Any = None) -> Any:
        """Return rows as a pandas DataFrame, in which a missing number is NaN.

        Parameters
        ----------
        columns, filter
            As for `table`.
        """
        library("pandas", "make a data frame", EXTRA)
        return self.table(columns, filter).to_pandas()

    def to_xarray(self, columns: Iterable[str] | None = None) -> Any:
        """Return the results as an ``xarray.Dataset`` whose dimensions are the axes of the grid.

        Parameters
        ----------
        columns : iterable of str, optional
            Names of columns; by default the outcome and all numbers.

        Returns
        -------
        xarray.Dataset
            One dimension for each axis, ``sample`` for samples or points, and ``model`` for several
            models. Sampled inputs are coordinates of the samples. A missing number is NaN, and the
            outcome of a case that is not finished is an empty text.
        """
        return labelled(self.table, self.columns, self.ledger, self._known(columns))

    def save(self, path: str | Path) -> None:
        """Write the results to a file; an existing file is replaced.

        Parameters
        ----------
        path : str or Path
            All rows for the endings .csv and .parquet, labelled arrays for .nc (netCDF), the
            summary for .json, and a picture for .svg, .png and .pdf.

        Raises
        ------
        BadInput
            The name has another ending, or the folder cannot be written.
        """
        path = Path(path)
        ending = path.suffix.lower()
        if ending in OTHERS:
            super().save(path)
            return
        check_writable(path, (*TABLES, *OTHERS))
        beside = path.with_name(f".{path.name}.new")
        try:
            if ending == ".nc":
                self.to_xarray().to_netcdf(beside, engine="h5netcdf")
            else:
                write = write_csv_table if ending == ".csv" else write_parquet_table
                write(self.dataset(), beside)
            beside.replace(path)
        except OSError as problem:
            raise BadInput("output file", path, f"writable ({problem.strerror})") from problem
        finally:
            beside.unlink(missing_ok=True)

    def _known(self, columns: Iterable[str] | None) -> list[str] | None:
        if columns is None:
            return None
        asked, known = list(columns), self.columns
        for each in asked:
            if each not in known:
                refuse_unknown("column", each, list(known))
        return asked

    @cached_property
    def _paths(self) -> list[str]:
        """Paths of all shards, whose digests are checked once, when rows are first read."""
        for each in self.ledger.entries:
            flaw = flaw_of(self.folder, each)
            if flaw:
                raise self._damaged(flaw)
        return [str(self.folder / each.shard) for each in self.ledger.entries]

    def _damaged(self, what: str) -> StonepassError:
        return StonepassError(
            f"a file of results in '{self.folder}' is missing or damaged ({what}): the same sweep, "
            "resumed, solves its cases again."
        )


def read_results(folder: str | Path) -> SweepResults:
    """Open the results of a sweep; rows are read when they are needed.

    Parameters
    ----------
    folder : str or Path
        Folder of the results. The sweep may still be running; its finished blocks are then read.

    Returns
    -------
    SweepResults

    Raises
    ------
    BadInput
        The folder has no results, or they have another format.

    References
    ----------
    docs/howto/sweep.md, "Reading the results".
    """
    path = Path(folder)
    return SweepResults(path, read_ledger(path))
