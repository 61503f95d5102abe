"""What is imported, when and by whom: budgets of the doors, no circles, nothing changed by it."""

import ast
import json
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import stonepass

ROOT = Path(stonepass.__file__).parent
MODULES = {
    ".".join(("stonepass", *path.relative_to(ROOT).with_suffix("").parts)).removesuffix(
        ".__init__"
    ): path
    for path in sorted(ROOT.rglob("*.py"))
}

# --- budgets

ELEMENTS = ("ngsolve", "netgen")
DRAWING = ("matplotlib", "PIL", "meshio")
TABLES = ("pandas", "dask", "lmfit", "scipy.stats")
HEAVY = (*ELEMENTS, *DRAWING, *TABLES)
BEAM = "--xi 1.2 --eta 1.3 --model beam --E1 0.465MPa --E2 0.02MPa"
FRICTIONLESS = "--xi 1.2 --eta 1.3 --accuracy fast --seating frictionless"


def door(arguments):
    return f"from stonepass.cli import run; assert run('{arguments}'.split()) == 0"


def refusal(arguments):
    return f"from stonepass.cli import run; assert run('{arguments}'.split()) == 2"


SURROGATE = (
    "import stonepass as sp; "
    "sp.load_surrogate().evaluate(size_ratio=1.2, wall_ratio=1.3, friction=0.5)"
)


SERVER = (
    "from stonepass.web.app import create_app; from stonepass.web.settings import ServerSettings; "
    "create_app(ServerSettings())"
)


FINITE_ELEMENTS = (*DRAWING, *TABLES, "pint", "scipy.optimize")
FIRST = (*HEAVY, "numpy", "scipy", "pint", "pydantic", "typer", "autograd")
# Statements and what must be absent after each of them. Those of one group are executed one after
# the other in one interpreter; what is absent after a statement is absent after all before it.
GROUPS = {
    "refusals": [
        ("import stonepass", FIRST),
        (refusal("pressure --xi 40 --eta 1.3"), (*HEAVY, "scipy", "pint", "rich", "autograd")),
        (refusal("push --xi 40 --eta 1.3"), (*HEAVY, "scipy")),
        (refusal("closures --xi 40 --eta 1.3"), (*HEAVY, "scipy")),
        (refusal("invitro none.csv --material latex"), (*HEAVY, "scipy")),
        (refusal("assess none.toml"), (*HEAVY, "scipy")),
    ],
    "help": [
        (door("--help"), (*HEAVY, "numpy", "scipy", "pint", "pydantic", "autograd", "rich")),
        (door("pressure --help"), (*HEAVY, "scipy", "pint", "autograd")),
        (door("material show ureter"), (*HEAVY, "scipy")),
    ],
    "sweeps": [
        ("import stonepass; stonepass.read_sweep", (*HEAVY, "pyarrow", "distributed", "xarray")),
        (refusal("sweep none.toml --out none"), (*HEAVY, "pyarrow", "distributed", "xarray")),
        (refusal("results none"), (*HEAVY, "pyarrow", "xarray")),
    ],
    "worker": [
        ("import stonepass.web.jobs.worker", (*HEAVY, "scipy.optimize", "fastapi", "uvicorn")),
    ],
    "server": [
        (refusal("serve --host 192.0.2.7"), (*HEAVY, "typst", "autograd")),
        (SERVER, (*HEAVY, "typst")),
    ],
    "loose stone": [
        (door("pressure --xi 0.9 --eta 1.3 --json"), (*HEAVY, "pint", "scipy", "rich")),
    ],
    "beam": [
        (door(f"pressure {BEAM} --json"), (*HEAVY, "pint", "scipy", "jaxtyping", "rich")),
        (door(f"size {BEAM[9:]} --limit 4kPa"), (*HEAVY, "pint", "scipy")),
    ],
    "finite elements": [(door(f"pressure {FRICTIONLESS} --json"), FINITE_ELEMENTS)],
    "Python": [
        ("import stonepass; stonepass.Ureter(wall_ratio=1.3)", (*HEAVY, "scipy")),
        ("import stonepass; stonepass.critical_pressure", (*HEAVY, "scipy")),
        ("import stonepass.model.far_field", (*HEAVY, "scipy")),
        ("import stonepass.model.models.elastic_foundation", (*HEAVY, "scipy")),
    ],
    "surrogate": [(SURROGATE, (*HEAVY, "distributed"))],
    "records": [
        ("import stonepass.records.answer", (*HEAVY, "scipy")),
        ("from stonepass.records import closures, compare, friction, rising", (*HEAVY, "scipy")),
        (
            "import stonepass.records.reference, stonepass.records.profile",  # all of them
            (*ELEMENTS, *DRAWING, "pandas", "lmfit", "pint", "rich", "typer"),
        ),
    ],
}


