"""The colours that a figure has in the dark theme, by those that it has in the light one."""

import re

from stonepass.report.style import COLOURS

GROUND = "#131416"  # of the dark theme
# Colours of the dark version by those of the light one; others are lightened as far as is needed.
DARK = {
    "#ffffff": GROUND,
    COLOURS["ink"].lower(): "#e5e7eb",
    COLOURS["grey"].lower(): "#9ca3af",
    COLOURS["stone"].lower(): "#5f594f",
    COLOURS["blue"].lower(): "#56b4e9",
    COLOURS["orange"].lower(): "#f0883e",
    COLOURS["green"].lower(): "#2fb592",
    COLOURS["pink"].lower(): "#e07fb8",
    "#e7b9a5": "#8a5a48",  # the wall in the diagram of symbols
    "#eef2f7": "#1f2937",  # the boxes of the map of the packages
}
LEAST_CONTRAST = 3.0  # of a line against the ground
STEP = 8  # by which a colour is lightened at a time, of 255
COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b")


def dark(svg):
    """Return a figure for the dark theme: the same drawing in other colours."""
    return COLOUR.sub(lambda found: dark_colour(found.group().lower()), svg)


def dark_colour(colour):
    """Return what ``#rrggbb`` becomes on the dark ground."""
    if colour in DARK:
        return DARK[colour]
    while contrast(colour, GROUND) < LEAST_CONTRAST:
        colour = "#" + "".join(f"{min(255, part + STEP):02x}" for part in parts_of(colour))
    return colour


def parts_of(colour):
    """Return red, green and blue of ``#rrggbb``, 0 to 255."""
    return [int(colour[k : k + 2], 16) for k in (1, 3, 5)]


def luminance(colour):
    """Return the relative luminance of ``#rrggbb``, 0 to 1 (WCAG 2)."""
    parts = [part / 255.0 for part in parts_of(colour)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    """Return the ratio of contrast of two colours, 1 to 21 (WCAG 2)."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)
