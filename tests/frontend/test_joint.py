"""A measured joint in Compare & diagnose: from torque, angle and lever to the missing effect."""

from __future__ import annotations

import csv
import io
import json
import math
import random
from pathlib import Path

from playwright.sync_api import Page, expect

from tests.frontend.comparing import braid_force, choose, diagnosed, file, use
from tests.frontend.diagnoses import remember
from tests.frontend.views import SIZES, link_to, load, marked, open_compare

ROOT = Path(__file__).resolve().parents[2]
RUB, NOISE = 0.5, 0.03  # N m


def joint() -> str:
    """A DMSP-20 between two points: slow swings at four pressures, against a bearing that rubs."""
    draw = random.Random(4)
    text = io.StringIO()
    text.write("# muscle: DMSP-20\n# nominal_length: 300 mm\n")
    write = csv.writer(text, lineterminator="\n").writerow
    write(
        [
            "Time (s)",
            "Knee angle (deg)",
            "Torque (N*m)",
            "Moment arm (mm)",
            "Muscle length (mm)",
            "Pressure (bar)",
        ]
    )
    time = 0.0
    for pressure, reach in ((2e5, 0.4), (3e5, 0.7), (4.5e5, 0.9), (6e5, 0.9)):
        for way in (1.0, -1.0):
            for i in range(30):
                angle = reach * (i / 29 if way > 0 else 1.0 - i / 29)
                # Between (0, 310 mm) and a point 40 mm from the pivot that begins a quarter below it.
                x, y = 0.04 * math.cos(angle - 0.4), 0.04 * math.sin(angle - 0.4)
                distance = math.hypot(x, y - 0.31)
                lever = x * 0.31 / distance
                length = distance - (math.hypot(0.04 * math.cos(0.4), 0.04 * math.sin(0.4) + 0.31) - 0.299)
                torque = (
                    lever * braid_force(pressure, 1.0 - length / 0.3) - way * RUB + draw.gauss(0.0, NOISE)
                )
                write([f"{time:.1f}", f"{math.degrees(angle):.4f}", f"{torque:.5f}", f"{1e3 * lever:.4f}",
                       f"{1e3 * length:.4f}", f"{pressure / 1e5:g}"])  # fmt: skip
                time += 0.5
    return text.getvalue()


def test_from_a_file_of_a_joint_to_its_bearing_in_two_actions(page: Page) -> None:
    open_compare(page)
    remember(page)
    choose(page, file("joint.csv", joint()))  # 1
    use(page)  # 2
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    expect(page.locator("#error-now")).to_contain_text("N·m")
    expect(page.locator("#overlay-torque .js-line").first).to_be_attached()
    titles = page.locator("#overlay-torque")
    expect(titles).to_contain_text("Angle (°)")
    expect(titles).to_contain_text("Torque (N·m)")
    following = page.get_by_role("region", name="Next")
    expect(following).to_contain_text("Add friction in the bearing of the joint")
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        expect(page.locator("#overlay-torque")).to_be_visible()
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_link_to_a_run_of_a_joint_shows_its_angle_and_torque(page: Page) -> None:
    knee = json.loads((ROOT / "presets/drives/joint-knee.json").read_text())["document"]
    load(page, link_to({"schema": 1, "view": "transient", "design": {}, "transient": {"drive": knee}}))
    marked(page, "[data-ran]", 120_000)
    for name in ("angle", "torque"):
        assert page.locator(f"#run-{name} .js-line").count() >= 1, name
    expect(page.locator(".transient .notice")).to_be_hidden()
