"""The registered studies by name; the tests of the `Study` contract run over all of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from stonepass.model.case import Case
from stonepass.studies.closures import ClosureMap
from stonepass.studies.curve import Curve
from stonepass.studies.rising import RisingPressure
from stonepass.studies.study import Study

__all__ = ["STUDIES"]

# Each function makes a small study of one case.
STUDIES: dict[str, Callable[[Case], Study[Any]]] = {
    "curve": lambda case: Curve(case, (case.size_ratio,)),
    "closures": lambda case: ClosureMap((case,)),
    "rising": RisingPressure,
}