@pytest.mark.parametrize("group", GROUPS)
def test_heavy_libraries_stay_behind_their_door(group):
    """What is loaded after each statement of a group, in a fresh interpreter."""
    probe = "\n".join(
        f"{statement}\nimport sys; print(); print('loaded:', *sys.modules)"
        for statement, _ in GROUPS[group]
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("loaded: ")]
    for (statement, absent), line in zip(GROUPS[group], lines, strict=True):
        loaded = set(line.split())
        assert "stonepass" in loaded
        assert loaded.isdisjoint(absent), statement


# --- circles


@cache
def parsed(name):
    return ast.parse(MODULES[name].read_text(encoding="utf-8"))


def named_by(node, package):
    """The modules that an import statement of this package may load."""
    if isinstance(node, ast.Import):
        return [each.name for each in node.names]
    assert node.level == 0, f"{package} imports by a relative name"
    parts = [f"{node.module}.{each.name}" for each in node.names]
    return [part if part in MODULES else node.module for part in parts]


def imported(name):
    """The modules of stonepass that a module imports anywhere, be it for types only."""
    found = set()
    for node in ast.walk(parsed(name)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            found.update(each for each in named_by(node, name) if each in MODULES)
    # A package's own file is loaded with each of its modules, and imports none of them.
    return found - {name, "stonepass"}


def test_no_module_imports_itself_by_way_of_others():
    """In the whole house and so inside each package; imports for types count."""
    graph = {name: imported(name) for name in MODULES if name != "stonepass"}
    assert len(graph) > 100
    assert sum(map(len, graph.values())) > 400
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as circle:
        pytest.fail(" -> ".join(circle.args[1]))


def test_a_circle_would_be_found():
    with pytest.raises(CycleError):
        TopologicalSorter({"a": {"b"}, "b": {"c"}, "c": {"a"}}).prepare()


# --- imports inside functions

# Libraries that take long to load, or that exist on some systems only, and who asks for them late.
LATE_LIBRARIES = {
    "PIL": ("surface.pictures",),
    "resource": ("sandbox.worker",),
    "scipy.optimize": ("model.energy_balance", "model.shape_fit"),
    "autograd": ("materials.derivatives", "materials.secant"),
    "autograd.numpy": ("inputs.material_file", "materials.derivatives", "materials.secant"),
    "scipy.interpolate": ("fe.axisymmetric.slip",),
    "scipy.special": ("materials.fung",),
    "scipy.ndimage": ("surface.drawn_bar", "surface.grey_scale", "surface.lost_points"),
    "scipy.stats": (
        "studies.surrogates.box",
        "studies.sweeps.sampling",
        "studies.uncertain_quantity",
    ),
    "stonepass.report": ("stonepass",),  # results are shown by it, from their first table on
}


# Modules of this package that load the finite elements, or NumPy for what is only declared, and
# who asks for them late.
LATE_OWN = {
    "materials.principal_stretches": ("materials.spectral_power",),
    "model.states.uncached": ("model.states.",),
    "studies.solution_cache": ("studies.serialisation",),
    "export.api": ("model.critical",),
    "export.checks": ("materials.known_laws",),
    "export.writers.inp": ("export.", "materials.known_laws"),
    "export.writers.feb": ("export.", "materials.known_laws"),
    "export.writers.vtu": ("export.", "model.", "units"),
}


def is_own(name, module):
    """Whether a late import of this package's own module is one of those listed."""
    own = module.removeprefix("stonepass.")
    return module.startswith("stonepass.") and own.startswith(LATE_OWN.get(name, ()) or ("!",))


def late_imports(name):
    """(function, module) of the imports inside the functions of a module."""
    found = set()
    for function in ast.walk(parsed(name)):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.Import):
                    found.update((function.name, each.name) for each in node.names)
                if isinstance(node, ast.ImportFrom):
                    found.add((function.name, node.module))
    return found


