"""Finite-element results on disk, by what they depend on: the case and the solver's own source.

One file for one result: SHA-256 of what follows, then a zip of JSON and arrays (NumPy's, without
pickle). A file whose digest is wrong is set aside in ``corrupt/`` and its result solved again.
Files are written beside their place and moved there in one step, so processes may share a folder.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, is_dataclass, replace
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
import platformdirs

from stonepass.errors import BadInput
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case import Case
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded import Critical, NoPush
from stonepass.model.states.seated import NoSeat, SeatedState
from stonepass.model.states.uncached import UNCACHED
from stonepass.studies.serialisation import deserialise, serialise

__all__ = ["SolutionCache", "default_folder"]

DIGEST = hashlib.sha256().digest_size
SOLVER = ("fe", "materials", "model")  # folders whose source the results depend on
LIBRARIES = ("ngsolve", "numpy", "scipy")
CORRUPT = "corrupt"

Found = TypeVar("Found")


def default_folder() -> Path:
    """The user's cache folder for this software; ``STONEPASS_CACHE`` names another."""
    named = os.environ.get("STONEPASS_CACHE")
    return Path(named) if named else Path(platformdirs.user_cache_dir("stonepass"))


@dataclass(frozen=True)
class SolutionCache:
    """Remembers finite-element results in `folder`; with `walls` those with their stress fields.

    Results depend on ratios alone, so cases of another size share theirs, as do those that differ
    only in closure, sign or far field. A law that is a Python function is solved afresh every time.
    """

    folder: Path
    walls: bool = False

    def seat(self, case: Case, resolution: Resolution | None) -> SeatedState | NoSeat:
        """See `model.states.seated.seat`."""
        asked = {"seating": case.method.seating, "friction": case.seating_friction}

        def solve() -> SeatedState | NoSeat:
            found = UNCACHED.seat(case, resolution)
            return found if self.walls or isinstance(found, NoSeat) else replace(found, wall=None)

        return self._remembered("seat", case, asked | _mesh(case, resolution), solve)

    def push(
        self, case: Case, resolutions: Sequence[Resolution], *, leak: bool
    ) -> list[Critical | NoPush]:
        """See `model.states.loaded.critical_push`."""
        asked = {
            "friction": case.stone.friction,
            "wetted": case.method.wetted,
            "leak": leak,
            "resolutions": [asdict(each) for each in resolutions],
        }

        def solve() -> tuple[Critical | NoPush, ...]:
            return tuple(map(self._slim, UNCACHED.push(case, resolutions, leak=leak)))

        return list(self._remembered("push", case, asked, solve))

    def pairs(self, case: Case) -> OpeningCurve | None:
        """See `model.states.opening.solve_opening_curve`."""
        return self._remembered("pairs", case, {}, lambda: UNCACHED.pairs(case))

    def set_aside(self) -> int:
        """How many corrupt files were found so far."""
        return len(list((self.folder / CORRUPT).glob("*")))

    def _slim(self, found: Critical | NoPush) -> Critical | NoPush:
        if self.walls or isinstance(found, NoPush):
            return found
        return replace(found, state=replace(found.state, wall=None))

    def _remembered(
        self,
        what: str,
        case: Case,
        asked: dict[str, Any],
        solve: Callable[[], Found],
    ) -> Found:
        key = _key(what, case, asked | {"walls": self.walls})
        if key is None:
            return solve()
        path = self.folder / key[:2] / key
        known = _read(path, self.folder / CORRUPT)
        if known is not None:
            return cast(Found, deserialise(known[0], known[1], case))
        found = solve()
        _write(path, *serialise(found))
        return found


def _mesh(case: Case, resolution: Resolution | None) -> dict[str, Any]:
    if resolution is None:
        return {"accuracy": case.method.accuracy}
    return {"resolution": asdict(resolution)}


def _key(what: str, case: Case, asked: dict[str, Any]) -> str | None:
    """Digest of all that a result depends on; None where the law cannot be written down."""
    law = case.ureter.material.law
    if not is_dataclass(law) or isinstance(law, type):
        return None
    if not type(law).__module__.startswith("stonepass.materials"):  # its source is not in the key
        return None
    document = {
        "what": what,
        "solver": _solver(),
        "size_ratio": case.size_ratio,
        "aspect": case.stone.shape.aspect,
        "outline": case.stone.shape.outline,
        "wall_ratio": case.wall_ratio,
        "material": case.ureter.material.name,
        "law": type(law).__name__,
        "constants": asdict(law),
        "strain_range": case.ureter.material.strain_range,
        "load": asdict(case.load),
        "half_length": case.method.half_length,
        **asked,
    }
    try:
        text = json.dumps(document, sort_keys=True, allow_nan=False)
    except (TypeError, ValueError):  # a law that holds a function
        return None
    return hashlib.sha256(text.encode()).hexdigest()


@lru_cache(maxsize=1)
def _solver() -> str:
    """Digest of the solver's source and of the libraries under it."""
    digest = hashlib.sha256()
    root = Path(__file__).parents[1]
    sources = [each for name in SOLVER for each in (root / name).rglob("*.py")]
    for path in sorted([*sources, root / "studies" / "serialisation.py"]):
        digest.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    for library in LIBRARIES:
        digest.update(metadata.version(library).encode())
    return digest.hexdigest()


def _write(path: Path, document: Any, arrays: dict[str, Any]) -> None:
    packed = io.BytesIO()
    text = np.frombuffer(json.dumps(document).encode(), np.uint8)
    np.savez_compressed(packed, document=text, **arrays)
    payload = packed.getvalue()
    beside = path.with_name(f"{path.name}.{os.getpid()}.new")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        beside.write_bytes(hashlib.sha256(payload).digest() + payload)
        beside.replace(path)
    except OSError as problem:
        raise BadInput("cache folder", str(path.parent), f"writable ({problem.strerror})",
                       "name another one, or none") from problem  # fmt: skip


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
    try:
        corrupt.mkdir(parents=True, exist_ok=True)
        if path.read_bytes() == raw:  # else another process has mended it meanwhile
            path.replace(corrupt / path.name)
    except OSError:  # gone, or a folder that cannot be written: solved again all the same
        pass
    return None
