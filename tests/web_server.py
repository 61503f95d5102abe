"""A server for tests: in this process without sockets, or in a thread at a free port."""

import socket
import threading
import time
from contextlib import contextmanager
from types import SimpleNamespace

import httpx2 as httpx
from starlette.testclient import TestClient

from stonepass.web.app import create_app
from stonepass.web.server import make_server
from stonepass.web.settings import ServerLimits, ServerSettings

HOST = "http://127.0.0.1:8765"
THIN = {"inner_diameter": "3.5 mm", "outer_diameter": "4.54 mm"}
CASE = {"stone": {"diameter": "4.2 mm"}, "ureter": THIN}
# A case whose states are solved fast.
QUICK = {
    "stone": {"size_ratio": 1.2},
    "ureter": {"wall_ratio": 1.3},
    "method": {"accuracy": "fast", "seating": "frictionless"},
}
# A question that takes long enough to be cancelled.
LONG = {
    "kind": "push",
    "steps": 60,
    "case": {"stone": {"size_ratio": 1.25}, "ureter": {"wall_ratio": 1.5}},
}


@contextmanager
def client(folder=None, **settings):
    """A client of an application in this process, whose server state lives as long as the context."""
    made = ServerSettings(cache_folder=folder, **settings)
    with TestClient(create_app(made), base_url=HOST, raise_server_exceptions=False) as found:
        yield found


@contextmanager
def server(folder=None, **settings):
    """Port and server, which listens in a thread of this process."""
    made, listening = make_server(ServerSettings(port=0, cache_folder=folder, **settings))
    thread = threading.Thread(target=made.run, args=([listening],))
    thread.start()
    try:
        while not made.started:
            assert thread.is_alive()
            time.sleep(0.01)
        yield SimpleNamespace(port=listening.getsockname()[1], made=made)
    finally:
        made.should_exit = True
        thread.join(20)
        listening.close()


def ended(asking, identity, seconds=120.0):
    """The job when it has ended."""
    last = time.monotonic() + seconds
    while time.monotonic() < last:
        found = asking.get(f"/api/v1/jobs/{identity}").json()
        if found["status"] not in ("queued", "running"):
            return found
        time.sleep(0.05)
    raise AssertionError(f"job {identity} did not end in {seconds} s")


def running(asking, identity, seconds=60.0):
    """Wait until a job is running."""
    last = time.monotonic() + seconds
    while asking.get(f"/api/v1/jobs/{identity}").json()["status"] == "queued":
        assert time.monotonic() < last
        time.sleep(0.02)


def exchange(port, sent, seconds=1.5):
    """What a server answers to bytes, until it closes the connection or is silent."""
    with socket.create_connection(("127.0.0.1", port), seconds) as made:
        made.sendall(sent)
        answer = b""
        try:
            while part := made.recv(65536):
                answer += part
        except TimeoutError:
            pass
        return answer


def at(port, **settings):
    """A client of a server at a port."""
    return httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60.0, **settings)


__all__ = ["CASE", "HOST", "LONG", "QUICK", "THIN", "ServerLimits", "at", "client", "ended", "exchange",
           "running", "server"]  # fmt: skip
