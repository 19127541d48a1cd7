"""Time from a step of a slider to the frame in which the four plots of Design show its answer.

    python -m tests.benchmarks.redraw [--steps 60]

A real server and Chromium, on a machine that does nothing else. A step is measured from the input event
until all plots are drawn, and until the second frame after that: the first is being painted, the second comes
when it is on screen. Also what of it was the answer of the server, and two frames of an empty page; and the
time from a key on a slider until the plots of Transient show the new run.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from tests.benchmarks.diagnosis import say
from tests.frontend.browser import ARGUMENTS, find_or_get
from tests.frontend.test_transient import open_transient
from tests.frontend.views import open_design, run
from tests.running_server import AUTHORIZED, RunningServer

_FRAMES = """
const frames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
"""
_EMPTY = f"""{_FRAMES}
const times = [];
for (let k = 0; k < argument; k++) {{
  const start = performance.now();
  await frames();
  times.push(performance.now() - start);
}}
return times;
"""
_STEPS = f"""{_FRAMES}
const slider = document.querySelector("[aria-label='Braid angle slider']"), root = document.documentElement;
const drawing = [], times = [], answers = [];
for (let k = 0; k < argument; k++) {{
  performance.clearResourceTimings();
  const drawn = new Promise((done) => {{
    const seen = new MutationObserver(() => (seen.disconnect(), done()));
    seen.observe(root, {{ attributes: true, attributeFilter: ["data-drawn"] }});
  }});
  const start = performance.now();
  slider.value = String(Number(slider.value) + (k % 20 < 10 ? 1 : -1));
  slider.dispatchEvent(new Event("input", {{ bubbles: true }}));
  await drawn;
  drawing.push(performance.now() - start);
  await frames();
  times.push(performance.now() - start);
  const asked = performance.getEntriesByType("resource").filter(({{ name }}) => name.endsWith("/api/curves"));
  answers.push(...asked.map(({{ duration }}) => duration));
  await new Promise((done) => setTimeout(done, 100));
}}
slider.dispatchEvent(new Event("change", {{ bubbles: true }}));
return [drawing, times, answers];
"""
_KEYS = """
const times = [];
let pressed = 0;
addEventListener("keydown", () => (pressed = performance.now()), true);
new MutationObserver(() => {
  if (pressed) times.push(performance.now() - pressed);
  pressed = 0;
}).observe(document.documentElement, { attributes: true, attributeFilter: ["data-ran"] });
window.latencies = times;
"""


def line(name: str, times: list[float]) -> None:
    """Print median and 95th percentile [ms]."""
    high = statistics.quantiles(times, n=20)[-1]
    say(f"{name:32}{statistics.median(times):8.1f}{high:8.1f}")


def measured(page: Page, steps: int) -> None:
    """Print the figures of the empty page and of the plots."""
    page.goto("about:blank")
    empty = run(page, _EMPTY, steps)
    open_design(page)
    page.wait_for_timeout(2000)  # what the page fetches at rest
    run(page, _STEPS, 10)  # compiled code
    drawn, times, answers = run(page, _STEPS, steps)
    say(f"{'ms':32}{'median':>8}{'p95':>8}")
    line("two frames of an empty page", empty)
    line("answer of the server", answers)
    line("slider to four plots drawn", drawn)
    line("slider to four plots on screen", times)
    open_transient(page)
    run(page, _KEYS)
    page.get_by_role("slider", name="Mass slider").focus()
    for key in range(steps):
        page.keyboard.press("ArrowRight" if key % 20 < 10 else "ArrowLeft")
        page.wait_for_timeout(150)
    line("key to plots of a new transient", page.evaluate("window.latencies"))


def main() -> None:
    """Print a table: median and 95th percentile of the parts of a step."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--steps", type=int, default=60)
    steps = parser.parse_args().steps
    found = find_or_get(say)
    path = {} if found.executable is None else {"executable_path": found.executable}
    with (
        tempfile.TemporaryDirectory() as folder,
        RunningServer(Path(folder)) as server,
        sync_playwright() as tool,
    ):
        browser = tool.chromium.launch(args=[*ARGUMENTS], **path)
        measured(
            browser.new_page(
                base_url=server.url, viewport={"width": 1440, "height": 1000}, extra_http_headers=AUTHORIZED
            ),
            steps,
        )
        browser.close()


if __name__ == "__main__":
    main()
