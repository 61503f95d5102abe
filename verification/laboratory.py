"""Fits to tests and series, the response surface of an assessment, and its printed report."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from page import Check, Section

from stonepass.bench.comparison import SeriesSetting, compare
from stonepass.bench.invitro import fit_friction
from stonepass.bench.law_fit import fit_law
from stonepass.bench.test_data import Tension
from stonepass.clinic.assess import assess
from stonepass.clinic.patient import read_patient
from stonepass.inputs.measured_pressures import Point
from stonepass.materials.catalogue import material
from stonepass.materials.demiray import Demiray
from stonepass.materials.fung import Fung
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Material
from stonepass.materials.yeoh import Yeoh
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.report.assess_page import write_assessment
from stonepass.studies.case_solver import CaseSolver, JobSolver
from stonepass.studies.conditions import Conditions
from stonepass.studies.executor import process_pool
from stonepass.studies.response import response_surface
from stonepass.units import Pressure

ROOT = Path(__file__).parents[1]
SEED = 20260
CORES = os.cpu_count() or 1
SERIES = 300  # noisy series of a law and a kind of noise; a fraction of 95 % is known to ± 1.3 %
NOISE = 0.01
COVERED = (0.93, 0.97)  # coverage of 95 % intervals, mean over the laws for a kind of noise
EACH = (0.91, 0.99)  # coverage for one law, three standard deviations of the count
ALARMS = 0.04  # largest fraction of cautions for series that obey the law
ONWARD = 0.6  # correlation of neighbouring errors
LAWS = {
    "neo-hookean": (NeoHookean(146.5e3), {}, ("axial",)),
    "mooney-rivlin": (MooneyRivlin(1e5, 3e4), {}, ("axial",)),
    "yeoh": (Yeoh(1e5, -1e4, 2e3), {}, ("axial",)),
    "demiray": (Demiray(1e5, 1.0), {}, ("axial",)),
    "ogden": (Ogden(1e5, 3.0), {}, ("axial",)),
    "fung": (
        Fung(C=0.4056e6, a1111=0.7091, a2222=0.8892, a1122=0.1856, G=1.2e4),
        {"G": 1.2e4, "a1122": 0.1856},
        ("axial", "circumferential"),
    ),
}
# Points of a test, whether errors are proportional to the stress, correlation of neighbours.
NOISES = {
    "equal": (14, False, 0.0),
    "proportional": (14, True, 0.0),
    "equal, 5 points": (5, False, 0.0),
    "correlated": (30, False, ONWARD),
}
TUBES = [(1.5, 1.1, 0.0), (1.5, 1.3, 0.0), (2.0, 1.2, 0.0), (2.0, 1.3, 0.0), (1.5, 1.2, 5.4),
         (2.0, 1.2, 5.4)]  # fmt: skip
FRICTION, STIFFER = 0.475, 1.25
SURFACES = {
    "ureter": ("ureter", Load(), (1.15, 2.5)),
    "ureter, 1 kPa outside": ("ureter", Load("1 kPa"), (1.3, 2.5)),
    "latex": ("latex", Load(), (1.3, 2.5)),
}
CONDITIONS = 40
PAGES = 4
MEDIAN, TAIL = 0.015, 0.06  # bounds of the median and the 95 % quantile of the relative error


def section() -> Section:
    checks, tables = [], []
    for part in (_fits, _series, _surfaces, _page):
        some, table = part()
        checks += some
        tables.append(table)
    return Section("From the bench and the clinic", TEXT, checks, tables)


TEXT = """Constants are fitted to simulated tensile tests with 1 % of noise. The first table gives
the fraction of the 95 % intervals that contain the true constant, and the fraction of the fits
with a caution. These cautions are false alarms, except for errors that are correlated from point
to point. A series of critical pressures is computed with the model and pressed seating. Friction
is fitted to it twice: with the stiffness of the wall, and with a wall that is 1.25 times as stiff
as the fit assumes. The response surface of an assessment is compared with full solves at random
conditions between the lumen and 1.75 times the lumen."""


def _fits():
    asked = [(law, noise) for noise in NOISES for law in LAWS]
    with process_pool(CORES) as pool:
        found = dict(zip(asked, pool.map(_coverage, *zip(*asked, strict=True)), strict=True))
    checks, rows = [], []
    for noise in NOISES:
        some = {law: found[law, noise] for law in LAWS}
        for law, (held, told) in some.items():
            shares = ", ".join(f"{name} {share:.1%}" for name, share in held.items())
            rows.append((law, noise, shares, f"{told:.1%}"))
        means = [float(np.mean(list(held.values()))) for held, _ in some.values()]
        alarms = float(np.mean([told for _, told in some.values()]))
        if noise == "correlated":  # the intervals are not made for it, so only the table has it
            continue
        mean = float(np.mean(means))
        within = COVERED[0] <= mean <= COVERED[1] and all(EACH[0] <= m <= EACH[1] for m in means)
        shown = f"{mean:.1%} ({min(means):.1%} to {max(means):.1%})"
        checks.append(Check(f"intervals contain the true constant, errors {noise}", shown, within))
        checks.append(Check(f"false alarms, errors {noise}", f"{alarms:.1%}", alarms <= ALARMS))
    caption = (
        "95 % intervals that contain the true constant, and fits with a caution, for "
        f"{SERIES} noisy series each. The noise is 1 % of the largest stress (*equal*), or 1 % of "
        "each stress with `--relative` (*proportional*). *Correlated* noise has 30 points with a "
        f"correlation of {ONWARD} between neighbours; the intervals are not made for it."
    )
    return checks, (caption, ("law", "errors", "containing", "with a caution"), rows)


def _coverage(name: str, noise: str) -> tuple[dict[str, float], float]:
    law, given, axes = LAWS[name]
    count, relative, onward = NOISES[noise]
    generator = np.random.default_rng([SEED, list(LAWS).index(name), list(NOISES).index(noise)])
    stretch = np.linspace(1.04, 1.5, count)
    axis = tuple(each for each in axes for _ in stretch)
    blank = Tension(np.tile(stretch, len(axes)), np.ones(len(axis)), axis)
    exact = blank.predicted(law)
    size = np.abs(exact) if relative else np.abs(exact).max()
    held: dict[str, list[bool]] = {}
    told = 0
    for _ in range(SERIES):
        z = generator.normal(size=len(exact))
        for k in range(1, len(z)):
            z[k] = onward * z[k - 1] + np.sqrt(1.0 - onward**2) * z[k]
        noisy = exact + NOISE * size * z
        fitted = fit_law(replace(blank, stress=noisy), name, given, relative=relative)
        told += fitted.approximate
        for constant in fitted.constants:
            if not constant.given:
                low = -np.inf if constant.low is None else constant.low
                high = np.inf if constant.high is None else constant.high
                true = getattr(law, constant.name)
                held.setdefault(constant.name, []).append(low <= true <= high)
    return {constant: float(np.mean(each)) for constant, each in held.items()}, told / SERIES


def _series():
    with TemporaryDirectory() as folder, process_pool(CORES) as pool:
        solver = JobSolver(pool, Path(folder))
        setting = SeriesSetting(material("latex"))
        stiff = Material("stiffer", NeoHookean(STIFFER * 0.1465e6), "", "", "", (1.0, 1.5))
        own = fit_friction(_made(setting, solver), setting, solver=solver)
        both = fit_friction(_made(replace(setting, material=stiff), solver), setting, solver=solver)
    assert both.joint is not None
    off = abs(own.friction.value / FRICTION - 1.0)
    apart = max(abs(both.joint.friction.value / FRICTION - 1.0),
                abs(both.joint.stiffness.value / STIFFER - 1.0))  # fmt: skip
    rows = [
        ("friction alone, stiffness as assumed", f"{own.friction.value:.5f}", "–"),
        ("friction alone, wall 1.25 times as stiff as assumed", f"{both.friction.value:.5f}", "–"),
        ("both, wall 1.25 times as stiff as assumed", f"{both.joint.friction.value:.5f}",
         f"{both.joint.stiffness.value:.5f}"),
    ]  # fmt: skip
    checks = [
        Check("the friction of a series is recovered", f"{off:.1e}", off < 1e-3),
        Check("friction and stiffness are recovered together", f"{apart:.1e}", apart < 5e-3),
    ]
    caption = f"Fits to a series of {len(TUBES)} spheres with friction {FRICTION}, without noise."
    return checks, (caption, ("fitted", "friction", "stiffness"), rows)


def _made(setting: SeriesSetting, solver: CaseSolver) -> list[Point]:
    blank = [Point(xi, eta, Pressure(1e3 * out), Pressure(1.0)) for eta, xi, out in TUBES]
    found = compare(blank, FRICTION, setting, solver)
    return [
        replace(point, pressure=Pressure(answer.pressure))
        for point, answer in zip(blank, found.answers, strict=True)
    ]


@dataclass(frozen=True)
class _Errors:
    true: np.ndarray
    claimed: float
    bounds: int
    tried: int


def _surfaces():
    found = {name: _errors(*given) for name, given in SURFACES.items()}
    checks, rows = [], []
    for name, errors in found.items():
        middle, tail = float(np.median(errors.true)), float(np.quantile(errors.true, 0.95))
        shares = (middle, tail, float(errors.true.max()), errors.claimed)
        shown = (f"{share:.2%}" for share in shares)
        rows.append((name, str(errors.tried), *shown, str(errors.bounds)))
        checks.append(Check(f"surface, {name}: median error", f"{middle:.2%}", middle < MEDIAN))
        checks.append(Check(f"surface, {name}: 95 % quantile", f"{tail:.2%}", tail < TAIL))
        checks.append(Check(f"surface, {name}: that is at most 1.2 times the stated error",
                            f"{errors.claimed:.2%}", tail <= 1.2 * errors.claimed))  # fmt: skip
    header = ("wall", "solves", "median", "95 %", "largest", "stated (95 %)", "lower bounds")
    caption = (
        f"Relative error of the response surface at {CONDITIONS} random conditions, compared with "
        "full solves. Conditions for which one of them gives only a lower bound are counted and "
        "not compared."
    )
    return checks, (caption, header, rows)


def _errors(name: str, load: Load, walls: tuple[float, float]) -> _Errors:
    case = Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.5, material=name), load)
    generator = np.random.default_rng(SEED)
    loaded = load.confining_pressure > 0.0
    many = Conditions(
        1.0 + generator.uniform(0.02, 0.75, 2000),
        generator.uniform(*walls, 2000),
        generator.uniform(0.05, 0.5, 2000),
        generator.uniform(0.6, 1.6, 2000) if loaded else np.ones(2000),
    )
    with process_pool(CORES) as pool:
        solver = JobSolver(pool)
        surface = response_surface(case, many, solver)
        some = many.where(np.arange(2000) < CONDITIONS)
        pressure, bound = surface(some)
        outside = load.confining_pressure * some.load_factor
        cases = [
            Case(
                Stone(size_ratio=float(some.size_ratio[k]), friction=float(some.friction[k])),
                Ureter(wall_ratio=float(some.wall_ratio[k]), material=name),
                replace(load, confining_pressure=Pressure(outside[k])),
            )
            for k in range(CONDITIONS)
        ]
        answers = solver.answers(cases, error=False)
    known = [k for k, a in enumerate(answers) if a.pressure is not None and not bound[k]]
    true = np.array([abs(pressure[k] / answers[k].pressure - 1.0) for k in known])
    claimed = float(np.quantile(surface.errors, 0.95))
    return _Errors(true, claimed, CONDITIONS - len(known), surface.tried)


def _page():
    """Count the printed pages of the example's report and of one with large uncertainties."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    header = ("report", "pages")
    if browser is None:
        return [], ("No browser was found to print the report.", header, [])
    rows, pages = [], []
    for name, path in (
        ("example", ROOT / "examples" / "patient.toml"),
        ("large uncertainties", None),
    ):
        with TemporaryDirectory() as folder:
            given = Path(folder) / "patient.toml"
            given.write_text(WIDEST if path is None else path.read_text(encoding="utf-8"))
            with process_pool(CORES) as pool:
                found = assess(read_patient(given), JobSolver(pool))
            count = _printed(browser, found, Path(folder))
        pages.append(count)
        rows.append((name, str(count)))
    few = max(pages) <= PAGES
    check = Check(f"a report prints on {PAGES} A4 pages at most", ", ".join(map(str, pages)), few)
    return [check], ("Number of pages of a report, printed by Chromium.", header, rows)


def _printed(browser: str, found, folder: Path) -> int:
    write_assessment(found, folder / "report.html")
    subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer",
         f"--print-to-pdf={folder / 'report.pdf'}", str(folder / "report.html")],
        check=True, capture_output=True, timeout=120,
    )  # fmt: skip
    return len(re.findall(rb"/Type\s*/Page\b", (folder / "report.pdf").read_bytes()))


WIDEST = """
[stone]
diameter = "7 mm ± 3 mm"
place = "distal"
[ureter]
inner_diameter = "3.4 mm ± 1.2 mm"
outer_diameter = "4.4 mm ± 1 mm"
[dilated]
inner_diameter = "4 mm ± 1 mm"
outer_diameter = "5.5 mm ± 1 mm"
[load]
confining_pressure = "1 kPa"
[assessment]
limit = "12 kPa"
"""
