"""Friction from a micrograph: slopes that are known exactly, damaged and hostile files."""

from __future__ import annotations

import importlib.util
import os
import resource
import subprocess
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from page import Check, Section

from stonepass.surface.baseline import fit_baseline
from stonepass.surface.friction import surface_friction
from stonepass.surface.paths import StraightPath
from stonepass.surface.surface_image import Area, SurfaceImage

ROOT = Path(__file__).parents[1]
MICRO = 1e-6
LENGTH = 500.0  # µm, of every path
PIXELS = (0.25, 0.5, 1.0, 2.0)  # µm
ANGLES = (0, 30, 45, 90)  # degrees, of the slopes and the paths in the picture
BITS = (8, 16)
NOISE = (0.0, 0.01, 0.02, 0.05)  # standard deviation of every pixel over the height range
PATHS = 6
EXACT = 0.5 / (1.0 - 0.38 * 0.12)
# Largest relative error of the friction coefficient for each noise; where it comes from is said on
# the page.
BOUNDS = dict(zip(NOISE, (0.005, 0.02, 0.05, 0.10), strict=True))
ORDERS, SHARES = (8, 16, 32), (0.25, 0.5, 0.75, 0.9, 1.0, 1.2)
FOLLOWED, LARGEST_RATIO = 0.75, 0.05
TRIED = 20_000
SEED = 20250
LARGEST_TIME, LARGEST_MEMORY = 5.0, 500.0  # s, MB


def section() -> Section:
    sys.path.insert(0, str(ROOT / "tests"))
    errors = known_answers()
    waves = followed()
    apart = max(abs(r - 1.0) for (_, s), found in waves.items() if s <= FOLLOWED for r in found)
    fuzzed = fuzz()
    refused = hostile_files()
    by_noise = {noise: largest(errors, 3, noise) for noise in NOISE}
    rows = [
        [what, *(f"{largest(errors, k, value, noise):.2%}" for noise in NOISE)]
        for k, name, values in ((0, "pixel {} µm", PIXELS), (1, "turned by {}°", ANGLES),
                                (2, "{} bit", BITS))
        for value in values
        for what in (name.format(value),)
    ]  # fmt: skip
    odd = sum(count for (_, how), count in fuzzed.items() if how not in ("read", "refused"))
    kinds = sorted({kind for kind, _ in fuzzed})
    slowest, biggest = max(r[2] for r in refused), max(r[3] for r in refused)
    wrong = [name for name, good, _, _ in refused if not good]
    return Section(
        title="Friction from a micrograph",
        text=(
            "Surfaces whose mean profile has a baseline of slope 0.38 and a deviation of slope "
            f"0.12, exactly, so that μ = {EXACT:.4f}: {len(errors)} pictures, all pixel sizes, "
            "directions, bit depths and noise levels together; paths of 500 µm, six for each "
            "picture. Noise is of every pixel for itself, its standard deviation over the height "
            "range. "
            "What it costs is the scale: the range of greys grows by the noise of the darkest and "
            "brightest places, so that slopes come out too small; that is why the range is taken "
            "after averaging over 5 × 5 pixels. Single profiles keep their noise: the slope by "
            "root mean square is not compared."
        ),
        tables=[
            ("Largest error of μ, relative, over the noise:",
             ("", *(f"{noise:.0%}" for noise in NOISE)), rows),
            ("Slope of a baseline over that of a wave, median and largest of 24 phases, by the "
             "wave's frequency over the highest that the baseline follows (a wave is no sum of "
             "its terms):",
             ("order", *(f"{share:g}" for share in SHARES)),
             [[str(order), *(f"{np.median(waves[order, s]):.2f}, {max(waves[order, s]):.2f}"
                             for s in SHARES)] for order in ORDERS]),
            (f"{TRIED} damaged files (bytes changed or left out, some cut short), seed {SEED}:",
             ("kind", "read", "refused in one sentence", "anything else"),
             [[kind, *(str(fuzzed[kind, how]) for how in ("read", "refused")),
               str(sum(c for (k, how), c in fuzzed.items()
                       if k == kind and how not in ("read", "refused")))] for kind in kinds]),
            ("Hostile files by the command, as a process:",
             ("file", "s", "MB"),
             [[name, f"{seconds:.1f}", f"{memory:.0f}"] for name, _, seconds, memory in refused]),
        ],
        checks=[
            *(Check(f"μ of known slopes within {BOUNDS[noise]:.1%} at noise {noise:.0%}",
                    f"{error:.2%} at most", error <= BOUNDS[noise])
              for noise, error in by_noise.items()),
            Check(f"waves of up to {FOLLOWED:g} of the highest frequency have their slope within "
                  f"{LARGEST_RATIO:.0%}", f"{apart:.1%} at most", apart <= LARGEST_RATIO),
            Check("a damaged file is read or refused in one sentence, whatever the damage",
                  f"{sum(fuzzed.values())} tried, {odd} ended otherwise",
                  odd == 0 and sum(fuzzed.values()) == TRIED),
            Check("hostile files: one sentence, exit 2", f"{len(refused)} files, not so: "
                  f"{', '.join(wrong) or 'none'}", not wrong and len(refused) >= 25),
            Check(f"within {LARGEST_TIME:g} s and {LARGEST_MEMORY:g} MB for its largest process",
                  f"{slowest:.1f} s, {biggest:.0f} MB",
                  slowest <= LARGEST_TIME and biggest <= LARGEST_MEMORY),
        ],
    )  # fmt: skip


