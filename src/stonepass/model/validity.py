"""Where a question goes beyond what the constants of its material are known for."""

from __future__ import annotations

from stonepass.model.case import Case
from stonepass.model.far_field import lumen_ratio

__all__ = ["range_warnings"]


def range_warnings(case: Case) -> list[str]:
    """Sentences where stone or load stretch the wall beyond the material's strain range."""
    material = case.ureter.material
    low, high = material.strain_range
    known = (
        f"but the constants of material '{material.name}' were used for stretches "
        f"{low:g} to {high:g} only"
    )
    warnings = []
    if case.size_ratio > high:
        warnings.append(
            f"the stone stretches the wall to {case.size_ratio:.3g} times its circumference, "
            + known
        )
    lumen = lumen_ratio(case.wall_ratio, material.law, case.load)
    if lumen is not None and lumen < low:
        warnings.append(f"the load shrinks the lumen to {lumen:.3g} times its width, {known}")
    return warnings
