"""Fig. 9: the beam model of the thin wall, compared with finite elements and over its inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.models.elastic_foundation import ElasticFoundation
from stonepass.model.size import SizeAnswer, critical_size
from stonepass.model.stone import Stone
from stonepass.paper.inputs import BEAM, BEAM_SIZE, FRICTION, LIMIT, ureter_case
from stonepass.paper.section import Asked, Claim, Illustration, Section, Table
from stonepass.report.style import (
    COLOURS,
    add_heading,
    add_mmhg_axis,
    in_style,
    new_figure,
    series,
    tidy,
)
from stonepass.studies.jobs import Job, PressureJob, Results
from stonepass.units import Pressure

__all__ = ["Fig9"]

WALL = 1.30
SECANT = 1.297  # stretch at which the secant modulus is the published E₁
SIZES = tuple(float(x) for x in np.round(np.linspace(1.0, 1.3, 13), 10))
FACTORS = tuple(float(x) for x in np.round(np.geomspace(0.5, 8.0, 17), 4))
FRICTIONS = tuple(float(x) for x in np.round(np.linspace(0.1, 1.5, 15), 10))


class Fig9:
    """P_ucr of the beam and of finite elements; ξ_cr of the beam over its inputs."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return the cases of the finite-element curve; the beam model needs no jobs."""
        return [PressureJob(ureter_case(WALL, xi)) for xi in SIZES]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw both panels, and judge the claims."""
        answers = [
            [found.answer(ureter_case(WALL, xi)) for xi in SIZES],
            [solve(ureter_case(WALL, xi, model=BEAM)) for xi in SIZES],
            [solve(_by_secants(xi)) for xi in SIZES],
        ]
        elements, published, secants = (_pressures(each) for each in answers)
        by_stiffness = [_size(asked.limit, _scaled(factor), FRICTION) for factor in FACTORS]
        by_friction = [_size(asked.limit, BEAM, friction) for friction in FRICTIONS]
        stiffness, friction = _ratios(by_stiffness), _ratios(by_friction)
        figure = new_figure(9.2, 4.4)
        add_heading(figure, f"Human ureter, η = {WALL:.2f} · μ = {FRICTION:g} unless it is varied")
        left, right = (figure.add_subplot(1, 2, k) for k in (1, 2))
        for k, (values, label) in enumerate(
            (
                (elements, "finite elements"),
                (published, "beam, published moduli"),
                (secants, f"beam, secants at stretch {SECANT:g} (our reading)"),
            )
        ):
            left.plot(SIZES, values, **series(k), markersize=3, label=label)
        left.axhline(asked.limit / 1e3, color=COLOURS["grey"], linestyle="--", linewidth=0.9)
        left.annotate(f"limit {asked.limit / 1e3:g} kPa", (SIZES[0], asked.limit / 1e3),
                      xytext=(2, 4), textcoords="offset points", color=COLOURS["grey"],
                      fontsize=8)  # fmt: skip
        left.set(xlabel="size ratio ξ", ylabel="critical pressure (kPa)", ylim=(0, None))
        left.set_title("Fig. 9c  Critical pressure")
        left.legend()
        tidy(left)
        add_mmhg_axis(left)
        right.plot(FACTORS, stiffness, **series(0), markersize=3,
                   label="stiffness, over the published moduli")  # fmt: skip
        right.plot(np.array(FRICTIONS) / FRICTION, friction, **series(1), markersize=3,
                   label=f"friction, over {FRICTION:g}")  # fmt: skip
        right.set(xlabel="factor on stiffness or friction", xlim=(0.0, None),
                  ylabel=r"critical size ratio $\xi_{cr}$")  # fmt: skip
        right.set_title(f"Fig. 9d  Critical size by the beam at {asked.limit / 1e3:g} kPa")
        right.legend()
        tidy(right)
        caption = (
            "Panels a and b of the paper's figure are sketches and are not drawn here. "
            "(c) Critical pressure of the thin wall by finite elements and as a beam on an elastic "
            "foundation. (d) Critical size by the beam, over stiffness (E₁ and E₂ together) and "
            "over friction."
        )
        names = ("finite_elements", "beam", "beam_by_secants")
        columns = [f"{name}_{what}" for name in names for what in ("outcome", "kPa")]
        size = ("outcome", "critical_size_ratio")
        return Section.written(
            "Fig. 9: the thin wall as a beam",
            "",
            folder,
            [Illustration("fig9", figure, caption)],
            [
                Table("fig9c", ("size_ratio", *columns),
                      [_row(xi, row) for xi, *row in zip(SIZES, *answers, strict=True)]),
                Table("fig9d_stiffness", ("factor", *size),
                      [[x, *_outcome(s)] for x, s in zip(FACTORS, by_stiffness, strict=True)]),
                Table("fig9d_friction", ("friction", *size),
                      [[x, *_outcome(s)] for x, s in zip(FRICTIONS, by_friction, strict=True)]),
            ],
            [*_headline(asked.limit), _agree(elements, published),
             *_trends(stiffness, friction, asked.limit)],
        )  # fmt: skip


def _pressures(answers: Sequence[Answer]) -> Float[np.ndarray, " sizes"]:
    """Return critical pressures in kPa; NaN without an answer."""
    return np.array([np.nan if a.pressure is None else a.pressure / 1e3 for a in answers])


def _row(xi: float, answers: Sequence[Answer]) -> list[object]:
    row: list[object] = [xi]
    for answer in answers:
        row += [answer.outcome.name, None if answer.pressure is None else answer.pressure / 1e3]
    return row


def _by_secants(xi: float) -> Case:
    return ureter_case(WALL, xi, model=ElasticFoundation(secant_stretch=SECANT))


def _scaled(factor: float) -> ElasticFoundation:
    moduli = (BEAM.circumferential_modulus, BEAM.longitudinal_modulus)
    hoop, axial = (Pressure(factor * float(each)) for each in moduli if each is not None)
    return replace(BEAM, circumferential_modulus=hoop, longitudinal_modulus=axial)


def _size(limit: Pressure, model: ElasticFoundation, friction: float) -> SizeAnswer:
    """Return the critical size of the beam model."""
    case = ureter_case(WALL, 1.1, model=model)
    case = replace(case, stone=Stone(size_ratio=1.1, friction=friction))
    return critical_size(case.ureter, limit, friction, model=model)


def _ratios(sizes: Sequence[SizeAnswer]) -> Float[np.ndarray, " sizes"]:
    """Return values of ξ_cr; NaN without an answer."""
    return np.array([np.nan if s.size_ratio is None else s.size_ratio for s in sizes])


def _outcome(size: SizeAnswer) -> tuple[str, float | None]:
    return size.outcome.name, size.size_ratio


def _headline(limit: Pressure) -> list[Claim]:
    if limit != LIMIT:
        return []
    ours = _size(limit, BEAM, FRICTION).size_ratio
    return [
        Claim(
            "ξ_cr of the beam at 12 kPa, η = 1.30 (section 3.3.1)",
            f"{BEAM_SIZE:g}",
            "none" if ours is None else f"{ours:.4g}",
            None,
            "the values differ: ours follows from the printed equations, with the fourth root in "
            "Eq. 24, and from the printed moduli; the secant moduli that the paper used are in its "
            "unpublished Supporting Information, so that the cause cannot be determined",
            None if ours is None else ours - BEAM_SIZE,
        )
    ]


def _agree(elements: Float[np.ndarray, " n"], beam: Float[np.ndarray, " n"]) -> Claim:
    kept = np.isfinite(beam) & np.isfinite(elements) & (elements > 0.0)
    off, relative = (
        (beam - elements)[kept] / elements[kept].max(),
        (beam / np.where(kept, elements, 1)),
    )
    worst, apart = float(off[np.argmax(np.abs(off))]), relative[kept] - 1.0
    return Claim(
        "the beam agrees with finite elements, η = 1.30, ξ to 1.3 (Fig. 9c)",
        "agrees well",
        f"within {np.abs(off).max():.0%} of the highest pressure; {apart.min():+.0%} to "
        f"{apart.max():+.0%} of the pressure itself",
        bool(abs(worst) <= 0.15 and kept.sum() >= 10),
        "the tolerance is 15 % of the highest pressure in the figure; the load is not a point load "
        "(aβ = 4.6), E₂ could not be derived, and small stones deviate most",
        worst,
        0.15,
    )


def _trends(
    stiffness: Float[np.ndarray, " factors"],
    friction: Float[np.ndarray, " frictions"],
    limit: Pressure,
) -> list[Claim]:
    """Return the claims on the slopes, and on the effect of doubling stiffness and friction."""
    if limit != LIMIT:
        return []
    falls = []
    for x, values in ((np.array(FACTORS), stiffness), (np.array(FRICTIONS), friction)):
        kept = np.isfinite(values)
        slopes = np.diff(values[kept]) / np.diff(x[kept])
        falls.append(
            bool((slopes < 0.0).all() and (np.diff(slopes) > 0.0).all() and kept.sum() > 8)
        )
    softer = np.interp([1.0, 2.0], FACTORS, stiffness)
    rougher = np.interp([FRICTION, 2.0 * FRICTION], FRICTIONS, friction)
    drops = softer[0] - softer[1], rougher[0] - rougher[1]
    return [
        Claim("ξ_cr falls with stiffness and with friction, and levels off (Fig. 9d)", "yes",
              "both fall, with decreasing slopes" if all(falls) else "not throughout",
              all(falls), "every slope is negative, and flatter than the one before"),
        Claim("stiffness matters more than friction (Fig. 9d)", "yes",
              f"doubling them reduces ξ_cr by {drops[0]:.3f} and {drops[1]:.3f}",
              bool(drops[0] > drops[1] > 0.0), "compared at twice the published values"),
    ]  # fmt: skip
