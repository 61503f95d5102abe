"""The paper by one command: what it writes, that it writes it twice the same, what it refuses."""

import csv
import re
from dataclasses import replace
from types import SimpleNamespace
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.export.vtu import write_vtu
from stonepass.inputs.measured_pressures import Point, read_points
from stonepass.model.numerics import Numerics
from stonepass.paper import fig6, fig8, fig9, inputs, seated_figures
from stonepass.paper.run import PARTS, WITH_CLAIMS, chosen, reproduce
from stonepass.paper.section import Asked, Claim
from stonepass.paper.sensitivity import Sensitivity, choices
from stonepass.studies.executor import process_pool
from stonepass.studies.jobs import PressureJob, Results, SizeJob, run_jobs
from stonepass.units import Pressure

pytestmark = pytest.mark.usefixtures("shared_solutions")

ASKED = Asked(inputs.LIMIT)
PAIR = ["fig4", "friction"]


@pytest.fixture(scope="module", autouse=True)
def fast():
    """The same parts with fewer sizes, on the coarse mesh."""
    patch = pytest.MonkeyPatch()
    plain = inputs.ureter_case
    smooth = sp.SeatedBalance("frictionless")  # enough for Fig. 9, whose beam has no path either
    for module, default in ((fig8, None), (fig9, smooth), (seated_figures, None)):

        def quick(eta, xi, load=None, model=None, *, default=default):
            return replace(plain(eta, xi, load, model or default), numerics=Numerics("fast"))

        patch.setattr(module, "ureter_case", quick)
    tube = inputs.latex_case
    patch.setattr(
        seated_figures,
        "latex_case",
        lambda *given: replace(tube(*given), numerics=Numerics("fast")),
    )
    patch.setattr(fig9, "SIZES", (1.0, *(round(1.03 + 0.03 * k, 2) for k in range(10))))
    patch.setattr(fig6, "SIZES", (1.0, 1.2, 1.4))
    yield
    patch.undo()


def moving(case, pressure):
    return sp.Answer(case, case.model, case.numerics, sp.Outcome.MOVES, pressure=pressure)


def files(folder, *endings):
    return sorted(path for path in folder.iterdir() if path.suffix in endings)


def table(path):
    return list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))


def test_names_of_parts():
    assert chosen([]) == chosen(["all"]) == list(PARTS)
    assert chosen(["fig9", "fig4"]) == ["fig4", "fig9"]
    assert chosen(["claims"]) == list(WITH_CLAIMS)
    with pytest.raises(BadInput, match=r"part of the paper is fig3.*did you mean 'fig"):
        chosen(["fig3"])


def test_an_answer_that_says_more_serves_for_one_that_says_less():
    case = inputs.latex_case(1.5, 1.2)
    quick = replace(case, numerics=Numerics("fast"))
    jobs = [PressureJob(quick, error=False), PressureJob(quick), PressureJob(quick, wall=True)]
    found = run_jobs(jobs)
    assert list(found.pressures) == jobs[2:]
    assert found.answer(quick) is found.answer(quick, wall=True)
    assert found.answer(quick, error=False) is found.answer(quick)
    assert found.of(jobs[:1]).pressures == found.pressures
    assert list(run_jobs(jobs[:2]).pressures) == jobs[1:2]


def test_each_job_is_run_once_and_told_of():
    case = inputs.latex_case(1.5, 0.9)
    told = []
    found = run_jobs([PressureJob(case)] * 2, progress=lambda *n: told.append(n))
    assert told == [(1, 1)]
    assert found.answer(case).outcome is sp.Outcome.LOOSE
    assert found.of([]).pressures == {}


@pytest.fixture(scope="module")
def written(tmp_path_factory, with_shared_solutions):
    """Two parts as they are solved, and again from what was remembered."""
    root = tmp_path_factory.mktemp("paper")
    folders, sections = [root / name for name in ("one", "again")], []
    for folder in folders:
        with pytest.MonkeyPatch.context() as patch, with_shared_solutions():
            if folder != folders[0]:  # the data are compared, and the pictures of one are enough
                patch.setattr("stonepass.paper.section.save", lambda figure, path: None)
            sections.append(reproduce(PAIR, folder, ASKED, cache_folder=root / "store"))
    return folders, sections


