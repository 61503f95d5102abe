"""Surrogates on disk: numbers in an ``.npz`` archive, everything else in a JSON file beside it.

Neither file contains pickled objects. The JSON file has the digest of the archive and that of the
material, so that a damaged archive, or a material whose constants have changed, is refused.
"""

from __future__ import annotations

import hashlib
import io
import json
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.errors import BadInput, require
from stonepass.inputs.build import build_case
from stonepass.inputs.case_file import values_of
from stonepass.inputs.case_record import describe_material
from stonepass.io.text_file import existing, replace_file
from stonepass.model.case import Case
from stonepass.model.models.push_through import PushThrough
from stonepass.studies.surrogates.box import Box
from stonepass.studies.surrogates.held_functions import HeldFunctions
from stonepass.studies.surrogates.held_stone import HeldStone
from stonepass.studies.surrogates.learnt import LearntFunctions
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.seated_contact import SeatedContact
from stonepass.studies.surrogates.stable_loads import StableLoads
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["load_surrogate", "save_surrogate", "shipped_surrogates"]

FORMAT = 2  # raised if the files change so that older versions cannot be read
SHIPPED = "shipped"  # folder of the surrogates that come with the package
_POLYNOMIALS = ("base", "correction", "error", "lumen")


def shipped_surrogates() -> list[tuple[str, str]]:
    """Return material and model of every surrogate that comes with the package."""
    folder = files(__package__) / SHIPPED
    if not folder.is_dir():
        return []
    names = sorted(each.name for each in folder.iterdir() if each.name.endswith(".json"))
    return [tuple(name.removesuffix(".json").rsplit("-", 1)) for name in names]  # type: ignore[misc]


def load_surrogate(name: str | Path = "ureter", model: str = "paper") -> Surrogate:
    """Load a surrogate that comes with the package, or one of your own.

    Parameters
    ----------
    name : str or Path
        Material of a surrogate of the package; or the JSON file of a surrogate.
    model : str
        Model of a surrogate of the package: ``"paper"`` or ``"direct"``.

    Raises
    ------
    BadInput
        There is no such surrogate, a file is damaged, or the material has other constants than when
        the surrogate was built.
    """
    if Path(name).suffix == ".json":
        return _read(existing(Path(name), "surrogate"))
    known = shipped_surrogates()
    if (str(name), model) not in known:
        listed = ", ".join(f"'{material}' with the model '{each}'" for material, each in known)
        remedy = "build one with 'stonepass surrogate build', and give its JSON file"
        raise BadInput(
            "surrogate", f"'{name}' with the model '{model}'", f"one of {listed}", remedy
        )
    return _read(Path(str(files(__package__) / SHIPPED / f"{name}-{model}.json")))


def save_surrogate(surrogate: Surrogate, path: Path) -> None:
    """Write a surrogate to a JSON file, and its arrays to an ``.npz`` archive beside it.

    Parameters
    ----------
    surrogate : Surrogate
    path : Path
        The JSON file; its folder must exist.

    Raises
    ------
    OSError
        A file cannot be written.
    """
    arrays: dict[str, Any] = {}
    learnt = surrogate.learnt
    parts = (learnt.base, learnt.correction, surrogate.error, surrogate.lumen)
    for part, polynomial in zip(_POLYNOMIALS, parts, strict=True):
        if polynomial is not None:
            arrays[f"{part}_degrees"] = polynomial.degrees.astype(np.int8)
            arrays[f"{part}_coefficients"] = polynomial.coefficients
    if isinstance(surrogate.physics, SeatedContact):
        arrays |= {"shear": surrogate.physics.shear, "axial": surrogate.physics.axial}
    stable = surrogate.stable
    arrays |= {"stable_wall_ratio": stable.wall_ratio, "stable_factor": stable.factor}
    packed = io.BytesIO()
    np.savez_compressed(packed, **arrays)
    case = surrogate.case
    document = {
        "format": FORMAT,
        "case": values_of(case, path.parent),
        "box": asdict(surrogate.box),
        "floor_Pa": surrogate.floor,
        "narrowest_lumen": stable.narrowest,
        "about": dict(surrogate.about),
        "material_digest": _material_digest(case),
        "arrays_digest": hashlib.sha256(packed.getvalue()).hexdigest(),
    }
    replace_file(path.with_suffix(".npz"), packed.getvalue())
    replace_file(path, (json.dumps(document, indent=1, allow_nan=False) + "\n").encode())


def _read(path: Path) -> Surrogate:
    damaged = BadInput("surrogate", path, "a pair of files that 'stonepass surrogate build' wrote",
                       "build it again")  # fmt: skip
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        packed = path.with_suffix(".npz").read_bytes()
        version = document["format"]
        digest = document["arrays_digest"]
    except (OSError, ValueError, KeyError, TypeError):
        raise damaged from None
    if version != FORMAT:
        raise BadInput("format of the surrogate", version, f"the number {FORMAT}", "build it again")
    if hashlib.sha256(packed).hexdigest() != digest:
        raise damaged
    try:
        return _rebuilt(path, document, packed)
    except BadInput:
        raise
    except (ValueError, KeyError, TypeError, AttributeError):
        raise damaged from None


def _rebuilt(path: Path, document: dict[str, Any], packed: bytes) -> Surrogate:
    """Return the surrogate that the content of both files describes."""
    material = document["material_digest"]
    with np.load(io.BytesIO(packed), allow_pickle=False) as parts:
        arrays = {name: parts[name] for name in parts.files}
    built = build_case(document["case"], path.parent)
    if _material_digest(built) != material:
        name = built.ureter.material.name
        raise BadInput("surrogate", path, f"built for the present constants of '{name}'",
                       "build it again")  # fmt: skip
    base, correction, error, lumen = (
        SparsePolynomial(arrays[f"{part}_degrees"].astype(int), arrays[f"{part}_coefficients"])
        if f"{part}_degrees" in arrays
        else None
        for part in _POLYNOMIALS
    )
    assert base is not None
    assert error is not None
    physics: SeatedContact | HeldStone
    learnt: LearntFunctions | HeldFunctions
    if isinstance(built.model, PushThrough):
        if correction is None or correction.degrees.shape[1] != base.degrees.shape[1]:
            raise ValueError
        physics, learnt = HeldStone(), HeldFunctions(base, correction)
    else:
        physics = SeatedContact(arrays["shear"], arrays["axial"])
        learnt = LearntFunctions(base, correction)
    limits = document["box"]
    box = Box(limits["size_ratio"], tuple(limits["wall_ratio"]), tuple(limits["friction"]))
    stable = StableLoads(arrays["stable_wall_ratio"], arrays["stable_factor"],
                         float(document["narrowest_lumen"]))  # fmt: skip
    floor, about = float(document["floor_Pa"]), dict(document["about"])
    require(0.0 <= floor < np.inf, f"floor_Pa in {path.name}", floor, "0 or more", "build it again")
    return Surrogate(built, box, physics, learnt, error, floor, stable, lumen, about)


def _material_digest(case: Case) -> str:
    text = json.dumps(describe_material(case.ureter.material), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()
