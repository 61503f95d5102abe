"""The base class of the bodies of requests."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

__all__ = ["StrictBody"]


class StrictBody(BaseModel):
    """A body without other keys, whose values are not converted from other types."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)