@pytest.fixture(scope="module")
def beams(tmp_path_factory, with_shared_solutions):
    """Fig. 9, in this process, where it is the quick one."""
    folder = tmp_path_factory.mktemp("fig9")
    with with_shared_solutions():
        return folder, reproduce(["fig9"], folder, ASKED)


def test_data_are_the_same_bytes_every_time(written):
    folders, sections = written
    one, again = (files(folder, ".csv") for folder in folders)
    assert [path.name for path in one] == [path.name for path in again] == ["fig4.csv"]
    assert one[0].read_bytes() == again[0].read_bytes()
    assert sections[0] == sections[1]


def test_parts_are_written_by_processes(written, tmp_path):
    """The drawing too is work for the pool; answers by processes are tested with the studies."""
    _, sections = written
    with process_pool(2) as pool:
        found = reproduce(["friction"], tmp_path, ASKED, pool)
    assert found == [section for section in sections[0] if "friction" in section.title]
    assert files(tmp_path, ".csv", ".svg", ".png") == []
    assert (tmp_path / "index.html").is_file()


def test_every_picture_is_there(written, beams):
    pictures = [path for folder in (written[0][0], beams[0]) for path in files(folder, ".svg")]
    assert [path.stem for path in pictures] == ["fig4", "fig4_3d", "fig9"]
    for path in pictures:
        ElementTree.parse(path)  # well-formed
        assert path.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
        assert path.stat().st_size < 3_000_000


def test_the_data_of_fig_9_are_the_models(beams):
    folder, _ = beams
    rows = table(folder / "fig9c.csv")
    assert [float(row["size_ratio"]) for row in rows] == list(fig9.SIZES)
    at = next(row for row in rows if row["size_ratio"] == "1.3")
    beam = sp.solve(inputs.ureter_case(1.3, 1.3, model=inputs.BEAM)).pressure
    assert float(at["beam_kPa"]) == pytest.approx(beam / 1e3, rel=1e-9)
    elements = [float(row["finite_elements_kPa"]) for row in rows]
    assert elements[0] == 0.0
    assert all(np.diff(elements) > 0.0)
    friction = table(folder / "fig9d_friction.csv")
    assert float(friction[4]["friction"]) == 0.5
    assert float(friction[4]["critical_size_ratio"]) == pytest.approx(1.1935, abs=2e-4)


def test_profiles_of_fig_4_vanish_outside_the_contact(written):
    (folder, *_), _ = written
    rows = np.array([list(row.values()) for row in table(folder / "fig4.csv")], float)
    assert rows[0, 0] == 0.0
    assert rows[-1, 0] == 180.0
    assert np.all(rows[rows[:, 0] < 60.0, 1:] == 0.0)
    assert np.all(rows[rows[:, 0] == 90.0, 1:] > 50.0)
    np.testing.assert_allclose(rows[:, 1:], rows[::-1, 1:], atol=1e-6)


def test_the_revolved_wall_has_the_volume_of_the_wall(written, tmp_path):
    """Volume of the hexahedra against π (R_b² − R_a²) 2L, which deformation keeps."""
    (folder, *_), _ = written
    mesh = meshio.read(folder / "fig4.vtu")
    corners = mesh.points[mesh.cells[0].data]
    volume = np.zeros(len(corners))
    for a, b, c, d in ((0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6)):
        edges = corners[:, [b, c, d]] - corners[:, [a]]
        volume += np.linalg.det(edges) / 6.0
    expected = np.pi * (1.57**2 - 1.0) * 20.0
    assert volume.sum() == pytest.approx(expected, rel=5e-3)
    stresses = {"stress_rr", "stress_tt", "stress_zz", "stress_rz"}
    assert set(mesh.point_data) == {*stresses, "displacement"}
    assert mesh.point_data["stress_rr"].min() < -5e4
    state = sp.seat(inputs.latex_case(1.5, 1.2))
    with pytest.raises(BadInput, match="output file"):
        write_vtu(tmp_path / "none" / "w.vtu", state.wall, mirrored=True)


