"""Jobs on worker processes: answered, repeated, cancelled, limited, and what happens to killed ones."""

import io
import os
import signal
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from web_server import CASE, LONG, QUICK, ServerLimits, client, ended, running

from stonepass.errors import BadInput
from stonepass.inputs.build import build_case
from stonepass.model.critical import solve
from stonepass.web.answers import Problem
from stonepass.web.documented import JobDocument, UploadDocument
from stonepass.web.jobs.bodies import AssessJob, JobBody, PressureJob
from stonepass.web.jobs.context import Context
from stonepass.web.jobs.tasks import patient
from stonepass.web.jobs.worker import MODULES
from stonepass.web.uploads.store import Upload, UploadStore

EXAMPLES = Path(__file__).parents[1] / "examples"
SIZE = {"kind": "size", "limit": "6 kPa", "case": QUICK}
PRESSURE = {"kind": "pressure", "case": QUICK}
LOOSE = {"kind": "pressure", "case": {"stone": {"size_ratio": 0.9}, "ureter": {"wall_ratio": 1.3}}}
PATIENT = {
    "stone": {"diameter": "5 mm ± 1 mm", "place": "distal"},
    "ureter": {"inner_diameter": "4.4 mm ± 0.5 mm", "wall_thickness": "0.7 mm ± 0.15 mm"},
    "dilated": {"inner_diameter": "5 mm ± 0.5 mm"},
    "assessment": {"limit": "6 kPa", "title": "<b>#emph[x]</b>"},
    "method": {"accuracy": "fast", "seating": "frictionless"},
}


def of_wall(**changed):
    """Return the quick case with a wall of given constants, some of which are changed."""
    wall = {"law": "neo-hookean", "C10": "70 kPa", "strain_range": [0.5, 1.5], "source": "mine"}
    return QUICK | {"ureter": {"wall_ratio": 1.3, "material": wall | changed}}


def of_shape(shape):
    """Return the quick case with a stone of some shape."""
    return QUICK | {"stone": {"size_ratio": 1.2, "shape": shape}}


@pytest.fixture(scope="module")
def asking(tmp_path_factory):
    with client(tmp_path_factory.mktemp("solved"), workers=1) as found:
        yield found


def ask(asking, body, status=202):
    found = asking.post("/api/v1/jobs", json=body)
    assert found.status_code == status, found.text
    (JobDocument if status == 202 else Problem).model_validate(found.json())
    return found.json()


def gone(process, seconds=10.0):
    """Whether a process ends within some time."""
    last = time.monotonic() + seconds
    while time.monotonic() < last:
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False


def test_every_kind_of_job_has_a_task():
    kinds = {
        each.model_fields["kind"].annotation.__args__[0] for each in JobBody.__args__[0].__args__
    }
    assert kinds == set(MODULES)
    assert len(kinds) == 6


def test_a_pressure_is_solved_once_and_then_known(asking):
    body = PRESSURE | {"stiffness": 2.0}
    asked = ask(asking, body)
    assert asked["status"] == "queued"
    found = ended(asking, asked["id"])
    assert found["status"] == "done", found
    result = found["result"]
    values = {
        f"{section}.{key}": value for section, part in QUICK.items() for key, value in part.items()
    }
    alone = solve(build_case(values)).pressure  # P_ucr is proportional to the stiffness
    assert result["critical_pressure_kPa"] == pytest.approx(2e-3 * alone, rel=1e-9)
    section = result["section"]
    assert section["exact"] is True
    assert max(section["stone"]["r"]) == pytest.approx(1.2)
    assert max(section["contact"]["pressure_kPa"]) > 1.0
    again = ask(asking, body | {"case": {key: QUICK[key] for key in reversed(QUICK)}})
    assert again["id"] == asked["id"]
    assert again["status"] == "done"
    assert again["result"] == result  # the first response has it, so that nothing was computed


