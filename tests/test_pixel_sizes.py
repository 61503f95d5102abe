"""Scales that files state, and variants of height-map files."""

import json
import re
import struct
from pathlib import Path

import numpy as np
import pytest
import tifffile
from picture_files import FEI, ZEISS, moved_x3p, packed_sur, save_tiff, some_grey, sur_file
from PIL import Image
from SurfaceTopography import Topography

import stonepass
from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.surface.friction import surface_friction
from stonepass.surface.height_maps import HEIGHT_MAPS
from stonepass.surface.pixel_size import imagej_scan, jeol_scan, ome_scan
from stonepass.surface.readers import read_surface_image
from stonepass.surface.sandboxed import read_in_sandbox
from stonepass.surface.surface_image import PixelArea

EXAMPLES = Path(__file__).parents[1] / "examples"
MICRO = 1e-6
JEOL = (
    "$SEM_DATA_VERSION 1\r\n$CM_MAG 1000\r\n$CM_FULL_SIZE 80 50\r\n"
    "$$SM_MICRON_BAR 40\r\n$$SM_MICRON_MARKER 10um\r\n"
)
HITACHI = "[SemImageFile]\r\nInstructName=SU8000\r\nPixelSize=248.0469\r\nDataSize=80x60\r\n"


# Scales


@pytest.mark.parametrize("unit", ["um", "micron", "\\u00B5m", "nm", "mm"])
def test_the_scale_of_fiji(tmp_path, unit):
    metre = {"nm": 1e-9, "mm": 1e-3}.get(unit, MICRO)
    per_unit = metre / 2.5e-7
    path = tmp_path / "fiji.tif"
    tifffile.imwrite(path, some_grey(), imagej=True, resolution=(per_unit, per_unit / 2),
                     metadata={"unit": unit})  # fmt: skip
    for read in (read_surface_image, read_in_sandbox):
        found = read(path)
        assert found.pixel == pytest.approx((2.5e-7, 5e-7), rel=1e-5)
        assert found.pixel_source == "ImageJ description"


def test_a_resolution_for_print_is_no_scale_in_fiji_either(tmp_path):
    path = tmp_path / "fiji.tif"
    tifffile.imwrite(path, some_grey(), imagej=True, resolution=(300, 300),
                     metadata={"unit": "inch"})  # fmt: skip
    found = read_surface_image(path)
    assert found.pixel is None
    assert (
        found.pixel_hint == "the ImageJ description gives it in inch, a unit of print resolutions"
    )
    assert imagej_scan({"unit": "pixel"}, ((1, 1), (1, 1))).pixel is None
    assert imagej_scan({"unit": "um"}, ((0, 1), None)).pixel is None
    assert imagej_scan({"unit": "furlong"}, ((2, 1), None)).pixel is None
    assert imagej_scan({}, (None, None)).pixel is None


@pytest.mark.parametrize("unit", ["µm", "nm", None])
def test_the_scale_of_ome(tmp_path, unit):
    size = 250.0 if unit == "nm" else 0.25
    metadata = {"axes": "YX", "PhysicalSizeX": size, "PhysicalSizeY": 2 * size}
    if unit:
        metadata |= {"PhysicalSizeXUnit": unit, "PhysicalSizeYUnit": unit}
    path = tmp_path / "a.ome.tif"
    tifffile.imwrite(path, some_grey(), ome=True, metadata=metadata)
    found = read_surface_image(path)
    assert found.pixel == pytest.approx((2.5e-7, 5e-7))
    assert found.pixel_source == "OME description"
    assert ome_scan('<Pixels SizeX="80" PhysicalSizeX="1" PhysicalSizeXUnit="pixel">').pixel is None
    assert ome_scan("no XML").pixel is None
    micro = ome_scan('<ome:Pixels SizeX="80" PhysicalSizeX="1" PhysicalSizeXUnit="&#181;m">')
    assert (micro.pixel, micro.columns) == (pytest.approx((MICRO, MICRO)), 80)


@pytest.mark.parametrize("encoding", ["ascii", "utf-16"])
@pytest.mark.parametrize(
    ("text", "pixel", "bottom", "source"),
    [(JEOL, 2.5e-7, 50, "JEOL text file"), (HITACHI, 2.480469e-7, 60, "Hitachi text file")],
)
def test_the_text_file_of_jeol_or_hitachi(tmp_path, text, pixel, bottom, source, encoding):
    path = tmp_path / "sem.tif"
    save_tiff(path, some_grey())
    (tmp_path / "sem.txt").write_bytes(text.encode(encoding))
    for read in (read_surface_image, read_in_sandbox):
        found = read(path)
        assert found.pixel == pytest.approx((pixel, pixel))
        assert found.pixel_source == source
        assert found.area == PixelArea(0, 0, 80, bottom)  # JEOL says how high the picture is
    (tmp_path / "sem.txt").write_text("notes of an afternoon\nPixelSize=3\n")
    assert read_surface_image(path).pixel is None


