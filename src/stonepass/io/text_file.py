"""Reader of text files and writer of files, with errors in one sentence."""

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

ARCHIVE = b"PK\x03\x04"  # first bytes of a workbook of a spreadsheet, which is a ZIP archive
SAVE_AS_TEXT = "it is a workbook or another archive: export the table as CSV"
MOST_NAMES = 1000  # files of a folder that are compared with a missing one
WRITING = threading.RLock()  # held while a file is being written; see `studies.executor`


def existing(path: Path, what: str = "file") -> Path:
    """Return the path of an existing file.

    Parameters
    ----------
    path : Path
        The file.
    what : str
        Kind of the file in messages.

    Raises
    ------
    BadInput
        The file does not exist; a file of a similar name beside it is named.
    """
    try:
        there = path.is_file()
    except (OSError, ValueError):  # the name is too long for the system or contains a NUL
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
    """Return the text of a file.

    Parameters
    ----------
    path : Path
        The file.
    largest : int
        Largest size of the file in bytes.
    kind : str
        Description of a valid file in messages, e.g. "valid TOML".
    what : str
        Kind of the file in messages.
    other_encodings : bool
        True if UTF-16 (with a byte order mark) and Windows-1252 (of which Latin-1 is a part) are
        accepted in addition to UTF-8.

    Raises
    ------
    BadInput
        The file does not exist, is too large, or cannot be read or decoded.
    """
    existing(path, what)
    size = f"{largest // 1000} kB" if largest < 1_000_000 else f"{largest // 1_000_000} MB"
    try:
        require(path.stat().st_size <= largest, what, path, f"smaller than {size}")
        with path.open("rb") as file:
            raw = file.read(largest + 1)  # the size of a pipe or device is unknown
        require(len(raw) <= largest, what, path, f"smaller than {size}")
        return _decoded(raw) if other_encodings else raw.decode("utf-8-sig")
    except UnicodeDecodeError as problem:
        remedy = SAVE_AS_TEXT if raw.startswith(ARCHIVE) else "save it with the encoding UTF-8"
        raise BadInput(what, path, kind, remedy) from problem
    except OSError as problem:
        raise BadInput(what, path, f"{kind} ({problem})") from problem


def _decoded(raw: bytes) -> str:
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = raw.decode("utf-16")
        if _has_control_characters(text):  # UTF-32 has a similar byte order mark
            raise UnicodeDecodeError("utf-16", raw[:4], 0, 4, "control characters")
        return text
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("cp1252")
        if _has_control_characters(text):
            raise UnicodeDecodeError("cp1252", raw[:4], 0, 4, "control characters") from None
    if 4 * text.count("\0") > len(text):  # UTF-16 without a byte order mark
        raise UnicodeDecodeError("utf-8", raw[:4], 0, 4, "NUL characters")
    return text


def _has_control_characters(text: str) -> bool:
    return any(unicodedata.category(c) == "Cc" and c not in "\t\r\n" for c in set(text))


def check_writable(path: Path, endings: tuple[str, ...]) -> None:
    """Refuse an output file that cannot be written, before the calculation begins.

    Parameters
    ----------
    path : Path
        The output file.
    endings : tuple of str
        Allowed endings of its name, in lower case with the dot.

    Raises
    ------
    BadInput
        The name has another ending, or the file cannot be written.
    """
    if path.suffix.lower() not in endings:
        raise BadInput("output file", str(path), "a name ending in " + ", ".join(endings))
    try:
        fits = not path.is_dir() and os.access(path.resolve().parent, os.W_OK)
        fits = fits and (not path.exists() or os.access(path, os.W_OK))
    except (OSError, ValueError):  # the name is too long for the system or contains a NUL
        fits = False
    if not fits:
        raise BadInput("output file", str(path), "in a folder that can be written to")


def write_file(path: Path, content: str | bytes, what: str = "output file") -> None:
    """Write a file in one step; see `replace_file`.

    Parameters
    ----------
    path : Path
        File to write.
    content : str or bytes
        Content of the file; text is encoded in UTF-8.
    what : str
        Kind of the file in messages.

    Raises
    ------
    BadInput
        The file cannot be written. A previous file is then unchanged.
    """
    try:
        replace_file(path, content if isinstance(content, bytes) else content.encode("utf-8"))
    except OSError as problem:
        raise BadInput(what, str(path), f"writable ({problem.strerror})") from problem


def replace_file(path: Path, content: bytes) -> None:
    """Write a file under a temporary name and rename it, so that it is always complete.

    A symbolic link is followed. A device or a pipe is written directly.

    Parameters
    ----------
    path : Path
        File to write.
    content : bytes
        Content of the file.

    Raises
    ------
    OSError
        The file cannot be written. A previous file is then unchanged.
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
