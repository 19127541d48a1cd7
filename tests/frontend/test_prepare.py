"""Preparing a file in Compare & diagnose: a step is refused or taken, drawn, undone; errors over windows."""

from __future__ import annotations

import math
import random

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.comparing import choose, file, setup, use
from tests.frontend.diagnoses import unanswered
from tests.frontend.guard import PageGuard
from tests.frontend.views import REFUSED, open_compare

pytestmark = pytest.mark.kept_page

PERIOD, STEP, ROWS = 1.0, 0.01, 600  # s, s


def record() -> str:
    """The stroke of a load under a swinging pressure, with noise."""
    draw = random.Random(3)
    lines = ["# muscle: DMSP-20", "# nominal_length: 300 mm", "# load_mass: 5 kg"]
    lines.append("time [s],pressure [bar],stroke [mm]")
    for row in range(ROWS):
        swing = math.sin(2.0 * math.pi * row * STEP / PERIOD)
        lines.append(
            f"{row * STEP:.2f},{3.0 + 1.5 * swing:.4f},{45.0 + 8.0 * swing + draw.gauss(0, 0.2):.3f}"
        )
    return "\n".join(lines) + "\n"


def test_a_step_is_refused_or_taken_drawn_and_undone(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    with unanswered(page):
        open_compare(page)
        choose(page, file("swing.csv", record()))
        use(page)
        expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
        expect(page.locator(".over-windows")).to_contain_text("windows of 1 s")  # a period of the motion
        panel = setup(page)
        prepare = panel.locator("details.prepare")
        prepare.locator("summary").click()
        step = prepare.get_by_role("combobox", name="A step that prepares swing.csv")
        step.fill("lowpas 5 Hz")
        step.press("Enter")
        expect(prepare.locator(".error")).to_contain_text("'lowpas 5 Hz': is no step")
        step.fill("range time 2 s to 4 s")
        prepare.get_by_role("button", name="Add").click()
        expect(prepare.locator("li")).to_contain_text("201 of 600 rows")
        expect(step).to_be_focused()
        expect(panel.get_by_text("201 of 600 rows; left out: 399 by")).to_be_visible(timeout=10_000)
        picture = prepare.locator("svg.thumbnail")
        expect(picture).to_be_visible()
        # Two channels over time, of the whole file pale and of the prepared rows strong, at most 400 points.
        assert picture.locator("circle.before").count() == 2 * 300
        assert picture.locator("circle:not(.before)").count() == 2 * 201
        page.keyboard.press("Escape")
        page.keyboard.press("Control+z")
        expect(prepare.locator("li")).to_have_count(0)
