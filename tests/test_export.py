"""Decks for other programs, and their results read back."""

import json
import os
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.export.comparison import DeckComparison, compare
from stonepass.export.element_strip import CLEARANCE
from stonepass.export.grid import grid
from stonepass.export.inp import write_inp
from stonepass.export.results import read_contact
from stonepass.export.seating import seating
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.protocol import Material
from stonepass.materials.yeoh import Yeoh
from stonepass.model.closure import Closure
from stonepass.model.critical_state import balance_pressure
from stonepass.model.far_field import far_field_law, lumen_ratio
from stonepass.model.states.nondimensional import profile_of

pytestmark = pytest.mark.usefixtures("shared_solutions")

XI, ETA, MU = 1.2, 1.5, 0.475
EXAMPLES = Path(__file__).parents[1] / "examples"


def latex(kind="pressed", xi=XI, load=None, **stone):
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=MU, **stone),
        sp.Ureter(wall_ratio=ETA, material="latex"),
        sp.Load() if load is None else load,
        **asking(seating=kind),
    )


def other(law, **method):
    material = Material("own", law, "s", "t", "v", (1.0, 1.5))
    return sp.Case(
        sp.Stone(size_ratio=XI),
        sp.Ureter(wall_ratio=ETA, material=material),
        **asking(**method),
    )


def deck(text):
    """Keyword lines with their parameters, each with its rows."""
    found = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            found.append((line, []))
        else:
            found[-1][1].append([word.strip() for word in line.split(",")])
    return found


def only(blocks, start):
    (rows,) = [rows for line, rows in blocks if line.startswith(start)]
    return rows


def assert_materials_are_whole(blocks):
    """What belongs to a material follows it at once: no other keyword stands between."""
    keywords = [line.split(",")[0] for line, _ in blocks]
    parts = {"*HYPERELASTIC", "*ANISOTROPIC HYPERELASTIC", "*ELASTIC"}
    at = [k for k, word in enumerate(keywords) if word == "*MATERIAL"]
    assert at
    assert all(keywords[k + 1] in parts for k in at)
    assert sum(word in parts for word in keywords) == len(at)


# --- the grid


def test_a_grid_of_one_row_has_the_nodes_of_quadratic_elements_anticlockwise():
    # One row of two elements: 5 + 3 + 5 nodes, no centres.
    g = grid(np.array([1.0, 2.0]), np.array([0.0, 1.0, 3.0]))
    assert len(g.points) == 13
    assert (g.rows, g.columns) == (1, 2)
    corners = g.points[g.cells[1][:4]]
    assert corners.tolist() == [[1.0, 1.0], [2.0, 1.0], [2.0, 3.0], [1.0, 3.0]]
    middles = g.points[g.cells[1][4:]]
    assert middles.tolist() == [[1.5, 1.0], [2.0, 2.0], [1.5, 3.0], [1.0, 2.0]]
    assert np.all(g.row_line(0) >= 0)


@pytest.mark.parametrize(
    "case",
    [
        latex(),
        latex("growing"),
        latex(aspect=1.7),
        latex(shape=sp.read_shape(EXAMPLES / "egg.csv")),
        latex(load=sp.Load(prestretch=1.2)),
        latex(load=sp.Load("6 kPa")),
    ],
)
def test_the_strip_starts_clear_of_the_wall_and_ends_as_the_stone(case):
    s = seating(case)
    end = s.element_strip.points + s.travel
    outer = s.element_strip.row_line(-1)
    gap = profile_of(case).gap(end[outer, 0], end[outer, 1])
    assert np.abs(gap).max() < 1e-12
    # Begins no wider than the lumen that is open at rest or under load, less the clearance.
    assert s.element_strip.points[:, 0].max() <= 1.0 - CLEARANCE + 1e-12
    assert s.element_strip.points[:, 0].min() > 0.0
    # Both meshes are the right way round: areas of the corner quadrilaterals are positive.
    for mesh in (s.wall, s.element_strip):
        a, b, c, d = (mesh.points[mesh.cells[:, k]] for k in range(4))
        ac, bd = c - a, d - b
        area = (ac[:, 0] * bd[:, 1] - ac[:, 1] * bd[:, 0]) / 2.0
        assert area.min() > 0.0
    # The strip reaches beyond the columns that may touch.
    touching = s.wall.points[s.wall.row_line(0)][:, 1][::2][s.facing]
    assert end[:, 1].max() > case.load.prestretch * touching.max() * 0.9


