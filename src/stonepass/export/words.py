"""Names of options in messages, as keywords of Python or as options of the command line."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

__all__ = ["FormatWords", "as_flag", "as_keyword"]

FLAGS = {"path": "out"}  # arguments whose command-line option has another name


@runtime_checkable
class FormatWords(Protocol):
    """A function that returns the name of an option, with its value if one is given."""

    def __call__(self, name: str, value: Any = None) -> str:
        """Return the text for the option `name`, or for the option with `value`."""


def as_keyword(name: str, value: Any = None) -> str:
    """Return an option as a keyword of Python.

    Parameters
    ----------
    name : str
        Name of the option.
    value : str or float, optional
        Its value; None for the name alone.

    Examples
    --------
    >>> as_keyword("flavour"), as_keyword("flavour", "abaqus")
    ('flavour', "flavour='abaqus'")
    """
    return name if value is None else f"{name}={value!r}"


def as_flag(name: str, value: Any = None) -> str:
    """Return an option as it is written on the command line.

    Parameters
    ----------
    name : str
        Name of the option in Python.
    value : str or float, optional
        Its value; None for the name alone.

    Examples
    --------
    >>> as_flag("flavour"), as_flag("flavour", "abaqus")
    ('--flavour', '--flavour abaqus')
    """
    name = FLAGS.get(name, name.replace("_", "-"))
    return f"--{name}" if value is None else f"--{name} {value}"