def test_another_question_has_another_id(asking):
    ids = set()
    for changed in ({}, {"stiffness": 1.5}, {"case": QUICK | {"stone": {"size_ratio": 1.21}}}):
        body = PressureJob.model_validate(PRESSURE | changed)
        ids.add(str(body.question()))
    assert len(ids) == 3


@pytest.mark.slow
def test_the_size_of_the_stone_does_not_matter_for_the_largest_stone(asking):
    without = {"ureter": QUICK["ureter"], "method": QUICK["method"]}
    first = ask(asking, SIZE)
    assert ask(asking, SIZE | {"case": without})["id"] == first["id"]
    found = ended(asking, first["id"])["result"]
    assert found["outcome"] == "SOLVED"
    assert 1.0 < found["critical_size_ratio"] < 1.3


def test_events_tell_the_way_of_a_job_to_its_end(asking):
    asked = ask(asking, PRESSURE | {"stiffness": 1.25})
    with asking.stream("GET", f"/api/v1/jobs/{asked['id']}/events") as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        lines = [line for line in stream.iter_lines() if line]
    events = [line for line in lines if line.startswith("event: ")]
    assert set(events) == {"event: job"}
    assert len(events) >= 2
    assert '"status":"done"' in lines[-1]
    assert '"result":{' in lines[-1]
    assert not any('"result":{' in line for line in lines[:-1])


def test_a_refusal_of_the_model_names_the_field(asking):
    body = {
        "kind": "pressure",
        "case": CASE | {"ureter": CASE["ureter"] | {"material": "ureter-printed"}},
    }
    found = ended(asking, ask(asking, body)["id"])
    assert found["status"] == "failed"
    assert found["problem"]["status"] == 422
    assert "not stable" in found["problem"]["detail"]
    assert ask(asking, body)["status"] == "queued"  # a failed job may be asked again


@pytest.mark.parametrize(
    ("changed", "field"),
    [
        ({"stiffness": 100.0}, "stiffness"),
        ({"stiffness": "1"}, "stiffness"),
        ({"case": QUICK | {"stone": {"size_ratio": 7}}}, "stone.size_ratio"),
        ({"case": QUICK | {"stone": {}}}, "stone.diameter"),
        ({"case": {"stone": {"size_ratio": 1.2}}}, "ureter.inner_diameter"),
        ({"case": QUICK | {"load": {"confining_pressure": "3"}}}, "load.confining_pressure"),
        ({"case": QUICK | {"method": {"model": "beam", "seating": "pressed"}}}, "method.seating"),
        ({"kind": "size"}, "limit"),
        ({"kind": "size", "limit": "0.5 Pa"}, "limit"),
        ({"kind": "push", "steps": 1000}, "steps"),
        ({"kind": "nothing"}, "kind"),
        ({"case": []}, "case"),
        ({"case": of_wall(source="")}, "ureter.material.source"),
        ({"case": of_wall(C10="70")}, "ureter.material.C10"),
        ({"case": of_wall(C01="1 kPa")}, "ureter.material.C01"),
        ({"case": of_wall(D="1 kPa")}, "ureter.material.D"),
        ({"case": of_wall(law="rubber")}, "ureter.material.law"),
        ({"case": of_wall(strain_range=[1.5, 1.0])}, "ureter.material.strain_range"),
        ({"case": of_shape([[0, 0], [1, 0]])}, "stone.shape"),
        ({"case": of_shape({"z": [-1, 1], "rho": [0, 0]})}, "stone.shape"),
        ({"case": of_shape({"radius": 2})}, "stone.shape"),
    ],
)
def test_a_question_is_checked_before_it_is_queued(asking, changed, field):
    found = ask(asking, PRESSURE | changed, 422)
    assert found["field"] == field, found
    assert "FILE.py" not in found["detail"]