def test_jeol_markers_of_every_unit():
    for marker, metre in (("100nm", 1e-7), ("1um", 1e-6), ("1µm", 1e-6), ("0.5mm", 5e-4)):
        scan = jeol_scan(JEOL.replace("10um", marker))
        assert scan.pixel == pytest.approx((metre / 40, metre / 40))
    for broken in (JEOL.replace("10um", "ten"), JEOL.replace("BAR 40", "BAR 0")):
        assert jeol_scan(broken).pixel is None


# Pictures that were resized


def resized(tmp_path, kind):
    """A picture of 80 columns whose words are of 160."""
    path = tmp_path / "sem.tif"
    if kind == "FEI tag":
        text = FEI.replace("ResolutionX=80", "ResolutionX=160")
        return save_tiff(path, some_grey(), extratags=[(34682, "s", 0, text, True)])
    if kind == "Zeiss tag":
        stored = "DP_IMAGE_STORE\r\nStore resolution = 160 * 120\r\n"
        return save_tiff(path, some_grey(), extratags=[(34118, "s", 0, ZEISS + stored, True)])
    save_tiff(path, some_grey())
    text = JEOL.replace("80 50", "160 100") if kind == "JEOL text file" else HITACHI.replace("80x60", "160x120")  # fmt: skip
    (tmp_path / "sem.txt").write_text(text)
    return path


@pytest.mark.parametrize("kind", ["FEI tag", "Zeiss tag", "JEOL text file", "Hitachi text file"])
def test_a_resized_picture_says_so_and_what_to_do(tmp_path, kind):
    path = resized(tmp_path, kind)
    with pytest.raises(BadInput) as refused:
        surface_friction(read_in_sandbox(path), "1 um")
    told = str(refused.value)
    size, double = ("0.248", "0.4961") if kind.startswith("Hitachi") else ("0.25", "0.5")
    assert "pixel size is missing, but must be given as --pixel; the" in told
    assert (
        f"the {kind} says {size} µm for a picture 160 pixels wide, but this one is 80 wide" in told
    )
    assert f"give {double}um if it was resized as a whole, or {size}um if it was cropped" in told
    assert read_surface_image(path).with_pixel(MICRO).pixel == (MICRO, MICRO)


def test_a_given_pixel_size_that_contradicts_the_file_is_told(tmp_path, capsys):
    """A picture keeps the given size with a note; a height map has its own, as its heights."""
    tag = (34682, "s", 0, FEI.replace("2e-007", "2.5e-007"), True)
    path = save_tiff(tmp_path / "sem.tif", some_grey(), extratags=[tag])
    found = read_surface_image(path)
    note = "the FEI tag says 0.25 µm × 0.25 µm per pixel, which is not used"
    assert found.with_pixel(2.5e-6).notes == (*found.notes, note)
    assert found.with_pixel(2.51e-7).notes == found.notes
    command = ["friction", str(EXAMPLES / "crystals.x3p")]
    assert run([*command, "--pixel", "5um"]) == 2
    told = " ".join(capsys.readouterr().err.split())
    sentence = (
        "pixel size is 5 µm, but must be left out; the height map has its own, 0.5 µm × 0.5 µm."
    )
    assert sentence in told


def test_the_help_names_kinds_of_files_that_are_read(capsys):
    """And so does the page, whose list of endings a browser offers."""
    assert run(["friction", "--help"]) == 0
    told = " ".join(capsys.readouterr().out.replace("│", " ").split())
    kinds = re.search(r"height map \((.*?) and others\)", told).group(1).split(", ")
    assert {f".{kind.lower()}" for kind in kinds} <= set(HEIGHT_MAPS)
    page = Path(stonepass.__file__).parent / "web/page/js/lab_friction.js"
    offered = re.search(r'ACCEPT = "(.*?),image', page.read_text()).group(1).split(",")
    assert set(offered) - set(HEIGHT_MAPS) == {".png", ".jpg", ".jpeg", ".tif", ".tiff"}


# Height maps


def heights(rows=24, columns=40):
    y, x = np.mgrid[:rows, :columns]
    return np.sin(x / 3.0) + 0.2 * np.cos(y / 4.0)


@pytest.mark.parametrize(
    "variant",
    [
        {"prefix": "scan/"},
        {"prefix": "a/b/", "slash": "\\"},
        {"slash": "\\"},
        {"revision": "ISO5436 - 2000", "prefix": "scan/"},
        {"revision": "ISO 5436-2000"},
        {},
    ],
)
def test_x3p_as_other_programs_write_it(tmp_path, variant):
    source = tmp_path / "plain.x3p"
    sizes = (40 * MICRO, 24 * MICRO)
    Topography(heights().T * MICRO, sizes, unit="m").to_x3p(str(source))
    path = moved_x3p(tmp_path / "other.x3p", source, **variant)
    for read in (read_surface_image, *([] if variant else [read_in_sandbox])):
        np.testing.assert_array_equal(read(path).values, read_surface_image(source).values)


def test_another_revision_is_still_refused(tmp_path):
    source = tmp_path / "plain.x3p"
    sizes = (40 * MICRO, 24 * MICRO)
    Topography(heights().T * MICRO, sizes, unit="m").to_x3p(str(source))
    with pytest.raises(BadInput, match="Revision should be"):
        read_surface_image(moved_x3p(tmp_path / "b.x3p", source, revision="ISO5436 - 2024"))


