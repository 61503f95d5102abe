"""The record of a held stone under rising urine pressure, and its states as CSV."""

from __future__ import annotations

import math
from pathlib import Path

from pydantic import Field

from stonepass.io.csv_file import write_csv
from stonepass.model.states.loaded_state import PushedState
from stonepass.records.base import CautionRecord, PartRecord, Record, kilo, warning_records
from stonepass.studies.rising import Rising

__all__ = ["RisingRecord", "RisingStateRecord", "rising_record", "write_rising"]


class RisingStateRecord(PartRecord):
    """The held stone at one urine pressure."""

    urine_pressure_kPa: float = Field(description="P_u on the held stone")
    net_force_kPa: float = Field(
        description="N, axial force on the stone divided by π R_s², positive downstream"
    )
    friction_work_kPa: float = Field(
        description="D, work of friction per unit advance of the stone, divided by π R_s²"
    )
    contact_angle_deg: float = Field(description="α, the angle at which the contact begins")
    downstream_angle_deg: float = Field(description="angle at which the contact ends")
    seal_angle_deg: float = Field(description="angle of the largest contact pressure")
    peak_contact_pressure_kPa: float = Field(description="largest contact pressure σ")
    equator_contact_pressure_kPa: float = Field(description="contact pressure σ at θ = 90°")
    upstream_radius_ratio: float = Field(description="r_a/R_a far upstream of the stone")
    contact_deviation: float | None = Field(
        description=(
            "∫ |σ − σ⁰| dθ/∫ σ⁰ dθ over the contact of this state, with the contact pressure σ⁰ of "
            "the seated state"
        )
    )


class RisingRecord(Record):
    """States of a held stone under rising urine pressure."""

    outcome: str = Field(description="outcome of the direct model (glossary: outcomes)")
    message: str = Field(description="the outcome as a sentence")
    critical_pressure_kPa: float | None = Field(description="P_ucr of the direct model")
    leak_pressure_kPa: float | None = Field(
        description="P_u at which urine passes the held stone, from the coarser solve"
    )
    states: list[RisingStateRecord] = Field(
        description="state at each urine pressure, in rising order from 0"
    )
    reason: str = Field(description="reason why states are missing; empty if none are missing")
    warnings: list[CautionRecord] = Field(description="warnings about the answer")


def rising_record(rising: Rising) -> RisingRecord:
    """Make the record of a held stone under rising pressure."""
    critical = rising.critical
    pairs = zip(rising.states, rising.deviation, strict=True)
    return RisingRecord(
        outcome=critical.outcome.name,
        message=critical.message,
        critical_pressure_kPa=kilo(critical.pressure),
        leak_pressure_kPa=kilo(getattr(critical.detail, "leak_pressure", None)),
        states=[_state(state, float(deviation)) for state, deviation in pairs],
        reason=rising.reason,
        warnings=warning_records(critical.warnings),
    )


def _state(state: PushedState, deviation: float) -> RisingStateRecord:
    return RisingStateRecord(
        urine_pressure_kPa=state.urine_pressure / 1e3,
        net_force_kPa=state.net_force / 1e3,
        friction_work_kPa=state.friction_work / 1e3,
        contact_angle_deg=math.degrees(state.contact_angle),
        downstream_angle_deg=math.degrees(state.downstream_angle),
        seal_angle_deg=math.degrees(state.seal_angle),
        peak_contact_pressure_kPa=state.peak_contact_pressure / 1e3,
        equator_contact_pressure_kPa=state.equator_contact_pressure / 1e3,
        upstream_radius_ratio=state.upstream_radius,
        contact_deviation=None if math.isnan(deviation) else deviation,
    )


def write_rising(rising: Rising, path: Path) -> None:
    """Write the states of a held stone as CSV, with empty cells for missing numbers.

    Parameters
    ----------
    rising : Rising
        The states; pressures are written in kPa and angles in degrees.
    path : Path
        File to write.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    columns = tuple(RisingStateRecord.model_fields)
    rows = (each.to_dict() for each in rising_record(rising).states)
    write_csv(path, columns, ([row[name] for name in columns] for row in rows))