def test_dead_forces_sum_to_the_load():
    # 2π R_b L P_out on half a tube of length L = 10 R_a.
    s = seating(latex(load=sp.Load("5.4 kPa")))
    assert s.dead_forces().sum() == pytest.approx(2.0 * np.pi * ETA * 10.0 * 5400.0, rel=1e-12)


# --- the deck


def test_the_deck_holds_together():
    case = sp.Case(
        sp.Stone("4.2 mm", friction=MU),
        sp.Ureter("3.5 mm", "5.25 mm", material="latex"),
        **asking(),
    )
    s = seating(case)
    fine = s.fine
    blocks = deck(write_inp(s, "CAX8R"))
    nodes = {int(n): (float(r), float(z)) for n, r, z in only(blocks, "*NODE, NSET=ALL")}
    wall = only(blocks, "*ELEMENT, TYPE=CAX8R, ELSET=WALL")
    strip = only(blocks, "*ELEMENT, TYPE=CAX8, ELSET=STRIP")
    used = {int(n) for element in (*wall, *strip) for n in element[1:]}
    assert used == set(nodes)
    numbers = [int(element[0]) for element in (*wall, *strip)]
    assert numbers == list(range(1, len(numbers) + 1))
    # In millimetres: the inner wall at 1.75 mm, the end at 17.5 mm.
    inner = [int(n) for row in only(blocks, f"*NSET, NSET=INNER_{s.fingerprint}") for n in row]
    assert {nodes[n][0] for n in inner} == {1.75}
    last = [int(n) for row in only(blocks, "*NSET, NSET=LAST") for n in row]
    assert {nodes[n][1] for n in last} == {17.5}
    # Faces: S4 of the wall lies on its inner line, S2 of the strip on the stone.
    elements = {int(e[0]): [int(n) for n in e[1:]] for e in (*wall, *strip)}
    for number, face in only(blocks, "*SURFACE, NAME=LUMEN"):
        assert face == "S4"
        e = elements[int(number)]
        assert {nodes[n][0] for n in (e[3], e[0], e[7])} == {1.75}
    (final,) = [rows for line, rows in blocks if line == "*BOUNDARY" and rows[0][0] == "STONE"][-1]
    moved = float(final[3])
    for number, face in only(blocks, "*SURFACE, NAME=STONE"):
        assert face == "S2"
        for n in [elements[int(number)][k] for k in (1, 2, 5)]:
            assert np.hypot(nodes[n][0] + moved, nodes[n][1]) == pytest.approx(2.1, rel=1e-9)
    # C10 in kPa; D1 = 3 (1 − 2ν)/(μ (1 + ν)), μ = 2 C10, ν = 0.499.
    ((C10, D1),) = only(blocks, "*HYPERELASTIC, NEO HOOKE")
    assert float(C10) == 146.5
    assert float(D1) == pytest.approx(3.0 * 0.002 / (2.0 * 146.5 * 1.499), rel=1e-10)
    assert float(only(blocks, "*FRICTION")[0][0]) == MU
    # 2 w″(1) over the element length, w″(1) = 8 C10.
    assert float(only(blocks, "*SURFACE BEHAVIOR")[0][0]) == pytest.approx(
        2 * 8 * 146.5 / fine / 1.75
    )
    assert [line for line, _ in blocks].count("*STEP, NLGEOM, INC=1000") == 2
    assert_materials_are_whole(blocks)


def test_frictionless_has_no_friction_and_a_bath_follows_the_outer_wall():
    blocks = deck(write_inp(seating(latex("frictionless", load=sp.Load("5.4 kPa", "hydrostatic")))))
    assert not [line for line, _ in blocks if line.startswith("*FRICTION")]
    load = only(blocks, "*DLOAD")
    s = seating(latex("frictionless", load=sp.Load("5.4 kPa", "hydrostatic")))
    assert len(load) == s.wall.columns
    assert {(face, float(p)) for _, face, p in load} == {("P2", 5.4)}


