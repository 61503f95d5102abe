"""Measurements of the server: start, memory, latency, many clients, requests from its description.

    python benchmarks/server.py [SECONDS] [REQUESTS]

Writes docs/data/server_benchmark.json and the table of docs/server.md. SECONDS is the duration of
the load by 50 clients, 60 by default; REQUESTS is the number of requests that schemathesis makes,
5000 by default. With 0 the numbers of the last run that made requests are kept. All requests go to
a server that this script starts on the loopback interface.
"""

from __future__ import annotations

import asyncio
import json
import os
import platform
import signal
import socket
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date
from pathlib import Path

import httpx2 as httpx
from api_fuzz import fuzz
from measure import Row

import stonepass

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT / "docs" / "data" / "server_benchmark.json"
PAGE = ROOT / "docs" / "server.md"
START, END = "<!-- written by benchmarks/server.py -->\n", "<!-- end -->\n"
SECTION = "server"
STARTS, LATENCIES, CLIENTS = 7, 300, 50
CASE = {
    "stone": {"diameter": "4.2 mm"},
    "ureter": {"inner_diameter": "3.5 mm", "outer_diameter": "4.54 mm"},
}
ALL = {"limit": "6 kPa", "include": ["curve", "map", "section"]}
QUICK = {
    "kind": "pressure",
    "case": {
        "stone": {"size_ratio": 1.2},
        "ureter": {"wall_ratio": 1.3},
        "method": {"accuracy": "fast", "seating": "frictionless"},
    },
}


def kept() -> list[Row]:
    """Numbers of the last run about requests from the server's description."""
    rows = json.loads(DATA.read_text(encoding="utf-8"))["rows"] if DATA.is_file() else []
    fields = ("section", "what", "value", "unit", "target", "at_least")
    return [Row(**{key: row[key] for key in fields}) for row in rows if "schema" in row["what"]
            or "5xx" in row["what"]]  # fmt: skip


KEPT = kept()


def main() -> None:
    """Measure, and write the file and the table."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    requests = int(sys.argv[2]) if len(sys.argv) > 2 else 5000
    load = os.getloadavg()[0]
    rows: list[Row] = []
    for measure in (started, latency, jobs, lambda: loaded(seconds), lambda: fuzzed(requests)):
        for row in measure():
            rows.append(row)
            print(f"{row.what:<72} {row.value:>9.4g} {row.unit}", flush=True)
        write(rows, load)  # a run that is stopped leaves what it has measured


def write(rows: list[Row], load: float) -> None:
    """Write the file and the table; `load` is the load average before the first measurement."""
    document = {
        "date": f"{date.today():%Y-%m-%d}",
        "machine": {
            "cores": str(os.cpu_count()),
            "system": f"{platform.system()} {platform.release()}",
            "python": platform.python_version(),
            "stonepass": stonepass.__version__,
        },
        "load_at_the_beginning": load,
        "rows": [row.record() for row in rows],
    }
    DATA.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(page(document), encoding="utf-8")


@contextmanager
def running(*options: str) -> Iterator[tuple[subprocess.Popen[str], str, float]]:
    """A server process, its address, and the seconds until it answered a request."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [sys.executable, "-m", "stonepass", "serve", "--no-browser", "--port", str(port)]
    began = time.perf_counter()
    process = subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True)
    address = f"http://127.0.0.1:{port}"
    try:
        while True:
            try:
                httpx.get(f"{address}/api/v1").raise_for_status()
                break
            except httpx.TransportError:
                assert process.poll() is None
                time.sleep(0.01)
        yield process, address, time.perf_counter() - began
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


