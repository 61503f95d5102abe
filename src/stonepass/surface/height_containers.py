"""Conversion of height-map files that the library SurfaceTopography does not read as they are.

X3P files (ISO 25178-72) are zip archives. The R package x3ptools writes the revision with a dash
and may put the members of the archive into a folder; Windows programs write paths with backslashes.
Digital Surf files may be compressed. After their header follow the number of zlib streams, the
unpacked and packed length of each stream (all as unsigned 32-bit little-endian integers), and the
streams.
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
REVISION = b"ISO5436 - 2000"  # the spelling that SurfaceTopography accepts
REVISIONS = re.compile(
    rb"(<Revision>)\s*ISO\s*5436\s*(?:-|\xe2\x80[\x90-\x95]|\x96|\xad)\s*2000\s*(<)"
)
LINKS = re.compile(rb"<(PointDataLink|ValidPointsLink)>([^<]{0,500})<")
PLAIN, PACKED = b"DIGITAL SURF", b"DSCOMPRESSED"
HEADER = 512  # bytes before the comment of a Digital Surf file
SIZES = 334  # offset of the lengths of the comment and of the private zone, two bytes each
STREAMS = 64  # largest number of streams that is accepted


def mended_x3p(path: Path) -> BytesIO | None:
    """Return a converted copy of an X3P file, or None if the file needs no conversion.

    Raises
    ------
    BadInput
        The members of the archive are larger than 90 MB in total.
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
    """Return the least nested folder, with its slash, that contains main.xml; None without one."""
    found = [name[: -len(MAIN)] for name in names if f"/{name}".lower().endswith(f"/{MAIN}")]
    return min(found, key=lambda folder: folder.count("/"), default=None)


def _mended_main(main: bytes) -> bytes:
    """Return main.xml with the revision and the links in the form that SurfaceTopography reads."""
    main = REVISIONS.sub(rb"\g<1>" + REVISION + rb"\g<2>", main)
    return LINKS.sub(
        lambda link: b"<%s>%s<" % (link.group(1), link.group(2).strip().replace(b"\\", b"/")), main
    )


def mended_sur(path: Path) -> BytesIO | None:
    """Return an uncompressed copy of a Digital Surf file, or None if the file is not compressed.

    Raises
    ------
    BadInput
        The file has more than 64 streams, or they are larger than 90 MB in total.
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
