"""Frames a second of the report's 3-D view, drawn by the processor in a headless browser.

    python -m benchmarks.report DIR...

turns the array of each package and moves its slider, 90 frames each. The frames that came are those
of a machine as busy as it was; what the browser's processes took of the processors is told too.
"""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

FRAMES = 90
MOVES = {
    "turning": "viewer.orbit(3, 0)",
    "sliding": "viewer.place((viewer.s + 0.1) % Number(viewer.slider.max))",
}
RUN = """async (frames) => {
  const viewer = sesameReport.viewer, start = performance.now();
  for (let k = 0; k < frames; k++) {
    %s;
    await new Promise((next) => requestAnimationFrame(next));
  }
  return (1000 * frames) / (performance.now() - start);
}"""


def processor_s() -> float:
    """Processor time of all processes that this one started, theirs included (Linux)."""
    parent: dict[int, int] = {}
    used: dict[int, float] = {}
    for file in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = file.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        pid = int(file.parent.name)
        parent[pid] = int(fields[1])
        used[pid] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def ours(pid: int) -> bool:
        while pid in parent and pid != os.getpid():
            pid = parent[pid]
        return pid == os.getpid()

    return sum(seconds for pid, seconds in used.items() if pid != os.getpid() and ours(pid))


def measure(page: Page, report: Path) -> None:
    """Print a line for each way of moving."""
    page.goto(report.resolve().as_uri())
    page.wait_for_selector("html.ready")
    page.wait_for_timeout(1500)
    for name, move in MOVES.items():
        before = processor_s()
        rate = page.evaluate(RUN % move, FRAMES)
        each_ms = 1000 * (processor_s() - before) / FRAMES
        size = report.stat().st_size / 1e6
        print(
            f"{report.parent.name} ({size:.2f} MB), {name}: {rate:.0f} frames/s, "
            f"{each_ms:.0f} ms of processor time a frame"
        )


def main() -> None:
    """Measure the packages that are named."""
    flags = [
        "--no-sandbox",
        "--disable-gpu",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
    ]
    with sync_playwright() as driver:
        browser = driver.chromium.launch(
            executable_path=shutil.which("chromium"), headless=True, args=flags
        )
        for folder in sys.argv[1:]:
            page = browser.new_page(viewport={"width": 1200, "height": 900})
            measure(page, Path(folder) / "report.html")
            page.close()
        browser.close()


if __name__ == "__main__":
    main()
