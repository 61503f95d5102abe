"""Reader of studies: TOML files, or dictionaries of the same structure, that describe a sweep."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.inputs.build import in_words
from stonepass.inputs.case_file import WORDS, checked_values
from stonepass.inputs.catalogue import MODEL, all_inputs, sections
from stonepass.inputs.material_file import find_material
from stonepass.inputs.opening_curve_file import find_opening_curve
from stonepass.inputs.shape_file import find_shape
from stonepass.io.toml_document import read_document
from stonepass.io.toml_file import merged
from stonepass.materials.protocol import Material
from stonepass.model.models.registry import MODELS
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.studies.sweeps.axes import Axis, Points, SampledRange, read_variation
from stonepass.studies.sweeps.case_rows import build
from stonepass.studies.sweeps.plan import Sweep, Variant
from stonepass.studies.sweeps.points_file import read_points_table
from stonepass.studies.sweeps.sampling import Sampling, read_sampling
from stonepass.studies.sweeps.varied_input import MATERIAL, varied_input

__all__ = ["read_sweep"]

OWN = ("vary", "samples", "points", "models")
_FILES = {
    MATERIAL: find_material,
    "stone.shape": find_shape,
    "method.opening_curve": find_opening_curve,
}
Table = Mapping[str, Any]


def read_sweep(study: str | Path | Table) -> Sweep:
    """Read the plan of a sweep.

    The fixed inputs are written as in a case file. The section ``vary`` has a list, steps or a
    range for each varied input; ``samples`` says how ranges are sampled; ``points`` has explicit
    samples; ``models`` has one sub-section for each model. Files that the study names are read
    now, so that the plan can be sent to other machines.

    Parameters
    ----------
    study : str, Path or mapping
        A TOML file, whose folder is the start of relative paths, or a dictionary of the same
        structure. A dictionary may contain arrays and objects such as a `Material` too.

    Returns
    -------
    Sweep

    Raises
    ------
    BadInput
        The file cannot be read, a key is unknown, a value is out of bounds, nothing is varied, or
        the first case cannot be built. The message names the file and the key.

    References
    ----------
    docs/howto/sweep.md, "The study file".
    """
    if isinstance(study, Mapping):
        return _read(study, Path("study"), Path(), typed=False)
    path = Path(study)
    return _read(read_document(path), path, path.parent, typed=True)


def _read(document: Table, path: Path, folder: Path, *, typed: bool) -> Sweep:
    case = {key: value for key, value in document.items() if key not in OWN}
    for key in case:
        if key not in sections():
            refuse_unknown(f"in {path.name}, key", key, [*sections(), *OWN])
    try:
        fixed = _resolved(checked_values(case, path) if typed else _flat(case), folder)
        plan = _plan(document, fixed, path, folder, typed=typed)
        _check(plan)
    except BadInput as problem:
        told = in_words(problem, WORDS)
        raise told if told.argument.startswith("in ") else told.within(path.name) from problem
    return plan


def _plan(document: Table, fixed: dict[str, Any], path: Path, folder: Path, *,
          typed: bool) -> Sweep:  # fmt: skip
    vary = _leaves(_table(document, "vary"))
    listed = _table(document, "models")
    if MODEL in vary:
        allowed = "left out, because [models] lists the models"
        require(not listed, f"'{MODEL}'", "varied", allowed)
        listed = _listed(vary.pop(MODEL))
    if listed and MODEL in fixed:
        raise BadInput(f"'{MODEL}'", fixed[MODEL], "left out, because the models are listed")
    models = _models(listed, path, folder, typed=typed) if listed else (_only(fixed),)
    materials = _materials(fixed, vary, folder)
    if any(key.startswith(f"{MATERIAL}.") for key in [*vary, *_table(document, "points")]):
        fixed.setdefault(MATERIAL, materials[0])
    found = [
        read_variation(varied_input(key, materials), value, folder) for key, value in vary.items()
    ]
    ranges = tuple(each for each in found if isinstance(each, SampledRange))
    points = _points(_table(document, "points"), materials, folder)
    return Sweep(
        fixed,
        tuple(each for each in found if isinstance(each, Axis)),
        ranges,
        _sampling(_table(document, "samples"), ranges, points),
        points,
        models,
    )


def _table(document: Table, name: str) -> Table:
    table = document.get(name, {})
    if not isinstance(table, Mapping):
        raise BadInput(f"'{name}'", table, f"a section, written [{name}]")
    return table


def _flat(case: Table) -> dict[str, Any]:
    """Return the values of a dictionary by key; their types are checked when cases are built."""
    found = {}
    for section, keys in case.items():
        if not isinstance(keys, Mapping):
            raise BadInput(f"'{section}'", keys, "a dictionary of the inputs of this section")
        for name, value in keys.items():
            if name not in sections()[section]:
                refuse_unknown(f"key of '{section}'", str(name), list(sections()[section]))
            found[f"{section}.{name}"] = value
    return found


def _resolved(values: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Return values in which the files they name have been read."""
    return {
        key: _FILES[key](value, folder) if key in _FILES else value for key, value in values.items()
    }