@pytest.mark.parametrize(("body", "field"), [({}, "kind"), ({"kind": "pressure"}, "case")])
def test_a_missing_part_of_a_question_is_named(asking, body, field):
    found = ask(asking, body, 422)
    assert (found["field"], found["detail"]) == (field, f"{field} is missing, but must be given.")


def test_a_body_that_is_declared_as_text_is_no_question(asking):
    found = asking.post("/api/v1/jobs", content="{}", headers={"content-type": "text/plain"})
    assert (found.status_code, found.json()["field"]) == (415, "Content-Type")


def test_a_job_is_cancelled_while_it_waits_and_while_it_runs(asking):
    book = asking.app.app.state.server.book
    first = ask(asking, LONG)["id"]
    second = ask(asking, LONG | {"steps": 59})["id"]
    running(asking, first)
    process = book.processes[0].pid
    for identity in (second, first):
        found = asking.delete(f"/api/v1/jobs/{identity}")
        assert found.status_code == 200
        assert found.json()["status"] == "cancelled"
    assert gone(process)
    # Whoever deletes a job that has ended makes the server forget it.
    assert asking.delete(f"/api/v1/jobs/{first}").status_code == 200
    assert asking.get(f"/api/v1/jobs/{first}").status_code == 404
    assert ended(asking, ask(asking, LOOSE)["id"])["result"]["outcome"] == "LOOSE"


def test_a_killed_worker_is_told_and_the_next_job_runs(asking):
    book = asking.app.app.state.server.book
    first = ask(asking, LONG | {"steps": 58})["id"]
    body = LOOSE | {"stiffness": 1.5}
    second = ask(asking, body)["id"]
    running(asking, first)
    os.kill(book.processes[0].pid, signal.SIGKILL)
    found = ended(asking, first)
    assert found["status"] == "failed"
    assert "ended before it had an answer (signal 9)" in found["problem"]["detail"]
    assert ended(asking, second)["result"]["outcome"] == "LOOSE"


def test_a_full_queue_says_when_to_ask_again(asking):
    limits = ServerLimits(waiting=1)
    with client(workers=1, limits=limits) as crowded:
        first = ask(crowded, LONG)["id"]
        running(crowded, first)
        ask(crowded, LONG | {"steps": 59})
        refused = crowded.post("/api/v1/jobs", json=LONG | {"steps": 58})
        assert refused.status_code == 429
        assert int(refused.headers["retry-after"]) > 0
        assert ask(crowded, LONG)["id"] == first  # a known question is not queued again


def test_a_job_that_takes_too_long_is_ended():
    with client(workers=1, limits=ServerLimits(job_seconds=2.0)) as hurried:
        found = ended(hurried, ask(hurried, LONG)["id"])
        assert (
            found["problem"]["detail"] == "The job took longer than the 2 s that the server allows."
        )


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the limit of memory is one of Linux")
def test_a_job_that_needs_too_much_memory_is_ended():
    with client(workers=1, limits=ServerLimits(job_memory=150_000_000)) as small:
        found = ended(small, ask(small, PRESSURE)["id"])
        assert found["status"] == "failed"
        detail = found["problem"]["detail"]
        assert detail == "The job needs more memory than the 150 MB that the server allows."


@pytest.mark.slow
@pytest.mark.parametrize("limits", [ServerLimits(finished=1), ServerLimits(results=1)])
def test_the_oldest_results_are_forgotten(limits):
    with client(workers=1, limits=limits) as forgetful:
        first = ask(forgetful, LOOSE)["id"]
        ended(forgetful, first)
        second = ask(forgetful, LOOSE | {"stiffness": 1.5})["id"]
        assert ended(forgetful, second)["status"] == "done"
        assert forgetful.get(f"/api/v1/jobs/{first}").status_code == 404


