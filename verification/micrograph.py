"""Friction from a micrograph: surfaces with known slopes, damaged and hostile files."""

from __future__ import annotations

import importlib.util
import os
import resource
import subprocess
import sys
from collections import Counter
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from page import Check, Section

from stonepass.studies.executor import process_pool
from stonepass.surface.baseline import fit_baseline
from stonepass.surface.friction import friction_of_slopes, surface_friction
from stonepass.surface.paths import StraightPath
from stonepass.surface.surface_image import PixelArea, SurfaceImage

ROOT = Path(__file__).parents[1]
MICRO = 1e-6
LENGTH = 500.0  # length of every path in µm
PIXELS = (0.25, 0.5, 1.0, 2.0)  # µm
ANGLES = (0, 30, 45, 90)  # direction of the slopes and the paths in the picture, in degrees
BITS = (8, 16)
NOISE = (0.0, 0.01, 0.02, 0.05)  # standard deviation of every pixel over the height range
PATHS = 6
EXACT = 0.5 / (1.0 - 0.38 * 0.12)
# Largest relative error of the friction coefficient for each noise level; the text of the section
# explains how noise changes the scale of the heights.
BOUNDS = dict(zip(NOISE, (0.005, 0.02, 0.05, 0.10), strict=True))
ORDERS, SHARES = (8, 16, 32), (0.25, 0.5, 0.75, 0.9, 1.0, 1.2)
FOLLOWED, LARGEST_RATIO = 0.75, 0.05
# Surfaces without noise whose waves are not terms of the baselines: number of each kind, and bounds
# of the median and of 90 % of the relative errors of the friction coefficient.
OTHERS = 200
OTHER_BOUNDS = {"one wave": (0.05, 0.12), "two waves": (0.09, 0.15), "ten waves": (0.03, 0.10),
                "filtered noise": (0.03, 0.10)}  # fmt: skip
TRIED = 20_000
SEED = 20250
LARGEST_TIME, LARGEST_MEMORY = 5.0, 500.0  # s of processor time, MB


