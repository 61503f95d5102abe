"""Declared inputs: each input of a question is declared once, and every door is made from that.

An input is declared in the metadata of the dataclass field that holds its value, with `declared`.
The command line, case files, their JSON schema and the documentation read the declarations with
`inputs_of`; the constructor of the dataclass checks its values against them with `check_inputs`, or
with `set_inputs` where it accepts text as well as the type of the field.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from numbers import Real
from typing import Any

from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.units import format_length, format_pressure, length, pressure

__all__ = [
    "DeclaredInput",
    "Input",
    "Kind",
    "check_inputs",
    "declared",
    "described",
    "inputs_of",
    "set_inputs",
]


class Kind(enum.Enum):
    """What an input is: decides how text is read, and its type in a schema."""

    LENGTH = "length"
    PRESSURE = "pressure"
    NUMBER = "number"
    WHOLE = "whole number"
    FLAG = "flag"
    CHOICE = "choice"
    MATERIAL = "material"
    SHAPE = "shape"
    OPENING_CURVE = "opening curve"


@dataclass(frozen=True)
class Input:
    """The declaration of one input.

    Attributes
    ----------
    kind : Kind
    option : str
        Name on the command line; a flag has two, ``--on/--off``.
    meaning : str
        One sentence of help, without its default.
    title : str
        Name in the messages of the Python interface; the name of the field where it is empty.
    bounds : (float, float), optional
        Smallest and largest value in SI units.
    choices : tuple of str
        The values of a choice.
    shown_default : str
        The default in words, where the value itself does not say it.
    metavar : str
        Placeholder of the value in the help.
    """

    kind: Kind
    option: str
    meaning: str
    title: str = ""
    bounds: tuple[float, float] | None = None
    choices: tuple[str, ...] = ()
    shown_default: str = ""
    metavar: str = ""

    @property
    def allowed(self) -> str:
        """The values that are allowed, in words."""
        if self.bounds is None:
            return {Kind.FLAG: "true or false"}.get(self.kind, f"a {self.kind.value}")
        low, high = (_shown(self.kind, bound) for bound in self.bounds)
        if self.kind in (Kind.LENGTH, Kind.PRESSURE):
            return f"{low} to {high}"
        return f"a {self.kind.value} from {low} to {high}"


@dataclass(frozen=True)
class DeclaredInput:
    """An input with the place of its field: `key` is ``section.name`` as in a case file."""

    section: str
    name: str
    default: Any
    declaration: Input

    @property
    def key(self) -> str:
        """Where a case file has it."""
        return f"{self.section}.{self.name}"

    @property
    def title(self) -> str:
        """Its name in the messages of the Python interface."""
        return self.declaration.title or self.name


def declared(kind: Kind, option: str, meaning: str, *, default: Any = MISSING, **more: Any) -> Any:
    """Make a dataclass field that carries the declaration of its input (see `Input`)."""
    metadata = {"input": Input(kind, option, meaning, **more)}
    return field(metadata=metadata) if default is MISSING else field(
        default=default, metadata=metadata
    )  # fmt: skip


def inputs_of(owner: type) -> dict[str, DeclaredInput]:
    """The declared inputs of a dataclass by the name of their field.

    The class names the section of the case file in its attribute ``SECTION``.
    """
    section: str = owner.SECTION  # type: ignore[attr-defined]
    return {
        each.name: DeclaredInput(section, each.name, each.default, each.metadata["input"])
        for each in fields(owner)
        if "input" in each.metadata
    }


def check_inputs(instance: Any) -> None:
    """Read and check every declared field of a frozen dataclass in its ``__post_init__``.

    Text of a length or a pressure is read into SI units; numbers become floats.

    Raises
    ------
    BadInput
        A value of the wrong kind, out of bounds, or none of the choices.
    """
    for each in fields(instance):
        if "input" in each.metadata:
            value = getattr(instance, each.name)
            if value is not None or not _optional(each):
                read = _read(each.metadata["input"], each.name, value)
                object.__setattr__(instance, each.name, read)


def set_inputs(instance: Any, **given: Any) -> None:
    """Set the declared fields in a constructor of its own; None stands for the default."""
    for each in fields(instance):
        if "input" in each.metadata:
            value = given.pop(each.name)
            chosen = each.default if value is None else value
            object.__setattr__(instance, each.name, chosen)
    assert not given, given
    check_inputs(instance)


def described(instance: Any, *left_out: str) -> str:
    """Write a value as its constructor would be called, without inputs that have their default.

    It serves as ``__repr__`` of dataclasses with declared inputs.

    Parameters
    ----------
    instance : dataclass with declared inputs
    left_out : str
        Names of inputs that follow from the others.

    Examples
    --------
    >>> import stonepass as sp
    >>> sp.Load("2 kPa"), sp.Numerics("fast"), sp.Ureter(wall_ratio=1.5, material="latex")
    (Load(confining_pressure='2 kPa'), Numerics(accuracy='fast'), Ureter(material='latex', \
wall_ratio=1.5))
    """
    parts = []
    for each in inputs_of(type(instance)).values():
        value = getattr(instance, each.name)
        if each.name not in left_out and value is not None and value != each.default:
            parts.append(f"{each.name}={_written(each.declaration.kind, value)}")
    return f"{type(instance).__name__}({', '.join(parts)})"


def _written(kind: Kind, value: Any) -> str:
    if kind is Kind.LENGTH:
        return repr(format_length(value))
    if kind is Kind.PRESSURE:
        return repr(format_pressure(value))
    if kind is Kind.MATERIAL and value.reference:
        return repr(value.reference)
    return repr(value)


def _optional(each: Field[Any]) -> bool:
    return each.default is None


def _read(declaration: Input, name: str, value: Any) -> Any:
    title, kind = declaration.title or name, declaration.kind
    readers: Mapping[Kind, Any] = {
        Kind.LENGTH: lambda: _bounded(declaration, title, length(value, title), value),
        Kind.PRESSURE: lambda: _bounded(declaration, title, pressure(value, title), value),
        Kind.NUMBER: lambda: _number(declaration, title, value),
        Kind.WHOLE: lambda: _whole(declaration, title, value),
        Kind.FLAG: lambda: _flag(declaration, title, value),
        Kind.CHOICE: lambda: _choice(declaration, title, value),
    }
    return readers[kind]() if kind in readers else value


def _bounded(declaration: Input, title: str, read: Any, value: Any) -> Any:
    if declaration.bounds is not None:
        low, high = declaration.bounds
        require(low <= read <= high, title, value, declaration.allowed)
    return read


def _number(declaration: Input, title: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise BadInput(title, value, declaration.allowed)
    try:
        number = float(value)
    except OverflowError:  # a whole number of hundreds of digits
        raise BadInput(title, value, declaration.allowed) from None
    return float(_bounded(declaration, title, number, number))


def _whole(declaration: Input, title: str, value: Any) -> int:
    whole = isinstance(value, int) and not isinstance(value, bool)
    require(whole, title, value, declaration.allowed)
    return int(_bounded(declaration, title, value, value))


def _flag(declaration: Input, title: str, value: Any) -> bool:
    require(isinstance(value, bool), title, value, declaration.allowed)
    return bool(value)


def _choice(declaration: Input, title: str, value: Any) -> str:
    if value not in declaration.choices:
        refuse_unknown(title, str(value), list(declaration.choices))
    return str(value)


def _shown(kind: Kind, bound: float) -> str:
    if kind is Kind.LENGTH:
        return format_length(bound)
    if kind is not Kind.PRESSURE:
        return f"{bound:g}"
    return f"{bound / 1e9:g} GPa" if bound >= 1e9 else format_pressure(bound)
