"""What every record shares: version, disclaimer, warnings; numbers that do not exist are None."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from stonepass.about import DISCLAIMER, VERSION
from stonepass.caution import Caution

__all__ = ["CautionRecord", "PartRecord", "Record", "degrees", "kilo", "warning_records"]

RECORD_VERSION = 1  # raised when a key of any record changes its name or its meaning


class PartRecord(BaseModel):
    """A part of a record: typed, closed, without numbers that are not finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    def to_dict(self) -> dict[str, Any]:
        """Return a JSON-ready dictionary with all keys."""
        return self.model_dump(mode="json")


class Record(PartRecord):
    """A result as every door shows it; `record_version` tells programs which keys to expect."""

    record_version: int = Field(default=RECORD_VERSION, description="version of these keys")
    version: str = Field(default=VERSION, description="version of stonepass")
    disclaimer: str = Field(default=DISCLAIMER, description="what the numbers are not for")

    def to_dict(self) -> dict[str, Any]:
        """Return a JSON-ready dictionary: the result first, then what it says of itself."""
        document = super().to_dict()
        last = {name: document.pop(name) for name in Record.model_fields}
        return document | last


class CautionRecord(BaseModel):
    """A warning: its code for programs, its sentence for people."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    code: str = Field(description="stays the same when the sentence is reworded")
    sentence: str = Field(description="the warning in words")
    values: dict[str, float | str] = Field(description="numbers and names of the sentence")

    @classmethod
    def of(cls, caution: Caution) -> CautionRecord:
        """Make the record of a caution."""
        return cls(code=caution.code, sentence=str(caution), values=dict(caution.values))


def warning_records(warnings: Iterable[Caution]) -> list[CautionRecord]:
    """Return the records of several cautions."""
    return [CautionRecord.of(each) for each in warnings]


def kilo(value: float | None) -> float | None:
    """Pascals in kilopascals."""
    return None if value is None else value / 1e3


def degrees(value: float | None) -> float | None:
    """Radians in degrees."""
    return None if value is None else math.degrees(value)
