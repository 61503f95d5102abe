"""Seated states compared with those of CalculiX, which solves exported decks."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from page import Check, Section

import stonepass as sp
from stonepass.export.comparison import DeckComparison, compare
from stonepass.export.inp import write_inp
from stonepass.export.results import read_contact
from stonepass.export.seating import seating
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.protocol import Law, Material
from stonepass.materials.yeoh import Yeoh

FRICTION = 0.475
WORKERS = 2
WALLS_AND_SIZES = ((1.1, 1.2), (1.5, 1.05), (1.5, 1.2), (1.5, 1.5), (3.4, 1.11))
DEAD, BATH = sp.Load("5.4 kPa"), sp.Load("5.4 kPa", "hydrostatic")
ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Question:
    what: str
    case: sp.Case
    element: str = "CAX8"


def case(
    xi: float,
    eta: float,
    kind: str = "pressed",
    load: sp.Load | None = None,
    law: Law | None = None,
    **stone: object,
) -> sp.Case:
    own = Material("own", law, "verification", "none", "made up", (1.0, 1.5)) if law else "latex"
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=FRICTION, **stone),
        sp.Ureter(wall_ratio=eta, material=own),
        sp.Load() if load is None else load,
        sp.SeatedBalance(seating=kind),
    )


def questions() -> list[Question]:
    egg = sp.read_shape(ROOT / "examples" / "egg.csv")
    smooth = "frictionless"
    return [
        *(
            Question(f"frictionless, η {eta}, ξ {xi}", case(xi, eta, smooth))
            for eta, xi in (*WALLS_AND_SIZES, (1.5, 1.02))
        ),
        Question("frictionless, η 1.5, ξ 1.2", case(1.2, 1.5, smooth), "CAX8R"),
        *(
            Question(f"pressed, η {eta}, ξ {xi}", case(xi, eta))
            for eta, xi in WALLS_AND_SIZES
        ),
        Question("pressed, η 1.5, ξ 1.2", case(1.2, 1.5), "CAX8R"),
        Question("growing, η 1.5, ξ 1.2", case(1.2, 1.5, "growing")),
        Question("pressed, 5.4 kPa dead", case(1.2, 1.5, load=DEAD)),
        Question("pressed, 5.4 kPa hydrostatic", case(1.2, 1.5, load=BATH)),
        Question("pressed, pre-stretch 1.2", case(1.2, 1.5, load=sp.Load(prestretch=1.2))),
        Question("pressed, spheroid 1.6", case(1.2, 1.5, aspect=1.6)),
        Question("pressed, spheroid 0.7", case(1.2, 1.5, aspect=0.7)),
        Question("pressed, egg", case(1.2, 1.5, shape=egg)),
        Question("pressed, Mooney–Rivlin", case(1.2, 1.5, law=MooneyRivlin(1e5, 4e4))),
        Question("pressed, Yeoh", case(1.2, 1.5, law=Yeoh(1e5, 1e4, 5e3))),
    ]  # fmt: skip


def section() -> Section:
    if shutil.which("ccx") is None:
        raise SystemExit("CalculiX (ccx) is not installed: apt-get install calculix-ccx")
    asked = questions()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(WORKERS) as pool:
        solved = list(pool.map(solver(Path(folder)), range(len(asked)), asked))
    rows, smooth, pressed = [], [], []
    for question, found in zip(asked, solved, strict=True):
        if found is None:
            rows.append([question.what, question.element, "not converged", "", "", ""])
            continue
        angle, sigma, inner, critical = differences(found)
        rows.append([question.what, question.element, f"{angle:+.2f}°", f"{sigma:+.2%}",
                     f"{inner:.2%}", f"{critical:+.2%}"])  # fmt: skip
        if question.case.model.seating == "frictionless":
            smooth.append(inner)
        pressed.append(abs(critical))
    lost = sum(found is None for found in solved)
    return Section(
        title="Comparison with CalculiX",
        text=(
            "CalculiX 2.20 solves exported decks, and `stonepass compare` reads its results. The "
            "table gives the difference of CalculiX from our `standard` answer. CalculiX enforces "
            "contact by a penalty, so that its contact reaches slightly farther. σ is its contact "
            "stress, averaged over each element: at 90°, and as the largest difference over the "
            "inner half of the contact. P_ucr is computed from both contacts with the same balance "
            "and closure. The wall is latex and the friction coefficient 0.475 unless stated "
            "otherwise."
        ),
        tables=[("", ("case", "elements", "α₀", "σ(90°)", "σ, largest", "P_ucr"), rows)],
        checks=[
            Check("every deck converges", f"{len(asked) - lost} of {len(asked)}", lost == 0),
            Check("frictionless: σ within 2 %", f"{max(smooth):.2%}", max(smooth) < 0.02),
            Check("P_ucr within 4 %", f"{max(pressed):.2%}", max(pressed) < 0.04),
        ],
    )


def solver(folder: Path) -> Callable[[int, Question], DeckComparison | None]:
    def solve(number: int, question: Question) -> DeckComparison | None:
        model, job = seating(question.case), f"job{number}"
        deck = write_inp(model, question.element)
        (folder / f"{job}.inp").write_text(deck, encoding="utf-8")
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        done = subprocess.run(["ccx", job], cwd=folder, env=environment, capture_output=True)
        if done.returncode:
            return None
        try:
            found = compare(question.case, read_contact(model, folder / f"{job}.dat"))
        except sp.BadInput:  # CalculiX stopped early with exit code 0
            return None
        return found if isinstance(found, DeckComparison) else None

    return solve


def differences(found: DeckComparison) -> tuple[float, float, float, float]:
    ours, theirs = found.seated, found.contact
    assert found.answer.pressure is not None
    assert found.pressure is not None
    half = (ours.downstream_angle - ours.contact_angle) / 4.0
    inner = (ours.downstream_angle + ours.contact_angle) / 2.0 + np.linspace(-half, half, 101)
    off = theirs.pressure_at(inner) / ours.pressure_at(inner) - 1.0
    return (
        float(np.degrees(theirs.contact_angle - ours.contact_angle)),
        theirs.equator_contact_pressure / ours.equator_contact_pressure - 1.0,
        float(np.abs(off).max()),
        found.pressure / found.answer.pressure - 1.0,
    )
