"""The documentation: its links, its drawings, its words, and what the code says of its pages."""

import csv
import importlib.util
import re
import tomllib
from pathlib import Path

import pytest

import stonepass
from stonepass.model.far_field import inflation

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
# Pages that people write; the runs of verification and benchmark, and the records, write the others.
WRITTEN_BY_RUNS = {"benchmark.md", "verification.md"}
PAGES = sorted(
    path
    for path in DOCS.rglob("*.md")
    if not {"_build", "generated"} & set(path.relative_to(DOCS).parts)
)
READ_FIRST = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
# Words of earlier versions that readers would have to learn, and the ones to use instead.
PRIVATE = {
    "scout": "contact predictor",
    "readout": "post-processing",
    "soundness": "stability report",
    "bearable": "maximum tolerable",
    "lopsided": "without mirror symmetry",
    "driver of": "sensitivity index",
    "ways in which": "simulated input combinations",
    "knows nothing of": "does not depend on",
}


def text_of(path):
    return path.read_text(encoding="utf-8")


def headings(path):
    """Titles of a page, without the lines of its code blocks."""
    prose = re.sub(r"^```.*?^```", "", text_of(path), flags=re.MULTILINE | re.DOTALL)
    return [title.strip().strip("`*") for title in re.findall(r"^#+ (.*)$", prose, re.MULTILINE)]


def slug(title):
    """Return the anchor that a code host makes of a title."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def script(name):
    spec = importlib.util.spec_from_file_location("script", DOCS / name)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def drawings():
    return script("figures/draw.py")


@pytest.mark.parametrize("name", ["symbols.svg", "layers.svg"])
def test_the_drawings_are_those_of_their_script(name):
    drawn = drawings().DRAWINGS[name]()
    assert text_of(DOCS / "figures" / name) == drawn, "write them again: docs/figures/draw.py"


def test_the_map_has_every_package():
    drawn = drawings().layers()
    packages = [path for path in Path(stonepass.__file__).parent.iterdir() if path.is_dir()]
    names = [path.name for path in packages if (path / "__init__.py").exists()]
    assert len(names) > 10
    for name in names:
        assert f">{name}</text>" in drawn


def test_the_code_names_sections_that_exist():
    """`docs/theory.md, "Far field"` or `"Far field" in docs/theory.md` in a docstring or comment."""
    found = 0
    for path in sorted(Path(stonepass.__file__).parent.rglob("*.py")):
        text = re.sub(r"\s*\n\s*(?:# ?)?", " ", text_of(path))
        after = re.findall(r"docs/([\w/-]+\.md), (?:section )?\"([^\"]+)\"", text)
        before = [(p, t) for t, p in re.findall(r"\"([^\"]+)\" in docs/([\w/-]+\.md)", text)]
        for page, title in after + before:
            found += 1
            assert title in headings(DOCS / page), f"{path.name}: {page} has no section {title!r}"
    assert found > 50


def test_links_lead_somewhere():
    """Files and anchors of relative links; the build of the site checks its own pages too."""
    found = 0
    for path in [*PAGES, *READ_FIRST]:
        for target in re.findall(r"\]\(([^)\s]+)\)", text_of(path)):
            if re.match(r"[a-z]+:", target) or "generated/" in target:
                continue
            found += 1
            name, _, anchor = target.partition("#")
            file = path if not name else path.parent / name
            assert file.exists(), f"{path.name}: {target}"
            if anchor and file.suffix == ".md":
                assert anchor in map(slug, headings(file)), f"{path.name}: {target}"
    assert found > 50


def test_the_pages_use_standard_words():
    assert len(PAGES) >= 15
    for path in [*PAGES, *READ_FIRST]:
        if path.name in WRITTEN_BY_RUNS:
            continue
        text = " ".join(text_of(path).lower().split())
        for word, better in PRIVATE.items():
            assert not re.search(rf"\b{word}\b", text), f"{path.name}: {word!r}; say {better!r}"


def test_the_citation_file_has_the_version_of_the_package():
    cited = text_of(ROOT / "CITATION.cff")
    project = tomllib.loads(text_of(ROOT / "pyproject.toml"))["project"]
    assert f"\nversion: {project['version']}\n" in cited
    assert project["version"] == stonepass.__version__


def test_the_pressures_above_the_end_of_the_closure_are_those_of_the_data():
    """The theory page gives the range of the direct pressure over P_u(r_a = R_s)."""
    law, over = stonepass.material("latex").law, []
    with (DOCS / "data" / "closures-latex.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["direct_pressure_kPa"] and not row["derived_pressure_kPa"]:
                end = inflation(float(row["size_ratio"]), float(row["wall_ratio"]), law)
                over.append(1e3 * float(row["direct_pressure_kPa"]) / float(end))
    found = (
        f"the {len(over)} latex cases .* at {min(over):.2f} to {max(over):.2f} times the pressure"
    )
    assert re.search(found, " ".join(text_of(DOCS / "theory.md").split()))


def test_the_readme_compares_stated_and_true_errors_as_the_verification_does():
    section = text_of(DOCS / "verification.md").split("<!-- error_estimates -->")[1]
    rows = re.findall(
        r"^\| (?:fast|standard|reference) (?:\|[^|\n]+){7,8}\|$", section, re.MULTILINE
    )
    numbers = [[cell.strip(" °") for cell in row.split("|")] for row in rows]
    ratios = [float(row[6]) / float(row[4]) for row in numbers]  # stated over true, both medians
    assert len(ratios) == 9
    found = f"stated error is {min(ratios):.0f} to {max(ratios):.0f} times the median true error"
    assert found in " ".join(text_of(ROOT / "README.md").split())


def test_the_glossary_is_sorted_and_its_words_are_in_use():
    table = text_of(DOCS / "glossary.md").split("## Outcomes")[0]
    terms = [line.split("|")[1].strip() for line in table.splitlines() if line.startswith("| ")]
    terms = [term for term in terms if term not in ("word", "---")]
    assert len(terms) > 40
    assert terms == sorted(terms, key=str.lower)
    elsewhere = " ".join(
        text_of(path)
        for path in [*PAGES, *READ_FIRST, *Path(stonepass.__file__).parent.rglob("*.py")]
        if path.name != "glossary.md"
    ).lower()
    elsewhere = " ".join(elsewhere.split())
    for term in (word for each in terms for word in each.split(", ")):
        assert term in elsewhere, f"{term!r} is in the glossary alone"


def test_the_page_of_case_files_has_the_keys_of_the_schema():
    module = script("write_reference.py")
    page = text_of(module.CASE_FILE)
    assert page == module.case_file_page(), "write it again: python docs/write_reference.py"
    assert page.count("\n| `") > 20
