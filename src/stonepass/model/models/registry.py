"""The models by their name at the doors. A new model is one file and one line here."""

from __future__ import annotations

from typing import Any

from stonepass.errors import refuse_unknown
from stonepass.model.models.elastic_foundation import ElasticFoundation
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance

__all__ = ["MODELS", "model_named"]

# The classes satisfy `Model`; a protocol with attributes is no type that a class is checked by.
MODELS: dict[str, type[Any]] = {
    each.NAME: each for each in (SeatedBalance, PushThrough, ElasticFoundation)
}


def model_named(name: str) -> type[Any]:
    """Look up a model by its name; an unknown one is refused, naming the nearest."""
    if name not in MODELS:
        refuse_unknown("model", name, list(MODELS))
    return MODELS[name]
