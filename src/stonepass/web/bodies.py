"""Bodies of requests as pydantic models, from which the OpenAPI description follows."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from stonepass.clinic.pressure_limits import read_limit
from stonepass.declaration import read_declared
from stonepass.web.case_body import CaseBody, case_of
from stonepass.web.instant.question import STIFFNESS_INPUT, InstantQuestion
from stonepass.web.strict_body import StrictBody

__all__ = ["InstantBody"]

STIFFNESS_LOW, STIFFNESS_HIGH = STIFFNESS_INPUT.bounds or (0.0, 1.0)
Part = Literal["curve", "map", "section"]


class InstantBody(StrictBody):
    """The question of an instant answer."""

    case: CaseBody = Field(description="the sections of a case file")  # type: ignore[valid-type]
    stiffness: float = Field(
        1.0,
        description=STIFFNESS_INPUT.meaning,
        json_schema_extra={"minimum": STIFFNESS_LOW, "maximum": STIFFNESS_HIGH},
    )
    limit: str | None = Field(
        None,
        description="pressure limit with its unit, for the largest stone that moves",
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
        stiffness = read_declared(STIFFNESS_INPUT, "stiffness", self.stiffness)
        limit = None if self.limit is None else read_limit(self.limit)
        return InstantQuestion(case_of(self.case), stiffness, limit, frozenset(self.include))
