"""Reader of sensitivity studies from TOML files.

The fixed inputs are written as in a case file. The section ``uncertain`` has a range or a
distribution for each uncertain input, and the section ``sensitivity`` has the settings.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput, refuse_unknown
from stonepass.inputs.build import in_words
from stonepass.inputs.case_file import WORDS, checked_values
from stonepass.inputs.catalogue import all_inputs, sections
from stonepass.inputs.overlay import refuse_pairs
from stonepass.inputs.sections import FileSection
from stonepass.io.toml_document import read_document
from stonepass.io.toml_file import merged, parse_table
from stonepass.studies.seed import SEED
from stonepass.studies.sensitivity.study import SensitivityStudy
from stonepass.studies.sensitivity.uncertain_case import uncertain_values

__all__ = ["read_sensitivity"]

UNCERTAIN, SETTINGS = "uncertain", "sensitivity"


class _Settings(FileSection):
    method: str | None = None
    limit: str | None = None
    samples: int | None = None
    seed: int = SEED.default
    surrogate: str | None = None
    sweep: str | None = None


class _Own(FileSection):
    sensitivity: _Settings = _Settings()


def read_sensitivity(path: str | Path, **overrides: Any) -> SensitivityStudy:
    """Read a sensitivity study.

    Parameters
    ----------
    path : str or Path
        A TOML file. Relative paths in it start at its folder.
    **overrides
        Settings that replace those of the file (see `SensitivityStudy`); None keeps the file's.

    Returns
    -------
    SensitivityStudy

    Raises
    ------
    BadInput
        The file cannot be read, a key is unknown or missing, a value has the wrong type or unit or
        is out of bounds, an input is both fixed and uncertain, or the medians describe no possible
        case. The message names the file and the key.

    References
    ----------
    docs/howto/sensitivity.md, "The file".
    """
    path = Path(path)
    document = read_document(path)
    for key in document:
        if key not in (*sections(), UNCERTAIN, SETTINGS):
            refuse_unknown(f"in {path.name}, key", key, [*sections(), UNCERTAIN, SETTINGS])
    own = {SETTINGS: document.pop(SETTINGS)} if SETTINGS in document else {}
    settings = parse_table(own, _Own, f"in {path.name}, ").sensitivity.model_dump()
    uncertain = document.pop(UNCERTAIN, None)
    if not isinstance(uncertain, dict) or not uncertain:
        value = "missing" if uncertain is None else uncertain
        allowed = f"a section [{UNCERTAIN}] with at least one input"
        raise BadInput(f"in {path.name}, '{UNCERTAIN}'", value, allowed)
    fixed, leaves = checked_values(document, path), _leaves(uncertain)
    try:
        for key in leaves:
            if key in fixed:
                raise BadInput(f"'{key}'", "fixed and uncertain", "one of the two")
        refuse_pairs({**fixed, **leaves}, {key: f"'{key}'" for key in all_inputs()})
        case = uncertain_values(fixed, leaves, path.parent)
        named = settings["surrogate"]
        if named is not None and Path(named).suffix == ".json":
            settings["surrogate"] = str(path.parent / named)
        if settings["sweep"] is not None:
            settings["sweep"] = str(path.parent / settings["sweep"])
        given = {name: value for name, value in overrides.items() if value is not None}
        return SensitivityStudy(case, **settings | given)
    except BadInput as problem:
        raise in_words(problem, WORDS).within(path.name) from problem


def _leaves(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return the entries by key; a key may be quoted, or written with sub-sections."""
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{prefix}{name}"
        more = _leaves(value, f"{key}.") if isinstance(value, dict) else {key: value}
        found = merged(found, more)
    return found
