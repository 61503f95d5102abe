"""Variants of height-map files that SurfaceTopography does not take, made into those it does.

X3P files (ISO 25178-72) by R's x3ptools write the revision with a dash and may hold their parts in
a folder; Windows programs write paths with backslashes. Digital Surf files may be compressed: after
the header follow the number of streams, the raw and the packed length of each, and the zlib streams
(all unsigned, 32 bits, little-endian).
"""

from __future__ import annotations

import re
import struct
import zipfile
import zlib
from io import BytesIO
from pathlib import Path

from stonepass.errors import BadInput
from stonepass.surface.file_name import short_name
from stonepass.surface.limits import DECODED, check_unpacked

__all__ = ["mended_sur", "mended_x3p"]

MAIN = "main.xml"
REVISION = b"ISO5436 - 2000"  # what SurfaceTopography takes
REVISIONS = re.compile(
    rb"(<Revision>)\s*ISO\s*5436\s*(?:-|\xe2\x80[\x90-\x95]|\x96|\xad)\s*2000\s*(<)"
)
LINKS = re.compile(rb"<(PointDataLink|ValidPointsLink)>([^<]{0,500})<")
PLAIN, PACKED = b"DIGITAL SURF", b"DSCOMPRESSED"
HEADER = 512  # bytes before the comment of a Digital Surf file
SIZES = 334  # where the lengths of the comment and of the private zone stand, two bytes each
STREAMS = 64  # at most


def mended_x3p(path: Path) -> BytesIO | None:
    """Return an X3P file with its parts where they belong; None where they are.

    Raises
    ------
    BadInput
        Parts that are too large together.
    """
    if not zipfile.is_zipfile(path):
        return None
    with zipfile.ZipFile(path) as packed:
        parts = [part for part in packed.infolist() if not part.is_dir()]
        check_unpacked(short_name(path), sum(part.file_size for part in parts))
        names = {part.filename: part.filename.replace("\\", "/") for part in parts}
        folder = _folder(list(names.values()))
        if folder is None:
            return None
        inside = {old: new for old, new in names.items() if new.startswith(folder)}
        contents = next(old for old, new in inside.items() if new[len(folder) :].lower() == MAIN)
        written = packed.read(contents)
        main = _mended_main(written)
        if main == written and all(old == new[len(folder) :] for old, new in inside.items()):
            return None
        stream = BytesIO()
        with zipfile.ZipFile(stream, "w") as mended:
            mended.writestr(MAIN, main)
            for old, new in inside.items():
                if old != contents:
                    mended.writestr(new[len(folder) :], packed.read(old))
    stream.seek(0)
    return stream


def _folder(names: list[str]) -> str | None:
    """The folder, with its slash, of the uppermost table of contents; None where there is none."""
    found = [name[: -len(MAIN)] for name in names if f"/{name}".lower().endswith(f"/{MAIN}")]
    return min(found, key=lambda folder: folder.count("/"), default=None)


def _mended_main(main: bytes) -> bytes:
    """The table of contents with the revision and the links as SurfaceTopography takes them."""
    main = REVISIONS.sub(rb"\g<1>" + REVISION + rb"\g<2>", main)
    return LINKS.sub(
        lambda link: b"<%s>%s<" % (link.group(1), link.group(2).strip().replace(b"\\", b"/")), main
    )


def mended_sur(path: Path) -> BytesIO | None:
    """Return a Digital Surf file without compression; None where it has none.

    Raises
    ------
    BadInput
        Streams that are too large or damaged.
    """
    with path.open("rb") as file:
        head = file.read(HEADER)
        if not head.startswith(PACKED) or len(head) < HEADER:
            return None
        between = file.read(sum(struct.unpack_from("<HH", head, SIZES)))
        (count,) = struct.unpack("<I", file.read(4))
        if count > STREAMS:
            raise BadInput("image", short_name(path), f"undamaged (it names {count} streams)")
        lengths = struct.unpack(f"<{2 * count}I", file.read(8 * count))
        raw, packed = lengths[::2], lengths[1::2]
        check_unpacked(short_name(path), sum(raw))
        stream = BytesIO()
        stream.write(PLAIN + head[len(PLAIN) :] + between)
        for long, short in zip(raw, packed, strict=True):
            stream.write(zlib.decompressobj().decompress(file.read(min(short, DECODED)), long))
    stream.seek(0)
    return stream
