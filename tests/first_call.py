"""Run-time checks of annotations that cost little where they are not needed.

beartype compiles a checker for every function that the import hook decorates, which takes longer
than the import itself, while most functions are never called in a given test run; so a checker is
compiled at the first call. A function inside another one is made anew at each call of the outer
one; its first few copies are checked, and the others are bare, because a checker would be compiled
for every copy. A function that is called thousands of times, as in a fit, is checked in
all of its first calls and in a fixed fraction of the others; the others are the bare function, since
the binding of the arguments alone costs more than many of these functions do.
"""

import functools
import itertools
from collections import Counter
from types import CodeType, FunctionType

import jaxtyping
from beartype import BeartypeConf, beartype
from jaxtyping import _decorator

ALWAYS, EVERY = 100, 20  # calls that are all checked; then one of so many
COPIES = 3  # of a function inside another one, that are checked
RULES = BeartypeConf(is_pep484_tower=True)  # an int is also a float, as for static checkers

_decorate = jaxtyping.jaxtyped
_NO_FUNCTION = object()
_copies: Counter[CodeType] = Counter()


def checked(function):
    """Decorate `function` with beartype at its first call."""
    found = []

    @functools.wraps(function)
    def call(*arguments, **keywords):
        if not found:
            found.append(beartype(function, conf=RULES))
        return found[0](*arguments, **keywords)

    return call


def sampled(function=_NO_FUNCTION, *, typechecker):
    """Decorate as `jaxtyping.jaxtyped`, for the calls named above."""
    if function is _NO_FUNCTION:
        return functools.partial(sampled, typechecker=typechecker)
    if isinstance(function, FunctionType) and "<locals>" in function.__qualname__:
        _copies[function.__code__] += 1
        if _copies[function.__code__] > COPIES:
            return function
    decorated = _decorate(function, typechecker=typechecker)
    if not isinstance(function, FunctionType):
        return decorated
    calls = itertools.count()

    @functools.wraps(function)
    def call(*arguments, **keywords):
        count = next(calls)
        if count >= ALWAYS and count % EVERY:
            return function(*arguments, **keywords)
        return decorated(*arguments, **keywords)

    return call


def install():
    """Let the import hook use `sampled`, for the members of classes too."""
    jaxtyping.jaxtyped = _decorator.jaxtyped = sampled
