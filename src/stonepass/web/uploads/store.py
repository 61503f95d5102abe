"""The uploaded files that the server holds in memory until a job uses them."""

from __future__ import annotations

import hashlib
import tempfile
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import astuple, dataclass, field, replace
from pathlib import Path
from time import monotonic
from typing import Any

from stonepass.sandbox.sandbox import Limits, parse_in_sandbox
from stonepass.surface.surface_image import PixelArea
from stonepass.web.api_words import FILE, UPLOAD
from stonepass.web.settings import ServerLimits

__all__ = ["Upload", "UploadStore", "as_file", "read_upload"]

TASK = "stonepass.web.uploads.reader"
PREVIEW = 16_000_000  # largest number of bytes of a preview
WHAT = {"fit": "table", "friction": "image"}  # how messages call the file


@dataclass(frozen=True)
class Upload:
    """An uploaded file.

    Attributes
    ----------
    id : str
        Digest of the kind, the content and the area.
    kind : str
        Kind of the job that may use it, ``fit`` or ``friction``.
    ending : str
        Ending of the name under which it is read.
    content : bytes
    summary : dict
        Description of the content of the file.
    area : tuple of 4 int, or None
        Part of the picture that belongs to the surface, as the client gave it.
    preview : bytes
        The picture as PNG; empty for a table.
    used : float
        Time of the last use.
    """

    id: str
    kind: str
    ending: str
    content: bytes = field(repr=False)
    summary: dict[str, Any]
    area: tuple[int, ...] | None = None
    preview: bytes = field(default=b"", repr=False)
    used: float = field(default_factory=monotonic)


class UploadStore:
    """Uploaded files by their ids; the oldest are dropped when there are too many bytes."""

    def __init__(self, limits: ServerLimits) -> None:
        self._limits = limits
        self._held: OrderedDict[str, Upload] = OrderedDict()

    def add(self, upload: Upload) -> None:
        """Hold a file."""
        self._held[upload.id] = upload
        self._held.move_to_end(upload.id)
        while sum(map(_size, self._held.values())) > self._limits.uploads:
            self._held.popitem(last=False)

    def get(self, identity: str) -> Upload | None:
        """Return a file, which is then held for some more time; None if it is not held."""
        self.drop_old()
        upload = self._held.get(identity)
        if upload is not None:
            self._held[identity] = upload = replace(upload, used=monotonic())
        return upload

    def drop(self, identity: str) -> bool:
        """Drop a file; return False if it was not held."""
        return self._held.pop(identity, None) is not None

    def drop_old(self) -> None:
        """Drop the files that no job has used for a while."""
        last = monotonic() - self._limits.upload_seconds
        for each in [each for each in self._held.values() if each.used < last]:
            del self._held[each.id]


def _size(upload: Upload) -> int:
    return len(upload.content) + len(upload.preview)


def read_upload(kind: str, ending: str, content: bytes, area: PixelArea | None = None) -> Upload:
    """Read an uploaded file in the sandbox and return it with its summary.

    Parameters
    ----------
    kind : str
        Kind of the job that may use it, ``fit`` or ``friction``.
    ending : str
        Ending of the name under which it is read, chosen by the server.
    content : bytes
    area : PixelArea, optional
        Part of the picture that belongs to the surface; only this part must be grey.

    Raises
    ------
    BadInput
        The file is damaged, of another kind, or needs too much time or memory.
    """
    about = (kind.encode(), ending.encode(), str(area or "").encode(), content)
    identity = hashlib.sha256(b"\0".join(about)).hexdigest()
    numbers = None if area is None else astuple(area)
    limits = Limits(body=PREVIEW)
    with as_file(ending, content) as path:
        request = {"kind": kind, "path": str(path), "area": numbers}
        summary, preview = parse_in_sandbox(TASK, request, limits, WHAT[kind], UPLOAD)
    return Upload(identity, kind, ending, content, summary, numbers, preview)


@contextmanager
def as_file(ending: str, content: bytes) -> Iterator[Path]:
    """Yield a file with this content in a private folder, which is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="stonepass-") as folder:
        path = Path(folder) / f"{FILE}{ending}"
        path.write_bytes(content)
        yield path
