"""Bodies of requests as pydantic models, from which the OpenAPI description follows."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from stonepass.declaration import read_declared
from stonepass.model.pressure_limit import PRESSURE_LIMIT, read_limit
from stonepass.studies.stiffness_input import STIFFNESS
from stonepass.web.case_body import CaseBody, case_of
from stonepass.web.declared_field import declared_field
from stonepass.web.instant.question import InstantQuestion
from stonepass.web.strict_body import StrictBody

__all__ = ["InstantBody"]

Part = Literal["curve", "map", "section"]


class InstantBody(StrictBody):
    """The question of an instant answer."""

    case: CaseBody = Field(description="the sections of a case file")  # type: ignore[valid-type]
    stiffness: float = declared_field(STIFFNESS)
    limit: str | None = declared_field(
        PRESSURE_LIMIT,
        "pressure limit with its unit, for the largest stone that moves",
        examples=["6 kPa", "60 cmH2O"],
    )
    include: list[Part] = Field(
        default_factory=list, max_length=8, description="further parts of the answer"
    )

    def question(self) -> InstantQuestion:
        """Return the question, with all values checked.

        Raises
        ------
        BadInput
            A value is out of bounds, names a file, or contradicts another one.
        """
        stiffness = read_declared(STIFFNESS.declaration, "stiffness", self.stiffness)
        limit = None if self.limit is None else read_limit(self.limit)
        return InstantQuestion(case_of(self.case), stiffness, limit, frozenset(self.include))
