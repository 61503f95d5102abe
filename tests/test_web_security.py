"""Who may ask what: every line of the security of the server has a test."""

import json
import os
import re
from pathlib import Path

import pytest
from web_server import CASE, HOST, ServerLimits, client

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.web.settings import ServerSettings

TOKEN = "correct-horse-battery-staple"


@pytest.mark.parametrize(
    ("given", "allowed"),
    [("[::1]", "[::1]"), ("[2001:db8::1]", "[2001:db8::1]"), ("FD00::A", "[fd00::a]")],
)
def test_the_address_of_the_server_is_one_of_its_names(given, allowed):
    assert allowed in ServerSettings(host=given, token=TOKEN).allowed_hosts


def test_the_token_is_not_passed_on_to_other_processes(monkeypatch):
    told = []
    monkeypatch.setenv("STONEPASS_TOKEN", TOKEN)
    monkeypatch.setattr("stonepass.web.server.serve", lambda made, browser: told.append(made))
    assert run(["serve", "--no-browser", "--host", "192.0.2.7"]) == 0
    assert told[0].token == TOKEN
    assert "STONEPASS_TOKEN" not in os.environ


@pytest.fixture(scope="module")
def asking():
    with client() as found:
        yield found


@pytest.fixture(scope="module")
def guarded():
    with client(host="192.0.2.7", token=TOKEN, names=("lab.example",)) as found:
        yield found


def problem_of(response, status):
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    found = response.json()
    assert found["status"] == status
    assert found["detail"].endswith(".")
    return found


# --- addresses


@pytest.mark.parametrize("host", ["127.0.0.1", "127.0.0.2", "::1", "localhost"])
def test_a_loopback_address_needs_no_token(host):
    assert ServerSettings(host).token == ""


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.7", "lab.example"])
def test_any_other_address_needs_a_token(host):
    with pytest.raises(BadInput, match="loopback address for a server without a token"):
        ServerSettings(host)
    assert ServerSettings(host, token=TOKEN).token == TOKEN


@pytest.mark.parametrize("token", ["short", "with a space in it", "völlig-geheim-hier"])
def test_a_token_that_could_be_guessed_or_is_not_ascii_is_refused_without_being_told(token):
    with pytest.raises(BadInput) as refusal:
        ServerSettings("192.0.2.7", token=token)
    assert token not in str(refusal.value)
    assert TOKEN not in repr(ServerSettings(token=TOKEN))


# --- DNS rebinding


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8765", "127.0.0.1.evil.example", "", "localhost.",
             "user@127.0.0.1", "127.0.0.1, evil.example"]
)  # fmt: skip
def test_a_request_for_another_host_is_refused(asking, host):
    found = problem_of(asking.get("/api/v1", headers={"host": host}), 421)
    assert "another" in found["title"]


@pytest.mark.parametrize("host", ["127.0.0.1:8765", "localhost:9000", "LOCALHOST", "[::1]:8765"])
def test_the_names_of_this_machine_are_allowed(asking, host):
    assert asking.get("/api/v1", headers={"host": host}).status_code == 200


def test_a_name_can_be_allowed(guarded):
    headers = {"authorization": f"Bearer {TOKEN}"}
    for host, status in (("lab.example", 200), ("192.0.2.7:1", 200), ("other.example", 421)):
        assert guarded.get("/api/v1", headers=headers | {"host": host}).status_code == status


def test_the_repeated_request_takes_the_token_from_the_environment(guarded):
    headers = {"authorization": f"Bearer {TOKEN}", "host": "lab.example"}
    body = {"case": {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.3}}}
    found = guarded.post("/api/v1/instant", headers=headers, json=body)
    curl = found.json()["repeat"]["curl"]
    assert curl.startswith('curl -H "Authorization: Bearer $STONEPASS_TOKEN" --json ')
    assert TOKEN not in found.text


# --- other pages


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "http://127.0.0.1:9999"},
        {"origin": "http://localhost:8765"},  # another origin than 127.0.0.1
        {"origin": "file://127.0.0.1:8765"},
        {"origin": "http://[::1"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
    ],
)
@pytest.mark.parametrize(
    ("method", "path"),
    [("POST", "/api/v1/instant"), ("POST", "/api/v1/jobs"), ("DELETE", "/api/v1/jobs/1"),
     ("POST", "/api/v1/uploads/fit"), ("POST", "/api/v1/report")],
)  # fmt: skip
def test_a_page_of_another_site_cannot_change_anything(asking, headers, method, path):
    problem_of(asking.request(method, path, headers=headers, json={"case": CASE}), 403)


@pytest.mark.parametrize(
    "headers", [{}, {"origin": HOST}, {"origin": HOST, "sec-fetch-site": "same-origin"}]
)
def test_the_own_page_and_programs_can(asking, headers):
    asked = asking.post("/api/v1/instant", json={"case": CASE}, headers=headers)
    assert asked.status_code == 200


# --- the token