def maker():
    spec = importlib.util.spec_from_file_location("maker", ROOT / "examples/make_micrographs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def known_answers() -> list[tuple[float, int, int, float, float]]:
    """Pixel, angle, bits, noise, and the relative error of the friction coefficient."""
    distance = np.linspace(0.0, LENGTH, 20_001)
    heights = maker().known_profile(distance)
    generator = np.random.default_rng(SEED)
    found = []
    for pixel, angle, bits, noise in product(PIXELS, ANGLES, BITS, NOISE):
        picture, paths = surface(distance, heights, pixel, angle, bits, noise, generator)
        friction = surface_friction(picture, f"{np.ptp(heights):.12g} um", paths).friction
        found.append((pixel, angle, bits, noise, abs(friction / EXACT - 1.0)))
    return found


def surface(distance, heights, pixel, angle, bits, noise, generator):
    """A picture of heights that vary in one direction only, and six paths along it."""
    along = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    across = np.array([-along[1], along[0]])
    apart = 12.0 * pixel
    offsets = apart * (np.arange(PATHS) - (PATHS - 1) / 2.0)
    ends = np.array([[s * along * LENGTH / 2 + o * across for s in (-1.0, 1.0)] for o in offsets])
    margin = 8.0 * pixel
    low = ends.reshape(-1, 2).min(axis=0) - margin
    columns, rows = np.ceil((ends.reshape(-1, 2).max(axis=0) + margin - low) / pixel).astype(int)
    x, y = np.meshgrid(np.arange(columns) * pixel + low[0], np.arange(rows) * pixel + low[1])
    place = x * along[0] + y * along[1] + LENGTH / 2
    z = np.interp(place, distance, heights)  # level beyond the ends of the paths
    share = (z - heights.min()) / np.ptp(heights) + noise * generator.normal(size=z.shape)
    full = 2**bits - 1
    room = 0.5 / (0.5 + 4.5 * noise)  # contrast that leaves room for the noise
    grey = np.clip(np.round(full * (0.5 + room * (share - 0.5))), 0, full)
    values = grey.astype(np.uint8 if bits == 8 else np.uint16)
    picture = SurfaceImage(values, (pixel * MICRO, pixel * MICRO), full, Area(0, 0, columns, rows))
    return picture, [StraightPath(*((end - low) / pixel).ravel()) for end in ends]


def followed() -> dict[tuple[int, float], list[float]]:
    """Steepest slope of a baseline over that of a sine, by order and frequency."""
    distance = np.linspace(0.0, LENGTH, 2001)
    found = {}
    for order, share in product(ORDERS, SHARES):
        number = np.pi * order * share / LENGTH
        phases = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
        found[order, share] = [
            fit_baseline(distance, np.sin(number * distance + phase), order).steepest / number
            for phase in phases
        ]
    return found


def largest(errors, which, value, noise=None):
    return max(e[4] for e in errors if e[which] == value and (noise is None or e[3] == noise))


def fuzz() -> Counter:
    """How damaged files end, by kind, tried in several processes."""
    cores = os.cpu_count() or 1
    shares = [(SEED + k, TRIED // cores + (k < TRIED % cores)) for k in range(cores)]
    with ProcessPoolExecutor(cores, mp_context=get_context("spawn")) as pool:
        return sum(pool.map(fuzz_some, shares), Counter())


def fuzz_some(share: tuple[int, int]) -> Counter:
    seed, count = share
    sys.path.insert(0, str(ROOT / "tests"))
    from picture_files import valid

    from stonepass.errors import BadInput
    from stonepass.surface.readers import read_surface_image

    resource.setrlimit(resource.RLIMIT_DATA, (2_000_000_000, 2_000_000_000))
    generator = np.random.default_rng(seed)
    ended: Counter = Counter()
    with TemporaryDirectory() as folder:
        whole = valid(Path(folder))
        names = sorted(whole)
        for k in range(count):
            name = names[k % len(names)]
            raw = bytearray(whole[name])
            for _ in range(int(generator.integers(1, 8))):
                at = int(
                    generator.integers(
                        0, min(len(raw), 600 if generator.random() < 0.7 else len(raw))
                    )
                )
                some = generator.choice([0, 1, 127, 128, 255, int(generator.integers(256))])
                length = int(generator.integers(1, 5))
                kept = length if generator.random() < 0.8 else 1  # else all behind it moves up
                raw[at : at + length] = bytes([int(some)]) * kept
            if generator.random() < 0.2:
                raw = raw[: int(generator.integers(1, len(raw)))]
            path = Path(folder) / name
            path.write_bytes(bytes(raw))
            try:
                read_surface_image(path)
                ended[name, "read"] += 1
            except BadInput as refused:
                ended[name, "refused" if "\n" not in str(refused) else "lines"] += 1
            except BaseException as problem:
                ended[name, type(problem).__name__] += 1
    return ended


def hostile_files() -> list[tuple[str, bool, float, float]]:
    """Name, whether it was refused as it should, seconds, and MB of the largest process."""
    from picture_files import hostile

    found = []
    with TemporaryDirectory() as name:
        folder = Path(name)
        for file in hostile(folder):
            command = [sys.executable, "-m", "stonepass", "friction", str(folder / file),
                       "--pixel", "1um", "--height-range", "10um"]  # fmt: skip
            measured = subprocess.run(
                [sys.executable, "-c", MEASURE, *command], capture_output=True, text=True
            )
            code, used, seconds = (float(part) for part in measured.stdout.split())
            lines = measured.stderr.strip().splitlines()
            told = [line for line in lines if line != "reading the picture …"]
            good = code == 2 and len(told) == 1 and told[0].startswith("stonepass: ")
            found.append((file, good, seconds, used / 1e3))
    return found


# Runs a command; prints its exit code, the memory of its largest process in kB, and seconds.
MEASURE = """
import resource, subprocess, sys, time
begun = time.monotonic()
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
print(done.returncode, used, time.monotonic() - begun)
"""
