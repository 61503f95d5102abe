"""How fast the page is: first answer after loading, sliding, bytes; writes docs/page.md.

A browser without a window loads the page of `stonepass serve` on this machine. Times are taken in
the browser by its own clock; a redraw ends with the first frame after the pictures have changed.
"""

from __future__ import annotations

import argparse
import datetime as dt
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from measure import machine
from page import table
from playwright.sync_api import Browser, Page, sync_playwright

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))
from page_browser import ANSWERED, ARGUMENTS, chromium  # noqa: E402

DATA, PAGE = ROOT / "docs" / "data" / "page_benchmark.json", ROOT / "docs" / "page.md"
MARK = "<!-- written by benchmarks/web_page.py -->"
LOADS, SLIDES, MAPS = 20, 240, 40
TARGETS = {"first": 1000.0, "median": 50.0, "p95": 100.0, "bytes": 1.5e6}

PRIORITY = (
    " The machine was busy with other work, over which server and browser had priority (SCHED_RR)."
)

# The clock starts before the page's own scripts, at the start of the navigation.
FIRST = """
new MutationObserver(() => {
  if (!("answered" in document.documentElement.dataset) || window.firstAnswer) return;
  window.firstAnswer = performance.now();
  const shown = () => { window.firstFrame = performance.now(); };
  requestAnimationFrame(() => requestAnimationFrame(shown));
}).observe(document, {attributes: true, subtree: true, attributeFilter: ["data-answered"]});
"""
BYTES = """() => performance.getEntriesByType("resource").concat(
  performance.getEntriesByType("navigation"))
  .filter((each) => each.startTime < window.firstAnswer)
  .reduce((sum, each) => sum + each.transferSize, 0)"""
SHIFT = """() => new Promise((resolve) => {
  let sum = 0;
  new PerformanceObserver((list) => { for (const each of list.getEntries()) sum += each.value; })
    .observe({type: "layout-shift", buffered: true});
  setTimeout(() => resolve(sum), 200);
})"""
SLIDE = """async ([label, values, mark]) => {
  const slider = document.querySelector(`[aria-label="${label}, slider"]`);
  const root = document.documentElement;
  const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
  const times = [];
  for (const value of values) {
    await frame();
    const begun = performance.now();
    slider.value = value;
    slider.dispatchEvent(new Event("input", {bubbles: true}));
    if (root.dataset[mark] !== "0") {
      await new Promise((resolve) => {
        const watch = new MutationObserver(() => {
          if (root.dataset[mark] !== "0") return;
          watch.disconnect();
          resolve();
        });
        watch.observe(root, {attributes: true, attributeFilter: ["data-" + mark]});
      });
    }
    await frame();
    times.push(performance.now() - begun);
  }
  return times;
}"""
SLIDERS = {
    "Diameter across the ureter": (3.2, 5.6),
    "Friction coefficient": (0.0, 1.0),
    "Wall thickness": (0.2, 3.0),
    "Pressure limit": (1.0, 15.0),
}


@contextmanager
def served() -> Iterator[str]:
    command = [sys.executable, "-m", "stonepass", "serve", "--port", "0", "--no-browser",
               "--workers", "1"]  # fmt: skip
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield "http://" + process.stdout.readline().split("http://")[1].split("/")[0]
        finally:
            process.terminate()


def load(browser: Browser, address: str) -> tuple[Page, dict[str, float]]:
    """Load the page without a cache and return it with what was measured."""
    page = browser.new_context(viewport={"width": 1280, "height": 900}).new_page()
    page.add_init_script(FIRST)
    page.goto(address)
    page.wait_for_selector(ANSWERED, state="attached")
    page.wait_for_timeout(300)
    return page, {
        "answer_ms": page.evaluate("window.firstAnswer"),
        "frame_ms": page.evaluate("window.firstFrame"),
        "bytes": page.evaluate(BYTES),
        "shift": page.evaluate(SHIFT),
    }


