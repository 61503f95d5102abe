"""Case files: TOML text to a `Case` and back."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import BaseModel, ConfigDict

from stonepass.errors import BadInput
from stonepass.inputs.material_file import find_material
from stonepass.inputs.opening_curve_file import read_opening_curve
from stonepass.inputs.shape_file import read_shape
from stonepass.io.toml_file import read_toml
from stonepass.materials.protocol import names_a_file
from stonepass.model.case import Case, Load, Method, Stone, Ureter
from stonepass.units import Pressure, format_length, format_pressure

__all__ = ["FileSection", "LoadSection", "MethodSection", "read_case", "write_case"]


class FileSection(BaseModel):
    """A section of a TOML file: no unknown keys, no conversions."""

    model_config = ConfigDict(extra="forbid", strict=True)


class _Stone(FileSection):
    diameter: str | None = None
    friction: float = 0.5
    size_ratio: float | None = None
    aspect: float | None = None
    shape: str | None = None


class _Ureter(FileSection):
    inner_diameter: str | None = None
    outer_diameter: str | None = None
    wall_ratio: float | None = None
    material: str = "ureter"


class LoadSection(FileSection):
    """``[load]``, see `Load`."""

    confining_pressure: str = "0 kPa"
    confinement: str = "dead"
    prestretch: float = 1.0


class MethodSection(FileSection):
    """``[method]``, see `Method`; files are named as seen from the file's folder."""

    model: str = "paper"
    seating: str = "pressed"
    seating_friction: float | None = None
    half_length: float = 10.0
    as_printed: bool = False
    closure_start: str = "inner-radius"
    closure: str = "linear"
    series_order: int = 3
    pairs: str | None = None
    far_field_ground: bool = False
    wetted: bool = False
    accuracy: str = "standard"
    circumferential_modulus: str | None = None
    longitudinal_modulus: str | None = None
    secant_stretch: float | None = None

    def method(self, folder: Path) -> Method:
        """Make the method."""
        given = self.model_dump()
        if self.pairs is not None:
            given["pairs"] = read_opening_curve(folder / self.pairs)
        return Method(**given)


class _CaseFile(FileSection):
    stone: _Stone
    ureter: _Ureter
    load: LoadSection = LoadSection()
    method: MethodSection = MethodSection()


def read_case(path: Path) -> Case:
    """Read a case file; files of materials, shapes and pairs are looked for beside it.

    Raises
    ------
    BadInput
        Naming the file and the key: missing file, broken TOML, unknown key (with the nearest
        known one), wrong type, or a value that a `Case` refuses.
    """
    parsed = read_toml(path, _CaseFile)
    stone, ureter = parsed.stone.model_dump(), parsed.ureter.model_dump()
    try:
        if parsed.stone.shape is not None:
            stone["shape"] = read_shape(path.parent / parsed.stone.shape)
        ureter["material"] = find_material(parsed.ureter.material, path.parent)
        return Case(
            Stone(**stone),
            Ureter(**ureter),
            Load(**parsed.load.model_dump()),
            parsed.method.method(path.parent),
        )
    except BadInput as problem:
        raise problem.within(path.name) from problem


def write_case(case: Case, path: Path) -> None:
    """Write a case so that `read_case` gives it back."""
    stone, ureter, load, method = case.stone, case.ureter, case.load, case.method
    reference = ureter.material.reference
    if not reference:
        raise BadInput("material", ureter.material.name, "from the catalogue or a file to be saved")
    if names_a_file(reference):
        reference = _beside(path, reference)
    shape = stone.shape
    if not shape.spheroidal and not shape.reference:
        raise BadInput("shape of the stone", "made in Python", "from a file to be saved")
    pairs = method.pairs
    if pairs is not None and not pairs.reference:
        raise BadInput("pairs", "made in Python", "from a file to be saved")
    document: dict[str, dict[str, Any]] = {
        "stone": {
            "diameter": None if stone.diameter is None else format_length(stone.diameter),
            "size_ratio": stone.size_ratio,
            "friction": stone.friction,
            "aspect": shape.aspect if shape.spheroidal and not shape.reference else None,
            "shape": _beside(path, shape.reference) if shape.reference else None,
        },
        "ureter": {
            "inner_diameter": _length(ureter.inner_diameter),
            "outer_diameter": _length(ureter.outer_diameter),
            "wall_ratio": None if ureter.outer_diameter is not None else ureter.wall_ratio,
            "material": reference,
        },
        "load": {
            "confining_pressure": format_pressure(load.confining_pressure),
            "confinement": load.confinement,
            "prestretch": load.prestretch,
        },
        "method": {name: _plain(getattr(method, name)) for name in MethodSection.model_fields}
        | {"pairs": None if pairs is None else _beside(path, pairs.reference)},
    }
    written = {
        section: {key: value for key, value in keys.items() if value is not None}
        for section, keys in document.items()
    }
    try:
        path.write_text(tomli_w.dumps(written), encoding="utf-8")
    except OSError as problem:
        raise BadInput("case file", str(path), f"writable ({problem.strerror})") from problem


def _plain(value: Any) -> Any:
    return format_pressure(value) if isinstance(value, Pressure) else value


def _beside(path: Path, reference: str) -> str:
    """Path of a file as seen from the folder of the case file."""
    return os.path.relpath(reference, path.resolve().parent)


def _length(value: float | None) -> str | None:
    return None if value is None else format_length(value)
