"""Files of pictures for the tests: good ones of every instrument, and bad ones of every kind."""

import struct
import zipfile
import zlib

import numpy as np
import tifffile
from PIL import Image
from SurfaceTopography import Topography

MICRO = 1e-6
ZEISS = "0\r\nAP_IMAGE_PIXEL_SIZE\r\nImage Pixel Size = 250.0 nm\r\nAP_PIXEL_SIZE\r\nPixel Size = 500 nm\r\n"
FEI = "[Scan]\r\nPixelWidth=2.5e-007\r\nPixelHeight=2e-007\r\n[Image]\r\nResolutionX=80\r\nResolutionY=50\r\n"
TESCAN = "[MAIN]\r\nPixelSizeX=2.5e-007\r\nPixelSizeY=2.5e-007\r\nImageStripSize=10\r\n"


def some_grey(rows=60, columns=80, bits=8):
    generator = np.random.default_rng(1)
    full = 2**bits - 1
    return generator.integers(0, full, (rows, columns)).astype(np.uint8 if bits == 8 else np.uint16)


def save_tiff(path, values, **more):
    tifffile.imwrite(path, values, **more)
    return path


def sur_file(path, heights, step):
    """A Digital Surf file: heights in µm, 16 bit, `step` µm apart."""
    rows, columns = heights.shape
    scale = np.ptp(heights) / 60000.0
    numbers = np.round((heights - heights.mean()) / scale).astype("<i2")
    text = lambda value, size: value.encode().ljust(size, b" ")  # noqa: E731
    head = struct.pack("<12sHHHH30s30sHHHHHII", b"DIGITAL SURF", 0, 1, 1, 2, b"x".ljust(30),
                       b"y".ljust(30), 0, 0, 0, 0, 1, 0, 0)  # fmt: skip
    head += struct.pack("<HiiiiIfff", 16, int(numbers.min()), int(numbers.max()), columns, rows,
                        rows * columns, step, step, scale)  # fmt: skip
    head += b"".join(text(name, 16) for name in ("X", "Y", "Z", "um", "um", "um", "um", "um", "um"))
    head += struct.pack("<fffHHHIIIHHHHHHHfIIHHH128sfff34b", 1.0, 1.0, 1.0, 0, 0, 0, 0, 0, 0, 1, 1, 1,
                        1, 1, 2020, 1, 1.0, 0, 0, 0, 0, 0, b"", 0.0, 0.0, 0.0, *[0] * 34)  # fmt: skip
    path.write_bytes(head + numbers.tobytes())
    return path


