"""The Studies view: from a drive to the spread of its figures, and from a grid back to one drive."""

from __future__ import annotations

import csv
import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.frontend.axe import violations
from tests.frontend.guard import PageGuard
from tests.frontend.test_layout import OVERLAPS, SCROLLS, SIDEWAYS, TOO_SMALL
from tests.frontend.views import REFUSED, SIZES, enter, link_of, load, marked, run

CLICKS = 6
ASKED = """
const model = await import('/js/views/studies/model.js'), state = await import('/js/state.js');
return model.studyRequest(state.doc.peek());
"""


def rows(page: Page) -> Locator:
    """One for each run."""
    return page.locator(".runs-table tbody tr")


def cells(page: Page, column: int) -> list[float]:
    """Numbers of a column of the table of runs, 1 for the first quantity."""
    texts = page.locator(f".runs-table tbody tr > :nth-child({column + 1})").all_inner_texts()
    return [float(text) for text in texts]


def test_from_a_drive_to_the_spread_of_its_figures(page: Page) -> None:
    load(page)
    clicks = 0

    def click(what: Locator) -> None:
        nonlocal clicks
        clicks += 1
        what.click()

    click(page.get_by_role("button", name="Transient", exact=True))
    click(page.get_by_role("button", name="How much does tolerance matter?"))
    expect(page.locator(".varied")).to_have_count(3)
    expect(page.get_by_role("region", name="Quantities")).to_contain_text("Assumed: ±5 %")
    click(page.get_by_role("button", name="Run 200 runs"))
    marked(page, '[data-study="done"]', 90_000)
    assert clicks <= CLICKS

    answer = run(page, "return (await import('/js/views/studies/model.js')).answer.peek();")
    assert answer["outcomes"] == {"completed": 200}
    masses = answer["table"]["load.mass"]
    assert min(masses) >= 0.95 * 50
    assert max(masses) <= 1.05 * 50
    result = page.get_by_role("region", name="Result", exact=True)
    expect(result).to_contain_text("200 completed")
    expect(result.locator("tbody tr")).to_have_count(5)
    expect(rows(page)).to_have_count(100)
    for column in range(1, 8):  # one number of decimals in each, four digits at most where they are alike
        texts = page.locator(f".runs-table tbody tr > :nth-child({column + 1})").all_inner_texts()
        assert len({len(text.partition(".")[2]) for text in texts}) == 1, texts
    expect(page.locator("#study-histogram .js-line").first).to_be_attached()
    expect(page.locator(".bar-row")).to_have_count(3)
    expect(page.locator(".parallel .axis")).to_have_count(8)
    # Above and below each axis its largest and its smallest value, with one number of decimals.
    ends = page.locator(".parallel text:not(.name):not(.unit)").all_text_contents()
    for most, least in zip(ends[::2], ends[1::2], strict=True):
        assert len(most.partition(".")[2]) == len(least.partition(".")[2]), (most, least)
    # A range drawn on an axis keeps the runs in it, in the lines and in the table; a click takes it away.
    axis = page.locator(".parallel .grip").last
    axis.scroll_into_view_if_needed()
    box = axis.bounding_box()
    assert box
    middle = box["x"] + 0.5 * box["width"]
    page.mouse.move(middle, box["y"] + 0.5 * box["height"])
    page.mouse.down()
    page.mouse.move(middle, box["y"] + box["height"], steps=3)
    page.mouse.up()
    told = page.get_by_role("button", name=re.compile(" to .*: show all runs$"))
    expect(told).to_have_count(1)
    values = [
        float(text) for text in page.locator(".runs-table tbody td:nth-last-child(2)").all_inner_texts()
    ]
    least, most = (float(text) for text in re.findall(r"[\d.]+", told.inner_text())[-2:])
    left = page.locator(".runs-table .filter")
    expect(left).to_contain_text(re.compile(r"\D\d{1,3} of 200 runs"))
    assert values
    assert all(least * 0.99 <= value <= most * 1.01 for value in values)
    assert violations(page) == []
    told.click()
    expect(left).not_to_contain_text("of 200 runs")

    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(300)  # Plotly draws again at the new size
        wide = run(page, SIDEWAYS)
        assert wide["page"] <= 0, width
        assert wide["out"] == [], width
        assert run(page, OVERLAPS) == [], width
        assert run(page, TOO_SMALL) == [], width
    # On a phone only the long table of all runs and the axes beside each other scroll sideways.
    wide = [name for name in run(page, SCROLLS) if not name.startswith("Parallel coordinates")]
    assert wide == ["Table of runs"]