@pytest.mark.parametrize("streams", [1, 3])
@pytest.mark.parametrize("comment", [b"", b"a comment"])
def test_compressed_digital_surf(tmp_path, streams, comment):
    plain = sur_file(tmp_path / "plain.sur", heights(), 1.0)
    packed = packed_sur(tmp_path / "packed.sur", plain.read_bytes(), streams)
    raw = bytearray(packed.read_bytes())
    raw[334:336] = struct.pack("<H", len(comment))
    packed.write_bytes(raw[:512] + comment + raw[512:])
    for read in (read_surface_image, *([] if comment or streams > 1 else [read_in_sandbox])):
        found = read(packed)
        np.testing.assert_array_equal(found.values, read_surface_image(plain).values)
        assert found.pixel == pytest.approx((MICRO, MICRO))
    packed.write_bytes(raw[: len(raw) - 40])
    with pytest.raises(BadInput, match="undamaged"):
        read_surface_image(packed)
    bomb = raw[:512] + comment + struct.pack("<III", 1, 2_000_000_000, 100) + bytes(200)
    packed.write_bytes(bomb)
    with pytest.raises(BadInput, match="at most 90 MB unpacked"):
        read_surface_image(packed)


def gwy_file(path, *channels):
    """A Gwyddion file of channels, each a title and the unit of its numbers."""

    def item(name, kind, body):
        return name.encode() + b"\0" + kind.encode() + body

    def thing(name, *items):
        body = b"".join(items)
        return name.encode() + b"\0" + struct.pack("<I", len(body)) + body

    def unit(name, text):
        return item(name, "o", thing("GwySIUnit", item("unitstr", "s", text.encode() + b"\0")))

    z = heights() * MICRO
    items = []
    for index, (title, z_unit) in enumerate(channels):
        field = thing(
            "GwyDataField",
            *(item(name, "i", struct.pack("<i", n)) for name, n in (("xres", 40), ("yres", 24))),
            *(item(name, "d", struct.pack("<d", n * MICRO)) for name, n in (("xreal", 40), ("yreal", 24))),
            unit("si_unit_xy", "m"),
            unit("si_unit_z", z_unit),
            item("data", "D", struct.pack("<I", z.size) + z.astype("<f8").tobytes()),
        )  # fmt: skip
        items.append(item(f"/{index}/data", "o", field))
        items.append(item(f"/{index}/data/title", "s", title.encode() + b"\0"))
    path.write_bytes(b"GWYP" + thing("GwyContainer", *items))
    return path


def test_a_file_without_a_channel_of_heights(tmp_path):
    path = gwy_file(tmp_path / "volts.gwy", ("Deflection", "V"))
    sentence = "volts.gwy without a channel of heights, but must be a map of heights; export the"
    with pytest.raises(BadInput, match=sentence):
        read_surface_image(path)
    path = gwy_file(tmp_path / "both.gwy", ("Phase", "deg"), ("Height", "m"))
    np.testing.assert_allclose(read_surface_image(path).values, heights() * MICRO)


# Names of files


def test_a_long_name_never_hides_the_reason(tmp_path):
    stem = "a_specimen_with_a_long_story_" * 8
    colours = np.stack([some_grey(), some_grey()[::-1], some_grey()], axis=-1)
    Image.fromarray(colours).save(tmp_path / f"{stem}.png")
    save_tiff(tmp_path / f"{stem}.tif", np.zeros((40, 40), np.float32))
    gwy_file(tmp_path / f"{stem}.gwy", ("Deflection", "V"))
    (tmp_path / f"{stem}.x3p").write_bytes(b"PK\3\4" + bytes(200))
    (tmp_path / f"{stem}.sur").write_bytes(b"nothing of the kind")
    for ending, reason in (
        ("png", "in colour, but must be grey"),
        ("tif", "of 32 signed or floating bits"),
        ("gwy", "without a channel of heights"),
        ("x3p", "an undamaged file of a kind that can be read (FileFormatMismatch"),
        ("sur", "an undamaged file of a kind that can be read (FileFormatMismatch"),
    ):
        with pytest.raises(BadInput) as refused:
            read_surface_image(tmp_path / f"{stem}.{ending}")
        told = str(refused.value)
        assert reason in told, told
        assert "a_specimen" in told
        assert len(told) < 400


def test_a_scale_is_used_by_the_command(tmp_path, capsys):
    y, x = np.mgrid[:60, :400]
    grey = (128 + 80 * np.sin(x / 25.0) + 20 * np.sin(y / 9.0)).astype(np.uint8)
    path = save_tiff(tmp_path / "sem.tif", grey)
    (tmp_path / "sem.txt").write_text(JEOL.replace("80 50", "400 60"))
    assert run(["friction", str(path), "--height-range", "5um", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["pixel_um"] == pytest.approx(0.25)
    assert record["pixel_source"] == "JEOL text file"
