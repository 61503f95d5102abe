"""At what urine pressure does a kidney stone pass a ureter, and how large may it be?

A Python implementation of the stone–ureter interaction model of Liu et al. 2022
(doi 10.1016/j.jmbbm.2022.105432), with its errata corrected openly. Research use only.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stonepass.origin import VERSION

if TYPE_CHECKING:
    from stonepass.errors import BadInput, Outcome, StonepassError
    from stonepass.imaging.friction import SurfaceFriction, surface_friction
    from stonepass.imaging.paths import StraightPath
    from stonepass.imaging.picture import Picture
    from stonepass.imaging.readers import read_picture
    from stonepass.imaging.untrusted import read_untrusted
    from stonepass.laboratory.assess import Assessment, assess
    from stonepass.laboratory.bench import read_inflation, read_tension
    from stonepass.laboratory.comparison import Setting
    from stonepass.laboratory.fit import fit_law
    from stonepass.laboratory.invitro import fit_friction
    from stonepass.laboratory.person import read_person
    from stonepass.materials.protocol import Material
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case, Load, Method, Stone, Ureter
    from stonepass.model.critical import critical_pressure, solve
    from stonepass.model.meridian import read_shape, shape_through
    from stonepass.model.points import read_points
    from stonepass.model.push_through import PushedState, push_through
    from stonepass.model.seated import SeatedState, seat
    from stonepass.model.shape import Shape
    from stonepass.model.size import SizeAnswer, critical_size

__version__ = VERSION

# Every public name and the module it lives in; nothing is imported before it is used.
_HOME = {
    "Answer": "model.answer",
    "Assessment": "laboratory.assess",
    "BadInput": "errors",
    "Case": "model.case",
    "Load": "model.case",
    "Material": "materials.protocol",
    "Method": "model.case",
    "Outcome": "errors",
    "Picture": "imaging.picture",
    "PushedState": "model.push_through",
    "SeatedState": "model.seated",
    "Setting": "laboratory.comparison",
    "Shape": "model.shape",
    "SizeAnswer": "model.size",
    "Stone": "model.case",
    "StonepassError": "errors",
    "StraightPath": "imaging.paths",
    "SurfaceFriction": "imaging.friction",
    "Ureter": "model.case",
    "assess": "laboratory.assess",
    "critical_pressure": "model.critical",
    "critical_size": "model.size",
    "fit_friction": "laboratory.invitro",
    "fit_law": "laboratory.fit",
    "push_through": "model.push_through",
    "read_inflation": "laboratory.bench",
    "read_person": "laboratory.person",
    "read_picture": "imaging.readers",
    "read_points": "model.points",
    "read_shape": "model.meridian",
    "read_tension": "laboratory.bench",
    "read_untrusted": "imaging.untrusted",
    "seat": "model.seated",
    "shape_through": "model.meridian",
    "solve": "model.critical",
    "surface_friction": "imaging.friction",
}

__all__ = [
    "Answer",
    "Assessment",
    "BadInput",
    "Case",
    "Load",
    "Material",
    "Method",
    "Outcome",
    "Picture",
    "PushedState",
    "SeatedState",
    "Setting",
    "Shape",
    "SizeAnswer",
    "Stone",
    "StonepassError",
    "StraightPath",
    "SurfaceFriction",
    "Ureter",
    "assess",
    "critical_pressure",
    "critical_size",
    "fit_friction",
    "fit_law",
    "push_through",
    "read_inflation",
    "read_person",
    "read_picture",
    "read_points",
    "read_shape",
    "read_tension",
    "read_untrusted",
    "seat",
    "shape_through",
    "solve",
    "surface_friction",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'stonepass' has no attribute '{name}'")
    return getattr(import_module(f"stonepass.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
