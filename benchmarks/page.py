"""The page of the benchmark in the documentation, made from its JSON."""

from __future__ import annotations

from typing import Any

HEAD = """# Benchmark

`make bench` writes this page. All numbers come from one run on one machine, with one thread for
each solve. Ratios compare processor times of the same run. The file
[data/benchmark.json](data/benchmark.json) has the same numbers. The page [Computing time](speed.md)
explains what reduced the times, and [Export to other programs](export.md) describes the deck."""


def page(found: dict[str, Any], sections: dict[str, str]) -> str:
    """Return the page as Markdown."""
    machine = ", ".join(f"{name} {value}" for name, value in found["machine"].items())
    parts = [HEAD, f"*{found['date']}, code {found['code']}; {machine}.*"]
    if found["resumed"]:
        parts.append(
            "The run was interrupted and resumed on the same machine: the processor times of "
            f"{found['resumed']} decks of CalculiX were measured before the interruption."
        )
    for section, title in sections.items():
        rows = [row for row in found["rows"] if row["section"] == section]
        parts.append(f"## {title}")
        if section == "peers":
            parts += [_about_peers(), _beside(found["beside"])]
        if section == "duels":
            parts += [_about_duels(found["settings"]), _duels(found["duels"])]
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
        "accuracies, with and without the estimate of the discretisation error, which needs a "
        "second, coarser solve. CalculiX has no such estimate. It solves the exported deck, with "
        "elements of 0.025 R_a in the contact, ν 0.499 and penalty contact. The errors are "
        "differences to the accuracy `reference` of stonepass; those of CalculiX come from its "
        "penalty, its ν and its mesh. P_ucr is computed from each contact by the balance of the "
        "paper.\n\n"
        "The time of stonepass is the median processor time of seven calls in a running process. "
        "The time of CalculiX is the processor time of one run. Two lengths of the increments were "
        "tried, once and twice that of the deck, and the longer one that converged counts. A "
        "single command of stonepass also has to load its libraries: the last rows of the table "
        "compare whole commands. A target applies to the fastest solve of stonepass whose three "
        "errors are no larger than those of CalculiX."
    )


def _about_duels(settings: dict[str, list[Any]]) -> str:
    grid = "; ".join(f"{name} {', '.join(map(str, values))}" for name, values in settings.items())
    return (
        "The exported deck is designed to converge for every case. A deck that is tuned to one "
        "case is faster: it has fewer rows, a coarser stone and larger increments. For the first "
        f"case every deck of a grid was run ({grid}), and the fastest of them were run for the "
        "other cases. A deck is accepted if α₀ is within 0.5°, σ(90°) within 2 % and P_ucr within "
        "1 % of the reference of stonepass. The table has the fastest accepted deck of each case. "
        "Ratios are given for solves of stonepass whose three errors are no larger than those of "
        "the deck."
    )


def _duels(rows: list[dict[str, Any]]) -> str:
    header = ["case", "seating", "fastest accepted deck", "accepted", "CPU s", "error of α₀",
              "of σ(90°)", "of P_ucr", "over `fast`, state alone", "`fast`",
              "`standard`"]  # fmt: skip
    cells = []
    for row in rows:
        ratio = {name: f"{value:.0f} ×" for name, value in row["ratios"].items()}
        mine = (ratio.get(f"stonepass, {who}", "–")
                for who in ("fast, state alone", "fast", "standard"))  # fmt: skip
        cells.append([
            row["case"], row["seating"], row["settings"],
            f"{row['decks_near_enough']} of {row['decks_run']}", f"{row['cpu_s']:.1f}",
            f"{row['contact_angle_error_deg']:.2f}°", f"{row['equator_pressure_error']:.2%}",
            f"{row['critical_pressure_error']:.2%}", *mine,
        ])  # fmt: skip
    return table(header, cells)


def _about_scaling() -> str:
    return (
        "Seated states are solved on meshes of increasing fineness, with the same increments of "
        "the path. The exponent is the slope of a line through all points of log time over log "
        "unknowns."
    )


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