def _leaves(table: Table, prefix: str = "") -> dict[str, Any]:
    """Return the entries of [vary] by key; a key may be quoted, or written with sub-sections."""
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{prefix}{name}"
        constant = key.startswith(f"{MATERIAL}.")
        nested = isinstance(value, Mapping) and key not in all_inputs() and not constant
        inside = isinstance(value, Mapping) and key == MATERIAL
        if (nested and key in (*sections(), "")) or inside:
            found = merged(found, _leaves(value, f"{key}."))
        else:
            found = merged(found, {key: value})
    return found


def _listed(models: Any) -> dict[str, Any]:
    """Return the section [models] that means the same as ``"method.model" = ["paper", …]``."""
    if isinstance(models, str | Mapping):
        raise BadInput(f"'{MODEL}'", models, "a list of models")
    return {str(name): {} for name in models}


def _only(fixed: Table) -> Variant:
    return Variant(str(fixed.get(MODEL, SeatedBalance.NAME)))


def _models(table: Table, path: Path, folder: Path, *, typed: bool) -> tuple[Variant, ...]:
    """Return the models side by side."""
    found = []
    for label, options in table.items():
        if not isinstance(options, Mapping):
            raise BadInput(f"'models.{label}'", options, f"a section, written [models.{label}]")
        values = {"method": {"model": label} | dict(options)}
        if values["method"]["model"] not in MODELS:
            refuse_unknown(f"'models.{label}'", str(values["method"]["model"]), list(MODELS))
        raw = checked_values(values, path) if typed else _flat(values)
        found.append(Variant(label, _resolved(raw, folder)))
    return tuple(found)


def _materials(fixed: Table, vary: dict[str, Any], folder: Path) -> list[Material]:
    """Return the materials of the sweep, whose laws declare the constants that may be varied."""
    listed = vary.get(MATERIAL)
    if isinstance(listed, list | tuple):
        return [find_material(each, folder) for each in listed]
    return [find_material(fixed.get(MATERIAL, "ureter"), folder)]


def _points(table: Table, materials: list[Material], folder: Path) -> Points | None:
    if not table:
        return None
    return read_points_table(table, lambda key: varied_input(key, materials), folder)


def _sampling(
    table: Table, ranges: tuple[SampledRange, ...], points: Points | None
) -> Sampling | None:
    if ranges:
        require(points is None, "'points'", "given", "left out where ranges are sampled")
        return read_sampling(table)
    require(not table, "[samples]", "given", "left out, because no input has a range {low, high}")
    return None


def _check(plan: Sweep) -> None:
    """Refuse a plan that varies nothing, one input twice, or a model that has no valid case."""
    varied = len(plan.inputs) > 0 or len(plan.models) > 1
    require(varied, "'vary'", "empty", "given: a list, steps or a range for at least one input")
    names: set[str] = set()
    for each in plan.inputs:
        require(each.column not in names, f"'{each.key}'", "varied twice", "varied once")
        names.add(each.column)
        clash = each.key in plan.fixed or any(each.key in model.values for model in plan.models)
        require(not clash, f"'{each.key}'", "fixed and varied", "one of the two")
    for model in range(len(plan.models)):
        _check_model(plan, model)


def _check_model(plan: Sweep, model: int) -> None:
    """Refuse a model for which neither the first, nor the middle, nor the last case can be built.

    A single case whose inputs contradict each other becomes a row with this outcome.
    """
    problems = []
    count, step = plan.cases // len(plan.models), len(plan.models)
    for k in dict.fromkeys((0, count // 2, count - 1)):
        try:
            build(plan.case(k * step + model).values)
            return
        except BadInput as problem:
            problems.append(problem)
    raise problems[0]