@pytest.mark.parametrize(
    "headers",
    [{}, {"authorization": "Bearer wrong"}, {"authorization": TOKEN}, {"authorization": "Bearer "},
     {"cookie": "stonepass_token=wrong"}, {"cookie": "=;;="}],
)  # fmt: skip
@pytest.mark.parametrize("path", ["/", "/api/v1", "/assets/none.js", "/?token=wrong", "/nothing"])
def test_without_the_token_nothing_is_told(guarded, headers, path):
    found = guarded.get(path, headers=headers | {"host": "192.0.2.7"}, follow_redirects=False)
    problem_of(found, 401)
    assert TOKEN not in found.text


def test_the_token_is_taken_from_the_header_or_from_a_cookie_that_scripts_cannot_read(guarded):
    host = {"host": "192.0.2.7"}
    entered = guarded.get(f"/?token={TOKEN}", headers=host, follow_redirects=False)
    assert entered.status_code == 303
    assert entered.headers["location"] == "/"  # the token does not stay in the address
    cookie = entered.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    guarded.cookies.clear()
    for headers in ({"authorization": f"bearer {TOKEN}"}, {"cookie": f"stonepass_token={TOKEN}"}):
        assert guarded.get("/api/v1", headers=host | headers).status_code == 200


# --- headers of responses


def responses(asking):
    yield asking.get("/")
    yield asking.get("/api/v1")
    yield asking.get("/api/v1/nothing")
    yield asking.get("/api/v1", headers={"host": "evil.example"})
    yield asking.post("/api/v1/instant", json={"case": CASE})
    yield asking.post("/api/v1/instant", content=b"{")
    yield asking.get("/assets/none.js")


def test_every_response_has_the_headers_of_security(asking):
    count = 0
    for response in responses(asking):
        headers, count = response.headers, count + 1
        policy = headers["content-security-policy"]
        assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self'")
        assert "unsafe" not in policy
        assert "http" not in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        kept = "no-cache" if "/assets/" in str(response.url) else "no-store"
        assert headers["cache-control"] == kept
        assert "access-control-allow-origin" not in headers
        assert "server" not in headers
    assert count == 7


# --- nothing of the disk of the server can be named

SECRET = "a text that only the server knows"


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("secret")
    (folder / "law.toml").write_text(f'law = "neo-hookean"\nC10 = "1 kPa"\nsource = "{SECRET}"\n')
    (folder / "law.py").write_text(f"raise SystemExit({SECRET!r})\n")
    (folder / "shape.csv").write_text("z,rho\n-1,0\n0,1\n1,0\n")
    return folder


def named(files):
    for name in ("law.toml", "law.py:energy", "law.py", "shape.csv"):
        yield str(files / name)
        yield f"../../{files.name}/{name}"
    yield from ("/etc/passwd", "file:///etc/passwd", "C:\\law.toml", "~/law.toml", "ureter.toml")


def places(text):
    """Every place of a request in which a text might be read as the name of a file."""
    case = {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.3}}
    patient = {
        "stone": {"diameter": "5 mm ± 1 mm"},
        "ureter": {"inner_diameter": "4.4 mm ± 1 mm", "wall_thickness": "0.7 mm ± 0.1 mm"},
        "assessment": {"limit": "6 kPa"},
    }
    for section, name in (("ureter", "material"), ("stone", "shape"), ("method", "opening_curve")):
        made = json.loads(json.dumps(case))
        made.setdefault(section, {})[name] = text
        if section == "method":
            made[section]["closure"] = "series"
        yield "/api/v1/instant", {"case": made}
        yield "/api/v1/jobs", {"kind": "pressure", "case": made}
        yield "/api/v1/jobs", {"kind": "push", "case": made}
        yield "/api/v1/report", {"kind": "html", "question": {"kind": "pressure", "case": made}}
        made = json.loads(json.dumps(patient))
        made.setdefault(section, {})[name] = text
        if section == "method":
            made[section]["closure"] = "series"
        yield "/api/v1/jobs", {"kind": "assess", "patient": made}
    yield "/api/v1/jobs", {"kind": "fit", "upload": text, "test": "tensile", "law": "neo-hookean"}
    yield "/api/v1/jobs", {"kind": "friction", "upload": text}


def test_no_file_of_the_server_can_be_named(asking, files, monkeypatch):
    def opened(path, *_, **__):
        raise AssertionError(f"{path} was opened")

    monkeypatch.setattr("stonepass.inputs.material_file.load_material", opened)
    monkeypatch.setattr("stonepass.inputs.shape_file.read_shape", opened)
    monkeypatch.setattr("stonepass.clinic.patient.read_shape", opened)
    monkeypatch.setattr("stonepass.inputs.opening_curve_file.read_opening_curve", opened)
    count = 0
    for text in named(files):
        for path, body in places(text):
            asking.app.app.state.server.rate._buckets.clear()
            found = asking.post(path, json=body)
            assert found.status_code == 422, (path, body, found.text)
            assert SECRET not in found.text
            count += 1
    assert count > 200


