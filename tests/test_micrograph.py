"""Friction from a micrograph: known answers, every kind of file, and files that are refused."""

import importlib.util
import json
import os
import struct
import subprocess
import sys
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from picture_files import (
    FEI,
    TESCAN,
    ZEISS,
    al3d_file,
    hostile,
    packed_sur,
    save_tiff,
    some_grey,
    sur_file,
    valid,
)
from PIL import Image
from SurfaceTopography import Topography

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.io import optional_imports
from stonepass.report.friction_figure import friction_figure
from stonepass.sandbox.sandbox import Limits, parse_in_sandbox
from stonepass.surface import worker
from stonepass.surface.baseline import fit_baseline
from stonepass.surface.friction import friction_of_slopes, surface_friction
from stonepass.surface.paths import StraightPath, evenly_spaced, profiles_along, read_path
from stonepass.surface.pixel_size import tescan_scan, zeiss_scan
from stonepass.surface.readers import read_surface_image
from stonepass.surface.sandboxed import read_in_sandbox
from stonepass.surface.surface_image import PixelArea, SurfaceImage

EXAMPLES = Path(__file__).parents[1] / "examples"
MICRO = 1e-6
K0, K1 = 0.38, 0.12


@pytest.fixture(scope="module")
def maker():
    spec = importlib.util.spec_from_file_location("maker", EXAMPLES / "make_micrographs.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def profile(maker):
    """Heights in µm at 0.5 µm steps over 500 µm, of slopes 0.38 and 0.12."""
    return maker.known_profile(0.5 * np.arange(1001))


def picture_of(heights, pixel=0.5, bits=16, rows=40):
    """A grey picture of heights along x, in µm."""
    full = 2**bits - 1
    grey = np.round(full * (heights - heights.min()) / np.ptp(heights))
    values = np.tile(grey, (rows, 1)).astype(np.uint8 if bits == 8 else np.uint16)
    return SurfaceImage(
        values, (pixel * MICRO, pixel * MICRO), full, PixelArea(0, 0, len(grey), rows)
    )


def height_range(heights):
    return f"{np.ptp(heights):.12g} um"


# Known answers


def test_eq_18():
    assert friction_of_slopes(0.38, 0.12) == pytest.approx(0.5 / 0.9544, rel=1e-14)
    assert friction_of_slopes(0.38, 0.12) == pytest.approx(0.524, abs=1e-3)
    assert friction_of_slopes(0.7, 0.0) == pytest.approx(0.7)
    assert friction_of_slopes(1.0, 0.999) > 1000.0
    with pytest.raises(BadInput, match=r"product of the slopes k0 and k1 is 2 × 0.5, but must"):
        friction_of_slopes(2.0, 0.5)


@pytest.mark.parametrize(("bits", "tolerance"), [(16, 0.003), (8, 0.004)])
def test_known_slopes_are_recovered(profile, bits, tolerance):
    found = surface_friction(picture_of(profile, bits=bits), height_range(profile))
    assert found.k0 == pytest.approx(K0, rel=tolerance)
    assert found.k1 == pytest.approx(K1, rel=tolerance)
    assert found.friction == pytest.approx(0.5239, rel=tolerance)
    assert len(found.paths) == 6
    assert found.spread.paths == pytest.approx([found.friction] * 6, rel=1e-9)


def test_known_slopes_as_heights(profile):
    """A height map needs no scaling: exact but for the sampling."""
    values = np.tile(profile * MICRO, (40, 1))
    heights = SurfaceImage(values, (0.5 * MICRO, 0.5 * MICRO), 0, PixelArea(0, 0, 1001, 40))
    found = surface_friction(heights)
    assert found.k0 == pytest.approx(K0, rel=1e-4)
    assert found.k1 == pytest.approx(K1, rel=1e-4)
    assert found.spread.height_range == ()
    with pytest.raises(BadInput, match="height range is 3 um, but must be left out"):
        surface_friction(heights, "3 um")


def test_a_pixel_that_is_not_square(profile):
    """The same surface stretched: along y the rows are twice as far apart."""
    grey = picture_of(profile)
    tall = SurfaceImage(
        grey.values.T.copy(), (2 * MICRO, 0.5 * MICRO), 65535, PixelArea(0, 0, 40, 1001)
    )
    found = surface_friction(tall, height_range(profile), [StraightPath(20, 0, 20, 1000)])
    assert found.friction == pytest.approx(0.5239, rel=3e-3)
    assert found.distance[-1] == pytest.approx(500 * MICRO)


def test_the_slope_of_a_plane_and_of_a_wave():
    """A tilted plane has its slope whatever the orders; a wave 2πA/λ, in the baseline that has it."""
    x = np.linspace(0.0, 300.0, 601) * MICRO
    plane = fit_baseline(x, 0.3 * x, 5)
    assert plane.steepest == pytest.approx(0.3, rel=1e-9)
    wave = 4.0 * MICRO * np.sin(2.0 * np.pi * x / (100.0 * MICRO) + 0.4)
    assert fit_baseline(x, wave, 24).steepest == pytest.approx(2.0 * np.pi * 0.04, rel=1e-3)
    assert fit_baseline(x, wave, 4).steepest < 0.15  # whose shortest wave is 150 µm
    assert fit_baseline(x, wave, 8).wavelength == pytest.approx(75.0 * MICRO)


def test_a_second_baseline_as_poor_as_the_first_has_no_slope(profile):
    distance = 0.5 * MICRO * np.arange(1001)
    first = fit_baseline(distance, profile * MICRO, 8)
    left = profile * MICRO - first.at(distance)
    assert fit_baseline(distance, left, 8).steepest < 1e-9
    with pytest.raises(
        BadInput, match="order of the deviation's baseline is 8, but must be larger"
    ):
        surface_friction(
            picture_of(profile), height_range(profile), baseline_order=8, deviation_order=8
        )


def test_friction_grows_with_the_relief_as_the_slopes_do(profile):
    grey = picture_of(profile)
    one, half = (surface_friction(grey, f"{h * np.ptp(profile):.9g} um") for h in (1.0, 0.5))
    assert half.k0 == pytest.approx(0.5 * one.k0, rel=1e-9)
    assert half.k1 == pytest.approx(0.5 * one.k1, rel=1e-9)
    assert half.roughness.Ra == pytest.approx(0.5 * one.roughness.Ra, rel=1e-9)


def test_roughness_of_a_wave():
    """A wave of amplitude A: Ra = 2A/π, Rq = A/√2, RΔq = √2 π A/λ, over whole waves."""
    x = 0.25 * np.arange(4001)
    wave = 3.0 * np.cos(2.0 * np.pi * x / 50.0)
    values = np.tile(wave * MICRO, (20, 1))
    heights = SurfaceImage(values, (0.25 * MICRO, 0.25 * MICRO), 0, PixelArea(0, 0, 4001, 20))
    found = surface_friction(heights, baseline_order=40, deviation_order=60)
    assert found.roughness.Ra == pytest.approx(6.0 / np.pi * MICRO, rel=0.01)
    assert found.roughness.Rq == pytest.approx(3.0 / np.sqrt(2.0) * MICRO, rel=0.01)
    assert found.roughness.RdeltaQ == pytest.approx(np.sqrt(2.0) * np.pi * 3.0 / 50.0, rel=0.01)
    assert found.k0 == pytest.approx(2.0 * np.pi * 3.0 / 50.0, rel=1e-3)


def test_the_spread_puts_its_parts_together():
    """Paths that differ: the jackknife is the standard error where friction is linear in the mean."""
    x = np.arange(801) * MICRO
    tilts = np.array([0.1, 0.2, 0.3, 0.4])
    values = np.vstack([np.outer(tilts, x), np.zeros((16, 801))])
    heights = SurfaceImage(values, (MICRO, MICRO), 0, PixelArea(0, 0, 801, 20))
    paths = [StraightPath(0, k, 800, k) for k in range(4)]
    found = surface_friction(heights, paths=paths)
    assert found.friction == pytest.approx(0.25, rel=1e-9)
    assert found.spread.sd == pytest.approx(np.std(tilts, ddof=1) / 2.0, rel=1e-6)
    one = surface_friction(heights, paths=paths[:1])
    assert one.spread.paths == ()
    assert "only one profile" in str(one.warnings[0])


# Paths


def test_paths_evenly_spaced_over_the_area(profile):
    grey = picture_of(profile, rows=60).with_area(100, 0, 500, 30)
    paths = evenly_spaced(grey, 3)
    assert [path.y0 for path in paths] == [4.0, 14.0, 24.0]
    assert {(path.x0, path.x1) for path in paths} == {(100.0, 499.0)}
    for count in (0, 31):
        with pytest.raises(BadInput, match=f"paths is {count}, but must be a whole number from 1"):
            evenly_spaced(grey, count)


def test_profiles_are_bilinear_and_of_one_length():
    values = np.add.outer(3.0 * np.arange(40), 2.0 * np.arange(50)) * MICRO
    heights = SurfaceImage(values, (MICRO, MICRO), 0, PixelArea(0, 0, 50, 40))
    paths = [StraightPath(1, 1, 31, 21), StraightPath(0, 0, 45, 30)]
    found = profiles_along(heights, paths)
    length = np.hypot(30.0, 20.0)
    assert found.distance[-1] == pytest.approx(length * MICRO)
    slope = (2.0 * 30.0 + 3.0 * 20.0) / length
    for row in found.values:
        np.testing.assert_allclose(np.diff(row) / np.diff(found.distance), slope, rtol=1e-9)
    assert "1.50 times the length of the shortest; all are cut" in str(found.warnings[0])


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("1,2,3", "path is 1,2,3, but must be four numbers x0,y0,x1,y1 in pixels"),
        ("1,2,3,nan", "four numbers"),
        ("1,2,3,x", "four numbers"),
    ],
)
def test_paths_that_are_none(text, sentence):
    with pytest.raises(BadInput, match=sentence):
        read_path(text)


