"""The greeting of ``stonepass`` without arguments: three commands to begin with."""

from __future__ import annotations

from stonepass.about import DISCLAIMER, VERSION

__all__ = ["BEGINNINGS", "greeting"]

# Commands without the name of the program, and the question that each of them answers.
BEGINNINGS = (
    (
        "pressure --stone 4.2mm --inner 3.5mm --outer 4.55mm",
        "At what urine pressure does this stone start to move?",
    ),
    (
        "size --inner 3.5mm --outer 4.55mm --limit 12kPa",
        "What is the largest stone that moves at this urine pressure?",
    ),
    (
        "curve --eta 1.3 --xi 1:1.3:0.05 --figure curve.svg",
        "How does the critical pressure grow with the size of the stone?",
    ),
)


def greeting() -> str:
    """Return the greeting."""
    lines = [f"stonepass {VERSION}: when does a kidney stone move in a ureter?", ""]
    for command, question in BEGINNINGS:
        lines += [f"  {question}", f"    stonepass {command}", ""]
    return "\n".join(
        [
            *lines,
            "'stonepass --help' lists all commands, 'stonepass COMMAND --help' explains one.",
            DISCLAIMER,
        ]
    )
