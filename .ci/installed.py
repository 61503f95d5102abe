"""What an installed wheel must do, from a folder without the sources: ``installed.py CHECKOUT``."""

import importlib
import pkgutil
import sys
from pathlib import Path

import stonepass as sp
from stonepass.web.information import glossary
from stonepass.web.section.grid import grid_of

# Libraries of the extras `imaging` and `web`, which are not installed here.
EXTRAS = {"SurfaceTopography", "fastapi", "h11", "starlette", "uvicorn"}
MODULES = 100  # at least; fewer means that a package was left out of the wheel


def modules() -> int:
    """Import every module of the package; return how many there are."""
    names = [each.name for each in pkgutil.walk_packages(sp.__path__, "stonepass.")]
    missing = set()
    for name in names:
        if name.endswith("__main__"):
            continue
        try:
            importlib.import_module(name)
        except ModuleNotFoundError as problem:
            missing.add(str(problem.name))
    assert missing <= EXTRAS, missing
    return len(names)


def main() -> None:
    """Fail with a traceback where something is missing."""
    home, checkout = Path(sp.__file__).resolve(), Path(sys.argv[1]).resolve()
    assert not home.is_relative_to(checkout / "src"), f"the sources were imported: {home}"
    for name in ("py.typed", "web/page/index.html", "web/page/js/main.js"):
        assert (home.parent / name).is_file(), name
    found = modules()
    assert found >= MODULES, found
    for name in sp.__all__:
        getattr(sp, name)
    loose = sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5))
    assert loose.outcome is sp.Outcome.LOOSE
    model, numerics = sp.SeatedBalance(seating="frictionless"), sp.Numerics("fast")
    latex = sp.Ureter(wall_ratio=1.5, material="latex")
    held = sp.critical_pressure(sp.Stone(size_ratio=1.2), latex, model=model, numerics=numerics)
    assert held.pressure is not None
    assert 40e3 < held.pressure < 43e3, held.pressure
    quick = sp.load_surrogate("latex").evaluate(size_ratio=1.2, wall_ratio=1.5, friction=0.5)
    assert quick.answered.all()
    assert len(glossary()) > 50
    assert grid_of("ureter") is not None
    print(f"The installed wheel has {found} modules and answers.")


if __name__ == "__main__":
    main()
