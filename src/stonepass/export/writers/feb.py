"""Export format ``feb``: an input file for FEBio 4."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from stonepass.export.contract import Export, Limit, Writer
from stonepass.export.input_options import FINE, SEATED_IGNORES, SEATED_LIMITS, WRITE_AS

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


def _laws() -> Mapping[str, Mapping[str, str]]:
    """Return the laws of FEBio."""
    from stonepass.export.feb_material import FEBIO
    from stonepass.materials.known_laws import KNOWN_LAWS

    return {name: {} for name, law in KNOWN_LAWS.items() if law in FEBIO}


FEB = Writer(
    name="feb",
    ending=".feb",
    description="input file for FEBio",
    write=_write,
    options=(FINE,),
    limits={
        **SEATED_LIMITS,
        "law": Limit(reason=WRITE_AS, table=_laws),
    },
    ignores=SEATED_IGNORES,
)