@pytest.mark.slow
def test_an_idle_worker_process_is_ended_and_a_new_one_is_started():
    with client(workers=1, limits=ServerLimits(idle_seconds=0.2)) as resting:
        process = resting.app.app.state.server.book.processes[0]
        ended(resting, ask(resting, LOOSE)["id"])
        last = time.monotonic() + 10.0
        while process.pid is not None and time.monotonic() < last:
            time.sleep(0.05)
        assert process.pid is None
        found = ended(resting, ask(resting, LOOSE | {"stiffness": 1.5})["id"])
        assert found["status"] == "done"


# --- uploads


def upload(asking, kind, name, content_type, status=201, **query):
    content = (EXAMPLES / name).read_bytes() if isinstance(name, str) else name
    headers = {"content-type": content_type}
    found = asking.post(f"/api/v1/uploads/{kind}", content=content, headers=headers, params=query)
    assert found.status_code == status, found.text
    (UploadDocument if status == 201 else Problem).model_validate(found.json())
    return found.json()


def test_a_tensile_test_is_fitted_and_its_wall_can_be_used(asking):
    sent = upload(asking, "fit", "latex_tensile.csv", "text/csv")
    assert sent["summary"]["test"] == "tensile"
    assert sent["summary"]["needs"] == ["width", "thickness"]
    asked = ask(asking, {"kind": "fit", "upload": sent["id"], "test": "tensile", "law": "neo-hookean",
                         "width": "10 mm", "thickness": "1.2 mm"})  # fmt: skip
    found = ended(asking, asked["id"])["result"]
    assert found["constants"][0]["value"] == pytest.approx(146e3, rel=0.01)
    assert found["figure_svg"].startswith("<?xml")
    case = {
        "stone": {"size_ratio": 1.2},
        "ureter": {"wall_ratio": 1.5, "material": found["material"]},
    }
    answered = asking.post("/api/v1/instant", json={"case": case})
    assert answered.status_code == 200
    assert "fitted wall" in answered.json()["repeat"]["case_file"]


@pytest.mark.slow
def test_a_micrograph_gives_a_friction_coefficient(asking):
    sent = upload(asking, "friction", "known_slopes.png", "image/png")
    assert sent["summary"]["width"] == 1001
    preview = asking.get(sent["links"]["preview"])
    assert preview.headers["content-type"] == "image/png"
    assert preview.content.startswith(b"\x89PNG")
    body = {"kind": "friction", "upload": sent["id"], "pixel": "0.5 um", "height_range": "24.8 um"}
    found = ended(asking, ask(asking, body)["id"])["result"]
    assert found["friction_coefficient"] == pytest.approx(0.5, abs=0.1)
    lines = body | {"path": [[0, 30, 1000, 30], [0, 90, 1000, 90]]}
    assert len(ended(asking, ask(asking, lines)["id"])["result"]["paths"]) == 2


def test_a_picture_with_a_coloured_scale_bar_is_used_by_its_grey_area(asking):
    """The refusal names the largest grey area; a job uses the area of its upload."""
    rgb = np.repeat(np.asarray(Image.open(EXAMPLES / "known_slopes.png"))[..., None], 3, axis=2)
    rows, columns = rgb.shape[:2]
    rgb = np.concatenate([rgb, np.full((20, columns, 3), 40, np.uint8)])
    rgb[rows + 5 : rows + 8, 100:300] = (255, 220, 0)
    packed = io.BytesIO()
    Image.fromarray(rgb).save(packed, "PNG")
    content, grey = packed.getvalue(), f"0,0,{columns},{rows}"
    whole = f"0,0,{columns},{rows + 20}"
    refused = upload(asking, "friction", content, "image/png", 422, area=whole)["detail"]
    assert refused == (
        f"image is the upload in colour, but must be grey; column 100 of row {rows + 5} is "
        f"coloured; select 'area' 0,0,{columns},{rows + 5}."
    )
    sent = upload(asking, "friction", content, "image/png", area=grey)
    assert sent["summary"]["area"] == [0, 0, columns, rows]
    body = {"kind": "friction", "upload": sent["id"], "pixel": "0.5 um", "height_range": "24.8 um"}
    found = ended(asking, ask(asking, body)["id"])
    assert found["status"] == "done", found
    plain = upload(asking, "friction", "known_slopes.png", "image/png")
    alone = ended(asking, ask(asking, body | {"upload": plain["id"]})["id"])["result"]
    assert found["result"]["friction_coefficient"] == alone["friction_coefficient"]
    job = ended(asking, ask(asking, body | {"area": [0, 0, columns, rows + 20]})["id"])
    assert "is coloured; select 'area'" in job["problem"]["detail"]
    for area in ("1,2,3", "0,0,9999,50", "-1,0,5,5", "a,b,c,d"):
        assert upload(asking, "friction", content, "image/png", 422, area=area)["field"] == "area"
    assert upload(asking, "fit", b"x", "text/csv", 422, area=grey)["field"] == "area"


