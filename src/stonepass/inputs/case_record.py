"""The canonical record of a case: a complete, versioned description in plain values and SI units.

JSON records and fingerprints follow from this description. It contains everything that an answer
depends on, with one exception: a user's function is described by its name only. It does not contain
the paths of files.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import fields, is_dataclass
from typing import Any

from stonepass.declaration import inputs_of
from stonepass.materials.protocol import Material
from stonepass.model.answer import Model
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.shape import Shape

__all__ = ["VERSION", "describe", "describe_material", "fingerprint"]

VERSION = 1  # raised if a key changes its name or its meaning


def describe(case: Problem, model: Model, numerics: Numerics) -> dict[str, Any]:
    """Return the canonical record of a case.

    Parameters
    ----------
    case : Problem
        Stone, ureter and load.
    model : Model
        The model with its options.
    numerics : Numerics
        Accuracy and length of the tube.

    Returns
    -------
    dict
        A JSON-ready dictionary; lengths in m, pressures in Pa. It always contains size ratio and
        wall ratio. Diameters are None if the case was given by ratios only.
    """
    stone, ureter, load = case.stone, case.ureter, case.load
    return {
        "version": VERSION,
        "stone": {
            "diameter_m": case.stone_diameter,
            "size_ratio": case.size_ratio,
            "friction": stone.friction,
            "shape": _shape(stone.shape),
        },
        "ureter": {
            "inner_diameter_m": ureter.inner_diameter,
            "outer_diameter_m": ureter.outer_diameter,
            "wall_ratio": ureter.wall_ratio,
            "material": describe_material(ureter.material),
        },
        "load": {
            "confining_pressure_Pa": float(load.confining_pressure),
            "confinement": load.confinement,
            "prestretch": load.prestretch,
        },
        "model": {"name": model.NAME} | _options(model),
        "numerics": _options(numerics),
    }


def describe_material(material: Material) -> dict[str, Any]:
    """Return the description of a material: name, law, constants in SI units and strain range.

    A user's function is described by its name only.
    """
    law = material.law
    constants: dict[str, Any] = _constants(law) if is_dataclass(law) else {}
    constants.pop("function", None)
    return {
        "name": material.name,
        "law": type(law).__name__,
        "constants": constants,
        "strain_range": list(material.strain_range),
    }


def _constants(law: Any) -> dict[str, Any]:
    """Return the constants of a law; a law inside it is described by its type and constants."""
    found = {each.name: getattr(law, each.name) for each in fields(law)}
    return {
        name: {"law": type(value).__name__, "constants": _constants(value)}
        if is_dataclass(value)
        else value
        for name, value in found.items()
    }


def fingerprint(case: Problem, model: Model, numerics: Numerics) -> str:
    """Return the SHA-256 digest of the canonical record in hexadecimal digits.

    A user's function is described by its name only, so that two versions of it have the same
    fingerprint.

    Parameters
    ----------
    case, model, numerics
        As for `describe`.
    """
    text = json.dumps(describe(case, model, numerics), sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def _shape(shape: Shape) -> dict[str, Any]:
    return {
        "aspect": shape.aspect,
        "outline": list(shape.outline),
        "deviation": shape.deviation,
    }


def _options(part: Any) -> dict[str, Any]:
    return {name: _plain(getattr(part, name)) for name in inputs_of(type(part))}


def _plain(value: Any) -> Any:
    if isinstance(value, OpeningCurve):
        return {"alpha_rad": list(value.alpha), "radius_ratio": list(value.radius)}
    return float(value) if isinstance(value, float) else value
