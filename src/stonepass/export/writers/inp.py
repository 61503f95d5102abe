"""Export format ``inp``: an input deck for CalculiX or Abaqus."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from stonepass.export.contract import Export, Limit, Writer
from stonepass.export.input_options import (
    ELEMENT,
    FINE,
    FLAVOUR,
    SEATED_IGNORES,
    SEATED_LIMITS,
    WRITE_AS,
)

if TYPE_CHECKING:  # these modules load NumPy and SciPy
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["INP"]

NEXT_STEPS = {
    "calculix": "run it with: ccx {stem}; then: stonepass compare … {stem}.dat",
    "abaqus": "run it with: abaqus job={stem} input={file}",
}


def _write(case: Case, options: Mapping[str, Any], solved: Callable[[], Answer]) -> Export:
    """Return the input deck of the seating of a stone; the case is not solved."""
    from stonepass.export.inp import write_inp
    from stonepass.export.seating import seating

    model, flavour = seating(case, options["fine"]), options["flavour"]
    text = write_inp(model, options["element"], flavour)
    return Export(text, model.summary, NEXT_STEPS[flavour])


def _laws() -> Mapping[str, Mapping[str, str]]:
    """Return the laws of both programs; some need the flavour of Abaqus."""
    from stonepass.export.inp_material import ABAQUS, CALCULIX
    from stonepass.materials.known_laws import KNOWN_LAWS

    needs = {FLAVOUR.name: "abaqus"}
    return {
        name: {} if law in CALCULIX else needs for name, law in KNOWN_LAWS.items() if law in ABAQUS
    }


INP = Writer(
    name="inp",
    ending=".inp",
    description="input deck for CalculiX or Abaqus",
    write=_write,
    options=(FLAVOUR, ELEMENT, FINE),
    limits={
        **SEATED_LIMITS,
        "law": Limit(reason=WRITE_AS, table=_laws),
    },
    ignores=SEATED_IGNORES,
)
