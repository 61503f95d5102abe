"""Sentences about uploaded files in the words of the API.

The sentences come from readers and fits that the command line uses too. They may name its options,
and the file by the name under which the server reads it.
"""

from __future__ import annotations

import re
from pathlib import PurePath

from stonepass.errors import BadInput

__all__ = ["FILE", "UPLOAD", "api_words", "in_api_words"]

FILE = "upload"  # name, without its ending, under which the server reads an uploaded file
UPLOAD = "the upload"
NAME = re.compile(rf"\b{FILE}\.\w+")
OPTION = re.compile(r"--([a-z][a-z-]+)")


def api_words(sentence: str) -> str:
    """Return a sentence with keys of the API in the place of options and of the file name."""
    keys = OPTION.sub(lambda found: f"'{found[1].replace('-', '_')}'", sentence)
    return NAME.sub(UPLOAD, keys)


def in_api_words(problem: BadInput) -> BadInput:
    """Return an error about an uploaded file in the words of the API."""
    value = problem.value
    if isinstance(value, PurePath):
        value = UPLOAD
    elif isinstance(value, str):
        value = api_words(value)
    argument, allowed, remedy = map(api_words, (problem.argument, problem.allowed, problem.remedy))
    return type(problem)(argument, value, allowed, remedy)
