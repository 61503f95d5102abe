"""The server at a socket: slow, malformed and many clients; address and start."""

import json
import socket
import time
from http.client import HTTPResponse

import pytest
from web_server import CASE, HOST, ServerLimits, at, exchange, server

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.web.server import make_server
from stonepass.web.settings import ServerSettings

LIMITS = ServerLimits(header_seconds=0.6, body_seconds=0.8, connections=20)


@pytest.fixture(scope="module")
def serving():
    with server(limits=LIMITS) as found:
        yield found


@pytest.fixture(scope="module")
def port(serving):
    return serving.port


def answers(port):
    """Whether the server answers another client at once."""
    with at(port) as client:
        started = time.monotonic()
        assert client.post("/api/v1/instant", json={"case": CASE}).status_code == 200
        return time.monotonic() - started < 2.0


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"4"),  # TLS
        (b"GET / HTTP/9.9\r\n\r\n", b"4"),
        (b"nonsense\r\n\r\n", b"4"),
        (b"GET /api/v1 HTTP/1.1\r\n\r\n", b"4"),  # no host
        (b"GET /api/v1 HTTP/1.1\r\nHost: a\r\nHost: 127.0.0.1\r\n\r\n", b"4"),
        (b"GET /api/v1 HTTP/1.0\r\n\r\n", b"4"),
        (b"GET /" + b"a" * 70_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n", b"4"),
        (b"GET / HTTP/1.1\r\nHost: localhost\r\n" + b"X: y\r\n" * 20_000 + b"\r\n", b"431"),
        (b"POST /api/v1/instant HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n"
         b"Content-Length: 6\r\n\r\n{}", b"4"),
        (b"POST /api/v1/instant HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
         b"zz\r\n", b"4"),
        (b"GET /\x00 HTTP/1.1\r\nHost: localhost\r\n\r\n", b"4"),
        (b"GET /api/v1/%ff%00 HTTP/1.1\r\nHost: localhost\r\n\r\n", b"4"),
        (b"CONNECT evil.example:80 HTTP/1.1\r\nHost: localhost\r\n\r\n", b"4"),
        (b"GET http://evil.example/ HTTP/1.1\r\nHost: evil.example\r\n\r\n", b"4"),
    ],
)  # fmt: skip
def test_malformed_requests_are_refused(port, sent, status):
    with socket.create_connection(("127.0.0.1", port), 5.0) as made:
        made.sendall(sent)
        with HTTPResponse(made) as answer:
            answer.begin()
            assert str(answer.status).encode().startswith(status)
            assert answer.headers["content-type"] == "application/problem+json"
            assert answer.headers["content-security-policy"]
            assert json.loads(answer.read())["status"] == answer.status
    assert answers(port)


@pytest.mark.parametrize(
    "head",
    [
        b"",
        b"GET / HT",
        b"GET / HTTP/1.1\r\nHost: localhost\r\n",
    ],
)
def test_a_client_that_sends_the_head_slowly_is_cut_off(port, head):
    started = time.monotonic()
    with socket.create_connection(("127.0.0.1", port), 5.0) as made:
        made.sendall(head)
        try:
            while time.monotonic() - started < 4.0:  # a byte now and then
                time.sleep(0.1)
                made.sendall(b"x")
        except OSError:
            pass
    assert 0.4 < time.monotonic() - started < 2.0
    assert answers(port)


def test_a_client_that_sends_the_body_slowly_is_told_and_cut_off(port):
    sent = b"POST /api/v1/instant HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n"
    sent += b"Content-Type: application/json\r\n\r\n{"
    started = time.monotonic()
    answer = exchange(port, sent)
    assert b" 408 " in answer.splitlines()[0]
    assert time.monotonic() - started < 3.0


def test_many_idle_connections_do_not_keep_others_out(port):
    idle = [socket.create_connection(("127.0.0.1", port)) for _ in range(3 * LIMITS.connections)]
    try:
        assert answers(port)
    finally:
        for each in idle:
            each.close()


def test_connections_that_rest_after_a_response_do_not_keep_others_out(port):
    resting = []
    try:
        for _ in range(3 * LIMITS.connections):
            made = socket.create_connection(("127.0.0.1", port), 5.0)
            made.sendall(b"GET /icon HTTP/1.1\r\nHost: evil.example\r\n\r\n")
            assert b" 421 " in made.recv(4096)
            resting.append(made)
        assert answers(port)
    finally:
        for made in resting:
            made.close()


def test_a_request_after_another_on_one_connection_is_answered(port):
    with at(port) as client:
        for _ in range(3):
            assert client.get("/api/v1").status_code == 200
        time.sleep(LIMITS.header_seconds + 0.3)  # an idle connection may rest longer than a head
        assert client.get("/api/v1").status_code == 200


def test_responses_that_nobody_reads_are_given_up(serving):
    with socket.socket() as made:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        made.connect(("127.0.0.1", serving.port))
        ours = made.getsockname()

        def held():
            return [each for each in serving.made.server_state.connections if each.client == ours]

        asked = b"GET /assets/fonts/inter.woff2 HTTP/1.1\r\nHost: localhost\r\n\r\n"
        made.sendall(100 * asked)  # more than the buffers of the system hold
        time.sleep(LIMITS.header_seconds / 2)
        assert held()
        last = time.monotonic() + 5.0
        while held() and time.monotonic() < last:
            time.sleep(0.05)
        assert not held()


def test_an_address_that_is_in_use_is_refused_with_a_remedy(port):
    with pytest.raises(BadInput, match="choose another with --port"):
        make_server(ServerSettings(port=port))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("serve --host 192.0.2.7 --no-browser", "loopback address for a server without a token"),
        ("serve --port 70000 --no-browser", "a whole number from 0 to 65535"),
        ("serve --host no.such.host.invalid --no-browser", "loopback"),
        ("serve --workers 1000 --no-browser", "a whole number from 1 to 64"),
    ],
)
def test_the_command_refuses_what_it_cannot_serve(arguments, said, capsys, monkeypatch):
    monkeypatch.delenv("STONEPASS_TOKEN", raising=False)
    assert run(arguments.split()) == 2
    assert said in capsys.readouterr().err


def test_without_the_extra_the_command_says_what_to_install(capsys, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "fastapi", None)
    assert run(["serve", "--no-browser"]) == 2
    assert "pip install 'stonepass[web]'" in capsys.readouterr().err


def test_the_address_in_answers_is_that_of_the_request(port):
    with at(port) as client:
        found = client.post("/api/v1/instant", json={"case": CASE}).json()
        assert f"http://127.0.0.1:{port}/api/v1/instant" in found["repeat"]["curl"]
        assert HOST not in found["repeat"]["curl"]
