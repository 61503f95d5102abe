"""The base classes of all records, with version, disclaimer and warnings."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from stonepass.about import DISCLAIMER, VERSION
from stonepass.caution import Caution

__all__ = ["CautionRecord", "PartRecord", "Record", "degrees", "kilo", "warning_records"]

RECORD_VERSION = 1  # raised if a key of any record changes its name or its meaning


class PartRecord(BaseModel):
    """A part of a record: only declared keys, and all numbers are finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    def to_dict(self) -> dict[str, Any]:
        """Return a JSON-ready dictionary with all keys."""
        return self.model_dump(mode="json")


class Record(PartRecord):
    """The record of a result; `record_version` identifies the set of keys."""

    record_version: int = Field(default=RECORD_VERSION, description="version of the set of keys")
    version: str = Field(default=VERSION, description="version of stonepass")
    disclaimer: str = Field(default=DISCLAIMER, description="restriction of use")

    def to_dict(self) -> dict[str, Any]:
        """Return a JSON-ready dictionary: the result first, then version and disclaimer."""
        document = super().to_dict()
        last = {name: document.pop(name) for name in Record.model_fields}
        return document | last


class CautionRecord(BaseModel):
    """A warning with a code for programs and a sentence for readers."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    code: str = Field(description="code of the warning, which does not change with its sentence")
    sentence: str = Field(description="the warning in words")
    values: dict[str, float | str] = Field(description="numbers and names in the sentence")

    @classmethod
    def of(cls, caution: Caution) -> CautionRecord:
        """Make the record of a caution."""
        return cls(code=caution.code, sentence=str(caution), values=dict(caution.values))


def warning_records(warnings: Iterable[Caution]) -> list[CautionRecord]:
    """Return the records of several cautions."""
    return [CautionRecord.of(each) for each in warnings]


def kilo(value: float | None) -> float | None:
    """Convert Pa to kPa; None stays None."""
    return None if value is None else value / 1e3


def degrees(value: float | None) -> float | None:
    """Convert radians to degrees; None stays None."""
    return None if value is None else math.degrees(value)
