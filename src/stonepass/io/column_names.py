"""Errors for unknown column names, with a suggestion that never changes the unit of the values."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from difflib import get_close_matches
from typing import NoReturn

from stonepass.errors import BadInput
from stonepass.units import unit_ratio

__all__ = ["is_unit", "refuse_column", "same_unit", "unit_of"]

# Units at the end of column names, in addition to the lengths and pressures of `stonepass.units`.
_FACTORS = {"N": 1.0, "kN": 1e3, "mN": 1e-3, "cN": 1e-2, "kgf": 9.80665, "gf": 9.80665e-3}
# Words in the names of columns whose values must be converted, which renaming would not do.
_OTHER_MEASURES = (
    ("strain", "stretch", "a stretch is 1 + the strain"),
    ("radius", "diameter", "a diameter is twice the radius"),
)
PER_CENT = ", which is the value in per cent divided by 100"
NEAR = 0.45  # smallest similarity of a name and the one that was probably meant
_TIMES = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0}
_ANGLES = {"deg": 1.0, "rad": 57.29577951308232}


def refuse_column(where: str, name: str, known: Sequence[str], header: Collection[str]) -> NoReturn:
    """Refuse an unknown column, and suggest the nearest known name or a conversion of the unit.

    Parameters
    ----------
    where : str
        Beginning of the message, with the name of the file.
    name : str
        The name of the column, one of `header`.
    known : sequence of str
        Columns that the table may have.
    header : collection of str
        Columns that the table has; they are not suggested.

    Raises
    ------
    BadInput
        Always.
    """
    left = [each for each in known if each not in header]
    for word, meant, rule in _OTHER_MEASURES:
        near = [each for each in known if meant in each]
        if word in name.lower() and near:
            other = get_close_matches(name.lower().replace(word, meant), near, n=1, cutoff=0.0)[0]
            part = PER_CENT if meant == "stretch" and _in_per_cent(name) else ""
            raise BadInput(where, name, f"one of {', '.join(known)}",
                           f"convert the values to '{other}': {rule}{part}")  # fmt: skip
    stem, unit = _split(name)
    stems = {_split(each)[0]: each for each in left}
    same = stems.get(stem) or next(
        (stems[each] for each in get_close_matches(stem, stems, n=1, cutoff=0.75)), None
    )
    allowed = "one of " + ", ".join(known)
    wanted = "" if same is None else _split(same)[1]
    ratio = _ratio(unit, wanted)
    if same is not None and ratio not in (None, 1.0):
        raise BadInput(where, name, same, f"convert the values from {unit} to {wanted}: "
                       f"1 {unit} is {ratio:.6g} {wanted}")  # fmt: skip
    for each in get_close_matches(name, left, n=3, cutoff=NEAR):
        its = _split(each)[1]
        if its == unit:
            raise BadInput(where, name, allowed, f"did you mean '{each}'")
        if not unit:
            raise BadInput(where, name, allowed, f"write '{each}' if its values are in {its}")
    raise BadInput(where, name, allowed, "leave out columns that the command does not use")


def _in_per_cent(name: str) -> bool:
    return "%" in name or "percent" in name.lower().replace(" ", "").replace("_", "")


def unit_of(name: str) -> str:
    """Return the unit at the end of a column name; empty if the name has no unit."""
    return _split(name)[1]


def is_unit(text: str) -> bool:
    """Return whether a text is a unit that may stand at the end of a column name."""
    return _ratio(text, text) is not None


def same_unit(unit: str, other: str) -> bool:
    """Return whether two names stand for one unit."""
    return unit == other or _ratio(unit, other) == 1.0


def _split(name: str) -> tuple[str, str]:
    """Return the column name without its unit, and the unit, which may be empty."""
    stem, _, end = name.rpartition("_")
    return (stem, end) if stem and is_unit(end) else (name, "")


def _ratio(unit: str, wanted: str) -> float | None:
    """Return how many `wanted` units one `unit` is; None if they measure different quantities."""
    for table in (_FACTORS, _ANGLES, _TIMES):
        if unit in table and wanted in table:
            return table[unit] / table[wanted]
    return unit_ratio(unit, wanted)
