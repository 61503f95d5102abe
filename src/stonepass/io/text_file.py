"""Files: read text and write text or bytes, or else refuse in one sentence."""

from __future__ import annotations

import codecs
import os
import shutil
import threading
import unicodedata
from itertools import islice
from pathlib import Path

from stonepass.errors import BadInput, did_you_mean, require

__all__ = ["WRITING", "check_writable", "existing", "read_text", "replace_file", "write_file"]

MOST_NAMES = 1000  # files of a folder that are compared with a missing one
WRITING = threading.RLock()  # held while a file is half written; see `studies.executor`


def existing(path: Path, what: str = "file") -> Path:
    """Return the path of a file that exists.

    Raises
    ------
    BadInput
        There is no such file; a file of a similar name beside it is named.
    """
    try:
        there = path.is_file()
    except (OSError, ValueError):  # a name too long for the system, or with a NUL
        there = False
    if not there:
        raise BadInput(what, path, "a file that exists", _similar(path) or "check the path")
    return path


def _similar(path: Path) -> str:
    """Return ``did you mean 'x'`` with a file of a similar name; empty without one."""
    try:
        names = [each.name for each in islice(path.parent.iterdir(), MOST_NAMES) if each.is_file()]
    except (OSError, ValueError):
        return ""
    return did_you_mean(path.name, names, 0.75).removeprefix("; ")


def read_text(
    path: Path, largest: int, kind: str, what: str = "file", *, other_encodings: bool = False
) -> str:
    """The text of a file in UTF-8 of at most `largest` bytes, a byte order mark left out.

    With `other_encodings` also UTF-16 with its byte order mark, and Latin-1 where no UTF-8 is given
    and the text has no control characters.

    Raises
    ------
    BadInput
        Naming the file; `kind` is what it should have been.
    """
    existing(path, what)
    size = f"{largest // 1000} kB" if largest < 1_000_000 else f"{largest // 1_000_000} MB"
    try:
        require(path.stat().st_size <= largest, what, path, f"smaller than {size}")
        with path.open("rb") as file:
            raw = file.read(largest + 1)  # some files do not know their size
        require(len(raw) <= largest, what, path, f"smaller than {size}")
        return _decoded(raw) if other_encodings else raw.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as problem:
        raise BadInput(what, path, f"{kind} ({problem})") from problem


def _decoded(raw: bytes) -> str:
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = raw.decode("utf-16")
        if _has_control_characters(text):  # UTF-32 begins with the same bytes
            raise UnicodeDecodeError("utf-16", raw[:4], 0, 4, "control characters")
        return text
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
        if _has_control_characters(text):
            raise
        return text


def _has_control_characters(text: str) -> bool:
    return any(unicodedata.category(c) == "Cc" and c not in "\t\r\n" for c in set(text))


def check_writable(path: Path, endings: tuple[str, ...]) -> None:
    """Refuse an output file that could not be written, before the work is done.

    Raises
    ------
    BadInput
        The name has another ending than `endings` (in lower case), or its folder cannot be written
        to.
    """
    if path.suffix.lower() not in endings:
        raise BadInput("output file", str(path), "a name ending in " + ", ".join(endings))
    try:
        fits = not path.is_dir() and os.access(path.resolve().parent, os.W_OK)
        fits = fits and (not path.exists() or os.access(path, os.W_OK))
    except (OSError, ValueError):  # a name too long for the system, or with a NUL
        fits = False
    if not fits:
        raise BadInput("output file", str(path), "in a folder that can be written to")


def write_file(path: Path, content: str | bytes, what: str = "output file") -> None:
    """Write a file in one step; text is encoded in UTF-8.

    Raises
    ------
    BadInput
        It cannot be written. A file that was there before is then as it was.
    """
    try:
        replace_file(path, content if isinstance(content, bytes) else content.encode("utf-8"))
    except OSError as problem:
        raise BadInput(what, str(path), f"writable ({problem.strerror})") from problem


def replace_file(path: Path, content: bytes) -> None:
    """Write a file beside its place and move it there, so that nobody ever sees half of it.

    A link is followed. A device or a pipe is written to directly.

    Raises
    ------
    OSError
        It cannot be written, and what was there before is as it was.
    """
    target = path.resolve()
    if target.exists() and not target.is_file():
        target.write_bytes(content)
        return
    beside = target.with_name(f".{os.getpid()}.{threading.get_ident()}.new")
    with WRITING:
        try:
            beside.write_bytes(content)
            if target.exists():
                shutil.copymode(target, beside)
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)