def test_a_growing_stone_moves_every_point_its_own_way():
    s = seating(latex("growing"))
    blocks = deck(write_inp(s))
    rows = [rows for line, rows in blocks if line == "*BOUNDARY"][-1]
    assert len(rows) == 2 * len(s.element_strip.points)
    moved = np.array([float(row[3]) for row in rows]).reshape(-1, 2)
    assert np.allclose(moved, s.travel)


def test_the_abaqus_flavour_is_hybrid_and_keeps_volume_exactly():
    text = write_inp(seating(latex()), "CAX8R", "abaqus")
    blocks = deck(text)
    assert only(blocks, "*ELEMENT, TYPE=CAX8RH, ELSET=WALL")
    assert [float(x) for x in only(blocks, "*HYPERELASTIC, NEO HOOKE")[0]] == [146.5, 0.0]
    assert "*CONTACT PRINT" not in text
    assert only(blocks, "*CONTACT OUTPUT")


def test_the_ureter_is_fung_with_its_ground_matrix_laid_over():
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3))
    law = case.ureter.material.law
    blocks = deck(write_inp(seating(case), "CAX8", "abaqus"))
    fibres = only(blocks, "*ELEMENT, TYPE=CAX8H, ELSET=WALL")
    matrix = only(blocks, "*ELEMENT, TYPE=CAX8, ELSET=MATRIX")  # only one of them is hybrid
    assert [e[1:] for e in fibres] == [e[1:] for e in matrix]
    assert not {e[0] for e in fibres} & {e[0] for e in matrix}
    first, second = only(blocks, "*ANISOTROPIC HYPERELASTIC, FUNG-ORTHOTROPIC")
    # 1, 2, 3 are r, z, θ: b1111 b1122 b2222 b1133 b2233 b3333 b1212 b1313, b2323 c D.
    b = [float(x) for x in (*first, *second)]
    assert b == [0.0, 0.0, law.a2222, 0.0, law.a1122, law.a1111, 0.0, 0.0, 0.0, law.C / 1e3, 0.0]
    C10, D1 = (float(x) for x in only(blocks, "*HYPERELASTIC, NEO HOOKE")[0])
    assert C10 == law.G / 2e3
    assert pytest.approx(2.0 / (20.0 * law.G / 1e3)) == D1
    assert_materials_are_whole(blocks)
    keywords = [line for line, _ in blocks]
    assert keywords.index("*ORIENTATION, NAME=CYLINDER") < keywords.index("*MATERIAL, NAME=WALL")


@pytest.mark.parametrize(
    ("law", "constants"),
    [(MooneyRivlin(1e5, 4e4), [100.0, 40.0]), (Yeoh(1e5, 1e4, 5e3), [100.0, 10.0, 5.0])],
)
def test_other_laws_have_their_constants_and_their_bulk_modulus(law, constants):
    blocks = deck(write_inp(seating(other(law))))
    row = [float(x) for x in only(blocks, "*HYPERELASTIC")[0]]
    assert row[: len(constants)] == constants
    shear = hoop_modulus(law) / 4e3
    assert row[len(constants)] == pytest.approx(3.0 * 0.002 / (shear * 1.499), rel=1e-10)


@pytest.mark.parametrize(
    ("case", "options", "words"),
    [
        (latex(), {"element": "CAX4"}, "element"),
        (latex(), {"flavour": "ansys"}, "flavour"),
        (sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3)), {}, "--flavour abaqus"),
    ],
)
def test_what_a_program_does_not_have_is_refused(case, options, words):
    with pytest.raises(BadInput, match=words):
        write_inp(seating(case), **options)


@pytest.mark.parametrize(
    ("case", "fine", "words"),
    [
        (latex(xi=0.9), 0.025, "larger than the lumen"),
        (latex(xi=2.5), 0.025, "axis"),
        (latex(xi=1.00001), 0.025, "cannot resolve a shorter contact"),
        (
            sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3, material="ureter-printed")),
            0.025,
            "not stable",
        ),
        (replace(latex(), **asking(model="direct")), 0.025, "paper"),
        (latex(), 0.0, "fine"),
        (latex(), float("nan"), "fine"),
    ],
)
def test_what_has_no_deck_is_refused(case, fine, words):
    with pytest.raises(BadInput, match=words):
        seating(case, fine)


