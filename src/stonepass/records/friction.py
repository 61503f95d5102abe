"""The friction coefficient of a surface as a record."""

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
    """Roughness of single profiles less their mean lines, averaged over the paths.

    No filter sets waviness apart, so these are Pa, Pq and PΔq of ISO 21920.
    """

    Ra_um: float = Field(description="arithmetic mean of the heights, in µm")
    Rq_um: float = Field(description="root mean square of the heights, in µm")
    RdeltaQ: float = Field(description="root mean square of the slopes dz/dx")


class FrictionSpreadRecord(PartRecord):
    """Friction coefficients for other choices; null where the surface is then too steep."""

    without_one_path: list[float | None] = Field(
        description="μ_f without one path, for each path; empty for a single path"
    )
    baseline_order: dict[str, float | None] = Field(
        description="μ_f by the order of the first baseline"
    )
    height_range_scaling: dict[str, float | None] = Field(
        description="μ_f by how grey is scaled to the height range; empty for a height map"
    )
    margin: dict[str, float | None] = Field(
        description=(
            "μ_f by the margin at the ends of the paths in shortest waves; not part of "
            "`friction_sd`"
        )
    )


class FrictionRecord(Record):
    """The friction coefficient from the slopes of a surface, and all that it was computed from."""

    friction_coefficient: float = Field(
        description="μ_f = tan(arctan k₀ + arctan k₁) (Eq. 18); what `--friction-from` takes"
    )
    friction_sd: float | None = Field(
        description=(
            "how far it moves with what was chosen: jackknife over paths, standard deviation over "
            "orders and over scalings, as a root of squares; null where one of the choices has "
            "no answer"
        )
    )
    k0: float = Field(description="largest slope of the mean profile's baseline")
    k1: float = Field(description="largest slope of the baseline of the deviation from it")
    baseline_order: int = Field(description="N of the mean profile's baseline")
    deviation_order: int = Field(description="N of the deviation's baseline")
    baseline_wavelength_um: float = Field(
        description="2L/N in µm, the shortest wave that the first baseline follows"
    )
    deviation_wavelength_um: float = Field(
        description="2L/N in µm, the shortest wave that the second baseline follows"
    )
    margin: float = Field(
        description=(
            "how far from the ends of the paths the steepest slopes are looked for, in shortest "
            "waves of each baseline; a quarter of the path at most"
        )
    )
    looked_at: dict[str, list[float]] = Field(
        description="from and to which fraction of the path `k0` and `k1` are looked for"
    )
    tilt_deg: float = Field(
        description="angle between the least-squares plane of the surface and the picture's"
    )
    levelled: bool = Field(description="whether that plane was subtracted (`--level`)")
    friction_levelled: float | None = Field(
        description=(
            "μ_f with the plane subtracted; null where that was not tried, because the plane "
            "changes by less than 1 % of the height range, or has no answer"
        )
    )
    height_range_um: float | None = Field(
        description="height from black to white in µm; null for a height map"
    )
    pixel_um: float | list[float] = Field(
        description="width of a pixel in µm, or [width, height] where it is not square"
    )
    paths: list[list[float]] = Field(
        description=(
            "[x0, y0, x1, y1] of each path in pixels: x to the right, y down, 0 the centre of the "
            "first pixel"
        )
    )
    path_length_um: float = Field(description="L in µm")
    roughness: RoughnessRecord = Field(description="roughness of the single profiles")
    friction_from_rms_slope: float = Field(
        description="`RdeltaQ` taken as the slope that has to be climbed"
    )
    spread: FrictionSpreadRecord = Field(description="μ_f for other choices")
    image: str = Field(description="name of the file")
    pixel_source: str = Field(description="who says how large a pixel is")
    notes: list[str] = Field(description="what was left out, and how the file was read")
    warnings: list[CautionRecord] = Field(description="where μ_f must be read with care")


def friction_record(found: SurfaceFriction, image: str) -> FrictionRecord:
    """Make the record of a friction coefficient; `image` is the name of the file."""
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
    """The value; None for NaN, which stands where a choice has no answer."""
    return value if value == value else None
