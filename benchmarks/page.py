"""The page of the benchmark in the documentation, made from its JSON."""

from __future__ import annotations

import math
from typing import Any

HEAD = """# Benchmark

`make bench` writes this page. All numbers come from one run on one machine, with one thread for
each solve. {interruption}Ratios compare processor times of the same run. The file
[data/benchmark.json](data/benchmark.json) has the same numbers. The page [Computing time](speed.md)
explains what reduced the times, and [Export to other programs](export.md) describes the deck."""
INTERRUPTION = """The run was interrupted and resumed on the same machine:
the processor times of {decks} decks of CalculiX are from before the interruption.
"""
# What the settings of a tuned deck are called on the page.
SETTINGS = {
    "element": "element",
    "fine": "element length in the contact in R_a",
    "rows": "rows through the wall",
    "stiffness": "contact stiffness in w″(1) divided by the element length",
    "increments": "smallest number of increments",
}
STAR = "\\*"  # a star that is no mark of emphasis
MINE = ("fast, state alone", "fast", "standard, state alone", "standard")


def page(found: dict[str, Any], sections: dict[str, str]) -> str:
    """Return the page as Markdown."""
    machine = ", ".join(f"{name} {value}" for name, value in found["machine"].items())
    resumed = INTERRUPTION.format(decks=found["resumed"]) if found["resumed"] else ""
    parts = [
        HEAD.format(interruption=resumed),
        f"*{found['date']}, code {found['code']}; {machine}.*",
    ]
    for section, title in sections.items():
        rows = [row for row in found["rows"] if row["section"] == section]
        parts.append(f"## {title}")
        if section == "peers":
            parts += [_about_peers(), _beside(found["beside"]), _ratios(rows)]
            continue
        if section == "duels":
            duels = found["duels"]
            parts += [_about_duels(found["settings"], duels), _duels(duels), _extremes(duels)]
            continue
        if section == "scaling":
            parts += [_about_scaling(), *(_growth(each) for each in found["scaling"])]
        parts.append(table(["", "measured", "target", ""], [_cells(row) for row in rows]))
    columns = found["phases"]
    phases = list(next(iter(columns.values())))
    parts += [
        "## Where the time goes",
        "The fractions are those of a profiler on one core. They include the error estimate.",
        table(["", *columns], [[p, *(column[p] for column in columns.values())] for p in phases]),
    ]
    return "\n\n".join(parts) + "\n"


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def _about_peers() -> str:
    return (
        "The case is a latex tube with η 1.5, ξ 1.2 and friction 0.475. stonepass solves it at two "
        "accuracies, with the estimate of the discretisation error, which needs a second, coarser "
        "solve, and without it (*state alone*). CalculiX has no such estimate. It solves the "
        "exported deck, with elements of 0.025 R_a in the contact, ν 0.499 and penalty contact. "
        "The errors are differences to the accuracy `reference` of stonepass; those of CalculiX "
        "come from its penalty, its ν and its mesh. P_ucr is computed from each contact by the "
        "balance of the paper.\n\n"
        "The time of stonepass is the median processor time of seven calls in a running process. "
        "The time of CalculiX is the processor time of one run. CalculiX was first run with "
        "increments twice as long as those of the deck, and with those of the deck if that run did "
        "not converge. A single command of stonepass also has to load its libraries: the rows "
        "*cold command* of the second table use the processor time of a whole command "
        f"(`--no-cache`). The mark {STAR} is on the fastest solve of stonepass whose three errors "
        "are no larger than those of CalculiX. Where there is a target, it applies to this row."
    )


def _about_duels(settings: dict[str, list[Any]], duels: list[dict[str, Any]]) -> str:
    count = math.prod(map(len, settings.values()))
    grid = ", ".join(
        f"{SETTINGS[name]} ({', '.join(str(value).removesuffix('.0') for value in values)})"
        for name, values in settings.items()
    )
    return (
        "The exported deck is designed to converge for every case. A deck that is tuned to one "
        f"case can be faster. For the first case {count} decks were run with each seating, which "
        f"differ in: {grid}. A deck is accepted if α₀ is within 0.5°, σ(90°) within 2 % and P_ucr "
        "within 1 % of the reference of stonepass. The four fastest accepted decks were then run "
        "for the other tubes. The table has the fastest accepted deck of each case." + _left(duels)
        + " For stonepass the table has the processor time and the ratio of the processor times "
        "(CalculiX / stonepass), for solves whose three errors are no larger than those of the "
        "deck. These solves were timed again for this table; the times differ from those above, "
        "because the machine is noisy ([Computing time](speed.md)). Without friction a solve with "
        "the error estimate can take less time than the state alone, because the finer solve then "
        "starts from the coarser one."
    )  # fmt: skip