# --- results


def fake_results(s, state, path):
    """A .dat as CalculiX writes it, from our own solved wall sunk in by pressure over penalty."""
    nodes = s.wall.row_line(0)
    Z = s.wall.points[nodes, 1]
    wall = state.wall
    on_inner = np.isclose(wall.R, 1.0)
    station, first = np.unique(wall.Z[on_inner], return_index=True)
    r = np.interp(Z, station, wall.r[on_inner][first])
    z = np.interp(Z, station, wall.z[on_inner][first])
    sunk = state.pressure_at(np.arctan2(r, -z)) / s.penalty
    lines = [
        "",
        f" displacements (vx,vy,vz) for set INNER_{s.fingerprint} and time  0.2000000E+01",
        "",
    ]
    for node, u, w in zip(nodes, r - sunk - 1.0, z - Z, strict=True):
        lines.append(f"{node + 1:10d} {u: .12E} {w: .12E}  0.000000E+00")
    lines += ["", " contact stress (slave element+face,press) and time 0.2000000E+01", ""]
    angle = np.arctan2(r, -z)[::2]
    for column in range(s.facing.stop):
        middle = np.linspace(angle[column], angle[column + 1], 9)[1::2]
        p = state.pressure_at(middle) / 1e3
        if p[0] > 0.0:
            lines += [f"{column + 1:10d} 6 {each: .9E} 0.0 0.0" for each in p]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.fixture(scope="module")
def seated(with_shared_solutions):
    with with_shared_solutions():
        return sp.seat(latex("frictionless"))


@pytest.fixture
def faked(seated, tmp_path):
    """A deck's seating and the path of its results."""
    s, path = seating(seated.case, 0.02), tmp_path / "job.dat"
    fake_results(s, seated, path)
    return s, path


def test_results_made_of_our_own_state_give_it_back(seated, faked):
    contact = read_contact(*faked)
    # Means over elements of 0.02 R_a, 1° on the stone.
    assert np.degrees(contact.contact_angle) == pytest.approx(
        np.degrees(seated.contact_angle), abs=0.6
    )
    assert contact.equator_contact_pressure == pytest.approx(
        seated.equator_contact_pressure, rel=2e-3
    )
    eq15 = Closure(far_field_law(seated.case, ground=False))
    expected = pytest.approx(balance_pressure(seated, eq15), rel=1e-2)
    assert balance_pressure(contact, eq15) == expected


