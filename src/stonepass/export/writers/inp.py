"""Export format ``inp``: an input deck for CalculiX or Abaqus."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from stonepass.export.contract import Export, Limit, Writer
from stonepass.export.input_options import ELEMENT, FINE, FLAVOUR, SEATED_IGNORES, SEATED_LIMITS

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


INP = Writer(
    name="inp",
    ending=".inp",
    description="input deck for CalculiX or Abaqus",
    write=_write,
    options=(FLAVOUR, ELEMENT, FINE),
    limits={
        **SEATED_LIMITS,
        "law": Limit(
            ("neo-hookean", "mooney-rivlin", "yeoh", "ogden", "holzapfel-gasser-ogden", "fung"),
            "write its constants as one of these",
            needs={
                "holzapfel-gasser-ogden": {"flavour": "abaqus"},
                "fung": {"flavour": "abaqus"},
            },
        ),
    },
    ignores=SEATED_IGNORES,
)
