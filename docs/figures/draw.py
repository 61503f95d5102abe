"""Draw the diagrams of the documentation: ``draw.py`` writes the SVG files beside it."""

import math
import tomllib
from pathlib import Path

FOLDER = Path(__file__).parent
PROJECT = FOLDER.parents[1] / "pyproject.toml"
HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
    'font-family="DejaVu Sans, Verdana, sans-serif" font-size="15">\n'
    '<rect width="{width}" height="{height}" rx="6" fill="#ffffff"/>\n'
)
# The colours of stonepass.report.style, of which the site makes those of the dark theme.
INK, WALL, STONE, FLUID, SOFT = "#1F2937", "#E7B9A5", "#D6CFC4", "#0072B2", "#6B7280"
CONTACT = "#D55E00"

# The diagram of symbols, in inner radii; z points downstream, to the right.
UNIT, CENTRE = 82.0, (430.0, 225.0)
ENDS = (-4.6, 4.6)
STONE_RADIUS, WALL_RATIO, UPSTREAM_RADIUS = 1.35, 1.4, 1.17
OPENED, SEATED = math.radians(72.0), math.radians(55.0)  # α upstream, α₀ downstream


def point(z, r):
    """Return where a place of the section is in the picture."""
    return CENTRE[0] + UNIT * z, CENTRE[1] - UNIT * r


def path(points, **style):
    """Return a line through points of the section."""
    places = " ".join(f"{x:.1f},{y:.1f}" for x, y in (point(*each) for each in points))
    return f'<polyline points="{places}" {_written(style)}/>\n'


def arrow(start, end, colour=INK, both=False):
    """Return an arrow between two places of the section."""
    (x1, y1), (x2, y2) = point(*start), point(*end)
    angle = math.atan2(y2 - y1, x2 - x1)
    line = f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>\n'
    heads = _head(x2, y2, angle, colour)
    return line + heads + (_head(x1, y1, angle + math.pi, colour) if both else "")


def _head(x, y, angle, colour):
    corners = [(x, y)] + [
        (x - 9 * math.cos(angle + turn), y - 9 * math.sin(angle + turn)) for turn in (-0.35, 0.35)
    ]
    places = " ".join(f"{a:.1f},{b:.1f}" for a, b in corners)
    return f'<polygon points="{places}" fill="{colour}"/>\n'


def label(text, z, r, colour=INK, anchor="middle", size=15):
    """Return a label; what follows an underscore is a subscript."""
    x, y = point(z, r)
    symbol, _, below = text.partition("_")
    if below:
        below = f'<tspan dy="4" font-size="{0.72 * size:.0f}" font-style="normal">{below}</tspan>'
    style = ' font-style="italic"' if below or len(symbol) == 1 else ""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}" '
        f'font-size="{size}"{style}>{symbol}{below}</text>\n'
    )


def _written(style):
    return " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())


def inner_wall():
    """Return the inner wall: on the stone within the contact, and back to the tube beyond it."""
    first, last = math.pi - OPENED, SEATED
    z1, r1 = STONE_RADIUS * math.cos(first), STONE_RADIUS * math.sin(first)
    z2, r2 = STONE_RADIUS * math.cos(last), STONE_RADIUS * math.sin(last)
    before, after = (-z1 / r1) / (r1 - UPSTREAM_RADIUS), (z2 / r2) / (r2 - 1.0)
    places = []
    for step in range(81):
        z = ENDS[0] + (z1 - ENDS[0]) * step / 80
        places.append((z, UPSTREAM_RADIUS + (r1 - UPSTREAM_RADIUS) * math.exp(before * (z - z1))))
    for step in range(1, 40):
        angle = first + (last - first) * step / 40
        places.append((STONE_RADIUS * math.cos(angle), STONE_RADIUS * math.sin(angle)))
    for step in range(81):
        z = z2 + (ENDS[1] - z2) * step / 80
        places.append((z, 1.0 + (r2 - 1.0) * math.exp(-after * (z - z2))))
    return places


def symbols():
    """Return the section of a ureter with a stone, and the symbols of the theory page."""
    inner = inner_wall()
    outer = [(z, math.sqrt(r**2 + WALL_RATIO**2 - 1.0)) for z, r in inner]
    x, y = CENTRE
    text = HEAD.format(width=860, height=480)
    for side in (1.0, -1.0):
        ring = [(z, side * r) for z, r in inner] + [(z, side * r) for z, r in outer[::-1]]
        text += path(ring, fill=WALL, stroke=INK, stroke_width=1.2)
    text += f'<circle cx="{x}" cy="{y}" r="{UNIT * STONE_RADIUS}" fill="{STONE}" stroke="{INK}"/>\n'
    text += path([(-5.1, 0.0), (5.1, 0.0)], stroke=SOFT, stroke_dasharray="9 4 2 4")
    return text + _angles() + _lengths() + _pressures() + "</svg>\n"


