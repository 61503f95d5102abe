"""Tables of a surrogate and of its answers for a terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np
from rich import box
from rich.table import Table

from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["answers_table", "surrogate_table"]

MOST_ROWS = 40  # largest number of answers in the table


def surrogate_table(surrogate: Surrogate) -> Table:
    """Return box, origin and measured errors of a surrogate as a table of two columns."""
    case, limits = surrogate.case, surrogate.box
    table = Table(box=box.SIMPLE, show_header=False)
    rows = {
        "material": case.ureter.material.name,
        "model": case.model.NAME,
        "size ratio ξ": f"from that of the lumen to {limits.size_ratio:g}",
        "wall ratio η": _span(limits.wall_ratio),
        "friction": _span(limits.friction),
        "confining pressure": _loads(surrogate),
        "terms": f"{surrogate.terms}",
    }
    cases = Counter[str]()
    for level in surrogate.about.get("levels", ()):
        cases[f"fitted to {level['accuracy']} {level['options']}"] += level["cases"]
    rows |= {name: f"{number} cases" for name, number in cases.items()}
    rows |= _errors(surrogate.about.get("check"))
    for name, value in rows.items():
        table.add_row(name, value)
    return table


def answers_table(answers: SurrogateAnswers) -> Table:
    """Return the first answers of a surrogate as a table."""
    table = Table(box=box.SIMPLE_HEAD)
    for name in ("ξ", "η", "friction", "outcome", "P_ucr (kPa)", "claimed error (kPa)"):
        table.add_column(name, justify="left" if name == "outcome" else "right")
    for row in answers.to_rows()[:MOST_ROWS]:
        numbers = (row["critical_pressure_kPa"], row["critical_pressure_error_kPa"])
        table.add_row(
            *(f"{row[name]:.4g}" for name in ("size_ratio", "wall_ratio", "friction")),
            "OUTSIDE" if row["outside"] else row["outcome"],
            *("–" if value is None else f"{value:.4g}" for value in numbers),
        )
    notes = []
    if answers.outside.any():
        notes.append(
            "OUTSIDE: the surrogate does not cover these inputs, see 'stonepass surrogate show'"
        )
    if len(answers) > MOST_ROWS:
        notes.append(f"{len(answers) - MOST_ROWS} further answers are not shown")
    table.caption = "\n".join(notes) or None
    return table


def _loads(surrogate: Surrogate) -> str:
    """Return the range of the confining pressure; that of the thinnest wall if it is smaller."""
    most, stable = surrogate.case.load.confining_pressure / 1e3, surrogate.stable
    text = f"0 to {most:g} kPa"
    if stable.factor[0] == 1.0:
        return text
    whole = stable.wall_ratio[np.argmax(stable.factor == 1.0)]
    return (
        f"{text}; in walls thinner than η {whole:.3g} less, because the tube is close to buckling: "
        f"{stable.factor[0] * most:.2g} kPa at η {stable.wall_ratio[0]:g}"
    )


def _errors(check: Mapping[str, Any] | None) -> dict[str, str]:
    if check is None:
        return {"measured error": "not measured; 'stonepass surrogate check' measures it"}
    return {
        "cases that were not used": f"{check['cases']}, of which {check['same_outcome']} have the "
        "same outcome",
        "largest error of P_ucr": f"{100.0 * check['largest']:.2g} % or 10 Pa",
        "root-mean-square error": f"{100.0 * check['typical']:.2g} %",
        "within the claimed error": f"{100.0 * check['within']:.1f} %",
    }


def _span(bounds: tuple[float, float]) -> str:
    return f"{bounds[0]:g} to {bounds[1]:g}"