def test_a_dropped_upload_is_gone_but_known_answers_stay(asking):
    sent = upload(asking, "fit", "latex_tensile.csv", "text/csv")
    assert asking.delete(f"/api/v1/uploads/{sent['id']}").status_code == 204
    assert asking.delete(f"/api/v1/uploads/{sent['id']}").status_code == 404
    body = {"kind": "fit", "upload": sent["id"], "test": "tensile", "law": "yeoh", "width": "10 mm",
            "thickness": "1.2 mm"}  # fmt: skip
    assert "upload the file again" in ask(asking, body, 410)["detail"]
    picture = upload(asking, "friction", "known_slopes.png", "image/png")
    assert ask(asking, body | {"upload": picture["id"]}, 410)["field"] == "upload"


def test_uploads_are_read_in_the_sandbox_and_refused_with_a_sentence(asking):
    for kind, content, content_type in (
        ("fit", b"a,b\n1,2\n", "text/csv"),
        ("fit", b"\x00" * 1000, "text/csv"),
        ("fit", b"stretch,force_N\n1,x\n", "text/csv"),
        ("friction", b"\x89PNG\r\n\x1a\n" + b"\x00" * 100, "image/png"),
        ("friction", b"GIF89a" + b"\x00" * 100, "application/octet-stream"),
    ):
        found = upload(asking, kind, content, content_type, 422)
        assert "stonepass-" not in found["detail"], found  # the name of the private folder
        assert "/tmp" not in found["detail"], found
    assert upload(asking, "fit", b"", "text/csv", 422)["field"] == "body"
    assert upload(asking, "fit", b"x", "image/png", 415)["field"] == "Content-Type"
    assert upload(asking, "fit", b"x", "text/csv", 422, format="x3p")["field"] == "format"
    assert upload(asking, "friction", b"x", "text/csv", 422, format="../x")["field"] == "format"


def test_a_zip_bomb_is_refused(asking):
    """A small archive with the ending of a height map that unpacks to more than is allowed."""
    import zipfile

    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bindata/data.bin", b"\0" * 120_000_000)
    assert len(packed.getvalue()) < 200_000
    upload(asking, "friction", packed.getvalue(), "application/octet-stream", 422, format="x3p")


@pytest.mark.slow
def test_an_image_that_would_fill_the_memory_is_refused(asking):
    """A PNG of a few bytes that declares 20000 × 20000 pixels."""
    import struct
    import zlib

    def chunk(name, data):
        return (
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        )

    head = struct.pack(">IIBBBBB", 20_000, 20_000, 8, 0, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"") + chunk(b"IEND", b"")
    upload(asking, "friction", png, "image/png", 422)


@pytest.mark.slow
def test_the_oldest_uploads_are_dropped_when_there_are_too_many_bytes():
    table = b"stretch,nominal_stress_kPa\n" + b"".join(
        b"%g,%d\n" % (1 + k / 100, k) for k in range(99)
    )
    with client(limits=ServerLimits(uploads=2 * len(table) + 60)) as asking:
        ids = [upload(asking, "fit", table + b"#" * k, "text/csv")["id"] for k in range(3)]
        kept = [asking.app.app.state.server.uploads.get(each) is not None for each in ids]
        assert kept == [False, True, True]


