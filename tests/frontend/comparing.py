"""What the tests of Compare & diagnose share: a measurement with hidden effects, opening it, waiting."""

from __future__ import annotations

import base64
import csv
import io
import math
import random
import re
from collections.abc import Callable

from playwright.sync_api import FilePayload, Locator, Page, expect

from tests.frontend.diagnoses import remember, unanswered
from tests.frontend.views import marked, open_compare, run

NOISE = 2.0  # N
# A muscle of the catalogue as its preset gives it, DMSP-20 at 300 mm.
LENGTH, DIAMETER, ANGLE, WALL = 0.3, 0.0218, 0.46303585055409563, 0.0018
C10, PRESTRESS, FRICTION = 0.5e6, 60.0, 15.0
# Pressure [Pa] -> contraction up to which this muscle pulls.
REACH = {1e5: 0.01, 2e5: 0.05, 3e5: 0.1, 4e5: 0.14, 5e5: 0.17, 6e5: 0.19}
POINTS = 30
ADD = re.compile("^Add (?!all|a term)")  # the button of one effect


def braid_force(pressure: float, contraction: float) -> float:
    """Chou & Hannaford: p pi D0^2/4 (3 (1 - k)^2 / tan^2 - 1 / sin^2) [N]."""
    shape = 3.0 * (1.0 - contraction) ** 2 / math.tan(ANGLE) ** 2 - 1.0 / math.sin(ANGLE) ** 2
    return pressure * math.pi * DIAMETER**2 / 4.0 * shape


def wall_force(contraction: float, c10: float) -> float:
    """A neo-Hookean tube whose hoop stretch the braid dictates: the slope of its energy over length [N]."""
    stretch = 1.0 - contraction
    hoop = 1.0 + (1.0 - stretch**2) / math.tan(ANGLE) ** 2  # squared
    hoop_slope = -2.0 * stretch / math.tan(ANGLE) ** 2
    radial_slope = -(2.0 * stretch * hoop + stretch**2 * hoop_slope) / (stretch**2 * hoop) ** 2
    return math.pi * DIAMETER * WALL * c10 * (2.0 * stretch + hoop_slope + radial_slope)


def measured(seed: int, *, points: int = POINTS, c10: float = C10, friction: float = FRICTION) -> str:
    """A file of slow sweeps, shortening and lengthening, with three effects the ideal muscle lacks.

    Its diagnosis takes 3 s of processor time; with the prestress alone and half the points less than 1 s.
    """
    draw = random.Random(seed)
    text = io.StringIO()
    text.write("# muscle: DMSP-20\n# nominal_length: 300 mm\n")
    write = csv.writer(text, lineterminator="\n").writerow
    write(["time [s]", "pressure [bar]", "length [mm]", "force [N]"])
    time = 0.0
    for pressure, reach in REACH.items():
        for direction in (-1, 1):
            for i in range(points):
                share = i / (points - 1)
                contraction = reach * (share if direction < 0 else 1.0 - share)
                force = braid_force(pressure, contraction) + wall_force(contraction, c10)
                force += direction * friction - PRESTRESS + draw.gauss(0.0, NOISE)
                length = 1e3 * LENGTH * (1.0 - contraction)
                write([f"{time:.2f}", f"{pressure / 1e5:g}", f"{length:.4f}", f"{force:.3f}"])
                time += 0.05
    return text.getvalue()


def file(name: str, text: str) -> FilePayload:
    """A file as the browser's file dialog gives it."""
    return {"name": name, "mimeType": "text/csv", "buffer": text.encode()}


def choose(page: Page, *files: FilePayload) -> None:
    """Put files into the file dialog of the view."""
    page.locator("#measurement-files").set_input_files(list(files))


DROP = """
const transfer = new DataTransfer();
for (const { name, text } of argument) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  transfer.items.add(new File([bytes], name, { type: "text/csv" }));
}
document.body.dispatchEvent(
  new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
"""


def drop(page: Page, *files: FilePayload) -> None:
    """Drop files anywhere on the page."""
    contents = [{"name": f["name"], "text": base64.b64encode(f["buffer"]).decode()} for f in files]
    run(page, DROP, contents)


def use(page: Page) -> None:
    """Accept how the files are read."""
    page.locator("dialog.import").get_by_role("button", name=re.compile("^Use th(is file|ese)")).click()


def diagnosed(page: Page, within: float = 180_000) -> None:
    """Wait (at most so many ms) until the numbers belong to the model and the diagnosis is complete."""
    expect(page.locator(".error-value")).not_to_have_class(re.compile("stale"), timeout=20_000)
    marked(page, '[data-diagnosis="done"]', within)
    expect(page.locator("#error-now")).not_to_have_class(re.compile("counting"))


def setup(page: Page, field: str = "") -> Locator:
    """The panel of files and experiment, opened at a field of the strip or at the files."""
    panel = page.locator(".setup-panel")
    if not panel.is_visible():
        fact = page.locator(f".strip [data-fact='{field}']")
        (fact if field else page.locator(".strip button.name")).click()
    expect(panel).to_be_visible()
    return panel


def state(page: Page) -> str | None:
    """The state of the case."""
    return page.locator(".strip").get_attribute("data-state")


def opened(page: Page, *files: FilePayload) -> None:
    """The view with these files, compared and diagnosed."""
    open_compare(page)
    bring(page, *files)


def bring(page: Page, *files: FilePayload) -> None:
    """Compare and diagnose files in the view that is open."""
    remember(page)
    choose(page, *files)
    use(page)
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)


def error(page: Page) -> float:
    """The error on screen [N]."""
    found = re.match(r"([\d.]+)\s*N", page.locator("#error-now").inner_text())
    assert found
    return float(found[1])


def changed(page: Page, act: Callable[[], object]) -> float:
    """Do something that changes the model; the error after it, with a complete diagnosis."""
    number = page.locator("#error-now")
    before = number.inner_text()
    act()
    expect(number).not_to_have_text(before, use_inner_text=True, timeout=20_000)
    diagnosed(page)
    return error(page)


def fitted(page: Page, act: Callable[[], object]) -> float:
    """Do something that changes the model; the error after it. No diagnosis comes."""
    number = page.locator("#error-now")
    before = number.inner_text()
    with unanswered(page):
        act()
        expect(number).not_to_have_text(before, use_inner_text=True, timeout=20_000)
        expect(page.locator(".error-value")).not_to_have_class(re.compile("stale"), timeout=20_000)
        expect(number).not_to_have_class(re.compile("counting"))
    return error(page)


# A change of the window's size moves everything once, in the frame after it: two frames are let go by.
WATCH = """
for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
window.shifts = [];
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) {
    const what = entry.sources.map(({ node }) => node?.outerHTML?.slice(0, 80) ?? node?.textContent);
    window.shifts.push({ value: entry.value, what, recent: entry.hadRecentInput });
  }
}).observe({ type: "layout-shift" });
"""


def watch_shifts(page: Page) -> None:
    """Remember from now on what moves on the page."""
    run(page, WATCH)


def unasked(page: Page) -> list[dict[str, object]]:
    """What moved later than half a second after a click or key: what a layout shift is by its definition."""
    return [shift for shift in shifts(page) if not shift["recent"]]


def shifts(page: Page) -> list[dict[str, object]]:
    """What moved without being asked to: also within half a second of a click, as the drop is one."""
    found = run(page, "return window.shifts;")
    assert isinstance(found, list)
    return found
