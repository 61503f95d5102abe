"""How messages name an option: in the words of Python, or in those of the command line."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

__all__ = ["Words", "as_flag", "as_keyword"]

FLAGS = {"path": "out"}  # arguments whose flag has another name


@runtime_checkable
class Words(Protocol):
    """Name an option in a message, with its value where one is given."""

    def __call__(self, name: str, value: Any = None) -> str:
        """Return the words for the option `name`, or for the option with `value`."""


def as_keyword(name: str, value: Any = None) -> str:
    """Return the words of Python.

    >>> as_keyword("flavour"), as_keyword("flavour", "abaqus")
    ('flavour', "flavour='abaqus'")
    """
    return name if value is None else f"{name}={value!r}"


def as_flag(name: str, value: Any = None) -> str:
    """Return the words of the command line.

    >>> as_flag("flavour"), as_flag("flavour", "abaqus")
    ('--flavour', '--flavour abaqus')
    """
    name = FLAGS.get(name, name.replace("_", "-"))
    return f"--{name}" if value is None else f"--{name} {value}"
