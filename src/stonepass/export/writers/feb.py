"""Export format ``feb``: an input file for FEBio 4."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from stonepass.export.contract import Export, Limit, Writer
from stonepass.export.input_options import FINE, SEATED_IGNORES, SEATED_LIMITS

if TYPE_CHECKING:  # these modules load NumPy and SciPy
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["FEB"]


def _write(case: Case, options: Mapping[str, Any], solved: Callable[[], Answer]) -> Export:
    """Return the input file of the seating of a stone; the case is not solved."""
    from stonepass.export.feb import write_feb
    from stonepass.export.seating import seating

    model = seating(case, options["fine"])
    return Export(write_feb(model), model.summary, "run it with: febio4 -i {file}")


FEB = Writer(
    name="feb",
    ending=".feb",
    description="input file for FEBio",
    write=_write,
    options=(FINE,),
    limits={
        **SEATED_LIMITS,
        "law": Limit(
            ("neo-hookean", "mooney-rivlin", "yeoh", "ogden", "holzapfel-gasser-ogden", "fung"),
            "write its constants as one of these",
        ),
    },
    ignores=SEATED_IGNORES,
)