def _angles():
    text = ""
    for angle, name, radius in ((OPENED, "α", 0.62), (math.radians(118.0), "θ", 0.36)):
        end = (-STONE_RADIUS * math.cos(angle), STONE_RADIUS * math.sin(angle))
        text += path([(0.0, 0.0), end], stroke=INK, stroke_width=1.0)
        arc = [math.radians(0.0) + angle * step / 24 for step in range(25)]
        text += path(
            [(-radius * math.cos(each), radius * math.sin(each)) for each in arc],
            fill="none",
            stroke=INK,
        )
        middle = 0.45 * angle
        text += label(name, -(radius + 0.1) * math.cos(middle), (radius + 0.1) * math.sin(middle))
    end = (STONE_RADIUS * math.cos(SEATED), -STONE_RADIUS * math.sin(SEATED))
    text += path([(0.0, 0.0), end], stroke=INK, stroke_dasharray="3 3")
    arc = [SEATED * step / 16 for step in range(17)]
    text += path(
        [(0.7 * math.cos(each), -0.7 * math.sin(each)) for each in arc], fill="none", stroke=INK
    )
    return text + label("α_0", 0.86, -0.48)


def _lengths():
    text = arrow((0.0, 0.0), (0.0, -STONE_RADIUS), both=False) + label("R_s", -0.2, -0.8)
    text += arrow((-4.2, 0.0), (-4.2, UPSTREAM_RADIUS)) + label("r_a", -4.0, 0.5)
    text += arrow((3.6, 0.0), (3.6, 1.0)) + label("R_a", 3.85, 0.45)
    text += arrow((4.3, 0.0), (4.3, WALL_RATIO)) + label("R_b", 4.55, 0.45)
    text += arrow((4.5, -2.35), (5.05, -2.35)) + label("z", 4.95, -2.6)
    text += label("downstream", 4.35, -2.41, anchor="end", size=13)
    return text + label("upstream", -4.6, -2.41, anchor="start", size=13)


def _pressures():
    text = label("P_u", -2.75, -0.42, FLUID, size=18)
    for r in (0.75, 0.25, -0.25, -0.75):
        text += arrow((-2.4, r), (-1.75, r), FLUID)
    text += label("urine", -3.4, -0.42, FLUID, size=13)
    for z in (-3.2, 2.2):
        text += arrow((z, 2.3), (z, 1.75), SOFT) + arrow((z, -2.3), (z, -1.75), SOFT)
    text += label("P_out", 2.65, 2.1, SOFT, size=16)
    for degrees in (62.0, 80.0, 98.0, 116.0):
        angle = math.radians(degrees)
        ends = [(f * math.cos(angle), f * math.sin(angle)) for f in (1.64, STONE_RADIUS + 0.02)]
        text += arrow(*ends, CONTACT)
    return (
        text
        + label("σ", 0.0, 1.85, CONTACT, size=18)
        + label("stone", 0.62, 0.35, size=13)
        + label("wall", -3.6, 1.32, size=13)
    )


MEANINGS = {
    "__main__": "python -m stonepass",
    "cli": "command line: one sub-command per file",
    "web": "HTTP API and page in the browser",
    "paper": "the published figures and claims",
    "report": "figures, tables, HTML",
    "records": "results as typed, versioned records",
    "bench": "laboratory: constants from tests",
    "clinic": "patients: assessment, cohorts",
    "studies": "many cases: jobs, executors, solution cache",
    "surface": "micrograph → friction",
    "export": "writers for other programs",
    "inputs": "case files, material and shape files",
    "model": "the physics of one case",
    "fe": "finite elements (NGSolve)",
    "materials": "wall laws, registry, stability",
    "sandbox": "untrusted files, in a child process",
    "io": "CSV, TOML and text files",
    "declaration": "every input, declared once",
    "units": "text with units to SI numbers",
    "errors": "refusals and outcomes",
    "about": "version and disclaimer",
    "strain": "Cauchy–Green tensor",
    "caution": "warnings as data",
    "array_dataclass": "== of values with arrays",
    "result": "printing, tables, plots",
    "array_types": "shapes of arrays",
}


def layers():
    """Return the map of the packages: the layers of pyproject.toml, the uppermost first."""
    with PROJECT.open("rb") as file:
        contract = tomllib.load(file)["tool"]["importlinter"]["contracts"][0]
    rows = [[name.strip() for name in layer.split("|")] for layer in contract["layers"]]
    height, width = 48, 860
    text = HEAD.format(width=width, height=len(rows) * height + 16)
    for index, names in enumerate(rows):
        wide = (width - 16) / len(names)
        for place, name in enumerate(names):
            text += _box(8 + place * wide, 8 + index * height, wide, height, name, len(names))
    return text + "</svg>\n"


def _box(x, y, wide, high, name, neighbours):
    middle = x + wide / 2
    text = (
        f'<rect x="{x + 3:.1f}" y="{y + 3}" width="{wide - 6:.1f}" height="{high - 6}" rx="4" '
        f'fill="#EEF2F7" stroke="{SOFT}"/>\n'
        f'<text x="{middle:.1f}" y="{y + 21}" text-anchor="middle" font-weight="bold" '
        f'font-size="14" fill="{INK}">{name}</text>\n'
    )
    meaning, size = MEANINGS.get(name, ""), 12 if neighbours < 4 else 9
    return text + (
        f'<text x="{middle:.1f}" y="{y + 37}" text-anchor="middle" font-size="{size}" '
        f'fill="{INK}">{meaning}</text>\n'
    )


DRAWINGS = {"symbols.svg": symbols, "layers.svg": layers}


def main():
    """Write every drawing beside this script."""
    for name, drawn in DRAWINGS.items():
        (FOLDER / name).write_text(drawn(), encoding="utf-8")


if __name__ == "__main__":
    main()
