"""Sensitivity of the critical size to the choices that the paper leaves open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from stonepass.errors import UnstableLaw
from stonepass.materials.catalogue import material
from stonepass.materials.protocol import Material
from stonepass.materials.stability import check
from stonepass.model.answer import Model
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.paper.inputs import FRICTION, PUBLISHED
from stonepass.paper.published import PUBLISHED_MARK
from stonepass.paper.section import Asked, Illustration, Section, Table
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure, tidy
from stonepass.studies.jobs import Job, Results, SizeJob
from stonepass.units import Pressure

__all__ = ["Sensitivity"]

OUTSIDE = Pressure(4e3)
GROUND = (5e3, 8e3, 14e3)  # Pa, in addition to the default of 12 kPa
LENGTHS = (8.0, 20.0)
SHADES = {1.30: "blue", 3.40: "orange"}
MARKS = {1.30: "o", 3.40: "s"}


@dataclass(frozen=True)
class Choice:
    """An alternative: its subject, its description, and the inputs of its cases."""

    about: str
    what: str
    material: Material
    model: Model
    numerics: Numerics
    load: Load

    def case(self, wall_ratio: float) -> Case:
        """Return the case of a wall; the size of its stone is not used."""
        stone = Stone(size_ratio=1.1, friction=FRICTION)
        ureter = Ureter(None, None, self.material, wall_ratio)
        return Case(stone, ureter, self.load, self.model, self.numerics)


class Sensitivity:
    """ξ_cr of both walls for each alternative."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return a critical size for each wall and alternative, unless the law is refused."""
        return [
            SizeJob(choice.case(eta), asked.limit)
            for choice in choices()
            if _refusal(choice.material) is None
            for eta in PUBLISHED
        ]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw the figure and return the section."""
        names, rows = [], []
        figure = new_figure(8.0, 6.8)
        add_heading(figure, f"Human ureter · μ = {FRICTION:g} · dotted lines: the defaults")
        axes = figure.add_subplot()
        listed = list(choices())
        first: dict[float, float | None] = {}
        for k, choice in enumerate(listed):
            names.append(f"{choice.about}: {choice.what}".replace("P_out", "$P_{out}$"))
            for eta, colour in SHADES.items():
                refused = _refusal(choice.material)
                if refused is not None:
                    rows.append([choice.about, choice.what, eta, "REFUSED", None, None, None])
                    continue
                size = found.size(choice.case(eta), asked.limit)
                first.setdefault(eta, size.size_ratio)
                base = first[eta]
                change = None
                if size.size_ratio is None and base is not None:
                    axes.annotate(size.outcome.name, (base, k), ha="center", va="center",
                                  color=COLOURS[colour], fontsize=7)  # fmt: skip
                if size.size_ratio is not None:
                    axes.plot(size.size_ratio, k, MARKS[eta], color=COLOURS[colour], markersize=5)
                    if base is not None:
                        change = size.size_ratio - base
                        axes.plot([base, size.size_ratio], [k, k], color=COLOURS[colour], lw=1.2)
                rows.append(
                    [choice.about, choice.what, eta, size.outcome.name, size.size_ratio,
                     size.size_ratio_error, change]
                )  # fmt: skip
            if _refusal(choice.material) is not None:
                axes.annotate("refused: not stable", (1.155, k), ha="center", va="center",
                              color=COLOURS["grey"], fontsize=8)  # fmt: skip
        for eta, colour in SHADES.items():
            base = first[eta]
            if base is not None:
                axes.axvline(base, color=COLOURS[colour], linewidth=0.8, linestyle=":")
            axes.plot([], [], MARKS[eta], color=COLOURS[colour], label=f"η = {eta:.2f}")
            axes.plot(PUBLISHED[eta], -0.75, **PUBLISHED_MARK,
                      label=None if eta < 2.0 else "published")  # fmt: skip
        axes.set_yticks(range(len(names)), names)
        axes.set(ylim=(len(names) - 0.4, -1.2), xlabel=r"critical size ratio $\xi_{cr}$")
        axes.set_title(f"Critical size at {asked.limit / 1e3:g} kPa, one choice changed at a time")
        figure.legend(loc="outside lower center", ncols=3)
        tidy(axes)
        caption = (
            "Change of the critical size from our defaults (dotted lines) if one choice is changed "
            "at a time, where the paper gives no value or contradicts itself. The other models are "
            "shown too."
        )
        header = ("about", "choice", "wall_ratio", "outcome", "critical_size_ratio",
                  "critical_size_ratio_error", "change")  # fmt: skip
        return Section.written(
            "Sensitivity to the choices that the paper leaves open",
            "",
            folder,
            [Illustration("sensitivity", figure, caption)],
            [Table("sensitivity", header, rows)],
        )


def choices() -> Iterator[Choice]:
    """Yield the defaults, and then alternatives that change one choice each."""
    default = Choice("defaults", "as the paper, errata corrected", material("ureter"),
                     SeatedBalance(), Numerics(), Load())  # fmt: skip
    yield default
    for name, what in (("ureter-soft-cross", "a₁₁₂₂ = 0.0892"), ("ureter-printed", "as printed")):
        yield replace(default, about="constants", what=what, material=material(name))
    for modulus in GROUND:
        entry = default.material
        law = replace(entry.law, G=modulus)  # type: ignore[type-var]
        named = replace(entry, law=law, name=f"ureter, G {modulus / 1e3:g} kPa", reference="")
        yield replace(default, about="ground matrix", what=f"G = {modulus / 1e3:g} kPa",
                      material=named)  # fmt: skip
    yield _by(default, "far field", "with the ground matrix", SeatedBalance(far_field_ground=True))
    yield _by(default, "sign of Eq. 5", "as printed", SeatedBalance(as_printed=True))
    for seating in ("growing", "frictionless"):
        yield _by(default, "seating", seating, SeatedBalance(seating=seating))
    for length in LENGTHS:
        yield replace(default, about="half-length", what=f"{length:g} inner radii",
                      numerics=Numerics(half_length=length))  # fmt: skip
    yield _by(default, "closure", "series fitted to direct states",
              SeatedBalance(closure="series"))  # fmt: skip
    yield _by(default, "model", "direct push-through", PushThrough())
    yield _by(default, "model", "direct, wetted", PushThrough(wetted=True))
    outside = f"P_out {OUTSIDE / 1e3:g} kPa"
    yield replace(default, about=outside, what="dead", load=Load(OUTSIDE))
    yield replace(default, about=outside, what="hydrostatic", load=Load(OUTSIDE, "hydrostatic"))
    yield _by(replace(default, load=Load(OUTSIDE)), outside, "dead, Eq. 15 from the lumen",
              SeatedBalance(closure_start="lumen"))  # fmt: skip


def _by(choice: Choice, about: str, what: str, model: Model) -> Choice:
    return replace(choice, about=about, what=what, model=model)


def _refusal(entry: Material) -> str | None:
    """Return why a law describes no stable solid; None if it does."""
    try:
        check(entry)
    except UnstableLaw as problem:
        return str(problem)
    return None