def test_materials_by_constants_are_allowed(asking):
    table = {"law": "neo-hookean", "C10": "0.1 MPa", "source": "a test", "strain_range": [1.0, 1.5]}
    case = {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.3, "material": table}}
    found = asking.post("/api/v1/instant", json={"case": case}).json()
    assert found["answer"] is None
    assert [each["code"] for each in found["warnings"]] == ["no_surrogate"]


@pytest.mark.parametrize(
    "path",
    ["/assets/../app.py", "/assets/%2e%2e/app.py", "/assets/..%2fapp.py", "/assets//etc/passwd",
     "/assets/%2fetc%2fpasswd", "/assets/..\\app.py", "/assets/../api/v1/nothing",
     "/assets/%2e%2e/%2e%2e/app.py"],
)  # fmt: skip
def test_static_files_are_those_of_the_page_alone(asking, path):
    found = asking.get(path)
    assert found.status_code == 404
    assert "import" not in found.text


# --- sizes, before anything is parsed


def test_the_length_that_a_request_states_is_checked_before_its_body_is_read(asking):
    limits = ServerLimits()
    for path, most in (("/api/v1/instant", limits.body), ("/api/v1/uploads/fit", limits.upload)):
        headers = {"content-length": str(most + 1), "content-type": "text/csv"}
        problem_of(asking.post(path, content=b"x", headers=headers), 413)
    for length in ("-1", "1e3", "9" * 500, "²"):
        headers = {"content-length": length.encode("utf-8")}
        problem_of(asking.post("/api/v1/instant", content=b"x", headers=headers), 413)


def test_a_body_of_unknown_length_is_counted():
    def parts():
        for _ in range(100):
            yield b" " * 1000

    with client(limits=ServerLimits(body=50_000)) as asking:
        problem_of(asking.post("/api/v1/instant", content=parts()), 413)


DEEP = b"[" * 100_000
STRANGE = [
    (b"{", 400),
    (b"", 422),
    (b"null", 422),
    (b'{"case": NaN}', 422),
    (DEEP, 400),
    (b'{"case": ' + b'{"a":' * 20_000 + b"1" + b"}" * 20_001, 400),
    (b"\xff\xfe", 400),
    (b'{"case": {"stone": {"size_ratio": 1e999}, "ureter": {"wall_ratio": 1.3}}}', 422),
    (b'{"case": {"stone": {"size_ratio": ' + b"9" * 5000 + b'}, "ureter": {}}}', 400),
    (b'{"case": {"stone": {"diameter": "\\ud800 mm"}, "ureter": {"wall_ratio": 1.3}}}', 422),
    (b'{"case": {"stone": {"size_ratio": true}, "ureter": {"wall_ratio": 1.3}}}', 422),
]


@pytest.mark.parametrize(("body", "status"), STRANGE)
def test_strange_bodies_are_refused_with_a_sentence(asking, body, status):
    headers = {"content-type": "application/json"}
    problem_of(asking.post("/api/v1/instant", content=body, headers=headers), status)


def test_a_json_request_must_say_that_it_is_json(asking):
    """Otherwise a form of another page could send one."""
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data"):
        body = json.dumps({"case": CASE}).encode()
        found = asking.post("/api/v1/instant", content=body, headers={"content-type": kind})
        assert found.status_code in (415, 422)


# --- the rate of expensive requests


def test_a_client_that_asks_too_often_is_told_when_to_ask_again():
    with client(limits=ServerLimits(per_minute=2)) as asking:
        for _ in range(2):
            assert asking.post("/api/v1/uploads/fit", content=b"x").status_code != 429
        found = asking.post("/api/v1/uploads/fit", content=b"x")
        problem_of(found, 429)
        assert 0 < int(found.headers["retry-after"]) <= 60
        assert asking.get("/api/v1").status_code == 200  # what costs little is not counted


# --- nothing leaves the machine, nothing is kept


def test_nothing_is_loaded_from_another_machine():
    source = Path(ServerSettings.__module__.replace(".", "/")).parent
    files = list((Path(__file__).parents[1] / "src" / source).rglob("*.py"))
    assert len(files) > 30
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"^(import|from) (urllib\.request|http\.client|requests|httpx)", text,
                             re.MULTILINE), file  # fmt: skip


def test_nothing_of_a_request_is_printed_or_logged(capfd, caplog):
    text = "4.23456 mm"
    with caplog.at_level(0), client() as asking:
        asking.post("/api/v1/instant", json={"case": CASE | {"stone": {"diameter": text}}})
        asking.post("/api/v1/instant", json={"case": CASE | {"stone": {"diameter": text, "x": 1}}})
    printed = capfd.readouterr()
    own = [each for each in caplog.records if not each.name.startswith(("httpx", "httpcore"))]
    assert text not in printed.out + printed.err + "".join(each.getMessage() for each in own)
