"""Export format ``vtu``: the solved wall for ParaView."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from stonepass.export.contract import Export, Limit, Writer
from stonepass.export.input_options import FROM_CONTACT

if TYPE_CHECKING:  # these modules load NumPy and SciPy
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["VTU"]


def _write(case: Case, options: Mapping[str, Any], solved: Callable[[], Answer]) -> Export:
    """Solve the case and return its wall; without a solved wall there is no content."""
    from stonepass.export.vtu import vtu_file
    from stonepass.model.contact_state import SolvedState
    from stonepass.model.states.seated_state import SeatedState
    from stonepass.units import METRE_PER_MM

    answer = solved()
    warnings, state = tuple(map(str, answer.warnings)), answer.contact
    if not isinstance(state, SolvedState) or state.wall is None:
        return Export(None, f"{answer.outcome.name}: {answer.message}", warnings=warnings)
    wall, diameter = state.wall, case.ureter.inner_diameter
    radius = 1.0 if diameter is None else diameter / 2.0 / METRE_PER_MM
    half = isinstance(state, SeatedState) and case.stone.shape.symmetric
    return Export(
        vtu_file(wall, mirrored=half, inner_radius=radius),
        f"{wall.r.size} points of the meridian, turned round the axis",
        warnings=warnings,
    )


def _models() -> Mapping[str, Mapping[str, str]]:
    """Return the models that solve the wall."""
    from stonepass.model.models.registry import MODELS

    return {name: {} for name, model in MODELS.items() if model.NEEDS_ELEMENTS}


VTU = Writer(
    name="vtu",
    ending=".vtu",
    description="solved wall with its stress, for ParaView",
    write=_write,
    limits={
        "model": Limit(reason="a model without finite elements has no wall to write", table=_models)
    },
    ignores=FROM_CONTACT,
)
