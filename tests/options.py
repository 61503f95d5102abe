"""Model and numerics of a case from their options, as the tests vary them."""

from stonepass.declaration import inputs_of
from stonepass.model.models.registry import MODELS
from stonepass.model.numerics import Numerics

__all__ = ["asking"]


def asking(model="paper", **options):
    """Return ``{"model": …, "numerics": …}``, to be unpacked into `stonepass.Case` and others."""
    numerical = {name: options.pop(name) for name in inputs_of(Numerics) if name in options}
    return {"model": MODELS[model](**options), "numerics": Numerics(**numerical)}
