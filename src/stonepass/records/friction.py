"""The record of the friction coefficient of a surface."""

from __future__ import annotations

from math import degrees

from pydantic import Field

from stonepass.records.base import CautionRecord, PartRecord, Record, warning_records
from stonepass.surface.friction_result import SurfaceFriction

__all__ = [
    "FrictionRecord",
    "FrictionSpreadRecord",
    "RoughnessRecord",
    "friction_record",
]

MICRO = 1e6  # µm per m


class RoughnessRecord(PartRecord):
    """Roughness of the profiles after subtraction of their mean lines, averaged over the paths.

    Waviness is not filtered out, so that these are the parameters of the primary profile of
    ISO 21920 (named Pa, Pq and PΔq there).
    """

    Ra_um: float = Field(description="arithmetic mean of the absolute heights in µm")
    Rq_um: float = Field(description="root mean square of the heights in µm")
    RdeltaQ: float = Field(description="root mean square of the slopes dz/dx")


class FrictionSpreadRecord(PartRecord):
    """Friction coefficients for other choices; null if μ_f does not exist for a choice."""

    without_one_path: list[float | None] = Field(
        description="μ_f without the k-th path, for each k; empty for a single path"
    )
    baseline_order: dict[str, float | None] = Field(
        description="μ_f by the order of the first baseline"
    )
    height_range_scaling: dict[str, float | None] = Field(
        description=(
            "μ_f by the way in which grey levels are scaled to the height range; empty for a "
            "height map"
        )
    )
    margin: dict[str, float | None] = Field(
        description=(
            "μ_f by the margin at the ends of the paths in units of the shortest wavelength; not "
            "part of `friction_sd`"
        )
    )


class FrictionRecord(Record):
    """The friction coefficient of a surface, with the intermediate results."""

    friction_coefficient: float = Field(
        description=(
            "μ_f = tan(arctan k₀ + arctan k₁) (Eq. 18); the option `--friction-from` reads it"
        )
    )
    friction_sd: float | None = Field(
        description=(
            "standard deviation of μ_f over analysis choices: the root of the sum of squares of "
            "the jackknife standard error over the paths and the standard deviations over orders "
            "and grey scalings; null if μ_f does not exist for one of the choices"
        )
    )
    k0: float = Field(description="largest slope of the baseline of the mean profile")
    k1: float = Field(
        description="largest slope of the baseline of the deviation from the first baseline"
    )
    baseline_order: int = Field(description="order N of the baseline of the mean profile")
    deviation_order: int = Field(description="order N of the baseline of the deviation")
    baseline_wavelength_um: float = Field(
        description="2L/N in µm, the shortest wavelength that the first baseline follows"
    )
    deviation_wavelength_um: float = Field(
        description="2L/N in µm, the shortest wavelength that the second baseline follows"
    )
    margin: float = Field(
        description=(
            "margin at the ends of the paths in which slopes are not evaluated, in units of the "
            "shortest wavelength of each baseline; a quarter of the path at most"
        )
    )
    looked_at: dict[str, list[float]] = Field(
        description=(
            "part of the path in which `k0` and `k1` are searched: fractions of its length at the "
            "start and at the end"
        )
    )
    tilt_deg: float = Field(
        description="angle between the least-squares plane of the surface and that of the picture"
    )
    levelled: bool = Field(description="true if the least-squares plane was subtracted (`--level`)")
    friction_levelled: float | None = Field(
        description=(
            "μ_f with the plane subtracted; null if the plane changes along the paths by less than "
            "1 % of the range of the profiles, or if μ_f does not exist"
        )
    )
    height_range_um: float | None = Field(
        description="height of the brightest above the darkest level in µm; null for a height map"
    )
    pixel_um: float | list[float] = Field(
        description="width of a pixel in µm, or [width, height] where it is not square"
    )
    paths: list[list[float]] = Field(
        description=(
            "[x0, y0, x1, y1] of each path in pixels; x counts to the right and y down from the "
            "centre of the first pixel"
        )
    )
    path_length_um: float = Field(description="length L of the paths in µm")
    roughness: RoughnessRecord = Field(description="roughness of the profiles")
    friction_from_rms_slope: float = Field(
        description="another estimate of μ_f: the root mean square slope `RdeltaQ`"
    )
    spread: FrictionSpreadRecord = Field(description="μ_f for other choices")
    image: str = Field(description="name of the file")
    pixel_source: str = Field(description="origin of the pixel size")
    notes: list[str] = Field(description="remarks of the reader about the file")
    warnings: list[CautionRecord] = Field(description="warnings about μ_f")


def friction_record(found: SurfaceFriction, image: str) -> FrictionRecord:
    """Make the record of a friction coefficient.

    Parameters
    ----------
    found : SurfaceFriction
        The friction coefficient and its intermediate results.
    image : str
        Name of the file of the picture.
    """
    picture, roughness, spread = found.picture, found.roughness, found.spread
    assert picture.pixel is not None
    across, down = (each * MICRO for each in picture.pixel)
    return FrictionRecord(
        friction_coefficient=found.friction,
        friction_sd=spread.sd,
        k0=found.k0,
        k1=found.k1,
        baseline_order=found.baseline.order,
        deviation_order=found.deviation_baseline.order,
        baseline_wavelength_um=found.baseline.wavelength * MICRO,
        deviation_wavelength_um=found.deviation_baseline.wavelength * MICRO,
        margin=found.baseline.margin,
        looked_at={
            "k0": list(found.baseline.looked_at),
            "k1": list(found.deviation_baseline.looked_at),
        },
        tilt_deg=degrees(found.tilt),
        levelled=found.levelled,
        friction_levelled=found.friction_levelled,
        height_range_um=None if found.height_range is None else found.height_range * MICRO,
        pixel_um=across if across == down else [across, down],
        paths=[[path.x0, path.y0, path.x1, path.y1] for path in found.paths],
        path_length_um=float(found.distance[-1]) * MICRO,
        roughness=RoughnessRecord(
            Ra_um=roughness.Ra * MICRO, Rq_um=roughness.Rq * MICRO, RdeltaQ=roughness.RdeltaQ
        ),
        friction_from_rms_slope=roughness.RdeltaQ,
        spread=FrictionSpreadRecord(
            without_one_path=[_number(mu) for mu in spread.paths],
            baseline_order={str(order): _number(mu) for order, mu in spread.orders},
            height_range_scaling={how: _number(mu) for how, mu in spread.height_range},
            margin={f"{margin:g}": _number(mu) for margin, mu in spread.margins},
        ),
        image=image,
        pixel_source=picture.pixel_source,
        notes=list(picture.notes),
        warnings=warning_records(found.warnings),
    )


def _number(value: float) -> float | None:
    """Return the value, or None for NaN."""
    return value if value == value else None
