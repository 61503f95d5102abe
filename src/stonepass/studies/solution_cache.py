"""Cache of finite-element results on disk.

The key of a result is a digest of the case and of the source code of the solver. Each result is one
file: a SHA-256 digest, followed by an archive of JSON and NumPy arrays without pickle. A file whose
digest does not match is moved to the folder ``corrupt``, and its result is solved again. A file is
written under another name and then renamed in one step, so that several processes can share a
folder. If the folder cannot be written, the result is returned but not stored, with a
`CacheWarning`.
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

DIGEST = hashlib.sha256().digest_size  # bytes
CORRUPT = "corrupt"  # folder of damaged files
SOURCES = "sources"  # folder of the digests of the source code
LAWS = "stonepass.materials"  # package whose source code is part of the key


def default_folder() -> Path:
    """Return the user's cache folder, or the folder in the environment variable STONEPASS_CACHE."""
    named = os.environ.get("STONEPASS_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("stonepass"))


@dataclass(frozen=True)
class SolutionCache:
    """A `StateSolver` that stores finite-element states on disk.

    States depend on ratios only, so that cases which differ in size share them, as do cases which
    differ in the closure, the sign of Eq. 5 or the far field. States are not stored if the law is a
    Python function or is defined outside this package.

    Attributes
    ----------
    folder : Path
        Folder of the cache, which is made if necessary. Several processes may share it.
    walls : bool
        True if states are stored with their stress fields.
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
        """Return the seated state; for the parameters see `StateSolver.seat`."""
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
        """Return the critical states; for the parameters see `StateSolver.push`."""
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
        """Return states of a held stone; for the parameters see `StateSolver.hold`.

        Cases that differ in size share states of equal pressure.
        """
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
        """Return the opening curve; for the parameters see `StateSolver.opening_curve`."""
        return self._remembered(
            "opening_curve", case, numerics, {}, lambda: UNCACHED.opening_curve(case, numerics)
        )

    def _slim(self, found: Any) -> Any:
        """Return a state without its stress field, unless stress fields are stored."""
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
                f"({problem.strerror or problem}), so that this result is not stored"
            )
            warnings.warn(CacheNotWritten(sentence), stacklevel=2)
        return found


def _mesh(numerics: Numerics, resolution: Resolution | None) -> dict[str, Any]:
    if resolution is None:
        return {"accuracy": numerics.accuracy}
    return {"resolution": asdict(resolution)}


def _document(what: str, case: Problem, numerics: Numerics, asked: dict[str, Any]) -> str | None:
    """Return a JSON text of everything that a result depends on, except the solver.

    None is returned if the law cannot be described.
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
    """Return the type and the constants of a law as a JSON value, also for nested laws.

    Parameters
    ----------
    law : dataclass of `stonepass.materials`
        The law; its constants are its fields.

    Raises
    ------
    TypeError
        A constant is not a law, a number, a text, or a sequence of these.
    """
    if law is None or isinstance(law, bool | int | float | str):
        return law
    if isinstance(law, tuple | list):
        return [describe_law(each) for each in law]
    kind = type(law)
    if not is_dataclass(kind) or not f"{kind.__module__}.".startswith(f"{LAWS}."):
        raise TypeError(f"a {kind.__name__} cannot be described")
    constants = {each.name: describe_law(getattr(law, each.name)) for each in fields(kind)}
    return {"type": f"{kind.__module__}.{kind.__qualname__}", "constants": constants}


def _write(path: Path, document: Any, arrays: dict[str, Any]) -> None:
    """Write one result; an OSError is raised if that fails."""
    packed = io.BytesIO()
    text = np.frombuffer(json.dumps(document).encode(), np.uint8)
    np.savez_compressed(packed, document=text, **arrays)
    payload = packed.getvalue()
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, hashlib.sha256(payload).digest() + payload)


def _read(path: Path, corrupt: Path) -> tuple[Any, dict[str, Any]] | None:
    """Return the document and the arrays of a file.

    None is returned if the file does not exist or is damaged; a damaged file is moved to `corrupt`.
    """
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
        except (ValueError, KeyError, zipfile.BadZipFile):  # another program wrote the file
            pass
    sentence = f"a damaged result was moved to '{corrupt}' and is solved again"
    warnings.warn(CacheWarning(sentence), stacklevel=2)
    try:
        corrupt.mkdir(parents=True, exist_ok=True)
        if path.read_bytes() == raw:  # otherwise another process has replaced it by a valid file
            path.replace(corrupt / path.name)
    except OSError:  # the file no longer exists, or the folder cannot be written
        pass
    return None
