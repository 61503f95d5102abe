"""Shapes and types in annotations are executed: jaxtyping and beartype, all numerical modules.

The doors (units, case, case_file, user_law) are left out: they refuse wrong types themselves, in
one sentence, and that is what their tests look at.
"""

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


@pytest.fixture
def solved(monkeypatch):
    """Names of what was solved afresh."""
    from stonepass.model.afresh import AFRESH

    found = []
    for name in ("seat", "push", "pairs"):
        original = getattr(AFRESH, name)

        def called(*arguments, _name=name, _original=original, **keywords):
            found.append(_name)
            return _original(*arguments, **keywords)

        monkeypatch.setattr(type(AFRESH), name, staticmethod(called))
    return found