def test_paths_that_leave_the_picture_or_cross_a_gap():
    values = np.zeros((30, 40))
    values[10, 10] = np.nan
    heights = SurfaceImage(values, (MICRO, MICRO), 0, PixelArea(0, 0, 40, 30))
    for path, sentence in (
        (
            StraightPath(0, 0, 40, 0),
            "0,0,40,0, but must be within columns 0 to 39 and rows 0 to 29",
        ),
        (StraightPath(0, 0, 1, 0), "at least two pixels long"),
        (StraightPath(0, 10, 39, 10), "one without gaps in the height map; choose other paths"),
    ):
        with pytest.raises(BadInput, match=sentence):
            profiles_along(heights, [path])
    with pytest.raises(BadInput, match="pixel size is missing, but must be given as --pixel"):
        profiles_along(SurfaceImage(values, None, 0, heights.area), [StraightPath(0, 0, 5, 0)])


# Every kind of file


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize(
    "kind", ["plain", "deflate", "big-endian", "bigtiff", "white-is-zero", "tiles", "lzw", "png"]
)
def test_grey_of_every_kind_is_read_as_it_is(tmp_path, kind, bits):
    values = some_grey(bits=bits)
    path = tmp_path / "grey.tif"
    options = {
        "deflate": {"compression": "zlib"},
        "big-endian": {"byteorder": ">"},
        "bigtiff": {"bigtiff": True},
        "tiles": {"tile": (32, 32)},
    }
    if kind == "white-is-zero":
        save_tiff(path, values.max() - values, photometric="miniswhite")
        found = read_surface_image(path)
        np.testing.assert_array_equal(
            np.diff(found.values.astype(int)), np.diff(values.astype(int))
        )
        return
    if kind == "lzw":
        Image.fromarray(values).save(path, compression="tiff_lzw")
    elif kind == "png":
        path = tmp_path / "grey.png"
        Image.fromarray(values).save(path)
    else:
        save_tiff(path, values, photometric="minisblack", **options.get(kind, {}))
    found = read_surface_image(path)
    np.testing.assert_array_equal(found.values, values)
    assert found.full_scale == 2**bits - 1
    assert found.pixel is None
    assert found.area == PixelArea(0, 0, 80, 60)


