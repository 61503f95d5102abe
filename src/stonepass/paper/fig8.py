"""Fig. 8: critical pressure and critical size of the human ureter."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from scipy.interpolate import PchipInterpolator

from stonepass.errors import Outcome
from stonepass.model.contact_state import SolvedState
from stonepass.model.load import Load
from stonepass.model.size import SizeAnswer
from stonepass.paper.inputs import CONFINING, FRICTION, LIMIT, PASSING, PUBLISHED, ureter_case
from stonepass.paper.published import PUBLISHED_MARK, draw_critical_size
from stonepass.paper.section import Asked, Claim, Illustration, Section, Table, answers_table
from stonepass.report.style import (
    COLOURS,
    add_heading,
    add_mmhg_axis,
    in_style,
    new_figure,
    ordered_colours,
    signed,
    tidy,
)
from stonepass.studies.jobs import Job, PressureJob, Results, SizeJob
from stonepass.units import Pressure

__all__ = ["Fig8"]

SIZES = tuple(float(x) for x in np.round(np.linspace(1.0, 1.3, 13), 10))
WALLS = tuple(float(x) for x in np.round(np.geomspace(1.3, 3.4, 13), 4))
LOADS = tuple(Load(Pressure(1e3 * p)) for p in (0.0, 2.0, 4.0, 6.0, 8.0))  # dead, Eqs 10 and 12
SHADES = {1.30: "blue", 3.40: "orange"}
MARKS = {1.30: "o", 3.40: "s"}
HIGHEST = 2.1  # largest size ratio in the figure of the line
LUMEN, LUMEN_SD = 3.40, 0.61  # mm, unaffected ureter on CT (Song 2010)
# Width in mm and fraction that passed in 20 weeks (Jendeberg 2017, quoted by secondary sources).
PASSED = ((4.0, 0.81), (5.0, 0.65), (6.0, 0.33))
SOURCES = (
    "Sizes that passed: Jendeberg et al. 2017, doi 10.1007/s00330-017-4852-6 (by secondary "
    "sources); lumen 3.40 ± 0.61 mm: Song et al. 2010, Korean J. Urol. 51(3)."
)
HEADING = f"Human ureter · μ = {FRICTION:g} · model: paper"
Line = dict[float, tuple[Outcome, float | None]]  # η: ξ_cr at the limit


class Fig8:
    """P_ucr(ξ) of both walls, its surface over η, and the effect of confining pressure."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return the cases of curves and surface, and the critical sizes."""
        loads = (Load(), *(Load(p) for p in CONFINING))
        curves = [ureter_case(e, x, load) for e in PUBLISHED for load in loads for x in SIZES]
        stones = [ureter_case(e, x, load) for e, x in PUBLISHED.items() for load in loads]
        sizes = [ureter_case(e, 1.1, load) for e in PUBLISHED for load in LOADS]
        return [
            *(PressureJob(case) for case in (*curves, *stones)),
            *(PressureJob(ureter_case(e, x), error=False) for e in WALLS for x in SIZES),
            *(SizeJob(case, asked.limit) for case in sizes),
        ]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw the panels, write their data, and judge the claims."""
        line = {eta: _size_of(found, eta, asked.limit) for eta in WALLS}
        figure = new_figure(9.6, 8.4)
        add_heading(figure, HEADING)
        _curves(figure.add_subplot(2, 2, 1), found, asked)
        _surface(
            figure.add_subplot(2, 2, 2, projection="3d", computed_zorder=False),
            found,
            line,
            asked.limit,
        )
        _confined(figure.add_subplot(2, 2, 3), found)
        fits = _sizes_under_load(figure.add_subplot(2, 2, 4), found, asked.limit)
        lines = new_figure(6.8, 5.0)
        add_heading(lines, HEADING)
        _line(lines.add_subplot(), line, asked.limit, found)
        return Section.written(
            "Fig. 8: the human ureter",
            "",
            folder,
            [
                Illustration(
                    "fig8",
                    figure,
                    "(a) Critical pressure of both walls. (b) Critical pressure over size and wall "
                    "ratio; the line is the critical size at the limit. (c) Under confining "
                    "pressure (dead load). (d) Critical size over confining pressure.",
                ),
                Illustration(
                    "fig8b_line",
                    lines,
                    "The critical size over the wall ratio, computed, beside the paper's linear "
                    f"interpolation between its two walls, and stones that passed. {SOURCES}",
                ),
            ],
            _tables(found, asked.limit, line),
            [*_sizes(found, asked.limit), *_diameters(found, asked.limit), _grows(found),
             *_added(found), *_falls(fits, asked.limit), _clinical()],
        )  # fmt: skip


def _tables(found: Results, limit: Pressure, line: Line) -> list[Table]:
    """Return the data of the panels."""
    rest = ("size_ratio", "outcome", "critical_pressure_kPa", "critical_pressure_error_kPa",
            "stability_margin")  # fmt: skip
    confined = [
        found.answer(ureter_case(eta, xi, Load(pressure)))
        for eta in PUBLISHED
        for pressure in (Pressure(0.0), *CONFINING)
        for xi in SIZES
    ]
    bare = [answer for answer in confined if answer.case.load == Load()]
    surface = [found.answer(ureter_case(e, x), error=False) for e in WALLS for x in SIZES]
    return [
        answers_table("fig8a", ("wall_ratio", *rest), bare),
        answers_table("fig8b", ("wall_ratio", *(c for c in rest if "error" not in c)), surface),
        Table("fig8b_line", ("wall_ratio", "outcome", "critical_size_ratio"),
              [[e, outcome.name, size] for e, (outcome, size) in line.items()]),
        answers_table("fig8c", ("wall_ratio", "confining_kPa", *rest), confined),
        Table("fig8d", ("wall_ratio", "confining_kPa", "outcome", "critical_size_ratio",
                        "critical_size_ratio_error", "stability_margin"),
              [_size_row(size) for size in _sizes_under(found, limit)]),
    ]  # fmt: skip


def _kilo(pressure: float | None) -> float | None:
    return None if pressure is None else pressure / 1e3


def _surface_pressure(found: Results, eta: float, xi: float) -> float | None:
    return found.answer(ureter_case(eta, xi), error=False).pressure


def _size_of(found: Results, eta: float, limit: Pressure) -> tuple[Outcome, float | None]:
    """Return ξ_cr of one wall from its row of the surface, or why the row has none."""
    row = [(x, _surface_pressure(found, eta, x)) for x in SIZES]
    sizes, pressures = np.array([(x, p) for x, p in row if p is not None]).reshape(-1, 2).T
    if len(sizes) < 2 or np.any(np.diff(pressures) <= 0.0):
        return Outcome.NO_SOLUTION, None
    if limit < pressures[0]:
        return Outcome.BELOW_RANGE, None
    if limit > pressures[-1]:
        return Outcome.BEYOND_RANGE if len(sizes) == len(row) else Outcome.NO_SOLUTION, None
    return Outcome.SOLVED, float(PchipInterpolator(pressures, sizes)(limit))


def _curves(axes: Axes, found: Results, asked: Asked) -> None:
    for eta in SHADES:
        pressures = [found.answer(ureter_case(eta, x)).pressure for x in SIZES]
        _draw(axes, pressures, eta, "-", f"η = {eta:.2f}")
        size = found.size(ureter_case(eta, 1.1, LOADS[0]), asked.limit).size_ratio
        colour = COLOURS[SHADES[eta]]
        draw_critical_size(axes, size, PUBLISHED[eta], asked.limit / 1e3, colour)
    axes.plot([], [], **PUBLISHED_MARK, label=r"published $\xi_{cr}$")
    axes.axhline(asked.limit / 1e3, color=COLOURS["grey"], linestyle="--", linewidth=0.9)
    axes.annotate(f"limit {asked.limit / 1e3:g} kPa", (1.0, asked.limit / 1e3), xytext=(2, 4),
                  textcoords="offset points", color=COLOURS["grey"], fontsize=8)  # fmt: skip
    _frame(axes, "a  Critical pressure of both walls")
    axes.legend(loc="upper left")


def _draw(
    axes: Axes, pressures: Sequence[float | None], eta: float, line: str, label: str | None
) -> None:
    values = [np.nan if pressure is None else pressure / 1e3 for pressure in pressures]
    axes.plot(SIZES, values, color=COLOURS[SHADES[eta]], linestyle=line, marker=MARKS[eta],
              markersize=3, label=label)  # fmt: skip


def _frame(axes: Axes, name: str) -> None:
    axes.set(xlabel="size ratio ξ", ylabel="critical pressure (kPa)", ylim=(0, None))
    axes.set_title(name)
    tidy(axes)
    add_mmhg_axis(axes)


def _known(line: Line) -> tuple[list[float], list[float]]:
    """Return wall ratios and critical sizes of the walls that have a critical size."""
    known = [(eta, size) for eta, (_, size) in line.items() if size is not None]
    return [eta for eta, _ in known], [size for _, size in known]


def _surface(axes: Axes, found: Results, line: Line, limit: Pressure) -> None:
    x, y = np.meshgrid(SIZES, WALLS)
    z = np.array([[_kilo(_surface_pressure(found, e, s)) for s in SIZES] for e in WALLS], float)
    space: Any = axes
    space.plot_surface(x, y, z, cmap="magma_r", linewidth=0.2, edgecolor="white", alpha=0.9)
    walls, sizes = _known(line)
    for height in (0.0, limit / 1e3):
        space.plot(sizes, walls, height, color=COLOURS["ink"])
    space.set(xlabel="size ratio ξ", ylabel="wall ratio η", zlabel="critical pressure (kPa)")
    space.set(xticks=[1.0, 1.1, 1.2, 1.3], yticks=[1.5, 2.0, 2.5, 3.0])
    space.set_title(f"b  Critical pressure; line: limit {limit / 1e3:g} kPa")
    space.view_init(elev=22, azim=-128)
    space.set_box_aspect(None, zoom=0.92)


def _confined(axes: Axes, found: Results) -> None:
    for eta in SHADES:
        for pressure, line in zip((Pressure(0.0), *CONFINING), ("-", "--", ":"), strict=True):
            row = [found.answer(ureter_case(eta, x, Load(pressure))).pressure for x in SIZES]
            label = f"η = {eta:.2f}, $P_{{out}}$ = {pressure / 1e3:g} kPa"
            _draw(axes, row, eta, line, label)
    _frame(axes, "c  Critical pressure under confining pressure")
    axes.legend(fontsize=7, loc="upper left")


def _sizes_under(found: Results, limit: Pressure) -> list[SizeAnswer]:
    return [found.size(ureter_case(e, 1.1, load), limit) for e in PUBLISHED for load in LOADS]


def _size_row(size: SizeAnswer) -> list[object]:
    state = None if size.at_size is None else size.at_size.contact
    return [
        size.case.wall_ratio,
        size.case.load.confining_pressure / 1e3,
        size.outcome.name,
        size.size_ratio,
        size.size_ratio_error,
        state.stability.margin if isinstance(state, SolvedState) else None,
    ]


def _sizes_under_load(
    axes: Axes, found: Results, limit: Pressure
) -> dict[float, tuple[float, float] | None]:
    """Draw ξ_cr(P_out) with a fitted line; return slope per kPa and R² for each wall."""
    fits: dict[float, tuple[float, float] | None] = {}
    for eta in SHADES:
        known = [
            (size.case.load.confining_pressure / 1e3, size.size_ratio)
            for size in _sizes_under(found, limit)
            if size.case.wall_ratio == eta and size.size_ratio is not None
        ]
        loads, sizes = np.array(known).reshape(-1, 2).T
        colour = COLOURS[SHADES[eta]]
        axes.plot(loads, sizes, MARKS[eta], color=colour)
        if len(known) < 3:
            fits[eta] = None
            continue
        slope, intercept = np.polyfit(loads, sizes, 1)
        share = float(np.corrcoef(loads, sizes)[0, 1] ** 2)
        fits[eta] = float(slope), share
        label = f"η = {eta:.2f}: {signed(float(slope), 4)} per kPa, $R^2$ = {share:.4f}"
        fitted = intercept + slope * loads
        axes.plot(loads, fitted, color=colour, linewidth=1.0, label=label)
    axes.set(xlabel="confining pressure (kPa)", ylabel=r"critical size ratio $\xi_{cr}$")
    axes.set_title(f"d  Critical size at {limit / 1e3:g} kPa")
    axes.legend()
    tidy(axes)
    return fits


def _line(axes: Axes, line: Line, limit: Pressure, found: Results) -> None:
    axes.plot(*_known(line), color=COLOURS["blue"], marker="o", markersize=3,
              label=f"computed, limit {limit / 1e3:g} kPa")  # fmt: skip
    walls = list(PUBLISHED)
    ends = [found.size(ureter_case(e, 1.1, LOADS[0]), limit).size_ratio for e in walls]
    known = [end for end in ends if end is not None]
    if len(known) == len(walls):
        axes.plot(walls, known, "--", color=COLOURS["grey"],
                  label="linear between the two walls, as in the paper")  # fmt: skip
    for (width, share), shade in zip(PASSED, ordered_colours(len(PASSED)), strict=True):
        ratio = width / LUMEN
        low, high = width / (LUMEN + LUMEN_SD), width / (LUMEN - LUMEN_SD)
        axes.axhspan(low, min(high, HIGHEST), color=shade, alpha=0.08, linewidth=0)
        axes.axhline(ratio, color=shade, linewidth=1.2)
        axes.annotate(f"{width:g} mm in a lumen of {LUMEN:g} mm: {share:.0%} passed", (3.38, ratio),
                      xytext=(0, 2), textcoords="offset points", ha="right", va="bottom",
                      fontsize=8)  # fmt: skip
    axes.set(xlabel="wall ratio η", ylabel="size ratio ξ", ylim=(1.0, HIGHEST))
    axes.set_title(f"Critical size at {limit / 1e3:g} kPa, and stones that passed")
    axes.annotate(SOURCES.replace("; ", "\n"), (0.0, -0.14), xycoords="axes fraction", fontsize=6,
                  va="top", color=COLOURS["grey"])  # fmt: skip
    axes.legend(loc="upper right")
    tidy(axes)


def _sizes(found: Results, limit: Pressure) -> list[Claim]:
    if limit != LIMIT:
        return []
    reason = "the ground matrix, which the paper does not give, was calibrated to meet both sizes"
    return [
        Claim.number(
            f"ξ_cr at 12 kPa, η = {eta:.2f} (Fig. 8a)",
            published,
            found.size(ureter_case(eta, 1.1, LOADS[0]), limit).size_ratio,
            0.01,
            reason,
        )
        for eta, published in PUBLISHED.items()
    ]


def _diameters(found: Results, limit: Pressure) -> list[Claim]:
    """Return claims for the narrowest ureter (thickest wall) and the widest (thinnest wall)."""
    if limit != LIMIT:
        return []
    claims = []
    for inner, (eta, published) in PASSING.items():
        size = found.size(ureter_case(eta, 1.1, LOADS[0]), limit).size_ratio
        claims.append(
            Claim.number(
                f"largest passing diameter in mm, lumen {inner * 1e3:g} mm (section 3.2)",
                published,
                None if size is None else size * inner * 1e3,
                0.01 * inner * 1e3 + 0.005,
                "0.01 in ξ_cr, and the rounding of the published number",
            )
        )
    return claims


def _grows(found: Results) -> Claim:
    grid = np.array([[_surface_pressure(found, e, x) for x in SIZES] for e in WALLS], float)
    along, across = np.diff(grid, axis=1), np.diff(grid[:, 1:], axis=0)
    along, across = along[np.isfinite(along)], across[np.isfinite(across)]
    return Claim(
        "P_ucr grows with ξ and with η (Fig. 8a, b)",
        "yes",
        f"with ξ in {int((along > 0).sum())} of {along.size} steps, with η in "
        f"{int((across > 0).sum())} of {across.size}",
        bool((along > 0).all() and (across > 0).all() and along.size > 100),
        "no step may fall",
    )


def _added(found: Results) -> list[Claim]:
    claims = []
    for eta, xi in PUBLISHED.items():
        bare = found.answer(ureter_case(eta, xi)).pressure
        ratios = []
        for pressure in CONFINING:
            loaded = found.answer(ureter_case(eta, xi, Load(pressure))).pressure
            if bare is not None and loaded is not None:
                ratios.append((loaded - bare) / pressure)
        claims.append(
            Claim(
                f"P_out adds about itself to P_ucr, η = {eta:.2f}, ξ = {xi:.2f} (Fig. 8c)",
                "nearly equal to P_out",
                ", ".join(f"{ratio:.3f} P_out" for ratio in ratios),
                len(ratios) == len(CONFINING) and all(abs(r - 1.0) <= 0.1 for r in ratios),
                "'nearly' is read as 10 %" + _beyond(found, eta, xi),
                max((r - 1.0 for r in ratios), key=abs, default=None),
                0.1,
            )
        )
    return claims


def _beyond(found: Results, eta: float, xi: float) -> str:
    """Return a remark if the loaded wall is not stable."""
    margins = []
    for pressure in CONFINING:
        seated = found.answer(ureter_case(eta, xi, Load(pressure))).contact
        if isinstance(seated, SolvedState) and seated.stability.margin < 0.0:
            margins.append(f"{seated.stability.margin:.2f} at {pressure / 1e3:g} kPa")
    if not margins:
        return ""
    return (
        f"; the wall is beyond its stability there (margin {', '.join(margins)}; 1 unloaded, "
        "0 lost), so no real wall stays in that state"
    )


def _falls(fits: dict[float, tuple[float, float] | None], limit: Pressure) -> list[Claim]:
    if limit != LIMIT:
        return []
    known = {eta: fit for eta, fit in fits.items() if fit is not None}
    shown = "; ".join(f"η {eta:.2f}: {slope:+.4f} per kPa, R² {r2:.4f}"
                      for eta, (slope, r2) in known.items())  # fmt: skip
    straight = len(known) == 2 and all(slope < 0.0 and r2 >= 0.98 for slope, r2 in known.values())
    thin, thick = (known.get(eta, (np.nan, np.nan))[0] for eta in (1.30, 3.40))
    return [
        Claim("ξ_cr falls linearly with P_out (Fig. 8d)", "yes", shown, straight,
              "linear is read as R² ≥ 0.98"),
        Claim("it falls faster for η = 1.30 (Fig. 8d)", "yes", f"{thin:+.4f} against {thick:+.4f}",
              bool(thin < thick), "the order of the slopes"),
    ]  # fmt: skip


def _clinical() -> Claim:
    return Claim(
        "ξ_cr(η) agrees with clinical sizes (Fig. 8b)",
        "agrees well",
        "not judged",
        None,
        "the sizes and wall ratios it was compared with are in the unpublished Supporting "
        "Information; over the lumen of unaffected ureters on CT, stones passed in clinics at "
        "ratios far above the line (fig8b_line)",
    )