def test_imports_inside_functions_are_for_heavy_libraries_alone():
    """The command line loads what a sub-command needs when it is run; elsewhere, only the listed."""
    late = {name: late_imports(name) for name in MODULES}
    doors = {name for name in MODULES if name.startswith("stonepass.cli")}
    assert sum(len(late[name]) for name in doors) > 50
    others = {
        (name.removeprefix("stonepass."), module)
        for name in MODULES.keys() - doors
        for _, module in late[name]
    }
    allowed = {(name, library) for library, names in LATE_LIBRARIES.items() for name in names}
    assert {pair for pair in others if not is_own(*pair)} == allowed
    assert {name for name, module in others if is_own(name, module)} == set(LATE_OWN)


# --- side effects

EFFECTS = """
import importlib, json, locale, logging, os, pkgutil, signal, sys, threading, warnings
import stonepass

for name in sys.argv[1:]:  # what other libraries do on import is theirs
    importlib.import_module(name)

import matplotlib, ngsolve, numpy

def state():
    return {
        "matplotlib": dict(matplotlib.rcParams),
        "backend": matplotlib.rcParams._get_backend_or_none(),
        "ngsolve": ngsolve.ngsglobals.msg_level,
        "numpy errors": numpy.geterr(),
        "numpy print": numpy.get_printoptions(),
        "warnings": list(warnings.filters),
        # threadpoolctl sets one of its own.
        "environment": {k: v for k, v in os.environ.items() if k != "KMP_DUPLICATE_LIB_OK"},
        "path": list(sys.path),
        "signals": [signal.getsignal(each) for each in signal.valid_signals()],
        "logging": list(logging.getLogger().handlers),
        "locale": locale.setlocale(locale.LC_ALL),
        "folder": os.getcwd(),
        "threads": threading.active_count(),
        "recursion": sys.getrecursionlimit(),
    }

names = [each.name for each in pkgutil.walk_packages(stonepass.__path__, "stonepass.")]
ngsolve.ngsglobals.msg_level = 3  # not what a solver would set
before = state()
for name in names:
    if name.endswith("__main__"):
        continue
    importlib.import_module(name)
after = state()
print(json.dumps({
    "modules": len(names), "changed": [key for key in before if before[key] != after[key]]
}))
"""


def test_importing_changes_nothing_outside(tmp_path):
    """Neither matplotlib's defaults nor the engine's settings, nor anything else of the process."""
    others = set()
    for name in MODULES:
        for node in parsed(name).body:
            if isinstance(node, ast.Import):
                others.update(each.name for each in node.names)
            elif isinstance(node, ast.ImportFrom):
                others.add(node.module)
    others = sorted(each for each in others if each.split(".")[0] != "stonepass")
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", EFFECTS, *others],
        capture_output=True, text=True, check=True, cwd=tmp_path,
    )  # fmt: skip
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["modules"] > 100
    assert found["changed"] == []
    assert list(tmp_path.iterdir()) == []