@pytest.mark.parametrize(
    "kind", ["rgb.tif", "rgb.png", "palette.tif", "palette.png", "la.png", "g.jpg"]
)
def test_grey_saved_as_colour_is_grey(tmp_path, kind):
    values = some_grey()
    path = tmp_path / kind
    image = Image.fromarray(values)
    if kind.startswith("rgb"):
        image.convert("RGB").save(path)
    elif kind.startswith("palette"):
        image.convert("P").save(path)
    elif kind.startswith("la"):
        image.convert("LA").save(path)
    else:
        Image.fromarray(np.tile(np.arange(80, dtype=np.uint8), (60, 1))).convert("RGB").save(
            path, quality=95
        )
        values = np.tile(np.arange(80, dtype=np.uint8), (60, 1))
    found = read_surface_image(path)
    np.testing.assert_allclose(found.values, values, atol=2 if kind == "g.jpg" else 0)


def test_of_several_pages_the_first(tmp_path):
    path = tmp_path / "pages.tif"
    save_tiff(path, np.stack([some_grey(), some_grey() // 2]), photometric="minisblack")
    found = read_surface_image(path)
    np.testing.assert_array_equal(found.values, some_grey())
    assert found.notes == ("the first of several pages is read",)


@pytest.mark.parametrize(
    ("tag", "pixel", "bottom", "note"),
    [
        ((34118, 's', 0, ZEISS, True), (2.5e-7, 2.5e-7), 60, "Zeiss tag"),
        ((34682, 's', 0, FEI, True), (2.5e-7, 2e-7), 50, "FEI tag"),
        ((34680, 's', 0, FEI, True), (2.5e-7, 2e-7), 50, "FEI tag"),
        ((50431, 'B', len(TESCAN), TESCAN.encode(), True), (2.5e-7, 2.5e-7), 50, "TESCAN tag"),
    ],
)  # fmt: skip
def test_pixel_size_and_data_bar_of_the_microscopes(tmp_path, tag, pixel, bottom, note):
    path = save_tiff(tmp_path / "sem.tif", some_grey(), photometric="minisblack", extratags=[tag])
    found = read_surface_image(path)
    assert found.pixel == pytest.approx(pixel)
    assert found.area == PixelArea(0, 0, 80, bottom)
    assert found.pixel_source == note
    assert found.with_pixel(1e-6).pixel_source == "as given"


@pytest.mark.parametrize("name", ["sem.hdr", "sem-png.hdr"])
def test_the_text_file_beside_a_picture(tmp_path, name):
    path = tmp_path / "sem.png"
    Image.fromarray(some_grey()).save(path)
    (tmp_path / name).write_text(TESCAN)
    assert read_surface_image(path).pixel == pytest.approx((2.5e-7, 2.5e-7))
    (tmp_path / name).write_text(TESCAN.replace("2.5e-007", "0"))
    assert read_surface_image(path).pixel is None  # asked for, not guessed


def test_the_size_of_a_zeiss_screen_pixel_is_taken_at_its_own_width_alone():
    scan = zeiss_scan({"ap_pixel_size": ("Pixel Size", 0.5, "µm")})
    assert scan.pixel_for(1024) == ((pytest.approx(5e-7), pytest.approx(5e-7)), "")
    assert scan.pixel_for(2048)[0] is None
    for wrong in (0.0, "?"):
        tags = {"ap_image_pixel_size": ("Image Pixel Size", wrong, "nm")}
        assert zeiss_scan(tags).pixel is None
    scan = tescan_scan("PixelSizeX=1e-7")
    assert (scan.pixel, scan.bar) == ((1e-7, 1e-7), 0)
    assert tescan_scan("PixelSizeX=abc").pixel is None


def test_print_resolution_is_no_pixel_size(tmp_path):
    Image.fromarray(some_grey()).save(tmp_path / "p.png", dpi=(300, 300))
    assert read_surface_image(tmp_path / "p.png").pixel is None


@pytest.mark.parametrize("kind", ["sur", "al3d", "x3p"])
def test_height_maps_of_instruments(tmp_path, kind, profile):
    heights = np.tile(profile, (24, 1)) + 0.2 * np.arange(24)[:, None]
    path = tmp_path / f"map.{kind}"
    if kind == "sur":
        sur_file(path, heights, 0.5)
    elif kind == "al3d":
        al3d_file(path, heights, 0.5)
    else:
        sizes = (1001 * 0.5 * MICRO, 24 * 0.5 * MICRO)
        Topography(heights.T * MICRO, sizes, unit="m").to_x3p(str(path))
    found = read_surface_image(path)
    assert found.has_heights
    assert found.pixel == pytest.approx((0.5 * MICRO, 0.5 * MICRO), rel=1e-6)
    np.testing.assert_allclose(
        found.values - found.values.mean(), (heights - heights.mean()) * MICRO, atol=2e-9
    )
    assert surface_friction(found).friction == pytest.approx(0.5239, rel=2e-3)


# Files that are refused


def test_every_hostile_file_is_refused_in_one_sentence(tmp_path):
    for name, sentence in hostile(tmp_path).items():
        with pytest.raises(BadInput) as refused:
            read_surface_image(tmp_path / name)
        told = str(refused.value)
        assert sentence in told, (name, told)
        assert name in told or "a file that exists" in told  # a long path is cut
        assert "\n" not in told
        assert len(told) < 400


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (np.full((40, 60), 7, np.uint8), "picture is flat, with greys from 7 to 7"),
        (np.tile(np.arange(60) // 5, (40, 1)).astype(np.uint8), "at least 16 grey levels"),
        (
            np.where(some_grey(40, 60) > 100, 255, some_grey(40, 60)).astype(np.uint8),
            "darkest or brightest grey",
        ),
        (some_grey(40, 60), "product of the slopes k0 and k1"),
        (some_grey(40, 30), "order of the deviation's baseline is 16, but must be at most"),
    ],
)
def test_pictures_without_an_answer(values, sentence):
    full = SurfaceImage(
        values, (MICRO, MICRO), 255, PixelArea(0, 0, values.shape[1], values.shape[0])
    )
    with pytest.raises(BadInput) as refused:
        surface_friction(full, "1 mm", baseline_order=8 if "order" in sentence else 3)
    assert sentence in str(refused.value)


def test_some_black_or_white_is_told_of(profile):
    grey = picture_of(profile, bits=8)
    values = np.clip(grey.values.astype(int) * 1.15, 0, 255).astype(np.uint8)
    found = surface_friction(
        SurfaceImage(values, grey.pixel, 255, grey.area), height_range(profile)
    )
    assert any("darkest or brightest grey, where heights" in str(told) for told in found.warnings)


def test_without_the_extra_it_says_what_to_install(tmp_path, monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(optional_imports, "import_module", missing)
    remedy = (
        r"library is SurfaceTopography, but must be installed.*pip install 'stonepass\[imaging\]'"
    )
    with pytest.raises(BadInput, match=remedy):
        read_surface_image(EXAMPLES / "crystals.x3p")
    save_tiff(tmp_path / "a.tif", some_grey())
    assert read_surface_image(tmp_path / "a.tif").values.shape == (60, 80)


# The process of its own


def test_a_file_read_in_a_process_of_its_own_is_the_same(tmp_path):
    path = save_tiff(tmp_path / "a.tif", some_grey(bits=16), extratags=[(34682, 's', 0, FEI, True)])  # fmt: skip
    here, there = read_surface_image(path), read_in_sandbox(path)
    np.testing.assert_array_equal(here.values, there.values)
    assert here == replace(there, values=here.values)
    (tmp_path / "words.png").write_text("no picture")
    with pytest.raises(BadInput, match=r"image is words\.png, but must be a TIFF"):
        read_in_sandbox(tmp_path / "words.png")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of data are Linux's")
def test_a_file_that_needs_more_memory_than_it_may_is_refused(tmp_path):
    path = tmp_path / "wide.png"
    Image.fromarray(np.zeros((4000, 6000), np.uint8)).save(path)
    with pytest.raises(BadInput, match=r"wide\.png, but must be readable"):
        read_in_sandbox(path, memory=60_000_000)
    assert read_in_sandbox(path).values.shape == (4000, 6000)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the stand-in is a shell script")
@pytest.mark.parametrize(
    ("script", "sentence"),
    [
        ("exit 1", "its reader ended with exit 1"),
        ("kill -9 $$", "its reader ended with signal 9"),
        ("echo ready; exec sleep 60", r"read within 0.5 s \(reading it took longer\)"),
        ("echo ready; echo nonsense", "its reader sent invalid data"),
        ("echo ready; echo '[1]'", "its reader sent invalid data"),
        ('echo ready; echo \'{"refused": ["a"]}\'', "its reader sent invalid data"),
        (
            'echo ready; echo \'{"header": {"shape": [20, 20], "type": "uint8", "area": [0, 0, 20, 20]}}\'',
            "20 × 20 values",
        ),
        (
            'echo ready; echo \'{"header": {"shape": [16, 16], "type": "uint8", "area": [0, 0, 99, 16]}}\'; printf %0256d 0',
            "area",
        ),
        (
            'echo ready; echo \'{"refused": ["a", "\\\\u001b[31mb", "c", ""]}\'',
            r"a is \?\[31mb, but",
        ),
    ],
)
def test_a_reader_is_believed_only_as_far_as_it_makes_sense(
    tmp_path, monkeypatch, script, sentence
):
    path = save_tiff(tmp_path / "a.tif", some_grey())
    (tmp_path / "reader").write_text(f"#!/bin/sh\nread line\n{script}\n")
    (tmp_path / "reader").chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "reader"))
    monkeypatch.setattr("stonepass.sandbox.sandbox.PATIENCE", 1.0 if "sleep" in script else 60.0)
    with pytest.raises(BadInput, match=sentence):
        read_in_sandbox(path, seconds=0.5)


def test_other_bytes_first_and_planes_apart_are_the_same_numbers(tmp_path):
    """Whatever the order of bytes and channels, and through the process of its own."""
    values = some_grey(bits=16)
    big = tmp_path / "big.tif"
    Image.fromarray(values.astype(">u2")).save(big, compression="tiff_lzw")
    swapped = tmp_path / "swapped.tif"
    save_tiff(swapped, values, byteorder=">", photometric="minisblack")
    planes = tmp_path / "planes.tif"
    save_tiff(planes, np.stack([values] * 3), photometric="rgb", planarconfig="separate")
    for path in (big, swapped, planes):
        for read in (read_surface_image, read_in_sandbox):
            found = read(path)
            np.testing.assert_array_equal(found.values, values)
            assert found.values.dtype.isnative
            assert found.full_scale == 65535


def test_bits_are_not_lost_in_silence(tmp_path):
    path = tmp_path / "deep.png"
    rows = b"".join(b"\0" + bytes(40 * 4) for _ in range(40))  # grey and alpha, 16 bit
    head = struct.pack(">IIBBBBB", 40, 40, 16, 4, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    body = b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)
    with pytest.raises(BadInput, match="16 bits in colour or with alpha"):
        read_surface_image(path)


def test_a_picture_that_was_turned_is_refused(tmp_path):
    save_tiff(tmp_path / "turned.tif", some_grey(), extratags=[(274, "H", 1, 6, True)])
    exif = Image.Exif()
    exif[274] = 8
    Image.fromarray(some_grey()).save(tmp_path / "turned.jpg", exif=exif)
    for name in ("turned.tif", "turned.jpg"):
        with pytest.raises(BadInput, match=r"rotated or mirrored .*rotate it and save it again"):
            read_surface_image(tmp_path / name)


def test_the_size_of_a_picture_that_was_made_smaller_is_asked_for(tmp_path):
    fei = FEI.replace("ResolutionX=80", "ResolutionX=160")
    path = save_tiff(tmp_path / "half.tif", some_grey(), extratags=[(34682, "s", 0, fei, True)])
    assert read_surface_image(path).pixel is None
    stored = {"ap_image_pixel_size": ("Image Pixel Size", 250.0, "nm")}
    twice = zeiss_scan(stored | {"dp_image_store": ("Store resolution", "2048 * 1536")})
    assert twice.pixel_for(1024)[0] is None
    same = zeiss_scan(stored | {"dp_image_store": ("Store resolution", "1024 * 768")})
    assert same.pixel_for(1024)[0] == pytest.approx((2.5e-7, 2.5e-7))
    assert tescan_scan(TESCAN + "ViewFieldsCountX=2\n").pixel is None
    assert tescan_scan("\n" * 200_000 + "PixelSizeX=1e-7").pixel == (1e-7, 1e-7)


def test_an_impossible_pixel_is_not_taken_and_may_be_given(tmp_path):
    for width, height in (("0.05", "0.05"), ("1e-3", "1e-11")):
        fei = FEI.replace("2.5e-007", width).replace("2e-007", height)
        path = save_tiff(tmp_path / "odd.tif", some_grey(), extratags=[(34682, "s", 0, fei, True)])
        found = read_surface_image(path)
        assert found.pixel is None
        (note,) = (each for each in found.notes if "pixel size" in each)
        assert note.startswith("the pixel size in the file is not used: the FEI tag says")
        assert note.endswith("which is outside the accepted range")
        assert found.with_pixel(1e-6).pixel == (1e-6, 1e-6)
    with pytest.raises(BadInput, match="pixel size is 1e-06 m × 1e-08 m"):
        SurfaceImage(some_grey(), (1e-6, 1e-8), 255, PixelArea(0, 0, 80, 60))


def test_what_is_no_surface_is_told_of(profile):
    grey = picture_of(profile, bits=8, rows=100)
    values = np.clip(grey.values.astype(int) // 2 + 40, 0, 255).astype(np.uint8)
    bar = values.copy()
    bar[20:26, 100:200] = 255
    warned = surface_friction(
        SurfaceImage(bar, grey.pixel, 255, grey.area), height_range(profile)
    ).warnings
    assert any("a scale bar or a label" in str(told) for told in warned)
    strip = np.vstack([values, np.full((10, values.shape[1]), values.min(), np.uint8)])
    area = PixelArea(0, 0, strip.shape[1], len(strip))
    warned = surface_friction(
        SurfaceImage(strip, grey.pixel, 255, area), height_range(profile)
    ).warnings
    assert any("rows have the same grey" in str(told) for told in warned)
    clean = surface_friction(
        SurfaceImage(values, grey.pixel, 255, grey.area), height_range(profile)
    ).warnings
    assert not any("--area" in str(told) for told in clean)


def test_steepest_at_the_edge_of_where_it_is_looked_at():
    x = np.linspace(0.0, 500.0, 501)
    heights = np.tile(x**2 / 1000.0 * MICRO, (20, 1))
    found = surface_friction(SurfaceImage(heights, (MICRO, MICRO), 0, PixelArea(0, 0, 501, 20)))
    assert found.k0 == pytest.approx(1.0 * (1.0 - 1.0 / 8.0), rel=1e-3)
    assert any("may be steeper beyond it" in str(told) for told in found.warnings)


def test_the_child_writes_numbers_and_json(tmp_path):
    path = save_tiff(tmp_path / "a.tif", some_grey())
    request = {"path": str(path)}
    asked = json.dumps({"request": request, "memory": 400_000_000, "seconds": 4.0}).encode()
    done = subprocess.run(
        [sys.executable, "-m", worker.__name__], input=asked, capture_output=True, check=True
    )
    ready, header, body = done.stdout.split(b"\n", 2)
    assert json.loads(ready) == {"ready": True}
    assert json.loads(header)["header"]["shape"] == [60, 80]
    assert body == some_grey().tobytes()


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    return valid(tmp_path_factory.mktemp("valid"))


damage = settings(
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@settings(damage, max_examples=20)
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused(files, tmp_path, data):
    assert_read_or_refused(files, tmp_path, data)


@pytest.mark.slow
@settings(damage, max_examples=300)
@given(data=st.data())
def test_many_damaged_files_are_read_or_refused(files, tmp_path, data):
    assert_read_or_refused(files, tmp_path, data)


def assert_read_or_refused(files, tmp_path, data):
    name = data.draw(st.sampled_from(sorted(files)))
    raw = bytearray(files[name])
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(raw) - 1))
        raw[at : at + 4] = data.draw(st.binary(min_size=1, max_size=4))
    raw = raw[: data.draw(st.integers(1, len(raw)))] if data.draw(st.booleans()) else raw
    path = tmp_path / name
    path.write_bytes(bytes(raw))
    try:
        found = read_surface_image(path)
    except BadInput as refused:
        assert "\n" not in str(refused)
    else:
        assert found.values.size <= 40_000_000


# The command


def test_the_command(tmp_path, capsys, profile):
    path = tmp_path / "stone.png"
    Image.fromarray(picture_of(profile, bits=8).values).save(path)
    arguments = ["friction", str(path), "--pixel", "0.5um", "--height-range", height_range(profile)]
    assert run([*arguments, "--json", "--figure", str(tmp_path / "f.png")]) == 0
    record = json.loads(capsys.readouterr().out)
    assert set(record) >= {
        "friction_coefficient", "friction_sd", "k0", "k1", "baseline_order", "height_range_um", "pixel_um",
        "paths", "roughness", "warnings", "version", "disclaimer",
    }  # fmt: skip
    assert set(record["roughness"]) == {"Ra_um", "Rq_um", "RdeltaQ"}
    assert record["friction_coefficient"] == pytest.approx(0.524, abs=0.003)
    assert record["pixel_um"] == pytest.approx(0.5)
    assert len(record["paths"]) == 6
    assert (tmp_path / "f.png").stat().st_size > 10_000
    assert run([*arguments, "--path", "0,5,1000,5", "--path", "0,20,1000,20"]) == 0
    shown = capsys.readouterr().out
    assert "friction coefficient" in shown
    assert "range over baseline orders" in shown
    for more, sentence in (
        (["--crystal", "20um"], "combination of --height-range and --crystal"),
        (["--paths", "3", "--path", "0,0,1,1"], "combination of --paths and --path"),
        (["--area", "1,2,3"], "four whole numbers"),
        (["--area", "0,0,9,1" + "0" * 5000], "four whole numbers"),
        (["--area", "0,0,2000,10"], "within 0, 0, 1001, 40"),
        (["--pixel", "3"], "--pixel"),
        (["--baseline-order", "0"], "order of the baseline is 0"),
    ):
        assert run([*arguments, *more]) == 2, more
        assert sentence in capsys.readouterr().err
    assert run(["friction", str(path), "--pixel", "0.5um"]) == 2
    assert "height range is missing" in capsys.readouterr().err
    assert run(["friction", str(path), "--crystal", "20um"]) == 2
    assert "pixel size is missing, but must be given as --pixel" in capsys.readouterr().err


def test_the_result_is_handed_on(tmp_path, capsys):
    path = tmp_path / "friction.json"
    path.write_text(json.dumps({"friction_coefficient": 0.4375}))
    case = ["--xi", "1.1", "--eta", "1.5", "--material", "latex", "--accuracy", "fast", "--json"]
    assert run(["pressure", *case, "--friction-from", str(path)]) == 0
    handed = json.loads(capsys.readouterr().out)
    assert handed["case"]["stone"]["friction"] == 0.4375
    path.write_text(path.read_text("utf-8"), "utf-16")  # as Windows PowerShell redirects it
    assert run(["pressure", *case, "--friction-from", str(path)]) == 0
    assert run(["pressure", *case, "--friction-from", str(path), "--friction", "0.3"]) == 2
    assert "--friction-from cannot be used with --friction" in capsys.readouterr().err
    for content, sentence in (
        ("{", "friction file is"),
        ("[1]", "'friction_coefficient' is missing"),
        ('{"friction_coefficient": "0.5"}', "is 0.5, but must be a number"),
        ('{"friction_coefficient": NaN}', "must be a number"),
        ('{"friction_coefficient": 7}', "friction"),
        ('{"friction_coefficient": 1' + "0" * 400 + "}", "must be a number"),
    ):
        path.write_text(content)
        assert run(["pressure", *case, "--friction-from", str(path)]) == 2
        assert sentence in capsys.readouterr().err
    assert run(["size", "--eta", "1.5", "--limit", "12kPa", "--friction-from", "no.json"]) == 2
    assert "a file that exists" in capsys.readouterr().err


def test_what_is_in_the_figure(profile):
    found = surface_friction(picture_of(profile), height_range(profile))
    picture, profiles, mean, rest = friction_figure(found).axes
    assert len(picture.lines) == 6
    assert len(profiles.lines) == 7
    fitted = mean.lines[1]
    np.testing.assert_allclose(
        fitted.get_ydata(), 1e6 * found.baseline.at(found.distance), rtol=1e-12
    )
    x, y = (np.array(values) for values in rest.lines[2].get_data())
    assert abs((y[1] - y[0]) / (x[1] - x[0])) == pytest.approx(found.k1, rel=1e-3)
    assert f"k₀ = {found.k0:.3f}" in mean.get_title("left")
    assert "μ = 0.52" in rest.get_title("left")


def test_the_examples_are_what_their_script_makes(tmp_path, maker):
    maker.write_png(tmp_path)
    heights = maker.cubic_crystals()
    maker.write_tiff(tmp_path, heights)
    maker.write_x3p(tmp_path, heights)
    for name in ("known_slopes.png", "crystals.tif", "crystals.x3p"):
        made, shipped = read_surface_image(tmp_path / name), read_surface_image(EXAMPLES / name)
        np.testing.assert_allclose(made.values, shipped.values, atol=1 if made.full_scale else 1e-9)
        assert made.pixel == shipped.pixel


# Sizes that are documented


def largest_maps(folder):
    """Height maps of 20 million points: as 32-bit floats, and packed."""
    z = np.random.default_rng(1).normal(size=(4472, 4472)).astype(np.float32)
    al3d_file(folder / "large.al3d", z, 1.0)
    plain = sur_file(folder / "large.sur", z[:3300, :3300], 1.0).read_bytes()
    packed_sur(folder / "packed.sur", plain)
    return ["large.al3d", "large.sur", "packed.sur"]


def largest_pictures(folder):
    """Pictures of 40 million pixels, or of 90 MB."""
    y, x = np.mgrid[:6320, :6320]
    grey = (120 + 60 * np.sin(x / 70.0) + 40 * np.sin(y / 90.0)).astype(np.uint8)
    deep = grey.astype(np.uint16) * 257
    save_tiff(folder / "deep.tif", deep, photometric="miniswhite")
    Image.fromarray(deep).save(folder / "deep.png", compress_level=1)
    Image.fromarray(deep).save(folder / "lzw.tif", compression="tiff_lzw")
    colormap = np.stack([np.arange(256) * 257] * 3).astype(np.uint16)
    palette = folder / "palette.tif"
    save_tiff(palette, grey[:4608, :6144], photometric="palette", colormap=colormap)
    colours = np.stack([grey[:5400, :5500]] * 3, axis=-1)
    save_tiff(folder / "rgb.tif", colours, photometric="rgb")
    Image.fromarray(colours).save(folder / "rgb.jpg")
    Image.fromarray(colours).save(folder / "rgb.png", compress_level=1)
    return ["deep.tif", "deep.png", "lzw.tif", "palette.tif", "rgb.tif", "rgb.jpg", "rgb.png"]


@pytest.mark.slow
@pytest.mark.parametrize("make", [largest_maps, largest_pictures])
def test_what_is_as_large_as_documented_is_read(tmp_path, make):
    for name in make(tmp_path):
        assert read_in_sandbox(tmp_path / name).values.size > 10_000_000, name


def test_what_is_larger_is_refused_with_the_limit_and_the_way_out(tmp_path):
    path = al3d_file(tmp_path / "map.al3d", np.zeros((40, 40)), 1.0)
    raw = path.read_bytes()
    for name in (b"Rows", b"Cols"):
        tag = name.ljust(20, b"\0") + b"40".ljust(30, b"\0")
        raw = raw.replace(tag, name.ljust(20, b"\0") + b"4473".ljust(30, b"\0"))
    path.write_bytes(raw)
    os.truncate(path, len(raw) + 4474 * 4473 * 4)
    with pytest.raises(BadInput, match="at most 20 million points; cut out the part"):
        read_surface_image(path)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits are Linux's")
def test_the_limit_that_was_met_is_named(tmp_path):
    path = tmp_path / "large.png"
    Image.fromarray(np.tile(some_grey(500, 600), (8, 9))).save(path, compress_level=1)
    sentence = "large.png, but must be readable within 80 MB; cut out the part that matters"
    with pytest.raises(BadInput, match=sentence):
        read_in_sandbox(path, memory=80_000_000)
    module = "from stonepass.sandbox.worker import serve\n"
    module += "def parse(request):\n    while True: pass\n"
    (tmp_path / "endless.py").write_text(module + "serve(lambda request: None, parse)\n")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
        patch.setattr("stonepass.sandbox.sandbox.PATIENCE", 300.0)
        with pytest.raises(
            BadInput,
            match=r"read within 0.2 s of processor time \(reading it took longer\); cut out",
        ):
            parse_in_sandbox("endless", {}, Limits(seconds=0.2), "image", "a.png")