@pytest.mark.parametrize(
    "spoil",
    [
        lambda whole: "",
        lambda whole: "nonsense",
        lambda whole: whole.replace("INNER", "OUTER"),
        lambda whole: whole.replace("contact stress", "stress"),
        lambda whole: whole.replace("E-", "E"),
        lambda whole: whole.replace("0.2000000E+01", "0.1475000E+01"),  # a run that broke off
        lambda whole: re.sub(r"(?m)^ +7 .*$", "", whole, count=1),  # a node
        lambda whole: re.sub(r"(?m)^ +7 6 .*\n", "", whole),  # all of an element
        lambda whole: re.sub(r"(?m)^( +7 6 ) *\S+", r"\1 NaN", whole, count=1),
        lambda whole: re.sub(r"(?m)^( +7 6 ) *\S+", r"\1 inf", whole, count=1),
        lambda whole: re.sub(r"(?m)^( +7 6 ) *\S+", r"\1", whole, count=1),
        lambda whole: re.sub(r"(?m)^( +7 )( *\S+.*)$", r"\1\2\n\1\2", whole, count=1),  # twice
        lambda whole: whole + "       999 6 1.0 0.0 0.0\n",
    ],
)
def test_damaged_results_are_refused_in_one_sentence(faked, spoil):
    s, path = faked
    path.write_text(spoil(path.read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(BadInput, match="results") as refused:
        read_contact(s, path)
    assert "\n" not in str(refused.value)


def test_results_that_are_cut_or_scribbled_on_are_refused_or_say_the_same(faked):
    s, path = faked
    whole = path.read_text(encoding="utf-8")
    eq15 = Closure(far_field_law(s.case, ground=False))
    right = balance_pressure(read_contact(s, path), eq15)
    rng = np.random.default_rng(4)
    spoilt = [whole[: rng.integers(len(whole))] for _ in range(40)]
    spoilt += [whole[:at] + "x" + whole[at:] for at in rng.integers(len(whole), size=40)]
    read = 0
    for text in spoilt:
        path.write_text(text, encoding="utf-8")
        try:
            found = balance_pressure(read_contact(s, path), eq15)
        except BadInput:
            continue
        # Of the last element, in which the contact ends, rows may be missing.
        assert found == pytest.approx(right, rel=3e-3)
        read += 1
    assert read < 10


@pytest.mark.parametrize(
    "other_case",
    [
        latex("frictionless", 1.19),
        latex("frictionless", aspect=1.1),
        latex("pressed"),
        latex("frictionless", load=sp.Load("1 kPa")),
        latex("frictionless", load=sp.Load(prestretch=1.01)),
        other(MooneyRivlin(1.465e5, 1.0), seating="frictionless"),
        replace(latex("frictionless"), **asking(seating="frictionless", half_length=11.0)),
    ],
)
def test_results_of_another_case_are_refused(faked, other_case):
    with pytest.raises(BadInput, match="that of this case's input deck"):
        read_contact(seating(other_case, 0.02), faked[1])


def test_results_of_another_mesh_are_refused(seated, faked):
    with pytest.raises(BadInput, match="that of this case's input deck"):
        read_contact(seating(seated.case, 0.0201), faked[1])


# --- the doors


def test_export_writes_and_says_how_to_go_on(tmp_path, capsys):
    out = tmp_path / "stone.inp"
    given = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--out", str(out)]
    assert run(["export", *given, "--format", "inp", "--element", "CAX8R"]) == 0
    said = capsys.readouterr().out
    assert "ccx stone" in said
    assert "stonepass compare" in said
    assert out.read_text(encoding="utf-8") == write_inp(
        seating(sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"))),
        "CAX8R",
    )


def test_export_of_the_solved_wall(tmp_path, capsys):
    out = tmp_path / "wall.vtu"
    lengths = ["--stone", "4.2mm", "--inner", "3.5mm", "--outer", "5.25mm", "--material", "latex"]
    assert run(["export", *lengths, "--seating", "frictionless", "--out", str(out)]) == 0
    mesh = meshio.read(out)
    r = np.hypot(mesh.points[:, 0], mesh.points[:, 1])
    # In mm; beside the stone the wall is narrower than unloaded, since its ends keep their place.
    assert 1.72 < r.min() < 1.75
    at_stone = np.abs(mesh.points[:, 2]) < 1e-9
    assert r[at_stone].min() == pytest.approx(2.1, rel=1e-6)
    moved = mesh.point_data["displacement"]
    back = mesh.points - moved
    assert np.hypot(back[:, 0], back[:, 1]).min() == pytest.approx(1.75, rel=1e-9)
    assert np.all(np.isfinite(mesh.point_data["stress_tt"]))
    capsys.readouterr()
    assert run(["export", "--xi", "0.9", "--eta", "1.5", "--out", str(tmp_path / "no.vtu")]) == 1
    assert not (tmp_path / "no.vtu").exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--format", "step", "--out", "x.step"], "--format"),
        (["--format", "inp", "--out", "x.vtu"], ".inp"),
        (["--out", "x.feb", "--element", "CAX8"], "--element"),
        (["--out", "x.vtu", "--fine", "0.1"], "--fine"),
        (["--out", "x.inp", "--model", "direct"], "paper"),
        (["--out", "nowhere/x.inp"], "nowhere"),
        (["--out", "x"], "ending of --out"),
        (["--out", "x.inp", "--flavour", ""], "flavour"),
        (["--out", "x" * 300 + ".inp"], "output file"),
    ],
)
def test_bad_requests(options, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["export", "--xi", "1.2", "--eta", "1.5", "--material", "latex", *options]) == 2
    assert words in capsys.readouterr().err


def test_compare_puts_results_beside_our_own(faked, tmp_path, capsys):
    """The door without the other program: results made of our own state."""
    _, path = faked
    figure = tmp_path / "c.svg"
    given = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--friction", "0.475"]
    given += ["--seating", "frictionless", "--fine", "0.02", "--results", str(path)]
    assert run(["compare", *given, "--json", "--figure", str(figure)]) == 0
    assert "pressure" in capsys.readouterr().out
    assert figure.read_text(encoding="utf-8").startswith("<?xml")
    assert run(["compare", *given]) == 0
    assert "CalculiX" in capsys.readouterr().out
    assert run(["compare", *given, "--fine", "0.03"]) == 2
    assert "that of this case's input deck" in capsys.readouterr().err


# --- CalculiX itself


needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")


@pytest.mark.slow
@needs_ccx
def test_a_coarse_deck_goes_through_calculix_and_back(tmp_path, capsys, monkeypatch):
    """At the command line: P_ucr within 4 %, contact angle within 1 degree.

    The elements in the contact are three times as long as in the test below, and the tube half as
    long.
    """
    monkeypatch.chdir(tmp_path)
    given = ["--xi", "1.05", "--eta", "1.5", "--material", "latex", "--seating", "frictionless"]
    given += ["--half-length", "5", "--fine", "0.04"]
    assert run(["export", *given, "--out", "job.inp", "--element", "CAX8R"]) == 0
    run_ccx(tmp_path)
    capsys.readouterr()
    assert run(["compare", *given, "--results", "job.dat", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    theirs = found["calculix"]
    assert theirs["critical_pressure_kPa"] == pytest.approx(
        found["critical_pressure_kPa"], rel=0.04
    )
    assert theirs["contact_angle_deg"] == pytest.approx(found["contact_angle_deg"], abs=1.0)


@pytest.mark.slow
@needs_ccx
def test_calculix_agrees_without_friction(tmp_path, capsys, monkeypatch):
    """Contact pressure within 2 %: the deck as the command line writes it, and back again."""
    monkeypatch.chdir(tmp_path)
    given = ["--xi", "1.05", "--eta", "1.5", "--material", "latex", "--seating", "frictionless"]
    assert run(["export", *given, "--out", "job.inp", "--element", "CAX8R"]) == 0
    run_ccx(tmp_path)
    assert run(["compare", *given, "--results", "job.dat"]) == 0
    assert "CalculiX" in capsys.readouterr().out
    case = sp.Case(
        sp.Stone(size_ratio=1.05),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        **asking(seating="frictionless"),
    )
    found = compare(case, read_contact(seating(case), Path("job.dat")))
    assert isinstance(found, DeckComparison)
    half = (np.pi / 2 - found.seated.contact_angle) / 2
    inner = np.linspace(np.pi / 2 - half, np.pi / 2 + half, 41)
    off = found.contact.pressure_at(inner) / found.seated.pressure_at(inner) - 1.0
    assert np.abs(off).max() < 0.02
    assert found.pressure == pytest.approx(found.answer.pressure, rel=0.04)
    assert np.degrees(abs(found.contact.contact_angle - found.seated.contact_angle)) < 1.0


@pytest.mark.slow
@needs_ccx
def test_calculix_agrees_pressed_under_load(tmp_path):
    """P_ucr within 4 %, with friction, pre-stretch and a dead confining pressure."""
    load = sp.Load("4 kPa", "dead", 1.05)
    case = latex("pressed", 1.1, load)
    s = seating(case, 0.04)
    (tmp_path / "job.inp").write_text(write_inp(s, "CAX8R"), encoding="utf-8")
    run_ccx(tmp_path)
    found = compare(case, read_contact(s, tmp_path / "job.dat"))
    assert isinstance(found, DeckComparison)
    assert found.pressure == pytest.approx(found.answer.pressure, rel=0.04)
    # Far from the stone the wall is as wide as a uniform tube under that load: 1 without, and a
    # little narrower beside the stone, since the ends keep their place (0.2 % without load).
    lumen = lumen_ratio(ETA, case.ureter.material.law, load)
    last = s.wall.row_line(0)[-1] + 1
    rows = [line.split() for line in (tmp_path / "job.dat").read_text().splitlines()]
    (moved,) = [float(row[1]) for row in rows if len(row) == 4 and row[0] == str(last)]
    assert 1.0 + moved == pytest.approx(lumen, abs=2e-3)
    assert lumen < 0.97


def run_ccx(folder):
    done = subprocess.run(
        ["ccx", "job"],
        cwd=folder,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-2000:]
