"""The instant answer to a question, with everything that one redraw of the calculator needs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from stonepass.about import DISCLAIMER, VERSION
from stonepass.caution import Caution
from stonepass.errors import Outcome
from stonepass.inputs.case_record import fingerprint
from stonepass.model.case import Case
from stonepass.model.validity import law_cautions, ring_buckling, strain_range
from stonepass.records.surrogate import surrogate_records
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.units import Pressure
from stonepass.web.instant.curve import curve, curve_sizes, part_of
from stonepass.web.instant.passing import Passing, passing_sizes
from stonepass.web.instant.question import InstantQuestion, obstacles, surrogate_for
from stonepass.web.instant.repeat import repeat
from stonepass.web.instant.size_map import size_map
from stonepass.web.instant.validity import validity
from stonepass.web.instant.words import pressure_sentence, size_sentence
from stonepass.web.section.picture import instant_section
from stonepass.web.stiffness import stiffened

__all__ = ["instant_answer"]

# The input that a warning belongs to, by its code.
CAUSES = {
    "wall_beyond_range": "stone.size_ratio",
    "lumen_below_range": "load.confining_pressure",
    "soft_law": "ureter.material",
    "varies_along": "ureter.material",
    "ring_buckling": "load.confining_pressure",
}


def instant_answer(
    question: InstantQuestion, body: Mapping[str, Any], address: str, *, token: bool = False
) -> dict[str, Any]:
    """Return the answer as a JSON-ready dictionary.

    Parameters
    ----------
    question : InstantQuestion
    body : mapping
        The request, which the answer repeats as a command.
    address : str
        Address of the server, without a slash at the end.
    token : bool
        True if the server needs a token.
    """
    surrogate = surrogate_for(question.case)
    reasons = obstacles(question.case, surrogate)
    ranges = {} if surrogate is None else validity(question, surrogate)
    inside = surrogate is not None and not reasons
    solved = stiffened(question.case, question.stiffness)
    warnings = [
        {"code": "no_surrogate", "sentence": each.sentence, "input": each.key} for each in reasons
    ]
    warnings += [_warning(each) for each in _cautions(solved)]
    document: dict[str, Any] = {"answer": None, "size": None}
    if inside and surrogate is not None:
        document |= _numbers(question, surrogate)
        inside = not document["answer"]["outside"]
    return document | {
        "validity": ranges,
        "warnings": warnings,
        "repeat": repeat(
            question, surrogate if inside else None, body, address, solved, token=token
        ),
        "notice": DISCLAIMER,
        "version": VERSION,
        "fingerprint": fingerprint(solved, solved.model, solved.numerics),
    }


def _numbers(question: InstantQuestion, surrogate: Surrogate) -> dict[str, Any]:
    """Return the parts of the answer that the surrogate computes."""
    case, held, limit = question.case, question.held, question.limit
    along = held.inside(surrogate, case.wall_ratio)
    # The answer and the curve are evaluated at once, which is faster.
    sizes = curve_sizes(surrogate) if along else np.empty(0)
    found = held.answers(surrogate, np.append(sizes, case.size_ratio), case.wall_ratio)
    last = len(sizes)
    record = surrogate_records(part_of(found, slice(last, None)))[0].to_dict()
    outcome = found.OUTCOMES[found.outcome[last]]
    name, model = surrogate.case.ureter.material.name, surrogate.case.model.NAME
    known: dict[str, Any] = {"model": model, "material": name, "source": "surrogate"}
    known["sentence"] = pressure_sentence(outcome, record)
    outside = record["outside"]  # the outcome of the surrogate then says nothing about the stone
    known["message"] = known["sentence"] if outside else outcome.sentence()
    document: dict[str, Any] = {"answer": record | known}
    if "section" in question.include:
        document["section"] = instant_section(case, question.stiffness)
    if along:
        others = part_of(found, slice(0, last))
        if limit is not None:
            table = (sizes, others.pressure[None, :])
            walls = np.array([case.wall_ratio])
            passing = passing_sizes(held, limit, surrogate, walls, table, refinements=2)
            document["size"] = _size(question, limit, passing)
        if "curve" in question.include:
            document["curve"] = curve(question, surrogate, others)
    if "map" in question.include and held.inside(surrogate):
        document["map"] = size_map(name, model, held, limit)
    return document


def _size(question: InstantQuestion, limit: Pressure, passing: Passing) -> dict[str, Any]:
    inner = question.case.ureter.inner_diameter
    size, outcome = float(passing.sizes[0]), passing.outcomes[0]
    diameter = None if inner is None else 1e3 * float(inner) * size
    solved = outcome is Outcome.SOLVED
    return {
        "outcome": outcome.name,
        "message": outcome.sentence(),
        "sentence": size_sentence(limit, size, diameter, outcome),
        "limit_kPa": limit / 1e3,
        "critical_size_ratio": size if solved else None,
        "critical_diameter_mm": diameter if solved else None,
        "lower_bound_size_ratio": None if solved else size,
        "lower_bound_diameter_mm": None if solved else diameter,
    }


def _cautions(case: Case) -> list[Caution]:
    """Return the cautions that follow from the inputs alone."""
    return [*strain_range(case), *ring_buckling(case), *law_cautions(case.ureter.material)]


def _warning(each: Caution) -> dict[str, Any]:
    return {"code": each.code, "sentence": str(each), "input": CAUSES[each.code]}
