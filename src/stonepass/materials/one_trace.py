"""Automatic differentiation by one thread at a time.

Autograd counts the levels of nested derivatives in one variable of the process. Two threads that
differentiate at once would take a level of the other for their own and get wrong numbers.
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
    """Let other threads wait while one is in `function`."""

    @wraps(function)
    def alone(*arguments: P.args, **keywords: P.kwargs) -> R:
        with _TRACE:
            return function(*arguments, **keywords)

    return alone
