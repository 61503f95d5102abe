"""At what urine pressure does a kidney stone pass a ureter, and how large may it be?

A Python implementation of the stone–ureter interaction model of Liu et al. 2022
(doi 10.1016/j.jmbbm.2022.105432), with its errata corrected openly. Research use only.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stonepass.about import VERSION

if TYPE_CHECKING:
    from stonepass.bench.comparison import Setting
    from stonepass.bench.invitro import fit_friction
    from stonepass.bench.law_fit import fit_law
    from stonepass.bench.test_data import read_inflation, read_tension
    from stonepass.clinic.assessment import Assessment, assess
    from stonepass.clinic.patient import read_patient
    from stonepass.errors import BadInput, Outcome, StonepassError
    from stonepass.inputs.material_file import load_material
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.inputs.shape_file import read_shape
    from stonepass.materials.protocol import Material
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case, Load, Method, Stone, Ureter
    from stonepass.model.critical import critical_pressure, solve
    from stonepass.model.shape import Shape
    from stonepass.model.shape_fit import shape_through
    from stonepass.model.size import SizeAnswer, critical_size
    from stonepass.model.states.loaded import PushedState, push_through
    from stonepass.model.states.seated import SeatedState, seat
    from stonepass.surface.friction import SurfaceFriction, surface_friction
    from stonepass.surface.paths import StraightPath
    from stonepass.surface.readers import read_surface_image
    from stonepass.surface.surface_image import SurfaceImage
    from stonepass.surface.untrusted import read_untrusted

__version__ = VERSION

# Every public name and the module it lives in; nothing is imported before it is used.
_HOME = {
    "Answer": "model.answer",
    "Assessment": "clinic.assessment",
    "BadInput": "errors",
    "Case": "model.case",
    "Load": "model.case",
    "Material": "materials.protocol",
    "Method": "model.case",
    "Outcome": "errors",
    "SurfaceImage": "surface.surface_image",
    "PushedState": "model.states.loaded",
    "SeatedState": "model.states.seated",
    "Setting": "bench.comparison",
    "Shape": "model.shape",
    "SizeAnswer": "model.size",
    "Stone": "model.case",
    "StonepassError": "errors",
    "StraightPath": "surface.paths",
    "SurfaceFriction": "surface.friction",
    "Ureter": "model.case",
    "assess": "clinic.assessment",
    "critical_pressure": "model.critical",
    "critical_size": "model.size",
    "fit_friction": "bench.invitro",
    "fit_law": "bench.law_fit",
    "load_material": "inputs.material_file",
    "push_through": "model.states.loaded",
    "read_inflation": "bench.test_data",
    "read_patient": "clinic.patient",
    "read_surface_image": "surface.readers",
    "read_points": "inputs.measured_pressures",
    "read_shape": "inputs.shape_file",
    "read_tension": "bench.test_data",
    "read_untrusted": "surface.untrusted",
    "seat": "model.states.seated",
    "shape_through": "model.shape_fit",
    "solve": "model.critical",
    "surface_friction": "surface.friction",
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
    "PushedState",
    "SeatedState",
    "Setting",
    "Shape",
    "SizeAnswer",
    "Stone",
    "StonepassError",
    "StraightPath",
    "SurfaceFriction",
    "SurfaceImage",
    "Ureter",
    "assess",
    "critical_pressure",
    "critical_size",
    "fit_friction",
    "fit_law",
    "load_material",
    "push_through",
    "read_inflation",
    "read_patient",
    "read_points",
    "read_shape",
    "read_surface_image",
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
