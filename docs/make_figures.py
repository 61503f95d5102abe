"""Draw the figures of the documentation: ``make_figures.py [NAME ...]``, or ``--check``.

Each figure is drawn by a public command into docs/img, as SVG; the site makes its dark version. The
manifest beside the figures keeps a digest of all that each was drawn by and from: the command, its
input files, the code that draws, and the version of the numbers. ``--check`` recomputes the digests
without drawing and names the figures that are out of date; a test does the same. Some figures need
other programs: compare needs CalculiX (ccx), assess and page need chromium.
"""

import argparse
import csv
import hashlib
import inspect
import json
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from stonepass.cli import run
from stonepass.errors import Outcome
from stonepass.model.case import Case
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.paper import fig8, headline_report, published, seated_figures, sensitivity
from stonepass.report import (
    assess_figure,
    assess_page,
    balance,
    case_figure,
    case_line,
    closures_report,
    compare_report,
    curve_figure,
    fit_figure,
    friction_figure,
    html,
    invitro_figure,
    push_figure,
    revolve,
    rising_report,
    section,
    stone,
    style,
)
from stonepass.studies.closures import CLOSURES, ClosureComparison
from stonepass.studies.source_digest import NUMBERS, code_digest

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "img"
MANIFEST = IMAGES / "manifest.json"
SCREENSHOT = ("chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
              "--window-size=860,1250")  # fmt: skip
PAGE = sorted(
    path.relative_to(ROOT).as_posix()
    for ending in ("html", "css", "js")
    for path in (ROOT / "src" / "stonepass" / "web" / "page").rglob(f"*.{ending}")
)
WINDOW = {"width": 1280, "height": 1072}  # size of the picture of the page in the browser
EXAMPLE = ("--stone", "4.2mm", "--inner", "3.5mm", "--outer", "4.54mm")
TUBE = ("--eta", "1.5", "--xi", "1.2", "--material", "latex", "--friction", "0.475")
SECTIONS = (section, stone)


@dataclass(frozen=True)
class Figure:
    """One figure of the documentation.

    Attributes
    ----------
    command : tuple of str
        Arguments of ``stonepass``; ``OUT`` in them is the file to draw, or the folder of a paper.
    drawn_by : tuple
        Modules and functions that draw it; `style` and `case_line` belong to every figure.
    inputs : tuple of str
        Files that it is drawn from, from the root of the repository.
    made : str
        Name of the figure in the folder of a paper.
    before : tuple of commands
        Commands that write what the command reads.
    ending : {"svg", "gif", "png"}
        Of the file; "png" is a screenshot of the page that the command writes as ``PAGE`` or
        serves.
    """

    command: tuple[str, ...]
    drawn_by: tuple = ()
    inputs: tuple[str, ...] = ()
    made: str = ""
    before: tuple[tuple[str, ...], ...] = ()
    ending: str = "svg"


FIGURES = {
    "case": Figure(
        ("pressure", *EXAMPLE, "--figure", "OUT"), (case_figure, balance, *SECTIONS)
    ),
    "push": Figure(
        ("pressure", *EXAMPLE, "--model", "direct", "--figure", "OUT"), (push_figure, *SECTIONS)
    ),
    "rise": Figure(
        ("push", *TUBE, "--animation", "OUT"),
        (rising_report.animation_frames, rising_report._palette, push_figure, *SECTIONS),
        ending="gif",
    ),
    "fit": Figure(
        ("fit", "tensile", "examples/ureter_tensile.csv", "--law", "fung", "--fix", "G=12kPa",
         "--fix", "a1122=0.1856", "--figure", "OUT"),
        (fit_figure,),
        ("examples/ureter_tensile.csv",),
    ),
    "friction": Figure(
        ("friction", "examples/crystals.tif", "--crystal", "20um", "--figure", "OUT"),
        (friction_figure,),
        ("examples/crystals.tif",),
    ),
    "invitro": Figure(
        ("invitro", "examples/latex_series.csv", "--material", "latex", "--figure", "OUT"),
        (invitro_figure,),
        ("examples/latex_series.csv",),
    ),
    "headline": Figure(
        ("headline", "--figure", "OUT"),
        (headline_report.headline_figure, published, curve_figure),
    ),
    "compare": Figure(
        ("compare", *TUBE, "--results", "RESULTS", "--figure", "OUT"),
        (compare_report.compare_figure,),
        before=(("export", *TUBE, "--out", "DECK"),),
    ),
    "assess": Figure(
        ("assess", "examples/patient.toml", "--html", "PAGE"),
        (assess_figure, assess_page, html),
        ("examples/patient.toml",),
        ending="png",
    ),
    "page": Figure(("serve", "--port", "0", "--no-browser"), inputs=tuple(PAGE), ending="png"),
    "closures-ureter": Figure(
        (), (closures_report.map_figure, closures_report._draw_errors),
        ("docs/data/closures-ureter.csv",),
    ),
    "closures-latex": Figure(
        (), (closures_report.map_figure, closures_report._draw_errors),
        ("docs/data/closures-latex.csv",),
    ),
    "paper-fig4-3d": Figure(
        ("paper", "fig4", "--out", "OUT"), (revolve, section.add_colour_bar), made="fig4_3d.svg"
    ),
    "paper-fig7": Figure(
        ("paper", "fig7", "--out", "OUT"), (seated_figures, *SECTIONS), made="fig7.svg"
    ),
    "paper-fig8": Figure(("paper", "fig8", "--out", "OUT"), (fig8, published), made="fig8.svg"),
    "paper-sensitivity": Figure(
        ("paper", "sensitivity", "--out", "OUT"), (sensitivity, published), made="sensitivity.svg"
    ),
}  # fmt: skip


