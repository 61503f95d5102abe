"""The registry of the models by name. To add a model, add one file and one line here."""

from __future__ import annotations

from typing import Any

from stonepass.errors import refuse_unknown
from stonepass.model.models.elastic_foundation import ElasticFoundation
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance

__all__ = ["MODELS", "model_named"]

# The classes satisfy `Model`, but a type checker cannot verify that of a class object.
MODELS: dict[str, type[Any]] = {
    each.NAME: each for each in (SeatedBalance, PushThrough, ElasticFoundation)
}


def model_named(name: str) -> type[Any]:
    """Look up the class of a model by its name.

    Raises
    ------
    BadInput
        No model has this name; the message suggests the most similar name.
    """
    if name not in MODELS:
        refuse_unknown("model", name, list(MODELS))
    return MODELS[name]