def test_the_page_links_what_is_there_and_shows_every_claim(written, beams):
    folder, sections = beams
    page = (folder / "index.html").read_text()
    for each in (folder, written[0][0]):
        linked = re.findall(r'(?:href|src)="([^":]+)"', (each / "index.html").read_text())
        assert len(linked) >= 5
        assert all((each / name).is_file() for name in linked)
    claims = [claim for section in sections for claim in section.claims]
    assert len(claims) == 4
    assert all(claim.what in page for claim in claims)
    assert "Research use only" in page
    assert "<script" not in page
    assert [claim.holds for claim in claims] == [None, True, True, True]
    assert claims[0].deviation == pytest.approx(-0.0465, abs=1e-3)


def test_a_claim_is_judged_by_its_tolerance():
    assert Claim.number("x", 1.22, 1.225, 0.01, "").holds is True
    assert Claim.number("x", 1.22, 1.24, 0.01, "").holds is False
    assert Claim.number("x", 1.22, 1.24, 0.01, "").deviation == pytest.approx(0.02)
    assert Claim.number("x", 1.22, None, 0.01, "").holds is False


def test_measured_points_are_compared(tmp_path, monkeypatch):
    """Points made by the model itself agree; points twice as high do not; none is not judged."""
    case = inputs.latex_case(1.5, 1.2)
    known = sp.solve(replace(case, numerics=Numerics("fast")))
    pressure = known.pressure
    answers = {}
    for job in fig6.Fig6().jobs(Asked(inputs.LIMIT, (Point(1.2, 1.5, Pressure(0.0), pressure),))):
        if job.case == case:
            answers[job] = known
        else:
            answers[job] = moving(job.case, 4e4 * job.case.size_ratio)
    found = Results(answers)
    monkeypatch.setattr("stonepass.paper.section.save", lambda figure, path: None)
    for factor, holds in ((1.0, True), (2.0, False)):
        points = (Point(1.2, 1.5, Pressure(0.0), Pressure(factor * pressure), Pressure(1e3)),)
        section = fig6.Fig6().write(found, Asked(inputs.LIMIT, points), tmp_path)
        assert section.claims[1].holds is holds
    section = fig6.Fig6().write(found, ASKED, tmp_path)
    assert section.claims[1].holds is None
    assert "not published" in section.claims[1].reason


@pytest.fixture
def drawn(monkeypatch):
    """Figures by name, as they are saved."""
    figures = {}
    monkeypatch.setattr(
        "stonepass.paper.section.save", lambda figure, path: figures.update({path.name: figure})
    )
    return figures


def made_up(job, steep=60e3):
    """A pressure that grows with ξ − 1, η and P_out, or the size at which it is the limit."""
    case = job.case
    slope = steep * case.wall_ratio**0.6
    if isinstance(job, PressureJob):
        pressure = slope * (case.size_ratio - 1.0) + case.load.confining_pressure
        return moving(case, pressure)
    size = 1.0 + (job.limit - case.load.confining_pressure) / slope
    return sp.SizeAnswer(case, sp.Outcome.SOLVED, "", job.limit, size_ratio=size)


def made_up_results(part, asked):
    jobs = part.jobs(asked)
    return Results({job: made_up(job) for job in jobs})


def test_what_is_in_fig_8(drawn, tmp_path):
    """Lines are the answers, the line on the surface is the inverse, the straight one is straight."""
    section = fig8.Fig8().write(made_up_results(fig8.Fig8(), ASKED), ASKED, tmp_path)
    axes = {
        (each.get_title("left") or each.get_title())[:1]: each for each in drawn["fig8.svg"].axes
    }
    a, c, d = (axes[name] for name in "acd")
    for line, eta in zip((a.lines[0], a.lines[3]), (1.3, 3.4), strict=True):
        assert line.get_label() == f"η = {eta:.2f}"
        np.testing.assert_allclose(
            line.get_ydata(), 60 * eta**0.6 * (np.array(fig8.SIZES) - 1.0), atol=1e-9
        )
    assert len(c.lines) == 6
    above = np.array(c.lines[2].get_ydata()) - np.array(c.lines[0].get_ydata())
    np.testing.assert_allclose(above, 8.0)
    np.testing.assert_allclose(d.lines[0].get_xdata(), [0, 2, 4, 6, 8])
    assert "R^2$ = 1.0000" in d.lines[1].get_label()
    (line,) = drawn["fig8b_line.svg"].axes
    computed, straight = line.lines[:2]
    np.testing.assert_allclose(
        computed.get_ydata(), 1.0 + 12 / (60 * np.array(computed.get_xdata()) ** 0.6), rtol=1e-3
    )
    assert list(straight.get_xdata()) == [1.3, 3.4]
    texts = " ".join(text.get_text() for text in line.texts)
    assert "81% passed" in texts
    assert "10.1007/s00330-017-4852-6" in texts
    rows = table(tmp_path / "fig8c.csv")
    assert len(rows) == 2 * 3 * len(fig8.SIZES)
    assert set(rows[0]) >= {"outcome", "stability_margin", "confining_kPa"}
    held = {claim.what: claim.holds for claim in section.claims}
    assert held["P_ucr grows with ξ and with η (Fig. 8a, b)"]
    assert held["ξ_cr at 12 kPa, η = 1.30 (Fig. 8a)"] is False  # the made-up wall is none


