"""Parts of a picture that are no surface: data bars, colours, gaps; and a specimen that is tilted."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import tifffile
from picture_files import FEI, save_tiff
from PIL import Image
from shown import check_shown

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.surface.baseline import fit_baseline
from stonepass.surface.border import without_border
from stonepass.surface.data_bar import find_bar
from stonepass.surface.decoded import Decoded
from stonepass.surface.friction import surface_friction
from stonepass.surface.gaps import known_area
from stonepass.surface.height_maps import read_height_map
from stonepass.surface.levelling import fit_plane
from stonepass.surface.lost_points import lost_points, without_lost_points
from stonepass.surface.paths import StraightPath, evenly_spaced, profiles_along
from stonepass.surface.readers import read_surface_image
from stonepass.surface.sandboxed import read_in_sandbox
from stonepass.surface.surface_image import PixelArea, SurfaceImage

EXAMPLES = Path(__file__).parents[1] / "examples"
MICRO = 1e-6
ROWS, COLUMNS = 240, 360


def surface(noise=6.0):
    """Grey values of a wavy surface with noise."""
    y, x = np.mgrid[:ROWS, :COLUMNS]
    generator = np.random.default_rng(1)
    grey = 128 + 70 * np.sin(x / 14.0) + 30 * np.sin(y / 20.0)
    return (grey + noise * generator.normal(size=x.shape)).clip(1, 254).astype(np.uint8)


def bar(height=30, background=255, ink=0, frame=True):
    """A data bar: writing on a background, in a frame."""
    found = np.full((height, COLUMNS), background, np.uint8)
    found[height // 3 : height // 3 + 12, 20:300:9] = ink
    found[height // 3 : height // 3 + 12, 21:300:9] = ink
    if frame:
        found[[0, -1]] = ink
        found[:, [0, -1]] = ink
    return found


def heights_of(z):
    """A height map of heights in µm, 1 µm apart."""
    rows, columns = z.shape
    return SurfaceImage(z * MICRO, (MICRO, MICRO), 0, PixelArea(0, 0, columns, rows))


# Data bars


@pytest.mark.parametrize("frame", [True, False])
@pytest.mark.parametrize(("background", "ink"), [(255, 0), (0, 255), (40, 250)])
@pytest.mark.parametrize("where", ["bottom", "top"])
@pytest.mark.parametrize("kind", ["png", "jpg"])
def test_a_data_bar_is_found_and_left_out(tmp_path, where, background, ink, frame, kind):
    parts = [surface(), bar(background=background, ink=ink, frame=frame)]
    path = tmp_path / f"sem.{kind}"
    picture = Image.fromarray(np.vstack(parts if where == "bottom" else parts[::-1]))
    picture.save(path, **({"quality": 92} if kind == "jpg" else {}))
    found = read_surface_image(path)
    top, bottom = (0, ROWS) if where == "bottom" else (30, 30 + ROWS)
    near = 2 if kind == "jpg" else 0  # JPEG smears the edge
    assert abs(found.area.top - top) <= near
    assert abs(found.area.bottom - bottom) <= near
    assert "look like a data bar" in found.notes[0]
    whole = read_surface_image(path, PixelArea(0, 0, COLUMNS, ROWS + 30))
    warned = surface_friction(whole.with_pixel(MICRO), "2 um").warnings
    assert "plain_rows" in {each.code for each in warned}


def test_a_surface_is_no_data_bar():
    """Neither rows of low contrast nor what fades into black."""
    y = np.arange(ROWS)[:, None]
    noise = 4.0 * np.random.default_rng(5).normal(size=(ROWS, COLUMNS))
    dark = (surface() * np.clip((ROWS - 40 - y) / 60.0, 0.0, 1.0) + noise).clip(0, 255)
    low = (surface().astype(int) // 16 + 100).astype(np.uint8)
    smooth = np.tile(np.round(127 + 100 * np.sin(np.arange(COLUMNS) / 90)), (ROWS, 1))
    for grey in (surface(), low, dark.astype(np.uint8), smooth.astype(np.uint8)):
        assert find_bar(grey) == (0, 0)


@pytest.mark.parametrize("bits", [8, 16])
def test_a_bar_of_cells_with_backgrounds_of_their_own_is_found(bits):
    cells = np.repeat([0, 128, 255], COLUMNS // 3)[None].repeat(40, axis=0)
    cells[12:24, 10:100:7] = 200
    grey = np.vstack([surface(), cells]).astype(np.uint8 if bits == 8 else np.uint16)
    assert find_bar(grey * (1 if bits == 8 else 257)) == (0, 40)


def test_the_margins_of_a_figure_cut_from_a_page_are_left_out(tmp_path):
    page = np.full((ROWS + 30, COLUMNS + 45), 255, np.uint8)
    page[10 : 10 + ROWS, 20 : 20 + COLUMNS] = surface()
    Image.fromarray(page).save(tmp_path / "figure.png")
    found = read_surface_image(tmp_path / "figure.png")
    assert found.area == PixelArea(20, 10, 20 + COLUMNS, 10 + ROWS)
    np.testing.assert_array_equal(found.surface, surface())
    assert "the last 25 columns look like a data bar or a margin" in found.notes[-1]


@pytest.mark.parametrize("grey", [0, 128, 255])
@pytest.mark.parametrize("width", [1, 3, 5, 100])
@pytest.mark.parametrize("sides", ["columns", "rows", "frame", "left"])
def test_a_border_of_one_grey_is_left_out_and_told(tmp_path, sides, width, grey):
    """However thin or wide, and at whatever sides: the area is the surface."""
    across, down = {
        "columns": ((width, width), (0, 0)), "rows": ((0, 0), (width, width)),
        "frame": ((width, width), (width, width)), "left": ((width, 0), (0, 0)),
    }[sides]  # fmt: skip
    padded = np.pad(surface(), (down, across), constant_values=grey)
    Image.fromarray(padded).save(tmp_path / "a.png")
    found = read_surface_image(tmp_path / "a.png")
    inner = PixelArea(across[0], down[0], across[0] + COLUMNS, down[0] + ROWS)
    assert found.area == inner
    assert len(found.notes) == (across[0] > 0) + (across[1] > 0) + (down[0] > 0) + (down[1] > 0)
    rows, columns = padded.shape
    whole = read_surface_image(tmp_path / "a.png", PixelArea(0, 0, columns, rows)).with_pixel(MICRO)
    try:
        told = " ".join(map(str, surface_friction(whole, "2 um").warnings))
    except BadInput as refused:
        told = str(refused)
        assert "darkest or brightest grey" in told
    assert inner.option in told


def test_the_friction_of_a_picture_with_borders_is_that_without(tmp_path, capsys):
    """The example with five white columns at both sides, and a frame of three pixels as JPEG."""
    known = np.asarray(Image.open(EXAMPLES / "known_slopes.png"))
    sides = np.pad(known, ((0, 0), (5, 5)), constant_values=255)
    Image.fromarray(sides).save(tmp_path / "sides.png")
    frame = np.pad(known, 3, constant_values=255)
    Image.fromarray(frame).save(tmp_path / "frame.jpg", quality=85)
    for name, tolerance in (("sides.png", 1e-12), ("frame.jpg", 0.01)):
        found = read_surface_image(tmp_path / name).with_pixel(0.5 * MICRO)
        plain = read_surface_image(EXAMPLES / "known_slopes.png").with_pixel(0.5 * MICRO)
        with_border, without = (surface_friction(each, "24.8 um") for each in (found, plain))
        assert with_border.friction == pytest.approx(without.friction, rel=tolerance)
        assert "the first" in " ".join(found.notes)
    command = ["friction", str(tmp_path / "sides.png"), "--pixel", "0.5um", "--height-range"]
    assert run([*command, "24.8um", "--area", "0,0,1011,240"]) == 0
    assert "exclude them with --area 5,0,1006,240" in " ".join(capsys.readouterr().err.split())


def test_a_smooth_surface_has_no_border():
    """Columns of one grey each, up to the edge, which is black or white or a dark corner."""
    x = np.arange(COLUMNS)
    waves = 127.5 + 127.5 * np.cos(x / 30.0)
    ramp = np.clip(x - 40.0, 0.0, 255.0)
    for profile in (waves, ramp, 255.0 * (x // 30 % 2)):
        grey = np.tile(np.round(profile), (ROWS, 1)).astype(np.uint8)
        for each in (grey, np.ascontiguousarray(grey.T)):
            area = PixelArea(0, 0, each.shape[1], each.shape[0])
            assert without_border(each, area) == area


def test_a_border_beside_a_declared_bar_is_left_out(tmp_path):
    fei = FEI.replace("ResolutionX=80", "ResolutionX=90").replace(
        "ResolutionY=50", "ResolutionY=60"
    )
    grey = np.vstack([np.pad(surface()[:50, :80], 5), np.zeros((10, 90), np.uint8)])
    path = save_tiff(tmp_path / "sem.tif", grey, extratags=[(34682, "s", 0, fei, True)])
    found = read_surface_image(path)
    assert found.area == PixelArea(5, 5, 85, 55)
    assert any("the lowest 15 rows look like" in each for each in found.notes)


def test_a_bar_of_an_fei_file_without_a_pixel_size(tmp_path):
    fei = FEI.replace("PixelWidth=2.5e-007\r\n", "").replace("PixelHeight=2e-007\r\n", "")
    grey = surface()[:60, :80]
    path = save_tiff(tmp_path / "sem.tif", grey, extratags=[(34682, "s", 0, fei, True)])
    found = read_surface_image(path)
    assert found.pixel is None
    assert found.area == PixelArea(0, 0, 80, 50)


def test_colour_outside_the_area_is_no_matter(tmp_path):
    """A green scale bar in the data bar, as RGB and as palette, by every reader."""
    grey = np.vstack([surface(), bar(frame=False)])
    index = grey.copy()
    index[ROWS + 20, 300:340] = 0
    index[grey == 0] = 1
    index[ROWS + 20, 300:340] = 0
    greys = np.stack([np.arange(256, dtype=np.uint8)] * 3, axis=1)
    greys[0] = 0, 255, 0
    rgb = greys[index]
    names = ["rgb.png", "rgb.tif", "palette.tif", "palette.png"]
    Image.fromarray(rgb).save(tmp_path / names[0])
    save_tiff(tmp_path / names[1], rgb, photometric="rgb")
    colormap = np.ascontiguousarray(greys.T.astype(np.uint16) * 257)
    save_tiff(tmp_path / names[2], index, photometric="palette", colormap=colormap)
    image = Image.fromarray(index, "P")
    image.putpalette(greys.tobytes())
    image.save(tmp_path / names[3])
    area = PixelArea(0, 0, COLUMNS, ROWS)
    for name in names:
        for read in (read_surface_image, read_in_sandbox):
            found = read(tmp_path / name, area=area)
            np.testing.assert_array_equal(found.surface, surface())
            with pytest.raises(BadInput, match="within 0, 0, 360, 240, the part without colours"):
                found.with_area(0, 0, COLUMNS, ROWS + 30)
        assert read_surface_image(tmp_path / name).area == area  # the bar is left out anyhow
        sentence = (
            f"{name} in colour, but must be grey; column 300 of row 260 is coloured; "
            "select --area 0,0,360,260."
        )
        with pytest.raises(BadInput, match=sentence):
            read_surface_image(tmp_path / name, PixelArea(0, 0, COLUMNS, ROWS + 30))
        with pytest.raises(BadInput, match="left, top, right, bottom within 0, 0, 360, 270"):
            read_surface_image(tmp_path / name, PixelArea(0, 0, COLUMNS, ROWS + 31))


def test_the_largest_grey_part_is_proposed():
    """A run of rows or of columns, whichever is larger; none if colours are everywhere."""
    rgb = np.repeat(np.full((700, 100, 1), 90, np.uint8), 3, axis=2)
    whole = PixelArea(0, 0, 100, 700)
    assert Decoded(rgb).grey_part(whole) == whole
    rgb[550, 80] = (255, 0, 0)
    assert Decoded(rgb).grey_part(whole) == PixelArea(0, 0, 80, 700)
    assert Decoded(rgb).grey_part(PixelArea(60, 100, 100, 700)) == PixelArea(60, 100, 100, 550)
    rgb[600, 40] = (255, 0, 0)
    assert Decoded(rgb).grey_part(whole) == PixelArea(0, 0, 100, 550)
    rgb[::100, ::10] = (0, 255, 0)
    assert Decoded(rgb).grey_part(whole) is None
    assert Decoded(rgb[..., 0]).grey_part(whole) == whole


# Pages


def test_a_thumbnail_is_not_the_picture(tmp_path):
    """Marked as reduced, by the new tag or the old one, or simply smaller; plain and by Pillow."""
    small, large = surface()[::4, ::4].copy(), surface()
    for name, mark in (
        ("new.tif", {"subfiletype": 1}),
        ("old.tif", {"extratags": [(255, "H", 1, 2, True)]}),
        ("none.tif", {}),
    ):
        with tifffile.TiffWriter(tmp_path / name) as file:
            file.write(small, photometric="minisblack", **mark)
            file.write(large, photometric="minisblack")
        found = read_surface_image(tmp_path / name)
        np.testing.assert_array_equal(found.values, large)
        assert found.notes == ("page 2 of 2 is read, the largest that is no reduced image",)
    path = tmp_path / "lzw.tif"
    images = [Image.fromarray(each) for each in (small, large)]
    images[0].save(path, save_all=True, append_images=images[1:], compression="tiff_lzw")
    np.testing.assert_array_equal(read_surface_image(path).values, large)


@pytest.mark.parametrize("compression", [None, "zlib", "tiff_lzw"])
@pytest.mark.parametrize("bits", [8, 16])
def test_white_is_zero_with_and_without_compression(tmp_path, bits, compression):
    values = surface().astype(np.uint8 if bits == 8 else np.uint16)
    path = tmp_path / "white.tif"
    if compression == "tiff_lzw":
        Image.fromarray(values).save(path, compression=compression)
        raw = bytearray(path.read_bytes())
        entry = raw.index(b"\x06\x01\x03\x00\x01\x00\x00\x00\x01\x00")  # photometric: black is zero
        raw[entry + 8] = 0
        path.write_bytes(bytes(raw))
    else:
        save_tiff(path, values, photometric="miniswhite", compression=compression)
    found = read_surface_image(path).values
    np.testing.assert_array_equal(found, 2**bits - 1 - values)


# Gaps


def wave(rows=120, columns=400):
    y, x = np.mgrid[:rows, :columns]
    return 2.0 * np.sin(2.0 * np.pi * x / 101.0) + 0.3 * np.sin(y / 9.0)


def test_a_missing_height_beside_a_path_is_no_matter():
    z = wave()
    z[21, 100] = np.nan
    whole, holed = heights_of(wave()), heights_of(z)
    for path in (StraightPath(0, 20, 399, 20), StraightPath(0, 22, 399, 22)):
        np.testing.assert_array_equal(
            profiles_along(holed, [path]).values, profiles_along(whole, [path]).values
        )
    with pytest.raises(BadInput, match="one without gaps in the height map; choose other paths"):
        profiles_along(holed, [StraightPath(0, 20.5, 399, 20.5)])


def test_small_gaps_are_bridged_and_told_of():
    """Four per cent of the heights missing, singly and in spots of up to 5 µm."""
    z = wave()
    exact = surface_friction(heights_of(z))
    check_shown(exact, "friction_coefficient", "k0", "k1")
    generator = np.random.default_rng(2)
    y, x = np.mgrid[: z.shape[0], : z.shape[1]]
    holes = generator.random(z.shape) < 0.01
    for _ in range(90):
        row, column = generator.integers(0, z.shape[0]), generator.integers(0, z.shape[1])
        holes |= np.hypot(y - row, x - column) <= 2.5
    assert 0.03 < holes.mean() < 0.06
    found = surface_friction(heights_of(np.where(holes, np.nan, z)))
    assert found.friction == pytest.approx(exact.friction, rel=0.01)
    assert found.roughness.Rq == pytest.approx(exact.roughness.Rq, rel=0.02)
    assert found.roughness.RdeltaQ == pytest.approx(exact.roughness.RdeltaQ, rel=0.02)
    (told,) = (each for each in found.warnings if each.code == "gaps_bridged")
    assert 0.02 < dict(told.values)["fraction"] < 0.07
    assert dict(told.values)["length_um"] <= 400 / 16 / 2


def test_a_row_with_a_long_gap_is_replaced_by_the_nearest_without():
    z = wave()
    z[8:12, 150:250] = np.nan  # row 10 is the first of six
    heights = heights_of(z)
    assert [path.y0 for path in evenly_spaced(heights, 6)] == [12.0, 30.0, 50.0, 70.0, 90.0, 110.0]
    found = surface_friction(heights)
    assert "1 of 6 profiles were moved" in " ".join(map(str, found.warnings))
    assert found.friction == pytest.approx(surface_friction(heights_of(wave())).friction, rel=1e-2)


def test_a_border_without_heights_is_named_with_the_area_that_helps():
    z = wave()
    z[:, :12] = z[:, -7:] = np.nan
    z[:5] = z[-9:] = np.nan
    z[np.random.default_rng(3).random(z.shape) < 0.03] = np.nan
    assert known_area(z, PixelArea(0, 0, 400, 120)) == PixelArea(12, 5, 393, 111)
    sentence = "leave out the border, where heights are missing, with --area 12,5,393,111"
    with pytest.raises(BadInput, match=sentence):
        surface_friction(heights_of(z))
    found = surface_friction(heights_of(z).with_area(12, 5, 393, 111))
    whole = surface_friction(heights_of(wave()).with_area(12, 5, 393, 111))
    assert found.friction == pytest.approx(whole.friction, rel=0.01)
    sentence = "one with measured heights at both ends; shorten it to 1"
    with pytest.raises(BadInput, match=sentence):
        surface_friction(heights_of(z), paths=[StraightPath(0, 60, 399, 60)])
    z[:, 50:] = np.nan
    z[:, ::3] = np.nan
    with pytest.raises(BadInput, match="give paths that avoid the gaps with --path"):
        surface_friction(heights_of(z))


# Lost points


def rough(rows=300, columns=400):
    """Heights in µm over a range of 10 µm, with noise of 0.07 µm."""
    y, x = np.mgrid[:rows, :columns]
    noise = 0.02 * np.random.default_rng(3).normal(size=(rows, columns))
    z = np.sin(2 * np.pi * x / 100 + 0.3) + 0.5 * np.sin(2 * np.pi * (x + 0.3 * y) / 61) + noise
    return 10.0 * (z - z.min()) / np.ptp(z)


def spots(shape, kind):
    """Places of lost points: single ones, pairs and more by chance, or round spots."""
    generator = np.random.default_rng(5)
    if kind == "points":
        return generator.random(shape) < 0.01
    y, x = np.mgrid[: shape[0], : shape[1]]
    found = np.zeros(shape, bool)
    for _ in range(60):
        row, column = generator.integers(0, shape[0]), generator.integers(0, shape[1])
        found |= np.hypot(y - row, x - column) < 2.5
    return found


def told_lost(found):
    return [dict(each.values) for each in found.warnings if each.code == "lost_points"]


@pytest.mark.parametrize(
    ("kind", "value", "offset"),
    [
        ("points", 0.0, 100.0),
        ("spots", 0.0, 100.0),
        ("points", -32.768, 0.0),
        ("spots", -9.999e6, 0.0),
        ("points", 0.0, -5.0),  # amid the heights of the surface
    ],
)
def test_lost_points_stored_as_a_constant_are_gaps(kind, value, offset):
    z = rough() + offset
    lost = spots(z.shape, kind)
    found = surface_friction(heights_of(np.where(lost, value, z)))
    exact = surface_friction(heights_of(z))
    missing = surface_friction(heights_of(np.where(lost, np.nan, z)))
    assert found.friction == pytest.approx(missing.friction, rel=1e-9)
    assert found.friction == pytest.approx(exact.friction, rel=0.01)
    assert found.roughness.RdeltaQ == pytest.approx(exact.roughness.RdeltaQ, rel=0.03)
    (told,) = told_lost(found)
    assert told == {"count": np.count_nonzero(lost), "heights": f"{value:.4g} µm"}


@pytest.mark.parametrize(
    ("places", "values", "shown"),
    [
        ([(25, 200)], [1000.0], "1000 µm"),
        ([(25, 201), (25, 202), (25, 203)], [-9.999e6] * 3, "-9.999e+06 µm"),
        ([(25, 200), (25, 201)], [1000.0, 1100.0], "1000 to 1100 µm"),
        ([(150, 200), (25, 0), (25, 300)], [1e36, -40.0, 30.0], "-40 to 1e+36 µm"),
    ],
)
def test_spikes_are_gaps_and_told(places, values, shown):
    z = rough()
    for place, value in zip(places, values, strict=True):
        z[place] = value
    paths = [StraightPath(1, 25 * k, 399, 25 * k) for k in range(1, 7)]
    found = surface_friction(heights_of(z), paths=paths)
    exact = surface_friction(heights_of(rough()), paths=paths)
    assert found.friction == pytest.approx(exact.friction, rel=1e-3)
    assert found.tilt == pytest.approx(exact.tilt, rel=0.01)
    (told,) = told_lost(found)
    assert told == {"count": len(places), "heights": shown}


def test_many_lost_points_are_refused_with_the_remedy():
    z = np.where(np.random.default_rng(6).random((300, 400)) < 0.3, 0.0, rough() + 100.0)
    sentence = (
        r"height map is 0 µm at 30% of its points, as if no height was measured there, but must be "
        r"without such points at more than 10%; leave them out with --area or store"
    )
    with pytest.raises(BadInput, match=sentence):
        surface_friction(heights_of(z))
    z[:, :200] = rough()[:, :200] + 100.0
    assert not told_lost(surface_friction(heights_of(z).with_area(0, 0, 200, 300)))


def test_a_real_surface_has_no_lost_points():
    """Steps, grooves, pits, pillars, crystals, terraces and noise keep every height."""
    z = rough()
    y, x = np.mgrid[: z.shape[0], : z.shape[1]]
    generator = np.random.default_rng(7)
    pillars = (x % 40 < 3) & (y % 40 < 3)
    groove = (x > 180) & (x < 220)
    surfaces = {
        "step": z + 20.0 * (x > 200),
        "groove": z - 20.0 * ((x > 200) & (x < 203)),
        "scratch": z - 20.0 * ((y == 100) & (x > 100) & (x < 300)),
        "flat groove": np.where(groove, -100.0, z),
        "flat pit": np.where(groove & (y > 100) & (y < 150), -100.0, z),
        "groove in a plate": np.where(groove, -5.0, 0.01 * generator.normal(size=z.shape)),
        "pillars": 0.01 * z + 20.0 * pillars,
        "terraces": np.floor(z),
        "cut off": np.clip(z, 3.0, 7.0),
        "two levels": np.where(x > 200, 20.0, 0.0),
        "half flat": np.where(x > 200, z, 0.0),
        "flat but for the last digit": (generator.random(z.shape) < 0.001) * 0.001,
        "noise": generator.normal(size=z.shape),
        "a plane": 0.1 * x + 0.02 * y,
        "missing": np.where(generator.random(z.shape) < 0.3, np.nan, z),
        "crystals": read_surface_image(EXAMPLES / "crystals.x3p").values / MICRO,
    }
    for name, each in surfaces.items():
        assert not lost_points(each * MICRO).any(), name
    picture = heights_of(z)
    assert without_lost_points(picture) == (picture, [])


# Tilt


@pytest.mark.parametrize("tilt", [1.0, 5.0])
@pytest.mark.parametrize("holes", [False, True])
def test_a_tilt_is_told_of_and_taken_out(tilt, holes):
    z = wave()
    if holes:
        z[np.random.default_rng(4).random(z.shape) < 0.03] = np.nan
    y, x = np.mgrid[: z.shape[0], : z.shape[1]]
    slope = np.tan(np.radians(tilt))
    flat, tilted = heights_of(z), heights_of(z + slope * x - 0.5 * slope * y)
    level = surface_friction(flat, level=True)
    raw, taken = surface_friction(tilted), surface_friction(tilted, level=True)
    assert taken.friction == pytest.approx(level.friction, rel=1e-9)
    assert raw.friction > level.friction + 0.6 * slope
    (told,) = (each for each in raw.warnings if each.code == "tilted")
    assert dict(told.values)["levelled"] == pytest.approx(level.friction, rel=1e-9)
    assert raw.friction_levelled == pytest.approx(taken.friction, rel=1e-12)
    expected = np.degrees(np.arctan(slope * np.hypot(1.0, 0.5)))
    assert np.degrees(raw.tilt) == pytest.approx(expected, abs=0.3)
    assert not any(each.code == "tilted" for each in (*taken.warnings, *level.warnings))


def test_a_plane_is_found_exactly():
    y, x = np.mgrid[:50, :1100]
    z = 3.0 + 0.25 * x - 0.125 * y
    z[:, 7] = np.nan
    picture = replace(heights_of(z), values=z, area=PixelArea(2, 3, 1000, 40))
    plane = fit_plane(picture)
    assert (plane.across, plane.down) == pytest.approx((0.25, -0.125), rel=1e-9)
    np.testing.assert_allclose(plane.at(x, y), 3.0 + 0.25 * x - 0.125 * y, atol=1e-9)
    assert plane.tilt((1.0, 0.5), 2.0) == pytest.approx(np.arctan(2.0 * np.hypot(0.25, 0.25)))


def test_a_grey_picture_that_drifts_is_levelled():
    """The greys of a wave and a drift, levelled, are those of the wave."""
    x = np.arange(1001)
    profile = np.sin(2.0 * np.pi * x / 200.2)
    drift = np.tile(profile + 0.004 * x, (40, 1))

    def picture(z):
        grey = np.round(60000 * (z - z.min()) / np.ptp(z)).astype(np.uint16)
        return SurfaceImage(grey, (MICRO, MICRO), 65535, PixelArea(0, 0, 1001, 40))

    plain = surface_friction(picture(np.tile(profile, (40, 1))), "8 um", level=True)
    levelled = surface_friction(picture(drift), "8 um", level=True)
    assert levelled.friction == pytest.approx(plain.friction, rel=1e-3)
    raw = surface_friction(picture(drift), "8 um")
    assert raw.friction != pytest.approx(plain.friction, rel=0.05)
    assert raw.friction_levelled == pytest.approx(levelled.friction, rel=1e-9)


# The margin


def test_the_margin_is_an_option_and_its_effect_is_told(tmp_path, capsys):
    """Of a parabola x²/1000 the slope is steepest at the end: 2 (L − margin)/1000."""
    x = np.linspace(0.0, 500.0, 501)
    baseline = fit_baseline(x, x**2 / 1000.0, 8, margin=0.25)
    assert baseline.looked_at == pytest.approx((1 / 16, 15 / 16))
    assert baseline.steepest == pytest.approx(1.0 * 15 / 16, rel=1e-9)
    assert replace(baseline, order=2, margin=2.0).looked_at == (0.25, 0.75)
    heights = heights_of(np.tile(x**2 / 1000.0, (20, 1)))
    found = surface_friction(heights, margin=0.0)
    assert found.k0 == pytest.approx(1.0, rel=1e-6)
    by_margin = dict(found.spread.margins)
    expected = {0.0: 1.0, 0.25: 15 / 16, 0.5: 7 / 8, 1.0: 3 / 4}
    assert by_margin == pytest.approx(expected, rel=1e-6)
    path = tmp_path / "bowl.png"
    Image.fromarray(np.tile(np.round(x**2 * 65535 / 250000), (20, 1)).astype(np.uint16)).save(path)
    command = ["friction", str(path), "--pixel", "1um", "--height-range", "250um"]
    assert run([*command, "--margin", "0.25", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["margin"] == 0.25
    assert record["looked_at"]["k0"] == pytest.approx([1 / 16, 15 / 16])
    assert record["spread"]["margin"]["0"] == pytest.approx(1.0, rel=0.01)
    assert record["tilt_deg"] == pytest.approx(26.6, abs=0.5)
    assert record["levelled"] is False
    assert run([*command, "--margin", "0.25", "--level"]) == 0
    shown = capsys.readouterr().out
    assert "range over end margins" in shown
    assert "the least-squares plane is" in shown
    assert run([*command, "--margin", "3"]) == 2
    assert "margin is 3.0, but must be a number from 0 to 2" in capsys.readouterr().err


@pytest.mark.parametrize(
    "bar", [(slice(200, 213), slice(80, 230)), (slice(60, 160), slice(300, 308))]
)
@pytest.mark.parametrize("grey", [0, 255])
def test_a_scale_bar_inside_a_picture_is_told(tmp_path, capsys, bar, grey):
    """White or black, along or across, as PNG and as JPEG; a round saturated patch is none."""
    values = surface().copy()
    values[bar] = grey
    rows, columns = bar
    place = f"{columns.start}, {rows.start}, {columns.stop}, {rows.stop}"
    for name in ("bar.png", "bar.jpg"):
        Image.fromarray(values).save(tmp_path / name, quality=92)
        picture = read_surface_image(tmp_path / name, PixelArea(0, 0, COLUMNS, ROWS)).with_pixel(
            MICRO
        )
        told = {each.code: each for each in surface_friction(picture, "2 um").warnings}
        assert "drawn_bar" in told
        if name == "bar.png":
            assert dict(told["drawn_bar"].values)["place"] == place
    plain = SurfaceImage(surface(), (MICRO, MICRO), 255, PixelArea(0, 0, COLUMNS, ROWS))
    assert "drawn_bar" not in {each.code for each in surface_friction(plain, "2 um").warnings}
    y, x = np.mgrid[:ROWS, :COLUMNS]
    patch = np.where(((x - 180) / 30) ** 2 + ((y - 120) / 8) ** 2 < 1.0, grey, surface())
    round_one = replace(plain, values=patch.astype(np.uint8))
    assert "drawn_bar" not in {each.code for each in surface_friction(round_one, "2 um").warnings}


def test_heights_in_arbitrary_units_are_named(monkeypatch, tmp_path):
    """The library refuses such a unit with an error of its own."""
    import SurfaceTopography.IO

    def refused(*arguments, **options):
        raise ValueError("Unknown unit 'a.u.'.")

    monkeypatch.setattr(SurfaceTopography.IO, "open_topography", refused)
    with pytest.raises(BadInput, match=r"map\.al3d without a unit of length"):
        read_height_map(tmp_path / "map.al3d", None)
