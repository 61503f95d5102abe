"""Shapes and types in annotations are executed: jaxtyping and beartype, all numerical modules.

The doors (units, case, case_file, user_law) are left out: they refuse wrong types themselves, in
one sentence, and that is what their tests look at.
"""

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
