"""Shapes and types in annotations are checked at run time, in all numerical modules.

The doors are left out: they refuse wrong types themselves with a sentence, which their tests read.
`test_annotations.py` counts the modules.
"""

import functools
import os
from contextlib import contextmanager
from pathlib import Path

import first_call
import pytest
from jaxtyping import install_import_hook
from page_browser import browser, open_page, page, server, watched  # noqa: F401

SOURCE = Path(__file__).parents[1] / "src"
# Packages whose modules are checked.
NUMERICAL = (
    "fe", "materials", "model", "studies", "surface", "bench", "clinic", "export", "records",
    "report", "paper",
)  # fmt: skip
# Modules that are not checked, each with the reason.
DOORS = {
    **dict.fromkeys(
        [f"stonepass.model.{name}" for name in ("stone", "ureter", "load", "numerics", "case")]
        + [
            f"stonepass.model.models.{name}"
            for name in ("seated_balance", "push_through", "elastic_foundation")
        ],
        "the constructors of values refuse wrong types with a sentence",
    ),
    **dict.fromkeys(
        [
            "stonepass.model.problem",
            "stonepass.model.critical",
            "stonepass.model.size",
            "stonepass.studies.curve",
        ],
        "public questions refuse arguments in a wrong order with a sentence",
    ),
    "stonepass.bench.test_files": "readers refuse a size without its unit with a sentence",
    "stonepass.materials.protocol": "the constructor of a material refuses a law with a sentence",
    "stonepass.materials.user_law": "a user's function may return anything; refused with a sentence",
}


def numerical_modules():
    """Names of all modules of the numerical packages, and of others with arrays; doors included."""
    root = SOURCE / "stonepass"
    found = []
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(SOURCE).with_suffix("").parts
        arrays = "stonepass.array_types" in path.read_text(encoding="utf-8")
        if path.name != "__init__.py" and len(name) > 2 and (name[1] in NUMERICAL or arrays):
            found.append(".".join(name))
    return found


first_call.install()
install_import_hook([m for m in numerical_modules() if m not in DOORS], "first_call.checked")


def pytest_collection_modifyitems(items):
    """A browser is another program, so its tests are run by `make test-all`.

    The longest tests begin first, so that the other processes do not wait for them at the end.
    """
    for each in items:
        if "browser" in each.fixturenames:
            each.add_marker("slow")
    items.sort(key=lambda each: each.get_closest_marker("longest") is None)


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
def solutions_of_this_run(tmp_path_factory):
    """Solution cache of all processes of this run, and what this process has asked it for."""
    from stonepass.studies.solution_cache import SolutionCache

    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # that of the run; each worker's own is below it
    return SolutionCache(folder / "solutions", walls=True), {}


@pytest.fixture(autouse=True, scope="session")
def cache_of_this_run(tmp_path_factory):
    """The commands remember states in a folder of this run, not in that of the user."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("STONEPASS_CACHE", str(folder / "cache"))
        yield


@pytest.fixture(autouse=True, scope="session")
def sources_parsed_once():
    """The source code is parsed once in this process, not once for each folder of a cache."""
    from stonepass.studies import source_digest

    parse, known = source_digest.code_digest, {}

    @functools.wraps(parse)
    def code_digest(files):
        files = tuple(files)
        if files not in known:
            known[files] = parse(files)
        return known[files]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(source_digest, "code_digest", code_digest)
        yield


@contextmanager
def sharing(solutions):
    """Within this context no question is solved again that was solved in this run."""
    cache, known = solutions
    asking_cache = []

    def once(name, function):
        def answered(*arguments, **keywords):
            if asking_cache:  # which solves what it does not hold
                return function(*arguments, **keywords)
            words = sorted(keywords.items())
            key = (name, *(tuple(a) if isinstance(a, list) else a for a in arguments), *words)
            if key not in known:
                asking_cache.append(name)
                try:
                    known[key] = getattr(cache, name)(*arguments, **keywords)
                finally:
                    asking_cache.clear()
            found = known[key]
            return list(found) if isinstance(found, list) else found

        return answered

    with pytest.MonkeyPatch.context() as patch:
        wrap_solver(patch, once)
        yield


@pytest.fixture
def shared_solutions(request, solutions_of_this_run):
    """A question that the finite elements have answered in this run is not solved again.

    For tests of the doors and of what is made of states, many of which ask for the same state.
    Tests of the solver and of the solution cache do without, so that they do solve; so does a
    test with the marker `afresh` in a module that uses this fixture.
    """
    if request.node.get_closest_marker("afresh"):
        yield
        return
    with sharing(solutions_of_this_run):
        yield


@pytest.fixture(scope="session")
def with_shared_solutions(solutions_of_this_run):
    """A function that returns a context for the fixtures of modules, like `shared_solutions`."""
    return lambda: sharing(solutions_of_this_run)
