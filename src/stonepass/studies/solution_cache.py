"""Finite-element results on disk, by what they depend on: the case and the solver's own source.

One file for one result: SHA-256 of what follows, then a zip of JSON and arrays (NumPy's, without
pickle). A file whose digest is wrong is set aside in ``corrupt/`` and its result solved again.
Files are written beside their place and moved there in one step, so processes may share a folder.
A folder that cannot be written costs the memory and not the answer: `CacheWarning` says so.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import warnings
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs

from stonepass.errors import CacheNotWritten, CacheWarning
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.io.text_file import replace_file
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.states.uncached import UNCACHED
from stonepass.studies.source_digest import solver_digest
from stonepass.units import Pressure

__all__ = ["SolutionCache", "default_folder", "describe_law"]

DIGEST = hashlib.sha256().digest_size
CORRUPT = "corrupt"
SOURCES = "sources"
LAWS = "stonepass.materials"  # laws defined elsewhere have source that the key does not cover


def default_folder() -> Path:
    """The user's cache folder for this software; ``STONEPASS_CACHE`` names another."""
    named = os.environ.get("STONEPASS_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("stonepass"))


@dataclass(frozen=True)
class SolutionCache:
    """A state solver (`model.states.state_solver.StateSolver`) that remembers states on disk.

    Results depend on ratios alone, so cases of another size share theirs, as do those that differ
    only in closure, sign or far field. A law that is a Python function, or is defined outside this
    package, is solved afresh every time.

    Attributes
    ----------
    folder : Path
        Made on demand; processes may share it.
    walls : bool
        Whether states are kept with their stress fields.
    """

    folder: Path
    walls: bool = False

    def seat(
        self,
        case: Problem,
        seating: Seating,
        numerics: Numerics,
        resolution: Resolution | None = None,
    ) -> SeatedState | NoSeat:
        """See `StateSolver.seat`."""
        asked = {"seating": seating.kind, "friction": seating.friction}
        return self._remembered(
            "seat",
            case,
            numerics,
            asked | _mesh(numerics, resolution),
            lambda: self._slim(UNCACHED.seat(case, seating, numerics, resolution)),
        )

    def push(
        self,
        case: Problem,
        numerics: Numerics,
        resolutions: Sequence[Resolution],
        *,
        wetted: bool,
        leak: bool,
    ) -> list[Critical | NoPush]:
        """See `StateSolver.push`."""
        asked = {
            "friction": case.stone.friction,
            "wetted": wetted,
            "leak": leak,
            "resolutions": [asdict(each) for each in resolutions],
        }

        def solve() -> tuple[Critical | NoPush, ...]:
            found = UNCACHED.push(case, numerics, resolutions, wetted=wetted, leak=leak)
            return tuple(map(self._slim, found))

        return list(self._remembered("push", case, numerics, asked, solve))

    def hold(
        self,
        case: Problem,
        numerics: Numerics,
        pressures: Sequence[Pressure],
        resolution: Resolution,
        *,
        wetted: bool,
    ) -> list[PushedState | NoPush]:
        """See `StateSolver.hold`; cases of another size share states of equal pressure."""
        asked = {
            "friction": case.stone.friction,
            "wetted": wetted,
            "pressures": [float(each) for each in pressures],
            "resolution": asdict(resolution),
        }

        def solve() -> tuple[PushedState | NoPush, ...]:
            found = UNCACHED.hold(case, numerics, pressures, resolution, wetted=wetted)
            return tuple(map(self._slim, found))

        return list(self._remembered("hold", case, numerics, asked, solve))

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """See `StateSolver.opening_curve`."""
        return self._remembered(
            "opening_curve", case, numerics, {}, lambda: UNCACHED.opening_curve(case, numerics)
        )

    def _slim(self, found: Any) -> Any:
        """Return a state without its stress field, unless it is to be kept."""
        if self.walls:
            return found
        if hasattr(found, "wall"):
            return replace(found, wall=None)
        if hasattr(found, "state"):
            return replace(found, state=replace(found.state, wall=None))
        return found

    def _remembered(
        self,
        what: str,
        case: Problem,
        numerics: Numerics,
        asked: dict[str, Any],
        solve: Callable[[], Any],
    ) -> Any:
        document = _document(what, case, numerics, asked | {"walls": self.walls})
        if document is None:
            return solve()
        from stonepass.studies.serialisation import deserialise, serialise  # loads NGSolve

        solver = solver_digest(self.folder / SOURCES)
        key = hashlib.sha256(f"{solver} {document}".encode()).hexdigest()
        path = self.folder / key[:2] / key
        known = _read(path, self.folder / CORRUPT)
        if known is not None:
            return deserialise(known[0], known[1], case)
        found = solve()
        try:
            _write(path, *serialise(found))
        except OSError as problem:
            sentence = (
                f"the cache folder '{self.folder}' could not be written "
                f"({problem.strerror or problem}), so that what was solved is not remembered"
            )
            warnings.warn(CacheNotWritten(sentence), stacklevel=2)
        return found


def _mesh(numerics: Numerics, resolution: Resolution | None) -> dict[str, Any]:
    if resolution is None:
        return {"accuracy": numerics.accuracy}
    return {"resolution": asdict(resolution)}


def _document(what: str, case: Problem, numerics: Numerics, asked: dict[str, Any]) -> str | None:
    """Return as JSON all that a result depends on, apart from the solver.

    None where the law cannot be written down.
    """
    try:
        document = {
            "what": what,
            "size_ratio": case.size_ratio,
            "aspect": case.stone.shape.aspect,
            "outline": case.stone.shape.outline,
            "wall_ratio": case.wall_ratio,
            "material": case.ureter.material.name,
            "law": describe_law(case.ureter.material.law),
            "strain_range": case.ureter.material.strain_range,
            "load": asdict(case.load),
            "half_length": numerics.half_length,
            **asked,
        }
        return json.dumps(document, sort_keys=True, allow_nan=False)
    except (TypeError, ValueError):
        return None


def describe_law(law: Any) -> Any:
    """Return the type and the constants of a law as JSON, for laws inside laws too.

    Parameters
    ----------
    law : dataclass of `stonepass.materials`
        Its constants are its fields.

    Raises
    ------
    TypeError
        For a part that is neither such a law nor a number, text, or sequence of them.
    """
    if law is None or isinstance(law, bool | int | float | str):
        return law
    if isinstance(law, tuple | list):
        return [describe_law(each) for each in law]
    kind = type(law)
    if not is_dataclass(kind) or not f"{kind.__module__}.".startswith(f"{LAWS}."):
        raise TypeError(f"a {kind.__name__} cannot be written down")
    constants = {each.name: describe_law(getattr(law, each.name)) for each in fields(kind)}
    return {"type": f"{kind.__module__}.{kind.__qualname__}", "constants": constants}


def _write(path: Path, document: Any, arrays: dict[str, Any]) -> None:
    """Write one result; OSError where that fails."""
    packed = io.BytesIO()
    text = np.frombuffer(json.dumps(document).encode(), np.uint8)
    np.savez_compressed(packed, document=text, **arrays)
    payload = packed.getvalue()
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, hashlib.sha256(payload).digest() + payload)


def _read(path: Path, corrupt: Path) -> tuple[Any, dict[str, Any]] | None:
    """Document and arrays of a file; None where there is none, or a corrupt one, then set aside."""
    try:
        raw = path.read_bytes()
    except OSError:
        return None
    payload = raw[DIGEST:]
    if hashlib.sha256(payload).digest() == raw[:DIGEST]:
        try:
            with np.load(io.BytesIO(payload), allow_pickle=False) as parts:
                arrays = {name: parts[name] for name in parts.files}
            return json.loads(arrays.pop("document").tobytes()), arrays
        except (ValueError, KeyError, zipfile.BadZipFile):  # of another writer
            pass
    sentence = f"a damaged result was set aside in '{corrupt}' and solved again"
    warnings.warn(CacheWarning(sentence), stacklevel=2)
    try:
        corrupt.mkdir(parents=True, exist_ok=True)
        if path.read_bytes() == raw:  # else another process has mended it meanwhile
            path.replace(corrupt / path.name)
    except OSError:  # gone, or a folder that cannot be written: solved again all the same
        pass
    return None
