"""Bodies of the requests for jobs, one for each kind of job."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from stonepass.bench.specimen_inputs import RELATIVE, SIZES, read_sizes
from stonepass.clinic.patient import PatientFile, patient_of
from stonepass.declaration import inputs_of, read_declared
from stonepass.errors import BadInput, require
from stonepass.inputs.case_record import describe
from stonepass.inputs.sections import section_values
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.constants import fixed_constant
from stonepass.materials.known_laws import KNOWN_LAWS, constants_by_name
from stonepass.model.case import Case
from stonepass.model.pressure_limit import read_limit
from stonepass.model.ureter import Ureter
from stonepass.studies.rising_inputs import HIGHEST, STEPS
from stonepass.studies.stiffness_input import STIFFNESS
from stonepass.surface.analysis import (
    CRYSTAL,
    HEIGHT_RANGE,
    PATH_COUNT,
    PATHS,
    PIXEL_SIZE,
    Analysis,
)
from stonepass.units import pressure
from stonepass.web.case_body import NO_FILES, CaseBody, case_of, refuse_files
from stonepass.web.declared_field import declared_field
from stonepass.web.stiffness import stiffened
from stonepass.web.strict_body import StrictBody

__all__ = [
    "AssessJob",
    "FitJob",
    "FrictionJob",
    "JobBody",
    "PressureJob",
    "PushJob",
    "ReportBody",
    "SizeJob",
    "solved_case",
]

Text = Annotated[str, Field(max_length=200)]
Upload = Annotated[str, Field(pattern="^[0-9a-f]{64}$", description="id of an uploaded file")]
CASE = "the sections of a case file"
CHOICES = inputs_of(Analysis)
TUBE = inputs_of(Ureter)


def solved_case(body: Any) -> Case:
    """Return the case of a body, with the stiffness in its material.

    Raises
    ------
    BadInput
        A value is out of bounds, names a file, or contradicts another one.
    """
    stiffness = read_declared(STIFFNESS.declaration, "stiffness", body.stiffness)
    return stiffened(case_of(body.case), stiffness)


def _described(case: Case) -> dict[str, Any]:
    """Return everything that an answer or its report depends on, the texts of the material too."""
    material = case.ureter.material
    texts = [material.name, material.source, material.test, material.verified, material.reference]
    return describe(case, case.model, case.numerics) | {"material_texts": texts}


class PressureJob(StrictBody):
    """Solve for the critical pressure by finite elements."""

    UPLOAD: ClassVar[str] = ""

    kind: Literal["pressure"]
    case: CaseBody = Field(description=CASE)  # type: ignore[valid-type]
    stiffness: float = declared_field(STIFFNESS)

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        return _described(solved_case(self))


class SizeJob(StrictBody):
    """Solve for the largest stone that moves at a pressure limit; the size of the stone is ignored.

    A stone without a size is therefore allowed.
    """

    UPLOAD: ClassVar[str] = ""

    kind: Literal["size"]
    case: CaseBody = Field(description=CASE)  # type: ignore[valid-type]
    limit: Text = Field(description="pressure limit with its unit", examples=["6 kPa"])
    stiffness: float = declared_field(STIFFNESS)

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        return _described(self.solved()) | {"limit_Pa": float(read_limit(self.limit))}

    def solved(self) -> Case:
        """Return the case with a stone of any size."""
        stiffness = read_declared(STIFFNESS.declaration, "stiffness", self.stiffness)
        return stiffened(case_of(self.case, size_ratio=1.0), stiffness)


class PushJob(StrictBody):
    """Follow a held stone by the direct model while the urine pressure rises from zero."""

    UPLOAD: ClassVar[str] = ""

    kind: Literal["push"]
    case: CaseBody = Field(description=CASE)  # type: ignore[valid-type]
    stiffness: float = declared_field(STIFFNESS)
    to: Text | None = declared_field(HIGHEST)
    steps: int = declared_field(STEPS)

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        read_declared(STEPS.declaration, "steps", self.steps)
        to = None if self.to is None else float(pressure(self.to, "to"))
        return _described(solved_case(self)) | {"to_Pa": to, "steps": self.steps}


class AssessJob(StrictBody):
    """Assess the stone of one patient; the patient is the content of a patient file."""

    UPLOAD: ClassVar[str] = ""

    kind: Literal["assess"]
    patient: PatientFile = Field(description="the sections of a patient file")  # type: ignore[valid-type]
    solve: bool = Field(
        False, description="solve about fifty cases although a surrogate covers the inputs"
    )

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        parsed: Any = self.patient
        if parsed.ureter.material not in CATALOGUE:
            raise BadInput("material", parsed.ureter.material, "one of " + ", ".join(CATALOGUE),
                           NO_FILES)  # fmt: skip
        if parsed.stone.shape is not None:
            raise BadInput("shape", parsed.stone.shape, "left out", f"{NO_FILES}; give the aspect")
        refuse_files(section_values(parsed.method, "method"))
        patient_of(self.patient)
        return parsed.model_dump(mode="json") | {"solve": self.solve}


class FitJob(StrictBody):
    """Fit the constants of a law to an uploaded table of a tensile or an inflation test."""

    UPLOAD: ClassVar[str] = "fit"

    kind: Literal["fit"]
    upload: Upload
    test: Literal["tensile", "inflation"]
    law: Text = Field(description="name of the law", examples=["neo-hookean"])
    width: Text | None = declared_field(SIZES["width"])
    thickness: Text | None = declared_field(SIZES["thickness"])
    section: Text | None = declared_field(SIZES["section"])
    gauge_length: Text | None = declared_field(SIZES["gauge_length"])
    inner: Text | None = declared_field(TUBE["inner_diameter"], "Inner diameter at rest.")
    outer: Text | None = declared_field(TUBE["outer_diameter"], "Outer diameter at rest.")
    fix: dict[Text, Text | float] = Field(
        default_factory=dict, max_length=20, description="constants that are known, by name"
    )
    free: list[Text] = Field(
        default_factory=list, max_length=20, description="constants with a default to be fitted"
    )
    relative: bool = declared_field(RELATIVE)

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        require(self.law in KNOWN_LAWS, "law", self.law, "one of " + ", ".join(KNOWN_LAWS))
        known = constants_by_name(self.law)
        for name in (*self.fix, *self.free):
            if name not in known:
                raise BadInput("constant", name, "one of " + ", ".join(known))
        for name, value in self.fix.items():
            fixed_constant(value, known[name], name)
        tube, strip = ("inner", "outer"), tuple(SIZES)
        needed, other = (tube, strip) if self.test == "inflation" else ((), tube)
        for name in needed:
            require(getattr(self, name) is not None, name, "missing", "given for an inflation test")
        for name in other:
            require(getattr(self, name) is None, name, getattr(self, name),
                    f"left out for the test '{self.test}'")  # fmt: skip
        read_sizes(**{name: getattr(self, name) for name in strip})
        for name in tube:
            size = TUBE[f"{name}_diameter"].declaration
            if getattr(self, name) is not None:
                read_declared(size, name, getattr(self, name))
        return self.model_dump(mode="json")


class FrictionJob(StrictBody):
    """Compute the friction coefficient from an uploaded picture or height map."""

    UPLOAD: ClassVar[str] = "friction"

    kind: Literal["friction"]
    upload: Upload
    pixel: Text | None = declared_field(PIXEL_SIZE)
    height_range: Text | None = declared_field(HEIGHT_RANGE)
    crystal: Text | None = declared_field(CRYSTAL)
    paths: int = declared_field(PATHS)
    path: list[Annotated[list[float], Field(min_length=4, max_length=4)]] = Field(
        default_factory=list,
        max_length=PATH_COUNT[1],
        description="ends x0, y0, x1, y1 of profiles in pixels",
    )
    area: Annotated[list[int], Field(min_length=4, max_length=4)] | None = Field(
        None, description="left, top, right and bottom of the surface in pixels"
    )
    baseline_order: int = declared_field(CHOICES["baseline_order"])
    deviation_order: int | None = declared_field(CHOICES["deviation_order"])
    level: bool = declared_field(CHOICES["level"])
    margin: float = declared_field(CHOICES["margin"])

    def question(self) -> dict[str, Any]:
        """Return everything that the answer depends on, with all values checked."""
        for each in (PIXEL_SIZE, HEIGHT_RANGE, CRYSTAL, PATHS):
            value = getattr(self, each.name)
            if value is not None:
                read_declared(each.declaration, each.name, value)
        Analysis(self.baseline_order, self.deviation_order, self.level, self.margin)
        if self.height_range is not None and self.crystal is not None:
            raise BadInput("crystal", self.crystal, "left out if the height range is given")
        if self.path and "paths" in self.model_fields_set:
            raise BadInput("paths", self.paths, "left out if the profiles are given")
        return self.model_dump(mode="json")


JobBody = Annotated[
    PressureJob | SizeJob | PushJob | AssessJob | FitJob | FrictionJob,
    Field(discriminator="kind"),
]


class ReportBody(StrictBody):
    """The question of a report to print."""

    kind: Literal["html", "pdf"] = Field(description="format of the report")
    question: Annotated[PressureJob | SizeJob | AssessJob, Field(discriminator="kind")]
