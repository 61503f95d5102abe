"""Run-time checks of annotations that cost little where they are not needed.

beartype compiles a checker for every function that the import hook decorates, which takes longer
than the import itself, while most functions are never called in a given test run; so a checker is
compiled at the first call. A function that is called thousands of times, as in a fit, is checked in
all of its first calls and in a fixed share of the others.
"""

import functools
import itertools

from beartype import BeartypeConf, beartype

ALWAYS, EVERY = 100, 10  # calls that are all checked; then one of so many
RULES = BeartypeConf(is_pep484_tower=True)  # an int is also a float, as for static checkers


def checked(function):
    """Decorate `function` with beartype at its first call, for the calls named above."""
    found, calls = [], itertools.count()

    @functools.wraps(function)
    def call(*arguments, **keywords):
        count = next(calls)
        if count >= ALWAYS and count % EVERY:
            return function(*arguments, **keywords)
        if not found:
            found.append(beartype(function, conf=RULES))
        return found[0](*arguments, **keywords)

    return call