def section() -> Section:
    sys.path.insert(0, str(ROOT / "tests"))
    errors = known_answers()
    waves = followed()
    others = other_waves()
    apart = max(abs(r - 1.0) for (_, s), found in waves.items() if s <= FOLLOWED for r in found)
    fuzzed = fuzz()
    refused = hostile_files()
    by_noise = {noise: largest(errors, 3, noise) for noise in NOISE}
    rows = [
        [what, *(f"{largest(errors, k, value, noise):.2%}" for noise in NOISE)]
        for k, name, values in ((0, "pixel {} µm", PIXELS), (1, "rotated by {}°", ANGLES),
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
            "The mean profile of each surface consists exactly of a baseline of slope 0.38 and a "
            f"deviation of slope 0.12, so that μ = {EXACT:.4f}. There are {len(errors)} pictures, "
            "one for each combination of pixel size, direction, bit depth and noise level, with "
            "six paths of 500 µm in each. The noise of each pixel is independent of the others. "
            "The noise level is its standard deviation divided by the height range. Noise changes "
            "the scale of the heights: the range of grey values grows by the noise at the darkest "
            "and brightest places, so that the slopes are too small. For this reason the range is "
            "taken after averaging over 5 × 5 pixels. Single profiles keep their noise, so that "
            "their root-mean-square slope is not compared."
        ),
        tables=[
            ("Largest relative error of μ for each noise level:",
             ("", *(f"{noise:.0%}" for noise in NOISE)), rows),
            ("Slope of the baseline that is fitted to a sine wave, divided by the slope of the "
             "wave: median and largest value of 24 phases. The column is the frequency of the wave "
             "divided by the highest frequency of the baseline. A sine wave of any phase is not a "
             "sum of the terms of the baseline:",
             ("order", *(f"{share:g}" for share in SHARES)),
             [[str(order), *(f"{np.median(waves[order, s]):.2f}, {max(waves[order, s]):.2f}"
                             for s in SHARES)] for order in ORDERS]),
            ("Error of μ for mean profiles without noise whose waves are not terms of the "
             "baselines. The wavelengths of the first part are at least 1.33 times the shortest "
             "wavelength of the first baseline, and those of the second part 0.67 to 0.75 times "
             "it. μ is compared with the largest slopes of both parts in the middle of the path, "
             "where slopes are evaluated, and along the whole path:",
             ("surface", "median", "5 % to 95 %", "largest", "median, whole path",
              "5 % to 95 %, whole path"),
             [[kind, *spread_of([each[0] for each in found]),
               *spread_of([each[1] for each in found])[:2]] for kind, found in others.items()]),
            (f"{TRIED} damaged files (bytes changed or left out, some cut short), seed {SEED}:",
             ("kind", "read", "refused in one sentence", "other results"),
             [[kind, *(str(fuzzed[kind, how]) for how in ("read", "refused")),
               str(sum(c for (k, how), c in fuzzed.items()
                       if k == kind and how not in ("read", "refused")))] for kind in kinds]),
            ("Hostile files given to the command: processor time and memory of its processes:",
             ("file", "s", "MB"),
             [[name, f"{seconds:.1f}", f"{memory:.0f}"] for name, _, seconds, memory in refused]),
        ],
        checks=[
            *(Check(f"μ of known slopes within {BOUNDS[noise]:.1%} at noise {noise:.0%}",
                    f"{error:.2%} at most", error <= BOUNDS[noise])
              for noise, error in by_noise.items()),
            Check(f"slopes of waves up to {FOLLOWED:g} of the highest frequency are found within "
                  f"{LARGEST_RATIO:.0%}", f"{apart:.1%} at most", apart <= LARGEST_RATIO),
            *(Check(f"μ of {kind} outside the terms of the baselines: median within "
                    f"{OTHER_BOUNDS[kind][0]:.0%}, 90 % within {OTHER_BOUNDS[kind][1]:.0%}",
                    ", ".join(spread_of([each[0] for each in found])[:2]),
                    within(found, *OTHER_BOUNDS[kind]))
              for kind, found in others.items()),
            Check("a damaged file is read or refused in one sentence, whatever the damage",
                  f"{sum(fuzzed.values())} tried, {odd} ended otherwise",
                  odd == 0 and sum(fuzzed.values()) == TRIED),
            Check("hostile files: exit code 2, one sentence", f"{len(refused)} files, exceptions: "
                  f"{', '.join(wrong) or 'none'}", not wrong and len(refused) >= 25),
            Check(f"hostile files take at most {LARGEST_TIME:g} s, and {LARGEST_MEMORY:g} MB in "
                  "the largest process",
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
    """Return pixel, angle, bits, noise, and the relative error of the friction coefficient."""
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
    """Return a picture of heights that vary in one direction only, and six paths along it."""
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
    picture = SurfaceImage(
        values, (pixel * MICRO, pixel * MICRO), full, PixelArea(0, 0, columns, rows)
    )
    return picture, [StraightPath(*((end - low) / pixel).ravel()) for end in ends]


def followed() -> dict[tuple[int, float], list[float]]:
    """Return the largest slope of a baseline over that of a sine, by order and frequency."""
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


def other_waves() -> dict[str, list[tuple[float, float]]]:
    """Return relative errors of μ by kind of surface: for the middle and the whole path."""
    generator = np.random.default_rng(SEED)
    return {kind: [error_of(kind, generator) for _ in range(OTHERS)] for kind in OTHER_BOUNDS}


def error_of(kind: str, generator: np.random.Generator) -> tuple[float, float]:
    """Return the errors of a surface; its parts have slopes of 0.38 and 0.12 in the middle."""
    x = np.linspace(0.0, LENGTH, 1001)
    highest = 8 / (2.0 * LENGTH)  # waves per µm that the first baseline follows
    count = {"one wave": 1, "two waves": 1, "ten waves": 5, "filtered noise": 100}[kind]
    lowest = 0.02 if kind == "filtered noise" else 0.25
    parts = [some_waves(x, highest * generator.uniform(lowest, 0.75, count), generator)]
    if kind != "one wave":
        parts.append(some_waves(x, highest * generator.uniform(1.33, 1.5, count), generator))
    z, middle, whole = np.zeros_like(x), [], []
    for (heights, slopes), steepest, order in zip(parts, (0.38, 0.12), (8, 16), strict=False):
        looked_at = np.abs(slopes[(x >= LENGTH / order) & (x <= LENGTH - LENGTH / order)]).max()
        z += heights * steepest / looked_at
        middle.append(steepest)
        whole.append(np.abs(slopes).max() * steepest / looked_at)
    first = fit_baseline(x, z, 8)
    rest = fit_baseline(x, z - first.at(x), 16)
    friction = friction_of_slopes(first.steepest, rest.steepest)
    exact = [np.tan(np.sum(np.arctan(slopes))) for slopes in (middle, whole)]
    return friction / exact[0] - 1.0, friction / exact[1] - 1.0


def some_waves(x, numbers, generator):
    """Return heights and slopes of waves of given numbers per µm and random phases."""
    phases = generator.uniform(0.0, 2.0 * np.pi, len(numbers))
    slopes = generator.normal(size=len(numbers)) if len(numbers) > 1 else np.ones(1)
    places = 2.0 * np.pi * np.outer(x, numbers) + phases
    return np.sin(places) @ (slopes / (2.0 * np.pi * numbers)), np.cos(places) @ slopes


def spread_of(errors) -> tuple[str, str, str]:
    """Return the median, the range of 90 %, and the largest error as text."""
    low, middle, high = np.quantile(errors, (0.05, 0.5, 0.95))
    return f"{middle:+.1%}", f"{low:+.1%} to {high:+.1%}", f"{max(errors, key=abs):+.1%}"


def within(found, median: float, nine_in_ten: float) -> bool:
    low, middle, high = np.quantile([each[0] for each in found], (0.05, 0.5, 0.95))
    return abs(middle) <= median and max(-low, high) <= nine_in_ten and len(found) == OTHERS


def largest(errors, which, value, noise=None):
    return max(e[4] for e in errors if e[which] == value and (noise is None or e[3] == noise))


def fuzz() -> Counter:
    """Return how damaged files end, by kind; several processes try them."""
    cores = os.cpu_count() or 1
    shares = [(SEED + k, TRIED // cores + (k < TRIED % cores)) for k in range(cores)]
    with process_pool(cores) as pool:
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
                kept = length if generator.random() < 0.8 else 1  # else the rest moves up
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
    """Return name, whether it was refused properly, seconds, and MB of the largest process."""
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


# Runs a command and prints its exit code, the memory of its largest process in kB, and the
# processor time of all its processes in s. Elapsed time would depend on the load of the machine.
MEASURE = """
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(done.returncode, used.ru_maxrss, used.ru_utime + used.ru_stime)
"""
