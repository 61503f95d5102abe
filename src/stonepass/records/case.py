"""The canonical description of a case as a record."""

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
        description="κ: length of a spheroid over its diameter, and nearly so of another shape"
    )
    outline: list[float] = Field(
        description="coefficients g_k of g(θ) = Σ g_k cos kθ; [1] for a spheroid"
    )
    deviation: float = Field(
        description=(
            "largest distance of the shape from the points it was made of, over R_s, along rays "
            "with z shrunk by κ"
        )
    )


class StoneRecord(PartRecord):
    """The stone."""

    diameter_m: float | None = Field(
        description="stone diameter across the ureter; null where only ratios are known"
    )
    size_ratio: float | None = Field(description="ξ; null where no critical size was found")
    friction: float = Field(description="μ_f, Coulomb coefficient between stone and wall")
    shape: ShapeRecord = Field(description="shape of the stone")


class MaterialRecord(PartRecord):
    """The material of the wall."""

    name: str = Field(description="name of the material")
    law: str = Field(description="name of the law's class")
    constants: dict[str, Any] = Field(description="constants of the law, moduli in Pa")
    strain_range: list[float] = Field(
        description="circumferential stretches for which the constants were used"
    )


class UreterRecord(PartRecord):
    """The ureter."""

    inner_diameter_m: float | None = Field(
        description="inner diameter without load; null where only ratios are known"
    )
    outer_diameter_m: float | None = Field(
        description="outer diameter without load; null where only ratios are known"
    )
    wall_ratio: float = Field(description="η, outer diameter over inner diameter")
    material: MaterialRecord = Field(description="material of the wall")


class LoadRecord(PartRecord):
    """The load before stone and urine."""

    confining_pressure_Pa: float = Field(description="P_out, pressure on the outer wall")
    confinement: str = Field(description="how that pressure acts: `dead` or `hydrostatic`")
    prestretch: float = Field(description="λ_z, axial stretch of the tube")


class ModelRecord(BaseModel):
    """The model: its name, and its options.

    They have the names that the section `method` of a case file gives them; moduli are in Pa. An
    `opening_curve` has angles `alpha_rad` and radii `radius_ratio` that the series is fitted to.
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    name: str = Field(description="name of the model")


class NumericsRecord(PartRecord):
    """How finely the case is solved."""

    accuracy: str = Field(description="`fast`, `standard` or `reference`")
    half_length: float = Field(description="L, half the tube's length in inner radii")


class CaseRecord(PartRecord):
    """All that an answer depends on, in SI units."""

    version: int = Field(description="version of this description")
    stone: StoneRecord = Field(description="the stone")
    ureter: UreterRecord = Field(description="the ureter")
    load: LoadRecord = Field(description="the load before stone and urine")
    model: ModelRecord = Field(description="the model and its options")
    numerics: NumericsRecord = Field(description="how finely the case is solved")


def case_record(case: Problem, model: Model, numerics: Numerics) -> CaseRecord:
    """Make the record of a case, as `inputs.case_record` describes it."""
    return CaseRecord.model_validate(describe(case, model, numerics))
