"""A lock that allows automatic differentiation in one thread at a time.

Autograd counts the levels of nested derivatives in a variable that all threads of the process
share. If two threads differentiated at the same time, their levels would be mixed up and the
derivatives would be wrong.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from threading import RLock
from typing import ParamSpec, TypeVar

__all__ = ["one_trace"]

P = ParamSpec("P")
R = TypeVar("R")
_TRACE = RLock()


def one_trace(function: Callable[P, R]) -> Callable[P, R]:
    """Decorate a function so that only one thread at a time executes it; other threads wait."""

    @wraps(function)
    def alone(*arguments: P.args, **keywords: P.kwargs) -> R:
        with _TRACE:
            return function(*arguments, **keywords)

    return alone
