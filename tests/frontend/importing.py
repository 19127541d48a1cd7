"""What the tests of the import share: files of several habits, the panel, what a preview holds."""

from __future__ import annotations

import json
import math
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
    preamble = ["Protokoll;Nr. 7", *([f"L0;{rest}"] if rest else []), ""]
    head = [*preamble, "Druck;Hub;Kraft;Traverse", "bar;mm;N;mm"]
    return file(name, table(head, rows))


def bare(name: str) -> FilePayload:
    """A file with names and without any unit."""
    return file(name, table(["p;x;F"], [[p / 1e3, 1e3 * s, f] for p, s, f in readings()]))


def plain(name: str, *, rest: str = "250 mm") -> FilePayload:
    """A file in which everything is said."""
    head = [f"# nominal_length: {rest}", "# muscle: DMSP-20", "pressure [bar(g)];stroke [mm];force [N]"]
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


def preview_of(page: Page, payload: FilePayload) -> dict[str, Any]:
    """The preview of a file as the server answers it."""
    answer = page.request.post(f"/api/measurements/preview?name={payload['name']}", data=payload["buffer"])
    assert answer.ok, answer.text()
    return json.loads(answer.body())
