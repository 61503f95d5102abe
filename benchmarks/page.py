"""The benchmark's page in the docs, from its JSON."""

from __future__ import annotations

from typing import Any

HEAD = """# Benchmark

Written by `make bench`. One run on one machine, one thread for each solve; ratios are of processor
time within the run. The same numbers as JSON: [data/benchmark.json](data/benchmark.json). What was
made faster, and how: [speed.md](speed.md). What the deck is: [export.md](export.md)."""


def page(found: dict[str, Any], sections: dict[str, str]) -> str:
    """Markdown of everything."""
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
        "By the profiler, on one core, error estimate included.",
        table(["", *columns], [[p, *(column[p] for column in columns.values())] for p in phases]),
    ]
    return "\n\n".join(parts) + "\n"


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def _about_peers() -> str:
    return (
        "The latex tube, η 1.5, ξ 1.2, friction 0.475, solved by us at two accuracies, the state "
        "alone and with the estimate of its error (a second, coarser solve, which CalculiX does "
        "not have), and by CalculiX from the exported deck (elements of 0.025 R_a in the contact, "
        "ν 0.499, penalty contact). Errors are against our `reference` accuracy; CalculiX's are "
        "those of its penalty, its ν and its mesh. P_ucr is the paper's balance on each contact."
        "\n\n"
        "Ours is the processor time of a call in a running process, median of seven; CalculiX's is "
        "that of its process, once, with the longer increments of two and one times the deck's own "
        "that converged. A single cold answer costs our imports too: the rows at the end of the "
        "table compare whole commands. A target stands at the cheapest of ours whose three errors "
        "are no larger than CalculiX's."
    )


def _about_duels(settings: dict[str, list[Any]]) -> str:
    grid = "; ".join(f"{name} {', '.join(map(str, values))}" for name, values in settings.items())
    return (
        "The exported deck is made to converge for every case. A deck that is tuned for one case "
        "is cheaper: fewer rows, a coarser stone, larger increments. For the first case every deck "
        f"of a grid was run ({grid}), and its cheapest ones on the other cases. A deck counts "
        "where α₀ is within 0.5°, σ(90°) within 2 % and P_ucr within 1 % of our reference; the "
        "cheapest that does stands here. The ratios are of those of ours whose three errors are no "
        "larger than its own."
    )


def _duels(rows: list[dict[str, Any]]) -> str:
    header = ["case", "seating", "cheapest deck", "decks near enough", "CPU s", "error of α₀",
              "of σ(90°)", "of P_ucr", "over ours, fast alone", "fast", "standard"]  # fmt: skip
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
        "Seated states on finer and finer meshes of the same kind, increments of the path kept; "
        "the power is that of a line through all points of log time over log unknowns."
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