# --- reports


@pytest.mark.slow
def test_reports_are_html_and_pdf_that_load_nothing(asking):
    for form, begin in (("html", b"<!doctype html>"), ("pdf", b"%PDF")):
        found = asking.post("/api/v1/report", json={"kind": form, "question": PRESSURE})
        assert found.status_code == 200, found.text
        assert found.content.startswith(begin)
        assert found.headers["content-disposition"].startswith("attachment; filename=")
        assert "sandbox" in found.headers["content-security-policy"]
        if form == "html":
            assert "Research use only. Not a medical device." in found.text
            assert "<script" not in found.text
            assert 'src="http' not in found.text


@pytest.mark.slow
def test_a_patient_is_assessed_and_the_report_has_the_title_as_text(asking):
    asked = ask(asking, {"kind": "assess", "patient": PATIENT})
    found = ended(asking, asked["id"], 600.0)
    assert found["status"] == "done", found
    assert found["result"]["outcome"] == "MOVES"
    question = {"kind": "assess", "patient": PATIENT}
    page = asking.post("/api/v1/report", json={"kind": "html", "question": question})
    assert "&lt;b&gt;#emph[x]&lt;/b&gt;" in page.text
    pdf = asking.post("/api/v1/report", json={"kind": "pdf", "question": question})
    assert pdf.content.startswith(b"%PDF")


@pytest.mark.parametrize("solve", [False, True])
def test_a_request_may_ask_for_solved_cases(monkeypatch, solve):
    """The option ``--solve`` of 'stonepass assess' is a field of the request."""
    body = {"kind": "assess", "patient": PATIENT, "solve": solve}
    asked = []

    def assessed(given, solver, *, surrogates):
        asked.append(surrogates)
        raise BadInput("stone", "x", "y")

    monkeypatch.setattr(patient, "assess", assessed)
    with pytest.raises(BadInput):
        patient.TASKS["assess"](body, Context(lambda *_: None))
    assert asked == [not solve]
    one, other = (AssessJob.model_validate(body | {"solve": each}) for each in (False, True))
    assert one.question() != other.question()


def test_a_job_that_cannot_be_begun_fails_and_the_next_one_runs(tmp_path, monkeypatch):
    """A full disk or too many processes must not leave a job that runs for ever."""

    async def refused(*_):
        raise OSError("no space left")

    with client(tmp_path, workers=1) as asking:
        with monkeypatch.context() as broken:
            broken.setattr("stonepass.web.jobs.process.WorkerProcess.run", refused)
            lost = ended(asking, ask(asking, LOOSE)["id"], 10.0)
        assert lost["status"] == "failed"
        assert lost["problem"]["status"] == 500
        assert "OSError" in lost["problem"]["detail"]
        assert ended(asking, ask(asking, LOOSE)["id"])["status"] == "done"


def test_reports_of_materials_with_other_sources_are_other_questions():
    """The source of a material is printed on a report, although no number depends on it."""
    wall = {"law": "neo-hookean", "C10": "70 kPa", "strain_range": [0.5, 1.5], "name": "mine",
            "test": "tension"}  # fmt: skip
    asked = [
        PressureJob(
            kind="pressure",
            case={"stone": {"size_ratio": 1.2},
                  "ureter": {"wall_ratio": 1.3, "material": wall | {"source": source}}},
        ).question()
        for source in ("one notebook", "another notebook")
    ]  # fmt: skip
    assert asked[0] != asked[1]


def test_old_files_are_dropped_though_nobody_asks_for_them():
    store = UploadStore(ServerLimits(upload_seconds=0.05))
    store.add(Upload("a" * 64, "fit", ".csv", b"1,2", {}))
    time.sleep(0.1)
    store.drop_old()
    assert not store._held
