"""The fingerprint that identifies the input deck of a case and a mesh."""

from __future__ import annotations

import hashlib
import json

from stonepass.about import VERSION
from stonepass.inputs.case_record import describe
from stonepass.model.case import Case
from stonepass.units import Length

__all__ = ["fingerprint"]

LETTERS = 8  # length of a fingerprint


def fingerprint(case: Case, inner_radius: Length, fine: float) -> str:
    """Return eight letters and digits that differ if anything in the input deck differs.

    They are the beginning of the SHA-256 digest of stone, ureter, load, seating and mesh in the
    canonical record of the case, and of the version of stonepass.

    Parameters
    ----------
    case : Case
        The case of the deck.
    inner_radius : Length
        Inner radius R_a of the deck in m.
    fine : float
        Length of the elements in the contact in inner radii.

    References
    ----------
    docs/export.md, "CalculiX and back".
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
