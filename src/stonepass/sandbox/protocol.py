"""The parts of a refusal, as they travel from the child process to its parent."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

__all__ = ["LONGEST", "Refusal", "Text"]

LONGEST = 500  # characters of each part

Text = Annotated[str, Field(max_length=LONGEST)]
# Argument, value, what is allowed and remedy of a `BadInput`.
Refusal = tuple[Text, Text, Text, Text]