def test_walls_that_do_not_reach_the_limit_say_so(tmp_path, drawn):
    for limit, outcome in ((90e3, "BEYOND_RANGE"), (5e3, "SOLVED")):
        asked = Asked(Pressure(limit))
        fig8.Fig8().write(made_up_results(fig8.Fig8(), asked), asked, tmp_path)
        rows = table(tmp_path / "fig8b_line.csv")
        assert {row["outcome"] for row in rows} == {outcome}
        assert all(bool(row["critical_size_ratio"]) == (outcome == "SOLVED") for row in rows)


def test_claims_about_12_kpa_are_made_at_12_kpa_alone(tmp_path, drawn):
    for part in (fig8.Fig8(), fig9.Fig9()):
        counts = []
        for limit in (12e3, 6e3):
            asked = Asked(Pressure(limit))
            section = part.write(made_up_results(part, asked), asked, tmp_path)
            counts.append(len(section.claims))
            told = " ".join(claim.what for claim in section.claims)
            assert ("12 kPa" in told) is (limit == 12e3)
        assert counts[1] < counts[0]


def solved_with(margin):
    """A solved contact of which nothing but the stability margin is asked for."""
    values = dict.fromkeys(
        ("contact_angle", "downstream_angle", "equator_contact_pressure", "peak_contact_pressure",
         "wall", "solver"), 0.0,
    )  # fmt: skip
    stability = SimpleNamespace(margin=margin)
    return SimpleNamespace(**values, pressure_at=abs, without_wall=abs, stability=stability)


def test_a_wall_beyond_its_stability_is_told_of():
    found = made_up_results(fig8.Fig8(), ASKED)
    assert fig8._beyond(found, 1.3, 1.22) == ""
    for pressure, margin in ((4e3, 0.2), (8e3, -0.3)):
        job = PressureJob(fig8.ureter_case(1.3, 1.22, sp.Load(Pressure(pressure))))
        found.by_job[job] = replace(found[job], contact=solved_with(margin))
    assert "(margin -0.30 at 8 kPa;" in fig8._beyond(found, 1.3, 1.22)


def test_what_is_in_fig_9(drawn, tmp_path):
    found = made_up_results(fig9.Fig9(), ASKED)
    fig9.Fig9().write(found, ASKED, tmp_path)
    left, right = drawn["fig9.svg"].axes[:2]
    assert [line.get_label().split(",")[0] for line in left.lines[:3]] == [
        "finite elements", "beam", "beam"
    ]  # fmt: skip
    np.testing.assert_allclose(
        left.lines[0].get_ydata(), 60 * 1.3**0.6 * (np.array(fig9.SIZES) - 1.0), atol=1e-9
    )
    stiffness, friction = right.lines
    at_one = [np.interp(1.0, line.get_xdata(), line.get_ydata()) for line in (stiffness, friction)]
    assert at_one[0] == pytest.approx(at_one[1], abs=1e-3)
    assert {row["beam_outcome"] for row in table(tmp_path / "fig9c.csv")} == {"LOOSE", "MOVES"}