def digest(figure):
    """Return the digest of the command, the inputs, the code that draws, and the numbers' version.

    Docstrings and comments do not count.
    """
    code = (style, case_line, *figure.drawn_by)
    sources = [(each.__name__.encode(), inspect.getsource(each).encode()) for each in code]
    files = [hashlib.sha256((ROOT / name).read_bytes()).hexdigest() for name in figure.inputs]
    parts = (*figure.command, *map(str, figure.before), figure.made, *files, str(NUMBERS))
    return hashlib.sha256("\0".join((*parts, code_digest(sources))).encode()).hexdigest()


def file_of(name):
    """Return the file of a figure."""
    return IMAGES / f"{name}.{FIGURES[name].ending}"


def entry(name):
    """Return what the manifest says of a figure: the digests of its origin and of its file."""
    drawn = hashlib.sha256(file_of(name).read_bytes()).hexdigest()
    return {"drawn_from": digest(FIGURES[name]), "file": drawn}


def stale():
    """Return the names of the figures whose files are missing, changed, or drawn by older code."""
    known = json.loads(MANIFEST.read_text(encoding="utf-8"))
    return [
        name for name in FIGURES if not file_of(name).is_file() or known.get(name) != entry(name)
    ]


def draw(name):
    """Draw a figure by its command."""
    figure = FIGURES[name]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / ("paper" if figure.made else file_of(name).name)
        if "serve" in figure.command:
            _draw_served(figure.command, out)
        elif figure.command:
            page = Path(folder) / "page.html"
            words = {
                "OUT": out,
                "PAGE": page,
                "DECK": f"{folder}/stone.inp",
                "RESULTS": f"{folder}/stone.dat",
            }
            for command in (*figure.before, figure.command):
                if run([str(words.get(word, word)) for word in command]) > 1:
                    raise SystemExit(f"{name}: the command failed")
                if "DECK" in command:
                    subprocess.run(["ccx", "stone"], cwd=folder, check=True, capture_output=True)
            if page.is_file():
                subprocess.run([*SCREENSHOT, f"--screenshot={out}", page.as_uri()], check=True,
                               capture_output=True)  # fmt: skip
        else:
            _draw_map(ROOT / figure.inputs[0], out)
        drawn = out / figure.made if figure.made else out
        shutil.copyfile(drawn, file_of(name))


def _draw_served(command, out):
    """Draw the page in the browser as it looks when it has been opened."""
    from playwright.sync_api import sync_playwright

    server = [sys.executable, "-m", "stonepass", *command]
    with subprocess.Popen(server, stdout=subprocess.PIPE, text=True) as process:
        try:
            address = process.stdout.readline().split()[2]
            with sync_playwright() as browsers:
                browser = browsers.chromium.launch(
                    executable_path=shutil.which(SCREENSHOT[0]), args=["--no-sandbox"]
                )
                page = browser.new_context(viewport=WINDOW).new_page()
                page.goto(address, wait_until="networkidle")
                page.wait_for_selector("html[data-answered]:not([data-waiting])", state="attached")
                page.screenshot(path=out)
                browser.close()
        finally:
            process.terminate()


def _draw_map(table, out):
    """Draw the map of closures from the table that ``stonepass closures --map --out`` wrote."""
    with table.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = []
    for row in rows:
        pressures = {name: row[f"{name}_pressure_kPa"] for name in CLOSURES}
        stone_ = Stone(size_ratio=float(row["size_ratio"]), friction=float(row["friction"]))
        ureter = Ureter(wall_ratio=float(row["wall_ratio"]), material=row["material"])
        known = {name: 1e3 * float(text) if text else None for name, text in pressures.items()}
        found.append(ClosureComparison(Case(stone_, ureter), known, Outcome[row["outcome"]], ""))
    style.save(closures_report.map_figure(found), out)


def main():
    """Draw the figures that are named, or those that are out of date."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all stale ones")
    parser.add_argument("--check", action="store_true", help="draw nothing; name what is stale")
    given = parser.parse_args()
    if unknown := sorted(set(given.names) - set(FIGURES)):
        parser.error(f"no figure is named {', '.join(unknown)}; known: {', '.join(FIGURES)}")
    outdated = stale()
    if given.check:
        print("\n".join(outdated) or "all figures are up to date")
        return 1 if outdated else 0
    for name in given.names or outdated:
        print(name, flush=True)
        draw(name)
        known = json.loads(MANIFEST.read_text(encoding="utf-8")) | {name: entry(name)}
        MANIFEST.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
