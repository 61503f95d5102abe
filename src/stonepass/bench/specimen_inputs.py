"""The inputs of a tensile test beside its table, declared once for all doors."""

from __future__ import annotations

from typing import Any

from stonepass.declaration import DeclaredInput, Kind, free_input, read_declared

__all__ = ["RELATIVE", "SIZES", "read_sizes"]

_LENGTHS = (1e-5, 1.0)  # m
_AREAS = (1e-10, 1e-2)  # m²

# Sizes of the strip at rest by their keys.
SIZES: dict[str, DeclaredInput] = {
    each.name: each
    for each in (
        free_input(
            "width",
            Kind.LENGTH,
            "--width",
            "Width of the strip at rest; needed with forces.",
            bounds=_LENGTHS,
        ),
        free_input(
            "thickness",
            Kind.LENGTH,
            "--thickness",
            "Thickness of the strip at rest; needed with forces.",
            bounds=_LENGTHS,
        ),
        free_input(
            "section",
            Kind.AREA,
            "--section",
            "Cross-section of the strip at rest, e.g. 12mm2; replaces width and thickness.",
            bounds=_AREAS,
        ),
        free_input(
            "gauge_length",
            Kind.LENGTH,
            "--gauge-length",
            "Length at rest over which the extension was measured; needed with extensions.",
            bounds=_LENGTHS,
        ),
    )
}
RELATIVE = free_input(
    "relative",
    Kind.FLAG,
    "--relative/--absolute",
    "Errors of measurement are proportional to the measured values (relative), or of equal size "
    "(absolute).",
    default=False,
)


def read_sizes(words: dict[str, str] | None = None, **given: Any) -> dict[str, Any]:
    """Read and check sizes of a strip at rest.

    Parameters
    ----------
    words : dict of str to str, optional
        The name of a size in messages; by default its key in `SIZES`.
    **given
        Sizes by their keys in `SIZES`, as text with a unit or as lengths and areas; None stays.

    Returns
    -------
    dict
        Lengths in m and areas in m².

    Raises
    ------
    BadInput
        The unit is missing or wrong, or the size is out of its bounds.
    """
    return {
        key: None
        if value is None
        else read_declared(SIZES[key].declaration, (words or {}).get(key, key), value)
        for key, value in given.items()
    }
