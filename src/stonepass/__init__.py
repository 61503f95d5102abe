"""At what urine pressure does a kidney stone pass a ureter, and what is the largest that can?

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
    from stonepass.caution import Caution
    from stonepass.clinic.assess import assess
    from stonepass.clinic.assessment import Assessment
    from stonepass.clinic.patient import read_patient
    from stonepass.errors import BadInput, Outcome, StonepassError
    from stonepass.inputs.case_file import read_case, write_case
    from stonepass.inputs.material_file import load_material
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.inputs.opening_curve_file import read_opening_curve
    from stonepass.inputs.schema import case_schema
    from stonepass.inputs.shape_file import read_shape
    from stonepass.materials.protocol import Material
    from stonepass.model.answer import Answer, Model
    from stonepass.model.case import Case
    from stonepass.model.case_states import push_through, seat
    from stonepass.model.critical import critical_pressure, solve
    from stonepass.model.load import Load
    from stonepass.model.models.elastic_foundation import ElasticFoundation
    from stonepass.model.models.push_through import PushThrough
    from stonepass.model.models.seated_balance import SeatedBalance
    from stonepass.model.numerics import Numerics
    from stonepass.model.opening_curve import OpeningCurve
    from stonepass.model.shape import Shape
    from stonepass.model.shape_fit import shape_through
    from stonepass.model.size import SizeAnswer, critical_size
    from stonepass.model.states.loaded_state import PushedState
    from stonepass.model.states.seated_state import SeatedState
    from stonepass.model.stone import Stone
    from stonepass.model.ureter import Ureter
    from stonepass.records.answer import AnswerRecord, answer_record
    from stonepass.records.assess import AssessRecord, assess_record
    from stonepass.records.closures import ClosuresRecord, closures_record
    from stonepass.records.compare import CompareRecord, compare_record
    from stonepass.records.curve import CurvePointRecord, curve_records
    from stonepass.records.fit import FitRecord, fit_record
    from stonepass.records.friction import FrictionRecord, friction_record
    from stonepass.records.invitro import InVitroRecord, invitro_record
    from stonepass.records.rising import RisingRecord, rising_record
    from stonepass.records.size import SizeRecord, size_record
    from stonepass.surface.friction import SurfaceFriction, surface_friction
    from stonepass.surface.paths import StraightPath
    from stonepass.surface.readers import read_surface_image
    from stonepass.surface.surface_image import SurfaceImage
    from stonepass.surface.untrusted import read_untrusted

__version__ = VERSION

# Every public name and the module it lives in; nothing is imported before it is used.
_HOME = {
    "Answer": "model.answer",
    "AnswerRecord": "records.answer",
    "AssessRecord": "records.assess",
    "Assessment": "clinic.assessment",
    "BadInput": "errors",
    "Case": "model.case",
    "Caution": "caution",
    "ClosuresRecord": "records.closures",
    "CompareRecord": "records.compare",
    "CurvePointRecord": "records.curve",
    "ElasticFoundation": "model.models.elastic_foundation",
    "FitRecord": "records.fit",
    "FrictionRecord": "records.friction",
    "InVitroRecord": "records.invitro",
    "Load": "model.load",
    "Material": "materials.protocol",
    "Model": "model.answer",
    "Numerics": "model.numerics",
    "OpeningCurve": "model.opening_curve",
    "Outcome": "errors",
    "PushThrough": "model.models.push_through",
    "PushedState": "model.states.loaded_state",
    "RisingRecord": "records.rising",
    "SeatedBalance": "model.models.seated_balance",
    "SeatedState": "model.states.seated_state",
    "Setting": "bench.comparison",
    "Shape": "model.shape",
    "SizeAnswer": "model.size",
    "SizeRecord": "records.size",
    "Stone": "model.stone",
    "StonepassError": "errors",
    "StraightPath": "surface.paths",
    "SurfaceFriction": "surface.friction",
    "SurfaceImage": "surface.surface_image",
    "Ureter": "model.ureter",
    "answer_record": "records.answer",
    "assess": "clinic.assess",
    "assess_record": "records.assess",
    "case_schema": "inputs.schema",
    "closures_record": "records.closures",
    "compare_record": "records.compare",
    "critical_pressure": "model.critical",
    "critical_size": "model.size",
    "curve_records": "records.curve",
    "fit_friction": "bench.invitro",
    "fit_law": "bench.law_fit",
    "fit_record": "records.fit",
    "friction_record": "records.friction",
    "invitro_record": "records.invitro",
    "load_material": "inputs.material_file",
    "push_through": "model.case_states",
    "read_case": "inputs.case_file",
    "read_inflation": "bench.test_data",
    "read_opening_curve": "inputs.opening_curve_file",
    "read_patient": "clinic.patient",
    "read_points": "inputs.measured_pressures",
    "read_shape": "inputs.shape_file",
    "read_surface_image": "surface.readers",
    "read_tension": "bench.test_data",
    "read_untrusted": "surface.untrusted",
    "rising_record": "records.rising",
    "seat": "model.case_states",
    "shape_through": "model.shape_fit",
    "size_record": "records.size",
    "solve": "model.critical",
    "surface_friction": "surface.friction",
    "write_case": "inputs.case_file",
}

__all__ = [
    "Answer",
    "AnswerRecord",
    "AssessRecord",
    "Assessment",
    "BadInput",
    "Case",
    "Caution",
    "ClosuresRecord",
    "CompareRecord",
    "CurvePointRecord",
    "ElasticFoundation",
    "FitRecord",
    "FrictionRecord",
    "InVitroRecord",
    "Load",
    "Material",
    "Model",
    "Numerics",
    "OpeningCurve",
    "Outcome",
    "PushThrough",
    "PushedState",
    "RisingRecord",
    "SeatedBalance",
    "SeatedState",
    "Setting",
    "Shape",
    "SizeAnswer",
    "SizeRecord",
    "Stone",
    "StonepassError",
    "StraightPath",
    "SurfaceFriction",
    "SurfaceImage",
    "Ureter",
    "answer_record",
    "assess",
    "assess_record",
    "case_schema",
    "closures_record",
    "compare_record",
    "critical_pressure",
    "critical_size",
    "curve_records",
    "fit_friction",
    "fit_law",
    "fit_record",
    "friction_record",
    "invitro_record",
    "load_material",
    "push_through",
    "read_case",
    "read_inflation",
    "read_opening_curve",
    "read_patient",
    "read_points",
    "read_shape",
    "read_surface_image",
    "read_tension",
    "read_untrusted",
    "rising_record",
    "seat",
    "shape_through",
    "size_record",
    "solve",
    "surface_friction",
    "write_case",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'stonepass' has no attribute '{name}'")
    return getattr(import_module(f"stonepass.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