def memory(process: subprocess.Popen[str]) -> float:
    """Resident memory of a process in MB."""
    pages = int(Path(f"/proc/{process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def processor(process: subprocess.Popen[str]) -> float:
    """Processor time in s that a process has used."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def started() -> list[Row]:
    """Time from the command to the first answer, and memory after a first instant answer."""
    times, spent, megabytes = [], [], []
    for _ in range(STARTS):
        with running() as (process, address, seconds):
            times.append(seconds)
            spent.append(processor(process))
            httpx.post(f"{address}/api/v1/instant", json={"case": CASE} | ALL).raise_for_status()
            time.sleep(0.5)
            megabytes.append(memory(process))
    return [
        Row(
            SECTION, "start, until the first response (median)", statistics.median(times), "s", 1.5
        ),
        Row(SECTION, "start, processor time", statistics.median(spent), "s", 1.5),
        Row(SECTION, "memory of the idle server (largest)", max(megabytes), "MB", 150.0),
    ]


def latency() -> list[Row]:
    """Time of an instant answer with everything, one client, as a slider moves."""
    rows = []
    with running() as (process, address, _), httpx.Client(base_url=address) as client:
        for what, section, name, low in (
            ("size of the stone changes", "stone", "diameter", 3.6),
            ("friction changes", "stone", "friction", 0.2),
        ):
            times, before = [], processor(process)
            for k in range(LATENCIES):
                value = low + 0.5 * k / LATENCIES
                case = {**CASE, section: CASE[section] | {name: value}}
                if name == "diameter":
                    case[section][name] = f"{value:.4f} mm"
                began = time.perf_counter()
                client.post("/api/v1/instant", json={"case": case} | ALL).raise_for_status()
                times.append(1e3 * (time.perf_counter() - began))
            spent = 1e3 * (processor(process) - before) / LATENCIES
            times.sort()
            p95 = times[int(0.95 * LATENCIES)]
            name = f"instant answer with curve, map and section; {what}"
            rows += [
                Row(SECTION, f"{name}, median", statistics.median(times), "ms", 50.0),
                Row(SECTION, f"{name}, 95th percentile", p95, "ms", 100.0),
                Row(SECTION, f"{name}, processor time of the server", spent, "ms", 15.0),
            ]
    return rows


def jobs() -> list[Row]:
    """Time of a repeated question, and what happens to a job whose process is killed."""
    with running("--workers", "1", "--no-cache") as (process, address, _):
        client = httpx.Client(base_url=f"{address}/api/v1", timeout=60.0)
        first = _done(client, QUICK)
        began = time.perf_counter()
        again = client.post("/jobs", json=QUICK).json()
        repeated = 1e3 * (time.perf_counter() - began)
        assert again["result"] == first["result"]
        killed = client.post("/jobs", json=QUICK | {"kind": "push", "steps": 60}).json()["id"]
        while client.get(f"/jobs/{killed}").json()["status"] == "queued":
            time.sleep(0.02)
        (child,) = _children(process.pid)
        os.kill(child, signal.SIGKILL)
        ended = _ended(client, killed)
        assert ended["status"] == "failed", ended
        survived = _done(client, QUICK | {"stiffness": 1.5})["status"] == "done"
    return [
        Row(SECTION, "a repeated question is answered", repeated, "ms"),
        Row(
            SECTION,
            "further jobs that are answered after a worker process was killed",
            float(survived),
            "of 1",
            1.0,
            at_least=True,
        ),
    ]


def _children(parent: int) -> list[int]:
    """Processes that a process has started."""
    text = Path(f"/proc/{parent}/task/{parent}/children").read_text()
    return [int(each) for each in text.split()]


def _done(client: httpx.Client, body: dict[str, object]) -> dict[str, object]:
    return _ended(client, client.post("/jobs", json=body).json()["id"])


def _ended(client: httpx.Client, identity: str) -> dict[str, object]:
    while True:
        found = client.get(f"/jobs/{identity}").json()
        if found["status"] not in ("queued", "running"):
            return found
        time.sleep(0.02)


def loaded(seconds: float) -> list[Row]:
    """Errors, requests per second and memory with 50 clients that ask without a pause."""
    with running() as (process, address, _):
        counts = asyncio.run(_ask(address, seconds, process))
    done, errors, times, most = counts
    times.sort()
    name = f"{CLIENTS} clients for {seconds:g} s"
    good, middle = 100.0 * (done - errors) / done, 1e3 * statistics.median(times)
    return [
        Row(SECTION, f"{name}: requests without an error", good, "%", 100.0, at_least=True),
        Row(SECTION, f"{name}: instant answers per second", done / seconds, "1/s"),
        Row(SECTION, f"{name}: median of the time of an answer", middle, "ms"),
        Row(SECTION, f"{name}: largest memory of the server", most, "MB"),
    ]


async def _ask(address, seconds, process):
    last = time.monotonic() + seconds
    done = errors = 0
    times: list[float] = []
    most = 0.0

    async def one(number: int) -> None:
        nonlocal done, errors, most
        step = 0
        async with httpx.AsyncClient(base_url=address, timeout=30.0) as client:
            while time.monotonic() < last:
                step += 1
                size = 3.4 + ((number * 37 + step * 11) % 200) / 100
                case = CASE | {"stone": {"diameter": f"{size:.3f} mm"}}
                began = time.perf_counter()
                try:
                    found = await client.post("/api/v1/instant", json={"case": case} | ALL)
                    errors += found.status_code != 200
                except httpx.HTTPError:
                    errors += 1
                times.append(time.perf_counter() - began)
                done += 1
                most = max(most, memory(process))

    await asyncio.gather(*(one(k) for k in range(CLIENTS)))
    return done, errors, times, most


FUZZED = """
from stonepass.web.server import serve
from stonepass.web.settings import Limits, ServerSettings

limits = Limits(per_minute=10**6, job_seconds=5.0, waiting=4)
serve(ServerSettings(port={port}, limits=limits), browser=False)
"""


def fuzzed(count: int) -> list[Row]:
    """Responses to requests that schemathesis makes of the server's description."""
    if count == 0:
        return KEPT
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    code = FUZZED.format(port=port)
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    try:
        assert process.stdout is not None
        process.stdout.readline()  # the server listens
        sent = 0
        faults = 0
        found = fuzz(f"http://127.0.0.1:{port}", count)
        while sent < count:
            sent += sum(found.values())
            faults += sum(number for (_, status), number in found.items() if status >= 500)
            if sent < count:
                found = fuzz(f"http://127.0.0.1:{port}", count - sent + 500)
        statuses = sorted({status for _, status in found})
        print("statuses:", *statuses)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)
    return [
        Row(SECTION, "requests made by schemathesis", float(sent), "", float(count), at_least=True),
        Row(SECTION, "responses of the class 5xx among them", float(faults), "", 0.0),
    ]


def page(document: dict[str, object]) -> str:
    """The page with the table of these measurements."""
    before, rest = PAGE.read_text(encoding="utf-8").split(START)
    on = document["machine"]
    lines = [
        f"Measured on {document['date']} with {on['cores']} cores, Python {on['python']}, "
        f"{on['system']}; the load average at the beginning was "
        f"{document['load_at_the_beginning']:.1f}.",
        "",
        "| what | measured | target |",
        "| --- | --- | --- |",
    ]
    for row in document["rows"]:
        target = ""
        if row["target"] is not None:
            number = f"{row['target']:g} {row['unit']}".rstrip()
            # No more than all requests can be without an error, and no fewer than none with one.
            bound = number == "100 %" if row["at_least"] else number == "0"
            sign = "=" if bound else "≥" if row["at_least"] else "≤"
            target = f"{sign} {number}: {'met' if row['met'] else 'missed'}"
        value = f"{row['value']:.4g} {row['unit']}".rstrip()
        lines.append(f"| {row['what']} | {value} | {target} |")
    return before + START + "\n".join(lines) + "\n" + END + rest.split(END)[1]


if __name__ == "__main__":
    main()
