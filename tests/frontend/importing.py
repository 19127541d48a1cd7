"""What the tests of the import share: files of several habits, the panel, what a preview holds."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

from playwright.sync_api import FilePayload, Locator, Page, expect

from tests.frontend.comparing import braid_force, file

CORPUS = Path(__file__).resolve().parents[3] / "shared" / "data" / "lab-formats" / "files"
LENGTH = 0.25
PRESSURES = (2e5, 3e5, 4e5)
MOST = 0.12  # contraction


def readings(scale: float = 1.0) -> list[tuple[float, float, float]]:
    """(pressure [Pa], stroke [m], force [N]) of slow sweeps of an ideal braid."""
    steps = 20
    return [
        (pressure, LENGTH * MOST * i / steps, scale * braid_force(pressure, MOST * i / steps))
        for pressure in PRESSURES
        for i in [*range(steps + 1), *range(steps, -1, -1)]
    ]


def table(head: list[str], rows: list[list[float]]) -> str:
    """A semicolon table with decimal commas."""
    lines = [";".join(f"{value:.4f}".replace(".", ",") for value in row) for row in rows]
    return "\n".join([*head, *lines]) + "\n"


def laboratory(name: str, *, scale: float = 1.0, rest: str = "") -> FilePayload:
    """A file with a preamble, names and units apart, a column in mm that nobody knows."""
    rows = [[p / 1e5, 1e3 * s, f, 1e3 * s + 80.0] for p, s, f in readings(scale)]
    preamble = ["Protokoll;Nr. 7", *(["Probe;DMSP-20", f"L0;{rest}"] if rest else []), ""]
    head = [*preamble, "Druck;Hub;Kraft;Kanal 4", "bar;mm;N;mm"]
    return file(name, table(head, rows))


def bare(name: str, *said: str) -> FilePayload:
    """A file with names and without any unit; ``said``: conditions such as ``muscle: DMSP-20``."""
    head = [*(f"# {one}" for one in said), "p;x;F"]
    return file(name, table(head, [[p / 1e3, 1e3 * s, f] for p, s, f in readings()]))


def plain(name: str, *, rest: str = "250 mm", muscle: str = "DMSP-20") -> FilePayload:
    """A file in which everything is said; ``muscle`` may be left out."""
    said = [f"# nominal_length: {rest}", *([f"# muscle: {muscle}"] if muscle else [])]
    head = [*said, "pressure [bar(g)];stroke [mm];force [N]"]
    return file(name, table(head, [[p / 1e5, 1e3 * s, f] for p, s, f in readings()]))


def trace(name: str) -> FilePayload:
    """A transient trace whose pressure has no unit."""
    rows = []
    for k in range(150):
        share = 1.0 - math.exp(-k / 30.0)
        rows.append([10.0 * k, 500.0 * share, 40.0 * share])
    return file(name, table(["Zeit [ms];Druck;Weg [mm]"], rows))


def panel(page: Page) -> Locator:
    """The panel of an import."""
    found = page.locator("dialog.import")
    expect(found).to_be_visible()
    return found


def accept_button(page: Page) -> Locator:
    """The button that takes the files."""
    return panel(page).get_by_role("button", name=re.compile("^Use th"))


def answer_everything(page: Page) -> int:
    """Answer what is open of the experiment; how many actions that took."""
    for actions in range(8):
        expect(page.locator(".import .state-now")).not_to_contain_text("Reading")
        if accept_button(page).is_enabled():
            return actions
        row = page.locator("dialog.import .question.open").first
        if row.locator("select").count():
            row.locator("select").select_option("DMSP-20")
        else:
            row.locator("input").fill("250 mm")
            page.keyboard.press("Tab")
    raise AssertionError("the panel asks on and on")


def preview_of(page: Page, payload: FilePayload) -> dict[str, Any]:
    """The preview of a file as the server answers it."""
    answer = page.request.post(f"/api/measurements/preview?name={payload['name']}", data=payload["buffer"])
    assert answer.ok, answer.text()
    return json.loads(answer.body())
