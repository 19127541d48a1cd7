"""Freeing the start of each run in Compare & diagnose: where there are runs, by keyboard, and in the link."""

from __future__ import annotations

import json
import re

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.comparing import choose, file, measured, setup, use
from tests.frontend.diagnoses import unanswered
from tests.frontend.views import link_of, load, open_compare
from tests.identification.predict.test_free_starts import swinging

pytestmark = pytest.mark.kept_page

BOX = "Fit the start of each run too"


def runs() -> str:
    """Two runs of a load on a DMSP-20, each from the middle of a swing that hardly damps."""
    columns = swinging(2)[0].columns
    lines = ["# muscle: DMSP-20", "# nominal_length: 300 mm", "# load_mass: 12 kg"]
    lines.append("time [s],pressure [bar],stroke [mm]")
    lines += [
        f"{time:.3f},{pressure / 1e5:g},{1e3 * stroke:.4f}"
        for time, pressure, stroke in zip(
            columns["time"], columns["pressure"], columns["displacement"], strict=True
        )
    ]
    return "\n".join(lines) + "\n"


def test_starts_are_freed_by_keyboard_shown_kept_in_the_link_and_given_up_with_the_runs(page: Page) -> None:
    with unanswered(page):
        open_compare(page)
        choose(page, file("runs.csv", runs()))
        use(page)
        expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
        panel = setup(page, "muscle")
        box = panel.get_by_role("checkbox", name=BOX)
        expect(box).to_have_accessible_description(re.compile("Stroke and speed at its first row"))
        expect(box).not_to_be_checked()
        now = page.locator("#error-now")
        expect(now).to_contain_text(re.compile(r"1\.\d+\smm"))
        box.focus()
        page.keyboard.press("Space")
        found = panel.get_by_role("list", name="Found starts").get_by_role("listitem")
        expect(found).to_have_count(2, timeout=20_000)
        for run, words in enumerate(found.all_inner_texts(), 1):
            assert re.fullmatch(
                rf"Start of run {run}, fitted: stroke [+−][\d.]+ ± [\d.]+ mm beyond its first reading, "
                r"speed [+−][\d.]+ ± [\d.]+ mm/s\.",
                words,
            ), words
        expect(box).to_be_focused()
        expect(panel.get_by_text("Geometry", exact=True)).to_be_visible()  # of which nothing is fitted
        expect(now).to_contain_text(re.compile(r"0\.[0-3]\d*\smm"))  # what is left is damping
        link = link_of(page)
        page.keyboard.press("Control+z")
        expect(box).not_to_be_checked()
        expect(found).to_have_count(0)
        load(page, link)
        panel = setup(page, "muscle")
        expect(panel.get_by_role("checkbox", name=BOX)).to_be_checked()
        expect(panel.get_by_role("list", name="Found starts")).to_be_visible(timeout=20_000)
        page.keyboard.press("Escape")
        with page.expect_download() as download:
            page.locator(".area-take").get_by_role("button", name=re.compile("^Model")).click()
        # A start belongs to the run: a saved model takes none along.
        assert json.loads(download.value.path().read_text("utf-8"))["free"] == []
        setup(page).get_by_role("button", name="Remove runs.csv").click()
        page.keyboard.press("Escape")
        choose(page, file("sweeps.csv", measured(1, points=8)))
        use(page)
        expect(page.locator("#error-now")).to_have_text(re.compile("N"), timeout=20_000)
        expect(setup(page, "muscle").get_by_role("checkbox", name=BOX)).to_be_hidden()
