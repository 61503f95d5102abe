"""The origin of a surrogate: version, case, and the solved cases that it was fitted to."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from stonepass.about import VERSION
from stonepass.inputs.case_record import fingerprint
from stonepass.model.answer import Answer
from stonepass.model.case import Case

__all__ = ["origin"]


def origin(case: Case, levels: Sequence[tuple[Case, Sequence[Answer]]]) -> dict[str, Any]:
    """Return the origin of a surrogate as a JSON-ready dictionary.

    Parameters
    ----------
    case : Case
        The case of the surrogate.
    levels : sequence of (Case, sequence of Answer)
        Model and numerics of the cases of each level, and their answers.
    """
    answers = levels[-1][1]
    return {
        "version": VERSION,
        "fingerprint": fingerprint(case, case.model, case.numerics),
        "levels": [
            {"model": each.model.NAME, "options": repr(each.model),
             "accuracy": each.numerics.accuracy, "cases": len(solved)}
            for each, solved in levels
        ],
        "outcomes": dict(Counter(each.outcome.name for each in answers)),
    }  # fmt: skip
