"""Results of a part of the paper: figures, their data, and published claims beside ours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from stonepass.inputs.measured_pressures import Point
from stonepass.io.csv_file import write_csv
from stonepass.model.answer import Answer
from stonepass.records.answer import answer_record
from stonepass.report.style import save
from stonepass.units import Pressure

__all__ = ["Asked", "Claim", "Illustration", "Section", "Table", "answers_table"]


@dataclass(frozen=True)
class Asked:
    """Inputs of a reproduction: the pressure limit, and measured points if there are any."""

    limit: Pressure
    points: tuple[Point, ...] = ()


@dataclass(frozen=True)
class Claim:
    """A published statement beside our number.

    Attributes
    ----------
    what, published, ours : str
        The statement, the published value, and our value.
    deviation : float or None
        Our number minus the published one, in its unit; None if there is no number.
    tolerance : float or None
        Largest deviation with which the claim counts as reproduced.
    holds : bool or None
        Whether the claim is reproduced; None if it cannot be judged.
    reason : str
        Reason for the tolerance, or why the claim is not reproduced or cannot be judged.
    """

    what: str
    published: str
    ours: str
    holds: bool | None
    reason: str
    deviation: float | None = None
    tolerance: float | None = None

    @classmethod
    def number(
        cls, what: str, published: float, ours: float | None, tolerance: float, reason: str
    ) -> Claim:
        """Return the claim of a number that must agree within a tolerance."""
        if ours is None:
            return cls(what, f"{published:g}", "none", False, reason, None, tolerance)
        off = ours - published
        return cls(what, f"{published:g}", f"{ours:.4g}", abs(off) <= tolerance, reason, off,
                   tolerance)  # fmt: skip


@dataclass(frozen=True)
class Table:
    """Data of a picture: file name, columns, rows."""

    name: str
    header: Sequence[str]
    rows: Sequence[Sequence[Any]]


def answers_table(name: str, header: Sequence[str], answers: Sequence[Answer]) -> Table:
    """Return a table of answers; columns are keys of `answer_record`, or of the load."""
    rows = []
    for answer in answers:
        confining = answer.case.load.confining_pressure
        found = answer_record(answer)
        known = (
            found.to_dict()
            | dict.fromkeys(DETAILS)
            | found.detail
            | {
                "confining_kPa": confining / 1e3,
                "confinement": answer.case.load.confinement if confining else "",
            }
        )
        rows.append([known[column] for column in header])
    return Table(name, header, rows)


# Numbers that only one model has, and for which the tables have a column.
DETAILS = ("closure_end_pressure_kPa", "leak_pressure_kPa")


@dataclass(frozen=True)
class Illustration:
    """A picture: file name without ending, the figure, and its caption."""

    name: str
    figure: Figure
    caption: str


@dataclass(frozen=True)
class Section:
    """A part that was written: names of files in the order of the page, captions, claims."""

    title: str
    text: str
    pictures: tuple[tuple[str, str], ...]
    files: tuple[str, ...]
    claims: tuple[Claim, ...]
    warnings: tuple[str, ...] = ()

    @classmethod
    def written(
        cls,
        title: str,
        text: str,
        folder: Path,
        pictures: Sequence[Illustration] = (),
        tables: Sequence[Table] = (),
        claims: Sequence[Claim] = (),
        files: Sequence[str] = (),
    ) -> Section:
        """Write pictures (SVG and PNG) and tables (CSV) into a folder."""
        for picture in pictures:
            save(picture.figure, folder / f"{picture.name}.svg")
            picture.figure.set_layout_engine("none")  # both files have the layout of the first
            save(picture.figure, folder / f"{picture.name}.png")
        for table in tables:
            write_csv(folder / f"{table.name}.csv", table.header, table.rows)
        return cls(
            title,
            text,
            tuple((picture.name, picture.caption) for picture in pictures),
            (*(f"{table.name}.csv" for table in tables), *files),
            tuple(claims),
        )
