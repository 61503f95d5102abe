"""Reader and writer of materials: constants of a known law in TOML, or a user's Python function."""

from __future__ import annotations

import runpy
import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import tomli_w
from pydantic import BaseModel, ConfigDict, Field, create_model

from stonepass.errors import BadInput, StonepassError, refuse_unknown
from stonepass.io.text_file import existing, write_file
from stonepass.io.toml_file import parse_table, read_toml
from stonepass.materials.catalogue import material as catalogued
from stonepass.materials.composition import Composed
from stonepass.materials.constants import (
    ConstantDeclaration,
    constants_of,
    format_constant,
    read_constant,
)
from stonepass.materials.derivatives import energy_derivatives
from stonepass.materials.known_laws import (
    COMPOSED,
    KNOWN_LAWS,
    ONES_OWN,
    constants_by_name,
    name_of_law,
)
from stonepass.materials.protocol import Law, Material, names_a_file
from stonepass.materials.user_law import UserLaw
from stonepass.strain import CauchyGreen, Place

__all__ = ["find_material", "load_material", "material_table", "write_law"]

_PARTS = ("fibres", "matrix")  # tables of a composed law
DEEPEST = 5  # levels of composed laws
Table = TypeVar("Table", bound="_LawTable")


class _LawTable(BaseModel):
    """The name of a law, and the laws inside a composed one; `_with_constants` adds constants."""

    model_config = ConfigDict(extra="forbid", strict=True)
    law: str
    fibres: dict[str, Any] | None = None
    matrix: dict[str, Any] | None = None


class _LawFile(_LawTable):
    """The keys that all law files have in common."""

    source: str = Field(min_length=1)
    strain_range: tuple[float, float] = Field(strict=False)
    name: str | None = None
    test: str = "not stated"


def find_material(value: Any, folder: Path | None = None) -> Material:
    """Return the material that a value of the command line or of a case file describes.

    Parameters
    ----------
    value : Material, str or dict
        A name of the catalogue, a law file ``law.toml``, a Python function ``file.py:name``, the
        table of a law, or a material. A Python file is executed.
    folder : Path, optional
        Folder in which relative paths start; by default the current one.

    Raises
    ------
    BadInput
        The name is unknown, or the file or the table is refused (see `load_material`).
    """
    if isinstance(value, Material):
        return value
    if isinstance(value, dict):
        return _of_table(parse_table(value, _with_constants(_LawFile), "material, "))
    if not isinstance(value, str):
        raise BadInput("material", value, "a name, a file, a table or a Material")
    return load_material(value, folder) if names_a_file(value) else catalogued(value)


def load_material(text: str, folder: Path | None = None) -> Material:
    """Read a material from a law file or from a Python file, which is executed.

    Parameters
    ----------
    text : str
        A law file ``law.toml``, or ``file.py:name`` with the name of the energy function.
    folder : Path, optional
        Folder in which relative paths start; by default the current one.

    Raises
    ------
    BadInput
        The file does not exist or cannot be read, a key is unknown or missing, a constant has the
        wrong unit, or the function fails or does not return a finite energy.
    """
    if text.endswith(".toml"):
        path = _existing(text, folder)
        return _from_toml(path, str(path))
    path_text, separator, name = text.rpartition(":")
    if not separator or not path_text.endswith(".py") or not name.isidentifier():
        raise BadInput("material", text, "written file.py:name, name being the energy function")
    path = _existing(path_text, folder)
    return _from_python(path, name, f"{path}:{name}")


def _existing(text: str, folder: Path | None) -> Path:
    path = Path(text) if folder is None else folder / text
    return existing(path, "material")