@pytest.mark.examination("test_from_a_drive_to_the_spread_of_its_figures")
def test_a_grid_sorted_pinned_and_opened(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    load(page, "#studies")
    add = page.get_by_label("Add a quantity")
    expect(add.locator('option[value="load.mass"]')).to_be_attached(timeout=20_000)
    page.locator("#study-method").select_option("grid")
    add.select_option("load.mass")
    enter(page, "From", "40 kg")
    enter(page, "To", "60")
    page.get_by_label("Points", exact=True).fill("3")
    page.get_by_label("Points", exact=True).press("Enter")
    link = link_of(page)

    enter(page, "To", "30")
    page.get_by_role("button", name="Run 3 runs").click()
    expect(page.locator(".varied .error").last).to_contain_text("not above 40", timeout=30_000)
    page.keyboard.press("Control+z")
    page.get_by_role("button", name="Run 3 runs").click()
    marked(page, '[data-study="done"]', 180_000)
    expect(rows(page)).to_have_count(3)
    assert cells(page, 1) == [40, 50, 60]

    page.get_by_role("button", name="Mass", exact=True).click()
    page.get_by_role("button", name="Mass", exact=True).click()
    assert cells(page, 1) == [60, 50, 40]
    times = cells(page, 2)
    assert times == sorted(times, reverse=True)  # a heavier load takes longer
    for number in (1, 3):
        page.get_by_role("button", name=f"Pin run {number}", exact=True).click()
    pinned = page.get_by_role("region", name="Pinned runs", exact=True)
    expect(pinned.locator("tbody tr").first).to_contain_text("+50.0 %")
    page.get_by_label("Show only runs by").select_option("load.mass")
    page.locator(".filter").get_by_role("textbox", name="At most").fill("50")
    page.locator(".filter").get_by_role("textbox", name="At most").press("Enter")
    expect(rows(page)).to_have_count(2)

    with page.expect_download() as saved:
        page.get_by_role("button", name="Export", exact=True).click()
        page.get_by_role("menuitem").filter(has_text="Runs as CSV").click()
    table = list(csv.DictReader(saved.value.path().read_text("utf-8").splitlines()))
    assert [float(row["load.mass [kg]"]) for row in table] == [40, 50, 60]

    with page.expect_response("**/api/simulations") as simulated:
        page.get_by_role("button", name="Open run 1 in Transient").click()
    assert simulated.value.request.post_data_json["drive"]["load"]["mass"] == 40
    milliseconds = 1e3 * simulated.value.json()["timing"]["extend"]["positioning_time"]
    assert milliseconds == pytest.approx(times[2], rel=1e-3)

    load(page, link)
    marked(page, '[data-study="done"]', 60_000)  # nobody asked: the server kept the runs
    assert run(page, "return (await import('/js/views/studies/model.js')).answer.peek().kept;") == 3
    assert cells(page, 1) == [40, 50, 60]
    document = run(page, "return (await import('/js/state.js')).doc.peek();")
    assert document["study"]["quantities"][0]["from"] == 40
    assert document["study"]["method"]["type"] == "grid"

    how = page.get_by_label("Mass: how it varies")
    how.select_option("logarithmic")
    how.select_option("values")
    values = page.get_by_label("Values (kg)")
    expect(values).to_have_value("40, 48.9897949, 60")
    values.fill("40; 45 60")
    values.press("Enter")
    page.locator("#study-method").select_option("monte_carlo")
    for law, given in [
        ("triangular", {"type": "triangular", "least": 40, "mode": 50, "most": 60}),
        ("lognormal", {"type": "lognormal", "median": 50, "log_deviation": 0.1}),
        ("normal", {"type": "normal", "mean": 50}),
    ]:
        how.select_option(law)
        asked = run(page, ASKED)
        law_asked = asked["quantities"][0]["distribution"]
        assert given.items() <= law_asked.items(), law
