"""Fields of request bodies that are made from declared inputs."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from stonepass.declaration import DeclaredInput, Kind
from stonepass.web.api_words import api_words

__all__ = ["declared_field"]


def declared_field(each: DeclaredInput, meaning: str = "", **more: Any) -> Any:
    """Return the pydantic field of a declared input: default, description and bounds.

    The bounds are described only. `read_declared` checks the value, in the words of the
    declaration.

    Parameters
    ----------
    each : DeclaredInput
        An input with a default.
    meaning : str
        Description that replaces the meaning of the declaration, if the API needs another one.
    **more
        Further arguments of `pydantic.Field`.
    """
    declaration = each.declaration
    if declaration.bounds is not None and declaration.kind in (Kind.NUMBER, Kind.WHOLE):
        low, high = declaration.bounds
        more["json_schema_extra"] = {"minimum": low, "maximum": high}
    if declaration.shown_default and not meaning:
        meaning = f"{declaration.meaning} The default is {declaration.shown_default}."
    return Field(each.default, description=api_words(meaning or declaration.meaning), **more)
