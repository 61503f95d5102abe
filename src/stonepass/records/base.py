"""What every record shares: version, disclaimer, cautions; numbers that do not exist are None."""

from __future__ import annotations

import math
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from stonepass.about import DISCLAIMER, VERSION
from stonepass.model.caution import Caution

__all__ = ["CautionRecord", "Record", "degrees", "kilo"]

RECORD_VERSION = 1  # raised when a key of any record changes its name or its meaning


class Record(BaseModel):
    """A result as every door shows it: typed, closed, without numbers that are not finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    record_version: int = Field(RECORD_VERSION, description="version of these keys")
    version: str = Field(VERSION, description="version of stonepass")
    disclaimer: str = Field(DISCLAIMER, description="what the numbers are not for")

    def to_dict(self) -> dict[str, Any]:
        """The record as a JSON-ready dictionary."""
        return self.model_dump(mode="json")


class CautionRecord(BaseModel):
    """A warning: its code for programs, its sentence for people."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    code: str = Field(description="stays the same when the sentence is reworded")
    sentence: str = Field(description="the warning in words")
    values: dict[str, float | str] = Field(description="numbers and names of the sentence")

    @classmethod
    def of(cls, caution: Caution) -> CautionRecord:
        """The record of a caution."""
        return cls(code=caution.code, sentence=str(caution), values=dict(caution.values))


def kilo(value: float | None) -> float | None:
    """Pascals in kilopascals."""
    return None if value is None else value / 1e3


def degrees(value: float | None) -> float | None:
    """Radians in degrees."""
    return None if value is None else math.degrees(value)
