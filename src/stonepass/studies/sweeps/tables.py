"""The rows of a sweep as labelled arrays of a grid, and as CSV and parquet files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.io.column_names import unit_of
from stonepass.io.optional_imports import library
from stonepass.studies.sweeps.ledger import Ledger
from stonepass.studies.sweeps.points_file import EXTRA
from stonepass.studies.sweeps.shards import READ

__all__ = ["labelled", "write_csv_table", "write_parquet_table"]

NUMERIC = ("double", "int64", "bool")


def labelled(
    table: Callable[[list[str]], Any],
    types: dict[str, str],
    ledger: Ledger,
    columns: list[str] | None,
) -> Any:
    """Return the results of a sweep as an ``xarray.Dataset``.

    Parameters
    ----------
    table : callable
        Function that returns the rows of some columns as a table of pyarrow.
    types : dict of str to str
        Types of the columns by name.
    ledger : Ledger
        The ledger of the results.
    columns : list of str or None
        Columns of the data; by default the outcome and all numbers.
    """
    xarray = library("xarray", "make labelled arrays", EXTRA)
    grid = _coordinates(ledger.plan)
    sampled = [name for name in _inputs(ledger.plan) if name not in grid]
    if columns is None:
        columns = [n for n, kind in types.items() if n == "outcome" or kind == "double"]
    data = [name for name in columns if name not in (*grid, *sampled, "index")]
    read = table(["index", *sampled, *data])
    index, shape = read["index"].to_numpy(), [len(each) for each in grid.values()]
    found = {name: _on_grid(read[name], index, shape, types[name]) for name in (*sampled, *data)}
    variables = {name: (list(grid), found[name], _attributes(name)) for name in data}
    result = xarray.Dataset(variables, {name: list(each) for name, each in grid.items()})
    inner = tuple(range(1, len(shape)))
    for name in sampled:
        result = result.assign_coords({name: ("sample", _first(found[name], inner))})
        result[name].attrs |= _attributes(name)
    for name in grid:
        result[name].attrs |= _attributes(name)
    single = [name for name in ("model",) if len(grid[name]) == 1]
    return result.squeeze(single).assign_attrs(stonepass=ledger.version, study=ledger.digest)


def _coordinates(plan: dict[str, Any]) -> dict[str, Sequence[Any]]:
    """Return the coordinates of each dimension, in the order in which cases are enumerated."""
    found: dict[str, Sequence[Any]] = {}
    if plan["samples"] is not None:
        found["sample"] = range(plan["samples"])
    found |= {each["column"]: each["values"] for each in plan["axes"]}
    return found | {"model": [each["label"] for each in plan["models"]]}


def _inputs(plan: dict[str, Any]) -> list[str]:
    return [each["column"] for each in plan["inputs"]]


def _on_grid(column: Any, index: Int[np.ndarray, " n"], shape: list[int], kind: str) -> Any:
    """Return a column as an array on the grid; a case that is not finished is NaN or empty."""
    if kind in NUMERIC:
        whole = np.full(int(np.prod(shape)), np.nan)
        whole[index] = column.to_numpy()
    else:
        whole = np.full(int(np.prod(shape)), "", dtype=object)
        whole[index] = ["" if each is None else str(each) for each in column.to_pylist()]
    return whole.reshape(shape)


def _first(values: Float[np.ndarray, "n ..."], inner: tuple[int, ...]) -> Float[np.ndarray, " n"]:
    """Return the value of each sample, which is the same in all of its finished cases."""
    known = np.where(np.isnan(values), -np.inf, values).max(axis=inner)
    return np.where(np.isneginf(known), np.nan, known)


def _attributes(name: str) -> dict[str, str]:
    unit = unit_of(name)
    return {"units": unit} if unit else {}


def write_parquet_table(dataset: Any, path: Path) -> None:
    """Write all rows to one parquet file, part by part."""
    parquet = library("pyarrow.parquet", READ, EXTRA)
    with parquet.ParquetWriter(path, dataset.schema) as writer:
        for batch in dataset.to_batches():
            writer.write_batch(batch)


def write_csv_table(dataset: Any, path: Path) -> None:
    """Write all rows as CSV, part by part; a missing number is an empty cell.

    The numbers of a list are separated by semicolons.
    """
    pyarrow, csv = (library(name, READ, EXTRA) for name in ("pyarrow", "pyarrow.csv"))
    plain = pyarrow.schema(
        [
            (each.name, pyarrow.string() if pyarrow.types.is_list(each.type) else each.type)
            for each in dataset.schema
        ]
    )
    with csv.CSVWriter(path, plain) as writer:
        for batch in dataset.to_batches():
            columns = [_as_text(pyarrow, column) for column in batch.columns]
            writer.write_batch(pyarrow.RecordBatch.from_arrays(columns, schema=plain))


def _as_text(pyarrow: Any, column: Any) -> Any:
    """Return a column of lists as texts, any other column as it is."""
    if not pyarrow.types.is_list(column.type):
        return column
    return pyarrow.array(
        [None if each is None else "; ".join(map(repr, each)) for each in column.to_pylist()],
        pyarrow.string(),
    )