def slide(page: Page, label: str, count: int, mark: str) -> list[float]:
    """Move a slider over its range and return the times until `mark` says that all is drawn."""
    low, high = SLIDERS[label]
    # The golden section visits the range evenly and no value twice.
    values = [low + (high - low) * ((k * 0.6180339887) % 1.0) for k in range(count)]
    times: list[float] = page.evaluate(SLIDE, [label, values, mark])
    return times


def measured() -> dict[str, Any]:
    with served() as address, sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium(), args=list(ARGUMENTS))
        load(browser, address)  # the first load also warms the server
        loads = [load(browser, address)[1] for _ in range(LOADS)]
        page, _ = load(browser, address)
        slides = {each: slide(page, each, SLIDES // len(SLIDERS), "pending") for each in SLIDERS}
        maps = slide(page, "Friction coefficient", MAPS, "map")
        shift = page.evaluate(SHIFT)
        version = browser.version
        browser.close()
    return {
        "date": dt.date.today().isoformat(),
        "machine": machine(),
        "browser": f"Chromium {version}",
        "loads": loads,
        "slides": slides,
        "maps": maps,
        "priority": os.sched_getscheduler(0) != os.SCHED_OTHER,
        "shift": max(shift, *(each["shift"] for each in loads)),
    }


def percentile(values: list[float], part: float) -> float:
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def section(found: dict[str, Any]) -> str:
    """Return the measurements as Markdown."""
    loads, every = found["loads"], [t for times in found["slides"].values() for t in times]
    frames = [each["frame_ms"] for each in loads]
    rows = [
        ["first answer on the screen after the start of loading, median",
         f"{statistics.median(frames):.0f} ms", f"{TARGETS['first']:.0f} ms"],
        ["the same, slowest load", f"{max(frames):.0f} ms", ""],
        ["slider to redrawn answer, curve and section, median",
         f"{statistics.median(every):.0f} ms", f"{TARGETS['median']:.0f} ms"],
        ["the same, 95th percentile", f"{percentile(every, 0.95):.0f} ms",
         f"{TARGETS['p95']:.0f} ms"],
        *([f"slider '{label}', median and 95th percentile",
           f"{statistics.median(times):.0f} and {percentile(times, 0.95):.0f} ms", ""]
          for label, times in found["slides"].items()),
        ["slider to redrawn map, which waits 80 ms for the slider to rest, median",
         f"{statistics.median(found['maps']):.0f} ms", ""],
        ["bytes before the first answer", f"{loads[0]['bytes'] / 1e3:.0f} kB",
         f"{TARGETS['bytes'] / 1e3:.0f} kB"],
        ["cumulative layout shift while loading and sliding", f"{found['shift']:.3f}", "0"],
    ]  # fmt: skip
    machine_words = ", ".join(f"{name} {value}" for name, value in found["machine"].items())
    return "\n\n".join(
        [
            f"*{found['date']}, {found['browser']} without a window; {machine_words}.*",
            table(["", "measured", "target, at most"], rows),
            f"{len(loads)} loads without a cache and {len(every)} movements of a slider were "
            "measured, with server and browser on the same machine. The file "
            "[data/page_benchmark.json](data/page_benchmark.json) has all times."
            + (PRIORITY if found["priority"] else ""),
        ]
    )


def write(found: dict[str, Any]) -> None:
    """Put the measurements between the marks of the documentation page."""
    before, _, rest = PAGE.read_text("utf-8").partition(MARK)
    after = rest.partition("<!-- end -->")[2]
    PAGE.write_text(f"{before}{MARK}\n\n{section(found)}\n\n<!-- end -->{after}", "utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only-page", action="store_true", help="write the page from the data")
    if not parser.parse_args().only_page:
        DATA.write_text(json.dumps(measured(), indent=1) + "\n", "utf-8")
    write(json.loads(DATA.read_text("utf-8")))


if __name__ == "__main__":
    main()
