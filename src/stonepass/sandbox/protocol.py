"""The data of an error that the child process sends to its parent process."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

__all__ = ["LONGEST", "Refusal", "Text"]

LONGEST = 500  # largest number of characters of each text

Text = Annotated[str, Field(max_length=LONGEST)]
# The attributes argument, value, allowed and remedy of a `BadInput`.
Refusal = tuple[Text, Text, Text, Text]