def _from_python(path: Path, name: str, text: str) -> Material:
    folder = str(path.resolve().parent)
    sys.path.insert(0, folder)  # the file may import other files in its folder
    try:
        with redirect_stdout(sys.stderr):
            module = runpy.run_path(str(path))
    except (Exception, SystemExit) as problem:
        raise BadInput(
            "material",
            text,
            f"a Python file that runs; this one raises {type(problem).__name__}: {problem}",
        ) from problem
    finally:
        sys.path.remove(folder)
    function = module.get(name)
    if name in module and not callable(function):
        raise BadInput(f"'{name}' in {path.name}", function, "a function")
    if not callable(function):
        known = [key for key, value in module.items() if callable(value) and key[:1] != "_"]
        refuse_unknown(f"function in {path.name}", name, known or ["energy"])
    law = UserLaw(function, name)
    interval = module.get("strain_range", (1.0, 1.5))
    try:
        low, high = (float(bound) for bound in interval)
    except (TypeError, ValueError) as problem:
        raise BadInput(
            f"strain_range in {path.name}", interval, "two circumferential stretches"
        ) from problem
    _try_out(law, low, high)
    return Material(
        name=text,
        reference=text,
        law=law,
        source=str(module.get("source", "not stated by the file")),
        test="not stated by the file",
        verified="a user's law: not verified",
        strain_range=(low, high),
    )


def _try_out(law: UserLaw, low: float, high: float) -> None:
    """Evaluate a law over its strain range, and refuse one that does not return finite energies.

    The law is also differentiated, because some functions work with numbers but not with the types
    of automatic differentiation.
    """
    import autograd.numpy as anp

    t = np.array([low, 1.0, (1.0 + high) / 2.0, high, 1.0, 1.0])
    z = np.array([1.0, 1.0, 1.0, 1.0, 0.95, 1.05])
    none = np.zeros_like(t)
    C, place = (
        CauchyGreen(1.0 / (t * z) ** 2, t**2, z**2, none, none, none),
        Place(none + 1.0, none),
    )
    with np.errstate(all="ignore"):  # energies that are not finite are refused below
        value = law.energy(C, place, anp)
    try:
        if np.iscomplexobj(value):
            raise TypeError("complex energies")
        energies = np.broadcast_to(np.asarray(value, dtype=float), t.shape)
    except (TypeError, ValueError) as problem:
        raise BadInput(
            f"value of law '{law.label}'", value, "one real energy in J/m³ per strain"
        ) from problem
    if not np.all(np.isfinite(energies)):
        bad = int(np.flatnonzero(~np.isfinite(energies))[0])
        raise BadInput(
            f"value of law '{law.label}'",
            f"{energies[bad]} at circumferential stretch {t[bad]:g}, axial stretch {z[bad]:g}",
            "a finite energy in J/m³ over the strain range of the law",
            "strain_range = (low, high) in its file states the range",
        )
    if np.ptp(energies) == 0.0:
        raise BadInput(
            f"value of law '{law.label}'", f"{energies[0]:g} at every strain", "strain-dependent"
        )
    try:
        energy_derivatives(law, C, place)
    except StonepassError:
        raise
    except Exception as problem:
        raise law.refusal(problem) from problem


def _from_toml(path: Path, text: str) -> Material:
    constants = read_toml(path, _with_constants(_LawFile))
    try:
        return _of_table(constants, text)
    except BadInput as problem:
        raise problem.within(path.name) from problem


def _of_table(constants: _LawFile, reference: str = "") -> Material:
    return Material(
        name=constants.name or reference or constants.law,
        law=_law(constants),
        source=constants.source,
        test=constants.test,
        verified="a user's constants: not verified",
        strain_range=constants.strain_range,
        reference=reference,
    )


def _all_constants() -> dict[str, ConstantDeclaration]:
    return {each.name: each for law in KNOWN_LAWS.values() for each in constants_of(law)}


def _with_constants(table: type[Table]) -> type[Table]:
    """Return the pydantic model of a table with the constants of a law.

    It has the constants of all laws, so that an error can suggest the nearest one.
    """
    keys: dict[str, Any] = {
        name: (float | None if each.unit == "1" else str | None, None)
        for name, each in _all_constants().items()
    }
    return create_model("_Constants", __base__=table, **keys)


