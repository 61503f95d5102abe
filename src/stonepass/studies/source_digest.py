"""A digest of the source code that a result depends on, without docstrings and comments."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable
from functools import lru_cache
from importlib import metadata
from pathlib import Path

from stonepass.io.text_file import replace_file

__all__ = ["code_digest", "solver_digest"]

# Version that a developer raises if results change for a reason outside the source code below.
NUMBERS = 1
PACKAGE = Path(__file__).parents[1]
SOURCES = ("fe", "materials", "model", "strain.py", "units.py", "studies/serialisation.py")
LIBRARIES = ("ngsolve", "numpy", "scipy", "autograd")


@lru_cache(maxsize=8)
def solver_digest(memory: Path) -> str:
    """Return a digest of everything that a result depends on, except its case.

    It covers the version `NUMBERS`, the versions of the numerical libraries, and the source code of
    the solver. Parsing the code takes about half a second; therefore the digest of the parsed code
    is stored in a file whose name is a digest of the unparsed files.

    Parameters
    ----------
    memory : Path
        Folder of these files. It is made if necessary; if it cannot be written, the code is parsed
        every time.
    """
    files = list(_files())
    versions = [str(NUMBERS), *(f"{name} {metadata.version(name)}" for name in LIBRARIES)]
    remembered = memory / _digest(part for name, source in files for part in (name, source))
    try:
        code = remembered.read_text(encoding="ascii")
    except (OSError, ValueError):
        code = code_digest(files)
        _remember(remembered, code)
    return _digest(part.encode() for part in (*versions, code))


def code_digest(files: Iterable[tuple[bytes, bytes]]) -> str:
    """Return a digest of Python files that ignores docstrings, comments and layout.

    Parameters
    ----------
    files : iterable of (bytes, bytes)
        Name and source code of each file.

    Examples
    --------
    >>> one = code_digest([(b"a.py", b'def f(x):\\n    "Double."\\n    return 2 * x')])
    >>> one == code_digest([(b"a.py", b"def f(x):\\n    return 2*x  # doubled")])
    True
    >>> one == code_digest([(b"a.py", b"def f(x):\\n    return 3 * x")])
    False
    """
    return _digest(
        part for name, source in files for part in (name, _without_docstrings(source).encode())
    )


def _files() -> Iterable[tuple[bytes, bytes]]:
    for name in SOURCES:
        path = PACKAGE / name
        for each in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            yield each.relative_to(PACKAGE).as_posix().encode(), each.read_bytes()


def _without_docstrings(source: bytes) -> str:
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            first = node.body[0] if node.body else None
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                del node.body[0]
    return ast.dump(tree)


def _digest(parts: Iterable[bytes]) -> str:
    digest = hashlib.sha256()
    for part in parts:
        digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()


def _remember(path: Path, code: str) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        replace_file(path, code.encode("ascii"))
    except OSError:  # without the file the digest is computed again the next time
        pass
