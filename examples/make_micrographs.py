"""Make the micrographs of the examples: files of instruments with exactly known surfaces.

    python examples/make_micrographs.py [FOLDER]

writes ``known_slopes.png``, ``crystals.tif`` and ``crystals.x3p`` (the last one with
``pip install 'stonepass[imaging]'``).
"""

import re
import sys
from pathlib import Path
from zipfile import ZipFile, ZipInfo

import numpy as np
from PIL import Image, TiffImagePlugin

SEED = 2022


def known_profile(distance, k0=0.38, k1=0.12, orders=(8, 16)):
    """Return heights whose first baseline has the largest slope k0, and the deviation from it k1.

    The first part is a sum of terms of the first baseline. The second part consists of shorter
    waves and is orthogonal to all terms of the first baseline. The largest slopes of both parts are
    away from the ends.
    """
    t = distance / distance[-1]
    fine = np.linspace(0.0, 1.0, 20_001)
    generator = np.random.default_rng(SEED)

    def terms(x, order):
        waves = np.pi * np.arange(1, order + 1)
        return np.column_stack([np.ones_like(x), x, x**2, np.cos(np.outer(x, waves))])

    def inside(coefficients, order):
        """Return the largest slope, and whether it is away from the ends."""
        slopes = np.abs(np.gradient(terms(fine, orders[1]) @ coefficients, fine))
        return slopes.max() / distance[-1], abs(fine[slopes.argmax()] - 0.5) < 0.5 - 1.0 / order

    while True:
        first, second = np.zeros(3 + orders[1]), np.zeros(3 + orders[1])
        first[3 : 3 + orders[0]] = generator.normal(size=orders[0])
        second[3 + orders[0] :] = generator.normal(size=orders[1] - orders[0])
        basis, shorter = terms(fine, orders[0]), terms(fine, orders[1]) @ second
        second[: 3 + orders[0]] = -np.linalg.lstsq(basis, shorter, rcond=None)[0]
        (steep0, good0), (steep1, good1) = inside(first, orders[0]), inside(second, orders[1])
        if good0 and good1:
            parts = k0 / steep0 * first + k1 / steep1 * second
            return terms(t, orders[1]) @ parts


def cubic_crystals(rows=400, columns=512, pixel=0.5, edge=20.0, count=900):
    """Return heights in µm of a heap of cubes on their corners, each rotated about its diagonal."""
    generator = np.random.default_rng(SEED)
    grid = np.mgrid[0:rows, 0:columns] * pixel
    surface = np.full((rows, columns), -np.inf)
    span = np.array([columns, rows]) * pixel
    for _ in range(count):
        centre, size = generator.uniform(0.0, span), edge * generator.uniform(0.7, 1.1)
        top = generator.uniform(0.55, 1.0) * np.sqrt(3.0) * edge
        turn = generator.uniform(0.0, 2.0 * np.pi / 3.0)
        tilt = generator.normal(0.0, 0.12, 2)
        radius = size * np.sqrt(2.0 / 3.0)
        first = np.maximum(np.floor((centre - radius) / pixel), 0.0).astype(int)
        last = np.ceil((centre + radius) / pixel).astype(int) + 1
        window = slice(first[1], last[1]), slice(first[0], last[0])
        y, x = grid[:, *window]
        faces = []
        for k in range(3):
            angle = turn + 2.0 * np.pi * k / 3.0
            along = (x - centre[0]) * np.cos(angle) + (y - centre[1]) * np.sin(angle)
            faces.append(top - np.sqrt(2.0) * along)  # a face falls by √2 away from the corner
        cube = np.minimum.reduce(faces) + tilt[0] * (x - centre[0]) + tilt[1] * (y - centre[1])
        near = np.hypot(x - centre[0], y - centre[1]) < radius
        below = surface[window]
        surface[window] = np.where(near, np.maximum(below, cube), below)
    return surface - surface.min()


def write_png(folder):
    """A surface of known slopes along x, 8 bit, 0.5 µm a pixel, 24.8 µm from black to white."""
    distance = 0.5 * np.arange(1001)
    profile = known_profile(distance)
    grey = np.round(255.0 * (profile - profile.min()) / np.ptp(profile)).astype(np.uint8)
    Image.fromarray(np.tile(grey, (240, 1))).save(folder / "known_slopes.png", optimize=True)
    return float(np.ptp(profile))


def write_tiff(folder, heights, pixel=0.5):
    """The crystals as TESCAN writes them: its tag, and a data bar under the picture."""
    generator = np.random.default_rng(SEED)
    bar = 40
    grey = 20.0 + 215.0 * heights / heights.max() + generator.normal(0.0, 2.0, heights.shape)
    picture = np.clip(np.round(grey), 0, 255).astype(np.uint8)
    strip = np.zeros((bar, heights.shape[1]), np.uint8)
    strip[18:22, 20 : 20 + round(50.0 / pixel)] = 255  # 50 µm
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    text = (f"[MAIN]\r\nDeviceModel=TS5136MM\r\nImageStripSize={bar}\r\n"
            f"PixelSizeX={pixel * 1e-6:g}\r\nPixelSizeY={pixel * 1e-6:g}\r\n")  # fmt: skip
    tags[50431] = text.encode("latin-1")
    tags.tagtype[50431] = 1
    image = Image.fromarray(np.vstack([picture, strip]))
    image.save(folder / "crystals.tif", compression="tiff_adobe_deflate", tiffinfo=tags)


def write_x3p(folder, heights, pixel=0.5):
    """The crystals as a height map of a surface instrument."""
    from SurfaceTopography import Topography

    some = heights[:200, :256]
    sizes = (some.shape[1] * pixel * 1e-6, some.shape[0] * pixel * 1e-6)
    path = folder / "crystals.x3p"
    Topography(some.T * 1e-6, physical_sizes=sizes, unit="m").to_x3p(str(path), dtype="I")
    with_fixed_date(path)


def with_fixed_date(path):
    """Write an .x3p file again without the time at which it was written: equal at every run."""
    with ZipFile(path) as file:
        parts = {name: file.read(name) for name in file.namelist()}
    parts["main.xml"] = re.sub(rb"(Date>)[^<]+<", rb"\g<1>2026-01-01T00:00:00<", parts["main.xml"])
    with ZipFile(path, "w") as file:
        for name, content in parts.items():
            file.writestr(ZipInfo(name, (2026, 1, 1, 0, 0, 0)), content)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    print(f"height range of known_slopes.png: {write_png(folder):.4f} µm")
    heights = cubic_crystals()
    write_tiff(folder, heights)
    write_x3p(folder, heights)


if __name__ == "__main__":
    main()