def _left(duels: list[dict[str, Any]]) -> str:
    """Return a sentence about the cases without an accepted deck, or nothing."""
    there = [(row["case"], row["seating"]) for row in duels]
    seatings = dict.fromkeys(seating for _, seating in there)
    cases = dict.fromkeys(case for case, _ in there)
    left = [f"{c} ({s})" for s in seatings for c in cases if (c, s) not in there]
    return f" No deck was accepted for {' and '.join(left)}." if left else ""


def _duels(rows: list[dict[str, Any]]) -> str:
    header = ["case", "seating", "fastest accepted deck", "accepted", "CPU s", "error of α₀",
              "of σ(90°)", "of P_ucr", *(_accuracy(who) for who in MINE)]  # fmt: skip
    cells = []
    for row in rows:
        mine = []
        for who in (f"stonepass, {each}" for each in MINE):
            ratio = row["ratios"].get(who)
            mine.append("–" if ratio is None else f"{row['ours_cpu_s'][who]:.2f} s, {ratio:.0f} ×")
        cells.append([
            row["case"], row["seating"], row["settings"],
            f"{row['decks_near_enough']} of {row['decks_run']}", f"{row['cpu_s']:.1f}",
            f"{row['contact_angle_error_deg']:.2f}°", f"{row['equator_pressure_error']:.2%}",
            f"{row['critical_pressure_error']:.2%}", *mine,
        ])  # fmt: skip
    return table(header, cells)


def _accuracy(who: str) -> str:
    level, *alone = who.split(", ")
    return ", ".join([f"`{level}`", *alone])


def _extremes(duels: list[dict[str, Any]]) -> str:
    """Return the smallest and the largest ratio by seating, with and without error estimate."""
    header = ["seating", "error estimate", "smallest ratio", "case, accuracy", "largest ratio",
              "case, accuracy"]  # fmt: skip
    cells = []
    for seating in dict.fromkeys(row["seating"] for row in duels):
        for estimate in ("no", "yes"):
            ratios = [
                (ratio, f"{row['case']}; `{who.split(', ')[1]}`")
                for row in duels
                if row["seating"] == seating
                for who, ratio in row["ratios"].items()
                if ("state alone" in who) is (estimate == "no")
            ]
            if ratios:
                ends = [(f"{ratio:.3g} ×", what) for ratio, what in (min(ratios), max(ratios))]
                cells.append([seating, estimate, *ends[0], *ends[1]])
    return table(header, cells)


def _about_scaling() -> str:
    return (
        "Seated states are solved on meshes of increasing fineness, with the same increments of "
        "the path. The exponent is the slope of a straight line fitted to log(time) as a function "
        "of log(unknowns)."
    )


def _ratios(rows: list[dict[str, Any]]) -> str:
    """Return the table of ratios; the name of each has four parts, see `peers.ratios`."""
    header = ["seating", "element of CalculiX", "accuracy of stonepass", "error estimate",
              "CPU s of CalculiX / stonepass", "target", ""]  # fmt: skip
    cells = []
    for row in rows:
        what, *numbers = _cells(row)
        marked = what.endswith(" *")
        seating, element, accuracy, estimate = what.removesuffix(" *").split(" | ")
        accuracy += f" {STAR}" if marked else ""
        cells.append([seating, element, accuracy, estimate, *numbers])
    return table(header, cells)


def _beside(rows: list[dict[str, Any]]) -> str:
    header = ["seating", "", "CPU s", "error of α₀", "of σ(90°)", "of P_ucr"]
    errors = ("contact_angle_error_deg", "equator_pressure_error", "critical_pressure_error")
    cells = []
    for row in rows:
        angle, sigma, critical = (row[name] for name in errors)
        cells.append([row["seating"], row["who"], f"{row['cpu_s']:.2f}", f"{angle:.3f}°",
                      f"{sigma:.3%}", f"{critical:.3%}"])  # fmt: skip
    return table(header, cells)


def _growth(each: dict[str, Any]) -> str:
    header = ["unknowns", *(f"{n}" for n in each["dofs"])]
    return f"{each['what']}:\n\n" + table(header, [["CPU s", *(f"{s:.2f}" for s in each["cpu_s"])]])


def _cells(row: dict[str, Any]) -> list[str]:
    bound = "≥" if row["at_least"] else "≤"
    target = "" if row["target"] is None else f"{bound} {row['target']:g} {row['unit']}"
    mark = {True: "met", False: "**missed**", None: ""}[row["met"]]
    return [row["what"], f"{row['value']:.3g} {row['unit']}", target, mark]
