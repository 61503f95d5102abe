"""What a part of the paper comes to: figures, their data, and claims beside the published ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from stonepass.errors import require
from stonepass.inputs.measured_pressures import Point
from stonepass.io.csv_file import write_csv
from stonepass.model.answer import Answer
from stonepass.records.answer import answer_record
from stonepass.report.style import save
from stonepass.units import Pressure

__all__ = ["Asked", "Claim", "Illustration", "Section", "Table", "answers_table"]

LIMITS = (1e2, 1e5)  # Pa


@dataclass(frozen=True)
class Asked:
    """What the reader chose: the pressure limit, and measured points where there are any."""

    limit: Pressure
    points: tuple[Point, ...] = ()

    def __post_init__(self) -> None:
        low, high = LIMITS
        shown = f"{self.limit / 1e3:g} kPa"
        require(low <= self.limit <= high, "limit", shown, "0.1 kPa to 100 kPa")


@dataclass(frozen=True)
class Claim:
    """A published statement beside our number.

    Attributes
    ----------
    what, published, ours : str
        The statement, what the paper says, what we find.
    deviation : float or None
        Ours less the published number, in its unit; None where the statement is no number.
    tolerance : float or None
        How large it may be for the claim to count as reproduced.
    holds : bool or None
        Whether it is; None where it cannot be judged, for the reason given.
    reason : str
        Why that tolerance; where the claim is not reproduced or cannot be judged, why.
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
        """A number, to within a tolerance."""
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
    """Make a table of answers; columns are names of `report.record`, or the load's."""
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


# Numbers of one model alone that the tables have a column for.
DETAILS = ("closure_end_pressure_kPa", "leak_pressure_kPa")


@dataclass(frozen=True)
class Illustration:
    """A picture: file name without ending, the figure, and what it shows."""

    name: str
    figure: Figure
    caption: str


@dataclass(frozen=True)
class Section:
    """One part, written: names of files in the order of the page, captions, claims."""

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
            picture.figure.set_layout_engine("none")  # laid out for the first, it is for both
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
