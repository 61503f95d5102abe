"""The fractions of the time of a solve, measured by a profiler."""

from __future__ import annotations

import cProfile
import os
import pstats

from cases import tube

import stonepass as sp

REPEATS = 5
# The functions of each phase, by the ends of their names in the profiler's output.
PHASES = {
    "tangent: assembly and condensation": ("ngsolve.comp.AssembleLinearization",),
    "tangent: factorisation": ("ngsolve.la.Inverse", "ngsolve.la.Update"),
    "residual": ("ngsolve.comp.Apply",),
    "back substitution": ("systems.py:solve",),
    "set-up of meshes, spaces and forms": (
        "discretisation.py:discretise",
        "contact_predictor.py:_form",
        "loading_path.py:_form",
        "active_set.py:_form",
        "fitted_contact.py:_form",
    ),
    "stability of the solved wall": ("stability.py:stability_of",),
}


def phases() -> dict[str, dict[str, str]]:
    """Return the fraction of the time by case and phase; the last entry is seconds per solve."""
    cases = {
        "frictionless latex, η 1.5, ξ 1.2": tube("frictionless", "latex", 1.5, 1.2),
        "frictionless ureter, η 1.3, ξ 1.21": tube("frictionless", "ureter", 1.3, 1.21),
        "pressed latex, η 1.5, ξ 1.2": tube("pressed", "latex", 1.5, 1.2),
        "pressed ureter, η 1.3, ξ 1.21": tube("pressed", "ureter", 1.3, 1.21),
    }
    return {what: shares(lambda case=case: sp.solve(case)) for what, case in cases.items()}


def shares(call) -> dict[str, str]:
    """Return the fraction of each phase and of the rest, and seconds per call with the profiler."""
    call()
    profiler = cProfile.Profile()
    profiler.enable()
    for _ in range(REPEATS):
        call()
    profiler.disable()
    table = pstats.Stats(profiler).stats
    total = sum(own for _, _, own, _, _ in table.values())
    found = {phase: cumulated(table, names) / total for phase, names in PHASES.items()}
    found["everything else"] = 1.0 - sum(found.values())
    row = {phase: f"{share:.0%}" for phase, share in found.items()}
    row["**seconds per solve**, profiler included"] = f"{total / REPEATS:.2f}"
    return row


def cumulated(table, names: tuple[str, ...]) -> float:
    """Return the seconds in functions of these names, including the functions that they call."""
    return sum(
        inclusive
        for (file, _, function), (_, _, _, inclusive, _) in table.items()
        if f"{os.path.basename(file)}:{function.strip('<>').split()[-1]}".endswith(names)
    )
