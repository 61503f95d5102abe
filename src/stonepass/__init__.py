"""At what urine pressure does a kidney stone in a ureter move, and what is the largest that moves?

A Python implementation of the stone–ureter interaction model of Liu et al. 2022
(doi 10.1016/j.jmbbm.2022.105432), with its errata corrected openly. Research use only.

>>> import stonepass as sp
>>> sp.critical_pressure(sp.Stone("3 mm"), sp.Ureter("3.5 mm", "4.54 mm")).outcome.name
'LOOSE'
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from stonepass.about import VERSION
from stonepass.errors import nearest
from stonepass.result import Presentation, present_with

if TYPE_CHECKING:
    from stonepass import export
    from stonepass.bench.comparison import SeriesSetting
    from stonepass.bench.invitro import InVitro, fit_friction
    from stonepass.bench.law_fit import FittedLaw, fit_law
    from stonepass.bench.test_data import Inflation, Tension
    from stonepass.bench.test_files import read_inflation, read_tension
    from stonepass.caution import Caution
    from stonepass.clinic.assess import assess
    from stonepass.clinic.assessment import Assessment
    from stonepass.clinic.patient import Patient, read_patient
    from stonepass.errors import (
        BadInput,
        CacheWarning,
        Misplaced,
        Outcome,
        StonepassError,
        UnstableLaw,
    )
    from stonepass.inputs.case_file import read_case, write_case
    from stonepass.inputs.material_file import load_material
    from stonepass.inputs.measured_pressures import Point, read_points
    from stonepass.inputs.opening_curve_file import read_opening_curve
    from stonepass.inputs.schema import case_schema
    from stonepass.inputs.shape_file import read_shape
    from stonepass.materials.catalogue import CATALOGUE, material
    from stonepass.materials.composition import Composed
    from stonepass.materials.demiray import Demiray
    from stonepass.materials.fung import Fung
    from stonepass.materials.holzapfel import HolzapfelGasserOgden
    from stonepass.materials.mooney_rivlin import MooneyRivlin
    from stonepass.materials.neo_hookean import NeoHookean
    from stonepass.materials.ogden import Ogden
    from stonepass.materials.protocol import Law, Material
    from stonepass.materials.yeoh import Yeoh
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
    from stonepass.model.states.state_solver import StateSolver
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
    from stonepass.records.sensitivity import SensitivityRecord, sensitivity_record
    from stonepass.records.size import SizeRecord, size_record
    from stonepass.records.surrogate import SurrogateAnswerRecord, surrogate_records
    from stonepass.records.sweep import SweepRecord, sweep_record
    from stonepass.result import Result
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.closures import ClosureComparison, closures
    from stonepass.studies.curve import CriticalCurve, Curve, critical_curve
    from stonepass.studies.executor import process_pool
    from stonepass.studies.jobs import PressureJob, SizeJob
    from stonepass.studies.rising import Rising, raise_pressure
    from stonepass.studies.sensitivity.evaluator import Evaluations, Evaluator
    from stonepass.studies.sensitivity.interpolated_cases import InterpolatedCases
    from stonepass.studies.sensitivity.sensitivity import Sensitivity, sensitivity
    from stonepass.studies.sensitivity.study import SensitivityStudy
    from stonepass.studies.sensitivity.study_file import read_sensitivity
    from stonepass.studies.sensitivity.surrogate_cases import SurrogateCases
    from stonepass.studies.sensitivity.uncertain_case import UncertainCase, uncertain_case
    from stonepass.studies.solution_cache import SolutionCache, default_folder
    from stonepass.studies.study import Study, run_study
    from stonepass.studies.surrogates.answers import SurrogateAnswers
    from stonepass.studies.surrogates.box import Box
    from stonepass.studies.surrogates.build import build_surrogate
    from stonepass.studies.surrogates.check import check_surrogate
    from stonepass.studies.surrogates.store import load_surrogate, save_surrogate
    from stonepass.studies.surrogates.surrogate import Surrogate
    from stonepass.studies.sweeps.plan import Sweep
    from stonepass.studies.sweeps.results import SweepResults, read_results
    from stonepass.studies.sweeps.run import sweep
    from stonepass.studies.sweeps.sweep_file import read_sweep
    from stonepass.surface.friction import surface_friction
    from stonepass.surface.friction_result import SurfaceFriction
    from stonepass.surface.paths import StraightPath
    from stonepass.surface.readers import read_surface_image
    from stonepass.surface.sandboxed import read_in_sandbox
    from stonepass.surface.surface_image import SurfaceImage
    from stonepass.units import Length, Pressure, length, pressure

__version__ = VERSION

# Every public name and the module it lives in; nothing is imported before it is used.
_HOME = {
    "Answer": "model.answer",
    "AnswerRecord": "records.answer",
    "AssessRecord": "records.assess",
    "Assessment": "clinic.assessment",
    "BadInput": "errors",
    "Box": "studies.surrogates.box",
    "CATALOGUE": "materials.catalogue",
    "CacheWarning": "errors",
    "Case": "model.case",
    "Composed": "materials.composition",
    "Caution": "caution",
    "ClosureComparison": "studies.closures",
    "ClosuresRecord": "records.closures",
    "CompareRecord": "records.compare",
    "CriticalCurve": "studies.curve",
    "Curve": "studies.curve",
    "CurvePointRecord": "records.curve",
    "Demiray": "materials.demiray",
    "ElasticFoundation": "model.models.elastic_foundation",
    "Evaluations": "studies.sensitivity.evaluator",
    "Evaluator": "studies.sensitivity.evaluator",
    "FitRecord": "records.fit",
    "FittedLaw": "bench.law_fit",
    "FrictionRecord": "records.friction",
    "Fung": "materials.fung",
    "HolzapfelGasserOgden": "materials.holzapfel",
    "InVitro": "bench.invitro",
    "InVitroRecord": "records.invitro",
    "Inflation": "bench.test_data",
    "InterpolatedCases": "studies.sensitivity.interpolated_cases",
    "JobSolver": "studies.case_solver",
    "Law": "materials.protocol",
    "Length": "units",
    "Load": "model.load",
    "Material": "materials.protocol",
    "Misplaced": "errors",
    "Model": "model.answer",
    "MooneyRivlin": "materials.mooney_rivlin",
    "NeoHookean": "materials.neo_hookean",
    "Numerics": "model.numerics",
    "Ogden": "materials.ogden",
    "OpeningCurve": "model.opening_curve",
    "Outcome": "errors",
    "Patient": "clinic.patient",
    "Point": "inputs.measured_pressures",
    "Pressure": "units",
    "PressureJob": "studies.jobs",
    "PushThrough": "model.models.push_through",
    "PushedState": "model.states.loaded_state",
    "Result": "result",
    "Rising": "studies.rising",
    "RisingRecord": "records.rising",
    "SeatedBalance": "model.models.seated_balance",
    "SeatedState": "model.states.seated_state",
    "Sensitivity": "studies.sensitivity.sensitivity",
    "SensitivityRecord": "records.sensitivity",
    "SensitivityStudy": "studies.sensitivity.study",
    "SeriesSetting": "bench.comparison",
    "Shape": "model.shape",
    "SizeAnswer": "model.size",
    "SizeJob": "studies.jobs",
    "SizeRecord": "records.size",
    "SolutionCache": "studies.solution_cache",
    "StateSolver": "model.states.state_solver",
    "Stone": "model.stone",
    "StonepassError": "errors",
    "StraightPath": "surface.paths",
    "Study": "studies.study",
    "SurfaceFriction": "surface.friction_result",
    "SurfaceImage": "surface.surface_image",
    "Surrogate": "studies.surrogates.surrogate",
    "SurrogateAnswerRecord": "records.surrogate",
    "SurrogateAnswers": "studies.surrogates.answers",
    "SurrogateCases": "studies.sensitivity.surrogate_cases",
    "Sweep": "studies.sweeps.plan",
    "SweepRecord": "records.sweep",
    "SweepResults": "studies.sweeps.results",
    "Tension": "bench.test_data",
    "UncertainCase": "studies.sensitivity.uncertain_case",
    "UnstableLaw": "errors",
    "Ureter": "model.ureter",
    "Yeoh": "materials.yeoh",
    "answer_record": "records.answer",
    "assess": "clinic.assess",
    "assess_record": "records.assess",
    "build_surrogate": "studies.surrogates.build",
    "case_schema": "inputs.schema",
    "check_surrogate": "studies.surrogates.check",
    "closures": "studies.closures",
    "closures_record": "records.closures",
    "compare_record": "records.compare",
    "critical_curve": "studies.curve",
    "critical_pressure": "model.critical",
    "critical_size": "model.size",
    "curve_records": "records.curve",
    "default_folder": "studies.solution_cache",
    "fit_friction": "bench.invitro",
    "fit_law": "bench.law_fit",
    "fit_record": "records.fit",
    "friction_record": "records.friction",
    "invitro_record": "records.invitro",
    "length": "units",
    "load_material": "inputs.material_file",
    "load_surrogate": "studies.surrogates.store",
    "material": "materials.catalogue",
    "pressure": "units",
    "process_pool": "studies.executor",
    "push_through": "model.case_states",
    "raise_pressure": "studies.rising",
    "read_case": "inputs.case_file",
    "read_in_sandbox": "surface.sandboxed",
    "read_inflation": "bench.test_files",
    "read_opening_curve": "inputs.opening_curve_file",
    "read_patient": "clinic.patient",
    "read_points": "inputs.measured_pressures",
    "read_results": "studies.sweeps.results",
    "read_sensitivity": "studies.sensitivity.study_file",
    "read_shape": "inputs.shape_file",
    "read_surface_image": "surface.readers",
    "read_sweep": "studies.sweeps.sweep_file",
    "read_tension": "bench.test_files",
    "rising_record": "records.rising",
    "run_study": "studies.study",
    "save_surrogate": "studies.surrogates.store",
    "seat": "model.case_states",
    "sensitivity": "studies.sensitivity.sensitivity",
    "sensitivity_record": "records.sensitivity",
    "shape_through": "model.shape_fit",
    "size_record": "records.size",
    "solve": "model.critical",
    "surface_friction": "surface.friction",
    "surrogate_records": "records.surrogate",
    "sweep": "studies.sweeps.run",
    "sweep_record": "records.sweep",
    "uncertain_case": "studies.sensitivity.uncertain_case",
    "write_case": "inputs.case_file",
}

_PACKAGES = ("export",)  # public packages of their own: stonepass.export.write(case, "stone.inp")

# Names under which people look for a public name.
_OTHER_NAMES = {
    "beam": "ElasticFoundation",
    "catalogue": "CATALOGUE",
    "compare_closures": "closures",
    "curve": "critical_curve",
    "direct": "PushThrough",
    "fit": "fit_law",
    "friction": "surface_friction",
    "invitro": "fit_friction",
    "load_case": "read_case",
    "materials": "CATALOGUE",
    "paper": "SeatedBalance",
    "pressure_curve": "critical_curve",
    "push": "PushThrough",
    "size": "critical_size",
    "solve_pressure": "critical_pressure",
}

__all__ = [
    "CATALOGUE",
    "Answer",
    "AnswerRecord",
    "AssessRecord",
    "Assessment",
    "BadInput",
    "Box",
    "CacheWarning",
    "Case",
    "Caution",
    "ClosureComparison",
    "ClosuresRecord",
    "CompareRecord",
    "Composed",
    "CriticalCurve",
    "Curve",
    "CurvePointRecord",
    "Demiray",
    "ElasticFoundation",
    "Evaluations",
    "Evaluator",
    "FitRecord",
    "FittedLaw",
    "FrictionRecord",
    "Fung",
    "HolzapfelGasserOgden",
    "InVitro",
    "InVitroRecord",
    "Inflation",
    "InterpolatedCases",
    "JobSolver",
    "Law",
    "Length",
    "Load",
    "Material",
    "Misplaced",
    "Model",
    "MooneyRivlin",
    "NeoHookean",
    "Numerics",
    "Ogden",
    "OpeningCurve",
    "Outcome",
    "Patient",
    "Point",
    "Pressure",
    "PressureJob",
    "PushThrough",
    "PushedState",
    "Result",
    "Rising",
    "RisingRecord",
    "SeatedBalance",
    "SeatedState",
    "Sensitivity",
    "SensitivityRecord",
    "SensitivityStudy",
    "SeriesSetting",
    "Shape",
    "SizeAnswer",
    "SizeJob",
    "SizeRecord",
    "SolutionCache",
    "StateSolver",
    "Stone",
    "StonepassError",
    "StraightPath",
    "Study",
    "SurfaceFriction",
    "SurfaceImage",
    "Surrogate",
    "SurrogateAnswerRecord",
    "SurrogateAnswers",
    "SurrogateCases",
    "Sweep",
    "SweepRecord",
    "SweepResults",
    "Tension",
    "UncertainCase",
    "UnstableLaw",
    "Ureter",
    "Yeoh",
    "answer_record",
    "assess",
    "assess_record",
    "build_surrogate",
    "case_schema",
    "check_surrogate",
    "closures",
    "closures_record",
    "compare_record",
    "critical_curve",
    "critical_pressure",
    "critical_size",
    "curve_records",
    "default_folder",
    "export",
    "fit_friction",
    "fit_law",
    "fit_record",
    "friction_record",
    "invitro_record",
    "length",
    "load_material",
    "load_surrogate",
    "material",
    "pressure",
    "process_pool",
    "push_through",
    "raise_pressure",
    "read_case",
    "read_in_sandbox",
    "read_inflation",
    "read_opening_curve",
    "read_patient",
    "read_points",
    "read_results",
    "read_sensitivity",
    "read_shape",
    "read_surface_image",
    "read_sweep",
    "read_tension",
    "rising_record",
    "run_study",
    "save_surrogate",
    "seat",
    "sensitivity",
    "sensitivity_record",
    "shape_through",
    "size_record",
    "solve",
    "surface_friction",
    "surrogate_records",
    "sweep",
    "sweep_record",
    "uncertain_case",
    "write_case",
]


def _presentation() -> Presentation:
    from stonepass.report import presentation  # loads matplotlib and the finite elements

    return presentation


present_with(_presentation)


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return import_module(f"stonepass.{name}")
    if name in _HOME:
        return getattr(import_module(f"stonepass.{_HOME[name]}"), name)
    meant = _OTHER_NAMES.get(name) or nearest(name, __all__)
    remedy = f"; did you mean stonepass.{meant}?" if meant else ""
    raise AttributeError(f"module 'stonepass' has no attribute '{name}'{remedy}")


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