def _law(table: _LawTable, depth: int = 0) -> Law:
    """Return the law of a table that stands `depth` levels inside that of a composed law."""
    if table.law not in (*KNOWN_LAWS, COMPOSED):
        refuse_unknown("law", table.law, [*KNOWN_LAWS, COMPOSED], ONES_OWN)
    given = {
        name: value
        for name in (*_all_constants(), *_PARTS)
        if (value := getattr(table, name)) is not None
    }
    known = _PARTS if table.law == COMPOSED else constants_by_name(table.law)
    for name in given:
        if name not in known:
            raise BadInput(f"'{name}'", "given", f"left out for law '{table.law}'")
    if table.law == COMPOSED:
        return Composed(**{name: _part(name, given.get(name), depth + 1) for name in _PARTS})
    values: dict[str, float] = {}
    for name, each in constants_by_name(table.law).items():
        if name in given:
            values[name] = read_constant(given[name], each)
        elif each.default is None:
            raise BadInput(f"'{name}'", "missing", f"given for law '{table.law}'")
    made: Law = KNOWN_LAWS[table.law](**values)
    return made


def _part(name: str, given: dict[str, Any] | None, depth: int) -> Law:
    """Return a law inside a composed law; its keys are named like ``fibres.C`` in messages."""
    if given is None:
        raise BadInput(f"'{name}'", "missing", f"a table with a law for law '{COMPOSED}'")
    if depth > DEEPEST:
        raise BadInput(f"'{name}'", "given", f"left out: laws are composed in {DEEPEST} levels")
    try:
        return _law(parse_table(given, _with_constants(_LawTable), ""), depth)
    except BadInput as problem:
        key = problem.argument.strip("'")
        if key.startswith("key"):  # "key", or "key of [matrix]"
            section = ".".join([name, *key.removesuffix("]").split("[")[1:]])
            raise problem.named(f"key of [{section}]") from problem
        raise problem.named(f"'{name}.{key}'") from problem


def material_table(material: Material) -> dict[str, Any]:
    """Return the table that describes a material of known laws; `find_material` reads it.

    Raises
    ------
    BadInput
        The law is not one of the known laws or composed of them, e.g. because it is a user's
        function.
    """
    return {
        **_law_table(material.law, material.name),
        "name": material.name,
        "source": material.source or "not stated",
        "test": material.test or "not stated",
        "strain_range": list(material.strain_range),
    }


def _law_table(law: Law, material: str, depth: int = 0) -> dict[str, Any]:
    """Return the table of a law; `material` is the name of its material for the message.

    The table stands `depth` levels inside that of a composed law.
    """
    if depth > DEEPEST:
        raise BadInput("law of the material", material,
                       f"composed in {DEEPEST} levels at most to be written")  # fmt: skip
    if isinstance(law, Composed):
        parts = {name: _law_table(getattr(law, name), material, depth + 1) for name in _PARTS}
        return {"law": COMPOSED, **parts}
    name_of = name_of_law(law)
    if not name_of:
        known = ", ".join(KNOWN_LAWS)
        raise BadInput(
            "law of the material", material, f"one of {known} or composed of them to be written"
        )
    declared = constants_by_name(name_of)
    constants = {name: format_constant(getattr(law, name), each) for name, each in declared.items()}
    return {"law": name_of, **constants}


def write_law(material: Material, path: Path) -> None:
    """Write a law file from which `load_material` returns the same material.

    Parameters
    ----------
    material : Material
        A material of a known law, or of a law composed of known ones.
    path : Path
        The law file.

    Raises
    ------
    BadInput
        The law is not one of these, or the file cannot be written.
    """
    document = material_table(material)
    write_file(path, tomli_w.dumps(document), "law file")
