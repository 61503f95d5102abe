"""The fingerprint that tells the input deck of one case and mesh from all others."""

from __future__ import annotations

import hashlib
import json

from stonepass.about import VERSION
from stonepass.inputs.case_record import describe
from stonepass.model.case import Case
from stonepass.units import Length

__all__ = ["fingerprint"]

LETTERS = 8


def fingerprint(case: Case, inner_radius: Length, fine: float) -> str:
    """Return eight letters and digits that depend on all that an input deck depends on.

    They follow from those parts of the canonical record of the case that the seated state has.

    Parameters
    ----------
    case : Case
    inner_radius : Length
        Inner radius R_a of the deck in m.
    fine : float
        Length of the elements in the contact over R_a.
    """
    record = describe(case, case.model, case.numerics)
    document = {
        "version": VERSION,
        **{part: record[part] for part in ("stone", "ureter", "load")},
        "seating": {name: record["model"].get(name) for name in ("seating", "seating_friction")},
        "half_length": record["numerics"]["half_length"],
        "inner_radius_m": inner_radius,
        "fine": fine,
    }
    text = json.dumps(document, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:LETTERS].upper()
