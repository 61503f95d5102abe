"""Shapes and types in annotations are executed: jaxtyping and beartype, all numerical modules.

The doors (units, case, case_file, user_law) are left out: they refuse wrong types themselves, in
one sentence, and that is what their tests look at.
"""

from pathlib import Path

import pytest
from jaxtyping import install_import_hook

CHECKED = [
    "stonepass.fe",
    "stonepass.materials.derivatives",
    "stonepass.materials.fung",
    "stonepass.materials.neo_hookean",
    "stonepass.materials.stability",
    *(
        f"stonepass.model.{name}"
        for name in ("balance", "closure", "critical", "far_field", "seated", "size")
    ),
    "stonepass.studies",
    "stonepass.report",
]
hook = install_import_hook(CHECKED, "beartype.beartype")


@pytest.fixture(scope="session", autouse=True)
def cache_of_the_tests(tmp_path_factory):
    """Commands remember results for this run of the tests only, not among the user's own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("STONEPASS_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture
def solved(monkeypatch):
    """Names of what was solved afresh."""
    from stonepass.model.states.uncached import UNCACHED

    found = []
    for name in ("seat", "push", "hold", "opening_curve"):
        original = getattr(UNCACHED, name)

        def called(*arguments, _name=name, _original=original, **keywords):
            found.append(_name)
            return _original(*arguments, **keywords)

        monkeypatch.setattr(type(UNCACHED), name, staticmethod(called))
    return found


@pytest.fixture
def undocumented():
    """A function that lists the keys of a record which the glossary does not name."""
    glossary = Path(__file__).parents[1] / "docs" / "glossary.md"
    text = glossary.read_text(encoding="utf-8")

    def missing(record):
        found = []
        if isinstance(record, list):
            return [key for each in record for key in missing(each)]
        if isinstance(record, dict):
            for key, value in record.items():
                found += [] if f"`{key}`" in text else [key]
                # Their keys are names of inputs, constants, outcomes.
                if key not in ("sensitivity", "without_answer", "law_constants", "correlations"):
                    found += missing(
                        list(value.values())
                        if key == "measured" and isinstance(value, dict)
                        else value
                    )
        return found

    return missing
