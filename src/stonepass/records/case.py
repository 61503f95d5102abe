"""The record of the canonical description of a case."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from stonepass.inputs.case_record import describe
from stonepass.model.answer import Model
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.records.base import PartRecord

__all__ = ["CaseRecord", "case_record"]


class ShapeRecord(PartRecord):
    """The meridian of the stone: ρ = R_s sin θ/g(θ), z = −κ R_s cos θ/g(θ)."""

    aspect: float = Field(
        description="κ: length of a spheroid divided by its diameter; nearly so for other shapes"
    )
    outline: list[float] = Field(
        description="coefficients g_k of g(θ) = Σ g_k cos kθ; [1] for a spheroid"
    )
    deviation: float = Field(
        description=(
            "largest distance of the shape from the points that it was fitted to, divided by R_s; "
            "it is measured along rays from the centre after z has been divided by κ"
        )
    )


class StoneRecord(PartRecord):
    """The stone."""

    diameter_m: float | None = Field(
        description="stone diameter across the ureter; null if only ratios are given"
    )
    size_ratio: float | None = Field(description="ξ; null if no critical size was found")
    friction: float = Field(description="μ_f, Coulomb friction coefficient of stone and wall")
    shape: ShapeRecord = Field(description="shape of the stone")


class MaterialRecord(PartRecord):
    """The material of the wall."""

    name: str = Field(description="name of the material")
    law: str = Field(description="name of the class of the law")
    constants: dict[str, Any] = Field(description="constants of the law; moduli in Pa")
    strain_range: list[float] = Field(
        description="smallest and largest circumferential stretch for which the constants hold"
    )


class UreterRecord(PartRecord):
    """The ureter."""

    inner_diameter_m: float | None = Field(
        description="inner diameter without load; null if only ratios are given"
    )
    outer_diameter_m: float | None = Field(
        description="outer diameter without load; null if only ratios are given"
    )
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    material: MaterialRecord = Field(description="material of the wall")


class LoadRecord(PartRecord):
    """The load without stone and urine pressure."""

    confining_pressure_Pa: float = Field(description="P_out, pressure on the outer wall")
    confinement: str = Field(description="how this pressure acts: `dead` or `hydrostatic`")
    prestretch: float = Field(description="λ_z, axial stretch of the tube")


class ModelRecord(BaseModel):
    """The name and the options of the model.

    The options have the names of the keys in the section `method` of a case file; moduli are in Pa.
    An `opening_curve` consists of the angles `alpha_rad` and the radii `radius_ratio` to which the
    series is fitted.
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    name: str = Field(description="name of the model")


class NumericsRecord(PartRecord):
    """The accuracy of the solution."""

    accuracy: str = Field(description="`fast`, `standard` or `reference`")
    half_length: float = Field(description="L, half the length of the tube in inner radii")


class CaseRecord(PartRecord):
    """The complete description of a case, in SI units."""

    version: int = Field(description="version of this description")
    stone: StoneRecord = Field(description="the stone")
    ureter: UreterRecord = Field(description="the ureter")
    load: LoadRecord = Field(description="the load without stone and urine pressure")
    model: ModelRecord = Field(description="the model and its options")
    numerics: NumericsRecord = Field(description="the accuracy of the solution")


def case_record(case: Problem, model: Model, numerics: Numerics) -> CaseRecord:
    """Make the record of a case from its canonical description.

    Parameters
    ----------
    case : Problem
        Stone, ureter and load.
    model : Model
        The model with its options.
    numerics : Numerics
        Accuracy and length of the tube.
    """
    return CaseRecord.model_validate(describe(case, model, numerics))
