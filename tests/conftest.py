"""Shapes and types in annotations are executed: jaxtyping and beartype, all numerical modules.

The doors (units, case, case_file, user_law) are left out: they refuse wrong types themselves, in
one sentence, and that is what their tests look at.
"""

import re
from functools import partial
from pathlib import Path

import jaxtyping
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
SHAPES = re.compile(r"\b(Float|Int|Bool|Shaped|Values)\b")
check_shapes = jaxtyping.jaxtyped


def unless_local_and_plain(function=None, *, typechecker=None):
    """Check a function, but not one made inside another that is annotated without any shape.

    The check is built each time such a function is made, a thousand times in one solve, which
    takes longer than the solve itself; its plain types are mypy's business.
    """
    if function is None:
        return partial(unless_local_and_plain, typechecker=typechecker)
    if "<locals>" in getattr(function, "__qualname__", ""):
        hints = getattr(function, "__annotations__", {}).values()
        if not any(SHAPES.search(str(hint)) for hint in hints):
            return function
    return check_shapes(function, typechecker=typechecker)


jaxtyping.jaxtyped = unless_local_and_plain  # what the hook puts on every function
hook = install_import_hook(CHECKED, "beartype.beartype")


def wrap_solver(monkeypatch, wrapper):
    """Replace each function of the uncached state solver by ``wrapper(name, function)``."""
    from stonepass.model.states.uncached import UNCACHED

    kind = type(UNCACHED)
    for name in [each for each in vars(kind) if not each.startswith("_")]:
        monkeypatch.setattr(kind, name, staticmethod(wrapper(name, getattr(UNCACHED, name))))


@pytest.fixture
def solved(monkeypatch):
    """Names of what was solved afresh."""
    found = []

    def counted(name, function):
        def called(*arguments, **keywords):
            found.append(name)
            return function(*arguments, **keywords)

        return called

    wrap_solver(monkeypatch, counted)
    return found


@pytest.fixture(scope="session")
def solutions_of_this_session():
    """What `shared_solutions` has solved so far, by the function and its arguments."""
    return {}


@pytest.fixture
def shared_solutions(request, monkeypatch, solutions_of_this_session):
    """A question that the finite elements have answered in this session is not solved again.

    For tests of the doors and of what is made of states, many of which ask for the same state.
    Tests of the solver and of the solution cache do without, so that they do solve; so does a
    test with the marker `afresh` in a module that uses this fixture.
    """
    if request.node.get_closest_marker("afresh"):
        return
    known = solutions_of_this_session

    def once(name, function):
        def answered(*arguments, **keywords):
            words = sorted(keywords.items())
            key = (name, *(tuple(a) if isinstance(a, list) else a for a in arguments), *words)
            if key not in known:
                known[key] = function(*arguments, **keywords)
            found = known[key]
            return list(found) if isinstance(found, list) else found

        return answered

    wrap_solver(monkeypatch, once)


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
