"""Declarations of inputs: name, kind, bounds, default and help text of each input, written once.

An input is declared with `declared`, in the metadata of the dataclass field that stores its value.
The command line, case files, their JSON schema and the documentation are generated from the
declarations, which they read with `inputs_of`. The constructor of the dataclass reads and checks
its values with `check_inputs`, or with `set_inputs` if the class has a constructor of its own.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, field, fields, replace
from numbers import Real
from typing import Any

from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.units import (
    Area,
    Length,
    Pressure,
    area,
    exact_length,
    exact_pressure,
    format_length,
    format_pressure,
    length,
    pressure,
)

__all__ = [
    "DeclaredInput",
    "Input",
    "Kind",
    "check_inputs",
    "declared",
    "described",
    "free_input",
    "inputs_of",
    "read_declared",
    "set_inputs",
]


class Kind(enum.Enum):
    """The kind of an input. It determines how text is read, and the type in the JSON schema."""

    LENGTH = "length"
    PRESSURE = "pressure"
    AREA = "area"
    NUMBER = "number"
    WHOLE = "whole number"
    FLAG = "flag"
    CHOICE = "choice"
    MATERIAL = "material"
    SHAPE = "shape"
    OPENING_CURVE = "opening curve"


_QUANTITIES: dict[Kind, Any] = {
    Kind.LENGTH: Length,
    Kind.PRESSURE: Pressure,
    Kind.AREA: Area,
}


@dataclass(frozen=True)
class Input:
    """The declaration of one input.

    Attributes
    ----------
    kind : Kind
    option : str
        Name on the command line; a flag has two names, ``--on/--off``.
    meaning : str
        Help text of one sentence, without the default value.
    title : str
        Name in messages of the Python interface; if it is empty, the name of the field is used.
    bounds : (float, float), optional
        Smallest and largest allowed value, in SI units.
    choices : tuple of str
        Allowed values of an input of the kind `Kind.CHOICE`.
    shown_default : str
        Default in words, for inputs whose default value does not explain itself.
    metavar : str
        Placeholder of the value in the help text, if that of the kind does not fit.
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
        """The allowed values in words."""
        if self.bounds is None:
            return {Kind.FLAG: "true or false"}.get(self.kind, f"a {self.kind.value}")
        low, high = (_shown(self.kind, bound) for bound in self.bounds)
        if self.kind in _QUANTITIES:
            return f"{low} to {high}"
        return f"a {self.kind.value} from {low} to {high}"


@dataclass(frozen=True)
class DeclaredInput:
    """A declared input together with its section in a case file, its field name and its default.

    Attributes
    ----------
    section : str
        Section of the case file.
    name : str
        Name of the dataclass field, which is also the key within the section.
    default : object
        Default value, or ``dataclasses.MISSING`` if a value must be given.
    declaration : Input
    """

    section: str
    name: str
    default: Any
    declaration: Input

    @property
    def key(self) -> str:
        """The key in a case file, ``section.name``."""
        return f"{self.section}.{self.name}"

    @property
    def title(self) -> str:
        """The name in messages of the Python interface."""
        return self.declaration.title or self.name


def declared(kind: Kind, option: str, meaning: str, *, default: Any = MISSING, **more: Any) -> Any:
    """Create a dataclass field that carries the declaration of its input.

    Parameters
    ----------
    kind, option, meaning
        See `Input`.
    default : object, optional
        Default value of the field; without it a value must be given.
    **more
        Further attributes of `Input`.

    Returns
    -------
    dataclasses.Field
    """
    metadata = {"input": Input(kind, option, meaning, **more)}
    return field(metadata=metadata) if default is MISSING else field(
        default=default, metadata=metadata
    )  # fmt: skip


def free_input(
    name: str, kind: Kind, option: str, meaning: str, *, default: Any = None, **more: Any
) -> DeclaredInput:
    """Declare an input that belongs to no section of a case file.

    Parameters
    ----------
    name : str
        Key of the input.
    kind, option, meaning
        See `Input`.
    default : object
        Default value.
    **more
        Further attributes of `Input`.
    """
    return DeclaredInput("", name, default, Input(kind, option, meaning, **more))


def inputs_of(owner: type) -> dict[str, DeclaredInput]:
    """Return the declared inputs of a dataclass by the names of their fields.

    The class attribute ``SECTION`` is the name of the section in a case file.
    """
    section: str = owner.SECTION  # type: ignore[attr-defined]
    return {
        each.name: DeclaredInput(section, each.name, each.default, each.metadata["input"])
        for each in fields(owner)
        if "input" in each.metadata
    }


def check_inputs(instance: Any) -> None:
    """Read and check every declared field; call this in ``__post_init__`` of a frozen dataclass.

    Lengths and pressures given as text are converted to SI units; numbers are converted to floats.

    Raises
    ------
    BadInput
        A value is of the wrong kind, is out of bounds, or is not one of the choices.
    """
    for each in fields(instance):
        if "input" in each.metadata:
            value = getattr(instance, each.name)
            if value is not None or not _optional(each):
                read = _read(each.metadata["input"], each.name, value)
                object.__setattr__(instance, each.name, read)


def read_declared(declaration: Input, name: str, value: Any, *, si: bool = False) -> Any:
    """Read and check one value of an input, as `check_inputs` does for a field.

    Parameters
    ----------
    declaration : Input
        The declaration of the input.
    name : str
        Name of the input in messages.
    value : object
        The value; a length, a pressure or an area is text with a unit.
    si : bool
        True if a length, a pressure or an area is given as a number in SI units.

    Raises
    ------
    BadInput
        The value is of the wrong kind, is out of bounds, or is not one of the choices.
    """
    if si and declaration.kind in _QUANTITIES:
        value = _QUANTITIES[declaration.kind](value)
    return _read(replace(declaration, title=name), name, value)


def set_inputs(instance: Any, **given: Any) -> None:
    """Set and check all declared fields; call this in a hand-written ``__init__`` of the dataclass.

    Parameters
    ----------
    instance : object
        Instance of the dataclass.
    **given
        A value for every declared field; None stands for the default.

    Raises
    ------
    BadInput
        See `check_inputs`.
    """
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
        return repr(exact_length(value))
    if kind is Kind.PRESSURE:
        return repr(exact_pressure(value))
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
        Kind.AREA: lambda: _bounded(declaration, title, area(value, title), value),
        Kind.NUMBER: lambda: _number(declaration, title, value),
        Kind.WHOLE: lambda: _whole(declaration, title, value),
        Kind.FLAG: lambda: _flag(declaration, title, value),
        Kind.CHOICE: lambda: _choice(declaration, title, value),
    }
    return readers[kind]() if kind in readers else value


def _bounded(declaration: Input, title: str, read: Any, value: Any) -> Any:
    if declaration.bounds is not None:
        low, high = declaration.bounds
        bare = declaration.kind in _QUANTITIES and not isinstance(value, str)
        shown = _shown(declaration.kind, read) if bare else value
        require(low <= read <= high, title, shown, declaration.allowed)
    return read


def _number(declaration: Input, title: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise BadInput(title, value, declaration.allowed)
    try:
        number = float(value)
    except OverflowError:  # an integer with hundreds of digits
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
        return f"{bound * 1e9:g} nm" if 0.0 < bound < 1e-6 else format_length(bound)
    if kind is Kind.AREA:
        return f"{bound * 1e6:.12g} mm2"
    if kind is not Kind.PRESSURE:
        return f"{bound:.12g}"
    return f"{bound / 1e9:g} GPa" if bound >= 1e9 else format_pressure(bound)
