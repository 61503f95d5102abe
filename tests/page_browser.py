"""A real server and a real browser for the tests of the page.

The browser is the Chromium of the system. Where it or Playwright is missing, the tests are skipped
with the reason, except in continuous integration, which installs both.
"""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from urllib.request import Request, urlopen

import pytest

CHROMIUM = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
# Nothing outside this machine can be reached, whatever the page or the browser asks for.
ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
)  # fmt: skip
ANSWERED = "html[data-answered]:not([data-waiting])"
SECONDS = 60_000  # ms that a test waits for finite elements on a busy machine


def chromium():
    """Path of the Chromium of the system; None if there is none."""
    return next(filter(None, map(shutil.which, CHROMIUM)), None)


def missing():
    """What is missing for a test in a browser, in words; empty if nothing is."""
    for name in ("playwright", "axe_playwright_python", "fastapi", "uvicorn"):
        if importlib.util.find_spec(name) is None:
            return f"the library {name} is not installed"
    return "" if chromium() else "there is no Chromium on this system"


@dataclass
class Server:
    """A running server."""

    address: str

    def get(self, path):
        with urlopen(f"{self.address}/api/v1/{path}", timeout=30) as answer:
            return json.load(answer)

    def post(self, path, body):
        sent = Request(f"{self.address}/api/v1/{path}", json.dumps(body).encode())
        sent.add_header("Content-Type", "application/json")
        with urlopen(sent, timeout=30) as answer:
            return json.load(answer)


@dataclass
class Watched:
    """What a page must not do: errors on the console, requests to other machines."""

    faults: list = field(default_factory=list)
    sizes: dict = field(default_factory=dict)
    # Problems that a test provokes: the browser logs every refused request on the console.
    expected: tuple = ()

    def watch(self, page, address):
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.faults.append(f"error: {error}"))
        page.on("request", lambda request: self._request(request.url, address))
        page.on("response", self._response)

    def _console(self, message):
        if message.type in ("error", "warning") and not any(
            each in message.text for each in self.expected
        ):
            self.faults.append(f"console: {message.text}")

    def _request(self, url, address):
        if not url.startswith((address, "data:", "blob:")):
            self.faults.append(f"request to another place: {url}")

    def _response(self, response):
        length = response.headers.get("content-length", "0")
        self.sizes[response.url] = int(length)


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """A server in a process of its own, as a user starts it."""
    reason = missing()
    if reason and os.environ.get("CI"):
        pytest.fail(f"continuous integration must run the tests in a browser, but {reason}")
    if reason:
        pytest.skip(reason)
    command = [sys.executable, "-m", "stonepass", "serve", "--port", "0", "--no-browser",
               "--workers", "1"]  # fmt: skip
    folder = tmp_path_factory.mktemp("server")
    errors = folder / "errors.txt"
    # Answers of earlier runs are not known, so that a solve takes long enough to be cancelled.
    own = os.environ | {"STONEPASS_CACHE": str(folder / "solved")}
    with errors.open("w") as told:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=told, text=True, env=own)
        try:
            line = process.stdout.readline()
            assert "http://" in line, errors.read_text()
            yield Server("http://" + line.split("http://")[1].split("/")[0])
        finally:
            process.terminate()
            process.wait(10)
            process.stdout.close()


@pytest.fixture(scope="session")
def browser(server):
    """A Chromium without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as started:
        found = started.chromium.launch(executable_path=chromium(), args=list(ARGUMENTS))
        yield found
        found.close()


@pytest.fixture
def watched():
    """The faults of the pages of a test; it fails if there are any at its end."""
    found = Watched()
    yield found
    assert not found.faults, "\n".join(found.faults)


@pytest.fixture
def open_page(browser, server, watched):
    """Open the page with the options of a browser context, and wait for the first answer.

    `prepare` is called with the page before it is opened.
    """
    contexts = []

    def opened(place="", prepare=None, **options):
        options = {"viewport": {"width": 1280, "height": 900}} | options
        context = browser.new_context(**options)
        contexts.append(context)
        context.set_default_timeout(20_000)
        page = context.new_page()
        watched.watch(page, server.address)
        if prepare:
            prepare(page)
        page.goto(f"{server.address}/{place}")
        page.wait_for_selector(ANSWERED, state="attached")
        return page

    yield opened
    for context in contexts:
        context.close()


@pytest.fixture
def page(open_page):
    """The page on a desktop, with its first answer."""
    return open_page()


def faults_of_access(page):
    """What axe-core finds on the page as it is, except for minor faults."""
    import axe_playwright_python

    script = Path(axe_playwright_python.__file__).parent / "axe.min.js"
    page.evaluate(script.read_text("utf-8"))  # unlike a script element, the policy allows this
    found = page.evaluate("() => axe.run(document, {resultTypes: ['violations']})")
    assert len(found["passes"]) > 15  # the rules were applied
    return [
        f"{each['id']}: {each['help']}: {each['nodes'][0]['html'][:200]}"
        for each in found["violations"]
        if each["impact"] != "minor"
    ]


def until(page, holds):
    """Wait until a condition holds, while the page goes on."""
    last = time.monotonic() + SECONDS / 1000.0
    while not holds():
        assert time.monotonic() < last, "the condition does not hold"
        page.wait_for_timeout(50)


def settled(page):
    """Wait until the answer belongs to the inputs, however many changes were made."""
    page.wait_for_selector("html[data-pending='0']", state="attached")