def packed_sur(path, plain, streams=2):
    """A compressed Digital Surf file of the bytes of a plain one, whose comment is empty."""
    body = plain[512:]
    step = -(-len(body) // streams)
    parts = [body[start : start + step] for start in range(0, len(body), step)]
    packed = [zlib.compress(part, 1) for part in parts]
    head = b"DSCOMPRESSED" + plain[12:512] + struct.pack("<I", len(parts))
    for part, short in zip(parts, packed, strict=True):
        head += struct.pack("<II", len(part), len(short))
    path.write_bytes(head + b"".join(packed))
    return path


def moved_x3p(path, source, prefix="", revision="ISO5436 – 2000", slash="/"):
    """An X3P file as other programs write it: parts in a folder, another dash, backslashes."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            body = old.read(name)
            if name == "main.xml":
                body = body.replace(b"ISO5436 - 2000", revision.encode())
                body = body.replace(b"bindata/", f"bindata{slash}".encode())
            new.writestr((prefix + name).replace("/", slash), body)
    return path


def al3d_file(path, heights, step):
    """An Alicona file: heights in µm as 32-bit floats in m, `step` µm apart."""
    rows, columns = heights.shape
    padded = (columns * 4 + 7) // 8 * 8 // 4
    data = np.zeros((rows, padded), "<f4")
    data[:, :columns] = heights * MICRO

    def tag(key, value):
        return key.encode().ljust(20, b"\0") + str(value).encode().ljust(30, b"\0") + b"\r\n"

    magic = b"AliconaImaging\0\r\n"
    fields = {"Rows": rows, "Cols": columns, "PixelSizeXMeter": step * MICRO,
              "PixelSizeYMeter": step * MICRO, "InvalidPixelValue": "NaN"}  # fmt: skip
    offset = len(magic) + 52 * (3 + len(fields)) + 256
    body = magic + tag("Version", 1) + tag("TagCount", len(fields) + 1)
    body += b"".join(tag(*each) for each in fields.items()) + tag("DepthImageOffset", offset)
    path.write_bytes(body.ljust(offset, b"\0") + data.tobytes())
    return path


def header_of(path, rows, columns, kind):
    """A file whose header promises rows × columns, and that has next to nothing."""
    if kind == "png":
        chunk = struct.pack(">4sIIBBBBB", b"IHDR", columns, rows, 8, 0, 0, 0, 0)
        end = struct.pack(">I4s", 0, b"IEND") + struct.pack(">I", zlib.crc32(b"IEND"))
        body = struct.pack(">I", 13) + chunk + struct.pack(">I", zlib.crc32(chunk))
        data = zlib.compress(b"\0" * 1000)
        idat = b"IDAT" + data
        body += struct.pack(">I", len(data)) + idat + struct.pack(">I", zlib.crc32(idat))
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + body + end)
    else:
        tags = [(256, 4, 1, columns), (257, 4, 1, rows), (258, 3, 1, 8), (259, 3, 1, 1),
                (262, 3, 1, 1), (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, rows),
                (279, 4, 1, 1000)]  # fmt: skip
        directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *t) for t in tags)
        path.write_bytes(b"II*\0" + struct.pack("<I", 1008) + b"\0" * 1000 + directory + b"\0" * 4)
    return path


def hostile(folder):
    """Name of a file to what its refusal says."""
    made = {}

    def make(name, sentence, content=None):
        made[name] = sentence
        if content is not None:
            (folder / name).write_bytes(content)
        return folder / name

    make("empty.png", "not empty", b"")
    make("words.png", "a TIFF, PNG or JPEG file, or a height map", b"these are words, no picture")
    make("wrong.jpg", "a TIFF, PNG or JPEG file", b"GIF89a" + b"\0" * 100)
    make("nothing.tif", "a file that exists")
    header_of(make("huge.png", "at most 40 million pixels"), 100_000, 100_000, "png")
    header_of(make("huge.tif", "at most 40 million pixels"), 100_000, 100_000, "tif")
    header_of(make("long.tif", "at most 40 million pixels"), 20, 2**31, "tif")
    header_of(make("short.tif", "undamaged"), 4000, 4000, "tif")
    header_of(make("tiny.png", "at least 16 × 16"), 5, 5, "png")
    bomb = make("bomb.png", "at most 40 million pixels")
    Image.fromarray(np.zeros((8000, 8000), np.uint8)).save(bomb)
    Image.fromarray(np.zeros((16, 600_000), np.uint8)).save(
        make("wide.png", "at most 20000 pixels long")
    )
    whole = folder / "whole.png"
    Image.fromarray(some_grey(300, 300)).save(whole)
    raw = whole.read_bytes()
    make("cut.png", "undamaged", raw[: len(raw) // 2])
    save_tiff(folder / "whole.tif", some_grey(300, 300), compression="zlib")
    raw = (folder / "whole.tif").read_bytes()
    make("cut.tif", "undamaged", raw[: len(raw) // 2])
    make("stub.tif", "undamaged", b"II*\0")
    loop = b"II*\0" + struct.pack("<IH", 8, 0) + struct.pack("<I", 8)
    make("loop.tif", "8 or 16 bits", loop)
    save_tiff(make("float.tif", "8 or 16 bits"), np.full((40, 40), np.nan, np.float32))
    save_tiff(make("deep.tif", "8 or 16 bits"), np.zeros((40, 40), np.uint32))
    save_tiff(make("signed.tif", "8 or 16 bits"), np.zeros((40, 40), np.int16))
    Image.new("1", (40, 40)).save(make("bits.png", "grey, of 8 or 16 bit"))
    colours = np.stack([some_grey(), some_grey()[::-1], some_grey()], axis=-1)
    Image.fromarray(colours).save(make("colour.png", "in colour, but must be grey"))
    save_tiff(make("colour.tif", "in colour, but must be grey"), colours, photometric="rgb")
    Image.fromarray(colours).convert("CMYK").save(make("cmyk.jpg", "grey, of 8 or 16 bit"))
    make("fake.x3p", "undamaged", b"PK\3\4" + b"\0" * 200)
    make("fake.sur", "undamaged", b"DIGITAL SURF" + b"\xff" * 600)
    make("fake.al3d", "undamaged", b"AliconaImaging\0\r\n" + b"\xff" * 600)
    sur = sur_file(folder / "map.sur", np.random.default_rng(1).normal(size=(30, 30)), 1.0)
    head = bytearray(sur.read_bytes())
    head[108:120] = struct.pack("<iiI", 100_000, 100_000, 100_000 * 100_000 % 2**32)
    make("huge.sur", "undamaged", bytes(head))
    packed = zipfile.ZipFile(
        make("bomb.x3p", "of at most 90 MB unpacked"), "w", zipfile.ZIP_DEFLATED
    )
    with packed, packed.open("main.xml", "w") as inner:
        inner.write(b"<a>")
        for _ in range(200):
            inner.write(b"x" * 1_000_000)
    return made


def valid(folder):
    """Name of one small valid file of each kind to its bytes."""
    generator = np.random.default_rng(1)
    heights = generator.normal(size=(20, 24))
    Image.fromarray(some_grey(20, 24)).save(folder / "a.png")
    Image.fromarray(some_grey(20, 24, 16)).save(folder / "deep.png")
    Image.fromarray(some_grey(20, 24)).save(folder / "a.jpg")
    Image.fromarray(some_grey(20, 24)).save(folder / "lzw.tif", compression="tiff_lzw")
    fei = (34682, "s", 0, FEI, True)
    save_tiff(folder / "a.tif", some_grey(20, 24), extratags=[fei])
    zeiss = (34118, "s", 0, ZEISS, True)
    save_tiff(folder / "z.tif", some_grey(20, 24, 16), compression="zlib", extratags=[zeiss])
    sur_file(folder / "a.sur", heights, 1.0)
    al3d_file(folder / "a.al3d", heights, 1.0)
    sizes = (24 * MICRO, 20 * MICRO)
    Topography(heights.T * MICRO, sizes, unit="m").to_x3p(str(folder / "a.x3p"), dtype="I")
    packed_sur(folder / "packed.sur", (folder / "a.sur").read_bytes())
    moved_x3p(folder / "moved.x3p", folder / "a.x3p", "scan/")
    with tifffile.TiffWriter(folder / "pages.tif") as file:
        file.write(some_grey(16, 16), photometric="minisblack", subfiletype=1)
        file.write(some_grey(20, 24), photometric="minisblack")
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}
