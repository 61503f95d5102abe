"""Case files: there and back, and every wrong line named."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from options import asking

import stonepass as sp
from stonepass.inputs.case_file import read_case, write_case

GOOD = """
[stone]
diameter = "4.2 mm"
[ureter]
inner_diameter = "3.5 mm"
outer_diameter = "4.55 mm"
"""


def test_defaults_of_a_short_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(GOOD)
    expected = sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", "4.55 mm"))
    assert read_case(path) == expected


@pytest.mark.parametrize(
    "case",
    [
        sp.Case(sp.Stone("4.2 mm", friction=0.3), sp.Ureter("3.5 mm", "4.55 mm", "latex")),
        sp.Case(
            sp.Stone(size_ratio=1.234567890123),
            sp.Ureter(wall_ratio=1.3),
            sp.Load("5.4 kPa", "hydrostatic", 1.05),
            **asking(
                half_length=12.5, as_printed=True, closure_start="lumen", accuracy="reference"
            ),
        ),
        sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", wall_ratio=1.3)),
    ],
    ids=["diameters", "ratios", "mixed"],
)
def test_what_is_written_is_read_again(case, tmp_path):
    write_case(case, tmp_path / "case.toml")
    assert read_case(tmp_path / "case.toml") == case


def test_material_files_are_found_beside_the_case(tmp_path):
    folder = tmp_path / "laws"
    folder.mkdir()
    (folder / "soft.toml").write_text(
        'law = "neo-hookean"\nC10 = "10 kPa"\nsource = "me"\nstrain_range = [1.0, 1.4]\n'
    )
    case = sp.Case(
        sp.Stone(size_ratio=1.2),
        sp.Ureter(wall_ratio=1.3, material=sp.load_material(str(folder / "soft.toml"))),
    )
    write_case(case, tmp_path / "case.toml")
    assert 'material = "laws/soft.toml"' in (tmp_path / "case.toml").read_text()
    assert read_case(tmp_path / "case.toml").ureter.material.law.C10 == 10e3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "'stone' is missing"),
        ("[stone\n", "valid TOML"),
        (GOOD.replace("diameter = \"4.2", "diametr = \"4.2"), r"key of \[stone\] is diametr.*did you mean 'diameter'"),
        (GOOD + "[lod]\n", "key is lod.*did you mean 'load'"),
        ("stone = 3\n" + "[ureter]\n", r"'stone' is 3, but must be a section, written \[stone\]"),
        (GOOD.replace('"4.2 mm"', "4.2"), "'stone.diameter' is 4.2, but must be text in quotes"),
        (GOOD.replace("4.2 mm", "4.2 kg"), "in case.toml, 'stone.diameter' is 4.2 kg"),
        (GOOD.replace("4.55 mm", "3 mm"), "in case.toml, 'ureter.outer_diameter' is 3 mm"),
        (GOOD + '[method]\nmodel = "paprika"\n', "in case.toml, 'method.model' is paprika.*did you mean 'paper'"),
        (GOOD + "[load]\nprestretch = nan\n", "in case.toml, 'load.prestretch' is nan"),
        (GOOD.replace("[ureter]", "[ureter]\nmaterial = \"no.toml\""), "a file that exists"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_naming_file_and_key(text, words, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(text)
    with pytest.raises(sp.BadInput, match=words) as refusal:
        read_case(path)
    assert "\n" not in str(refusal.value)


def test_a_missing_or_binary_file_is_refused(tmp_path):
    with pytest.raises(sp.BadInput, match="a file that exists"):
        read_case(tmp_path / "none.toml")
    (tmp_path / "b.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(sp.BadInput, match="valid TOML"):
        read_case(tmp_path / "b.toml")


@pytest.mark.slow
@given(st.text(max_size=200))
@settings(max_examples=200, deadline=None)
def test_any_text_is_read_or_refused(text):
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.toml"
        path.write_text(GOOD + text, encoding="utf-8", errors="surrogatepass")
        try:
            assert isinstance(read_case(path), sp.Case)
        except sp.BadInput as refusal:
            assert "\n" not in str(refusal)