def test_what_is_in_fig_6(drawn, tmp_path):
    """Where there is no answer there is a cross; measured points have their bars."""
    points = (Point(1.2, 1.5, Pressure(0.0), Pressure(30e3), Pressure(2e3)),)
    asked = Asked(inputs.LIMIT, points)
    found = made_up_results(fig6.Fig6(), asked)
    lost = PressureJob(inputs.latex_case(2.0, fig6.SIZES[-1]))
    found.by_job[lost] = sp.Answer(
        lost.case, lost.case.model, lost.case.numerics, sp.Outcome.BEYOND_CLOSURE
    )
    fig6.Fig6().write(found, asked, tmp_path)
    air, water = drawn["fig6.svg"].axes[:2]
    assert [line.get_marker() for line in air.lines].count("x") == 1
    assert [line.get_marker() for line in water.lines].count("x") == 0
    (bars,) = air.containers
    (point, _, _) = bars.lines
    assert (point.get_xdata()[0], point.get_ydata()[0]) == (1.2, 30.0)
    assert len([line for line in water.lines if line.get_linestyle() == "--"]) == 4  # and a label
    missing = [row for row in table(tmp_path / "fig6.csv") if not row["critical_pressure_kPa"]]
    assert [row["outcome"] for row in missing] == ["BEYOND_CLOSURE"]


def test_a_folder_that_cannot_be_written_is_refused_before_anything_is_solved(tmp_path, solved):
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(BadInput, match=r"output folder is .*must be writable"):
        reproduce(["fig5"], file, ASKED, cache_folder=tmp_path / "cache")
    assert solved == []


def test_points_from_a_file(tmp_path):
    path = tmp_path / "points.csv"
    path.write_text("eta,xi,pressure_kPa,confining_kPa,sd_kPa\n1.5,1.2,40,5.4,2\n")
    (point,) = read_points(path)
    assert point == Point(1.2, 1.5, Pressure(5400.0), Pressure(40e3), Pressure(2e3))
    path.write_text("eta,xi,pressure_kPa,confining_kPa\n1.5,1.2,40,0\n1.5,12,40,0\n")
    with pytest.raises(BadInput, match=r"in points\.csv, row 3, column 'xi' is 12, but must"):
        read_points(path)


def test_sensitivity_changes_one_thing_at_a_time():
    listed = list(choices())
    assert len({(each.about, each.what) for each in listed}) == len(listed) >= 16
    default = listed[0].case(1.3)
    for each in listed[1:]:
        assert each.case(1.3) != default
    jobs = Sensitivity().jobs(ASKED)
    assert all(isinstance(job, SizeJob) for job in jobs)
    assert len(jobs) == 2 * (len(listed) - 1)  # the printed constants are refused
    assert not any(job.case.ureter.material.name == "ureter-printed" for job in jobs)


def test_the_command(tmp_path, capsys):
    out, cache = tmp_path / "out", tmp_path / "cache"
    arguments = ["paper", "friction", "fig5", "--out", str(out), "--cache", str(cache)]
    assert run([*arguments, "--workers", "1"]) == 0
    shown, told = capsys.readouterr()
    assert "0.5239" in shown
    assert told.startswith("solving 2 cases for fig5, friction: about ")
    assert f"wrote {out / 'index.html'}" in told
    remembered = [path for path in cache.glob("[0-9a-f][0-9a-f]/*") if path.is_file()]
    assert len(remembered) == 2
    raw = bytearray(remembered[0].read_bytes())
    raw[100] ^= 1
    remembered[0].write_bytes(raw)
    before = (out / "fig5.csv").read_bytes()
    assert run([*arguments, "--workers", "1"]) == 0
    warned = capsys.readouterr().err
    assert warned.count("warning: a damaged result was moved to ") == 1
    assert "--cache" not in warned  # no other folder is called for
    assert (out / "fig5.csv").read_bytes() == before
    assert run(["paper", "friction", "--limit", "0kPa"]) == 2
    assert "--limit is 0kPa, but must be 0.001 kPa to 1000 kPa" in capsys.readouterr().err
    assert run(["paper", "fig12"]) == 2
    assert "did you mean" in capsys.readouterr().err
    assert run(["paper", "--cache", "x", "--no-cache"]) == 2
    (tmp_path / "bad.csv").write_text("xi,eta,confining_kPa\n1,2,3\n")
    assert run(["paper", "fig6", "--points", str(tmp_path / "bad.csv")]) == 2
    assert "bad.csv, column 'pressure_kPa' is missing" in capsys.readouterr().err
