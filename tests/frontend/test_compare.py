"""The Compare & diagnose view: from a file to the noise of its data, and everything on the way."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Page, expect

from tests.frontend.comparing import (
    ADD,
    C10,
    FRICTION,
    NOISE,
    POINTS,
    PRESTRESS,
    REACH,
    changed,
    choose,
    diagnosed,
    drop,
    error,
    file,
    measured,
    opened,
    use,
)
from tests.frontend.diagnoses import remember
from tests.frontend.guard import PageGuard
from tests.frontend.views import REFUSED, link_of, open_compare, redo, run


@pytest.fixture(scope="module")
def sweeps() -> FilePayload:
    """The measurement with three hidden effects."""
    return file("sweeps.csv", measured(1))


def test_from_the_empty_page_to_the_noise_in_five_clicks(page: Page, sweeps: FilePayload) -> None:
    page.goto("/")
    clicks = 0

    def click(name: str | re.Pattern[str]) -> None:
        nonlocal clicks
        page.get_by_role("button", name=name).first.click()
        clicks += 1

    drop(page, sweeps)  # counts as a click
    clicks += 1
    click("Use this file")
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    start = error(page)
    assert start > 50 * NOISE
    expect(page.locator(".where-words")).to_contain_text("contraction")
    path = [start]
    while error(page) > 1.15 * NOISE:
        path.append(changed(page, lambda: click(ADD)))
    assert clicks <= 5
    assert len(path) == 4
    assert path == sorted(path, reverse=True)
    expect(page.locator("#verdict-status")).to_have_text("The model is adequate")
    # Every effect that was no candidate is listed with the reason.
    page.locator(".not-tried summary").click()
    expect(page.locator(".not-tried")).to_contain_text("It does not show in isobaric data, only in transient")
    expect(page.locator(".not-tried")).to_contain_text("Leak")
    expect(page.locator("#error-change")).to_contain_text("−")
    expect(page.locator(".path-table tbody tr")).to_have_count(4)
    # The values are those the file was made with, within their errors.
    fields = page.locator(".model-card .parameter")
    texts = [fields.nth(i).locator("input").input_value() for i in range(fields.count())]
    values = [abs(float(text.replace("−", "-"))) for text in texts]
    for hidden in (C10 / 1e6, FRICTION, PRESTRESS):
        assert any(value == pytest.approx(hidden, rel=0.02) for value in values), values


def test_all_at_once_undo_remove_and_refit(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    start = error(page)
    noise = changed(page, page.locator("#add-all").click)
    assert noise <= 1.15 * NOISE
    assert changed(page, lambda: page.keyboard.press("Control+z")) == start
    expect(page.locator(".path-table tr.past")).to_have_count(0)
    assert changed(page, lambda: redo(page)) == noise
    removed = changed(page, page.locator(".in-model").get_by_role("button").first.click)
    assert removed > 2 * noise
    expect(page.locator(".in-model")).to_have_count(2)
    again = changed(page, page.locator(".candidate").get_by_role("button", name=ADD).first.click)
    assert again < removed
    back = page.locator(".path-table tr.past").first.get_by_role("button")
    assert changed(page, back.click) == start
    expect(page.locator(".path-table tr.past")).to_have_count(0)


def test_before_and_after_flip_with_b(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    expect(page.locator("#show-before")).to_be_disabled()
    changed(page, page.locator("#add-all").click)
    model = page.locator("#overlay-force .js-line").last
    after = model.get_attribute("d")
    page.keyboard.press("b")
    expect(page.locator("#show-before")).to_have_attribute("aria-pressed", "true")
    expect(page.locator(".before-tag")).to_contain_text("Before")
    expect(model).not_to_have_attribute("d", after or "")
    page.keyboard.press("b")
    expect(page.locator(".before-tag")).to_be_hidden()
    expect(model).to_have_attribute("d", after or "")


def deepest(page: Page) -> int:
    """The strongest colour of the map, in percent of the full one."""
    styles = [cell.get_attribute("style") or "" for cell in page.locator(".heat button").all()]
    return max(int(share) for style in styles for share in re.findall(r"(\d+)%", style))


def test_the_map_shows_what_is_left_and_compares_with_the_start(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    key, note = page.locator(".heat-key"), page.locator(".heat-note")
    spans = page.get_by_role("group", name="Colours of the map span")
    own, first = (spans.get_by_role("button", name=f"{name} scale") for name in ("Own", "First"))
    expect(spans).to_be_hidden()
    start = key.inner_text()
    assert deepest(page) > 50
    changed(page, page.locator("#add-all").click)
    # In the scale of the start hardly a cell would have a colour.
    expect(own).to_have_attribute("aria-pressed", "true")
    assert deepest(page) == 100
    expect(key).not_to_have_text(start)
    largest = re.search(
        r"Largest cell [+−]([\d.]+)\sN at pressure .*; at the start up to ([\d.]+)\sN", note.inner_text()
    )
    assert largest
    assert f"+{largest[1]}" in key.inner_text()
    assert f"+{largest[2]}" in start
    first.click()
    expect(first).to_have_attribute("aria-pressed", "true")
    expect(key).to_have_text(start, use_inner_text=True)
    expect(note).to_contain_text("as at the start")
    assert deepest(page) < 20
    # The start itself in the same colours; the choice stays.
    back = page.locator(".path-table tr.past").first.get_by_role("button")
    changed(page, back.click)
    expect(key).to_have_text(start, use_inner_text=True)
    assert deepest(page) > 50
    changed(page, lambda: page.keyboard.press("Control+z"))
    expect(first).to_have_attribute("aria-pressed", "true")
    own.click()
    expect(own).to_have_attribute("aria-pressed", "true")
    assert deepest(page) == 100


def test_r_fits_again_after_a_value_was_changed(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    noise = changed(page, page.locator("#add-all").click)
    value = page.locator(".model-card .parameter input").first
    value.fill("0.1")
    assert changed(page, lambda: value.press("Enter")) > 5 * noise
    page.locator("h1").click()
    assert changed(page, lambda: page.keyboard.press("r")) == pytest.approx(noise, rel=0.05)


def test_a_range_of_the_residual_and_a_cell_of_the_map(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    whole = error(page)
    edge = page.get_by_role("slider", name="Chosen range, from")
    edge.focus()
    for _ in range(4):
        page.keyboard.press("Shift+ArrowRight")
    told = page.locator("#brush-rms b")
    expect(told).to_contain_text("N")
    assert float(re.findall(r"[\d.]+", told.inner_text())[0]) > whole
    page.keyboard.press("Escape")
    expect(told).to_be_hidden()
    page.locator(".heat button").last.click()
    expect(page.locator("#brush-rms")).to_contain_text("pressure")
    page.get_by_role("button", name="Clear the chosen range").click()
    box = page.locator("#residual .brush-area").bounding_box()
    assert box
    page.mouse.move(box["x"] + 0.1 * box["width"], box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 30, steps=4)
    page.mouse.up()
    expect(page.locator("#brush-rms")).to_contain_text("contraction")
    for name in ("pressure", "time"):
        page.get_by_role("button", name=f"Residual over {name}").click()
        expect(page.locator("#residual .xtitle")).to_contain_text(name.capitalize())
    page.get_by_role("button", name="How often each size").click()
    expect(page.locator("#residual .js-line")).to_have_count(2)


def test_a_second_file_checks_the_first(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps, file("check.csv", measured(2)))
    uses = page.get_by_role("radiogroup", name="Use of check.csv")
    uses.get_by_role("radio", name="Check").click()
    expect(page.locator("#validation-error")).to_contain_text("N", timeout=20_000)
    diagnosed(page)
    changed(page, page.locator("#add-all").click)
    found = re.match(r"([\d.]+)", page.locator("#validation-error").inner_text())
    assert found
    assert float(found[1]) <= 1.15 * NOISE
    uses.get_by_role("radio", name="Off").click()
    expect(page.locator("#validation-error")).to_be_hidden(timeout=20_000)


def test_a_file_that_is_no_measurement_says_so(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    open_compare(page)
    choose(page, file("notes.csv", "only words\nand more words\n"))
    told = page.locator(".measurements [role=alert]").or_(page.locator("dialog [role=alert]"))
    expect(told.first).to_contain_text("notes.csv")
    assert run(page, "return document.querySelectorAll('.file').length;") == 0


def test_dropped_anywhere(page: Page, sweeps: FilePayload) -> None:
    page.goto("/")
    expect(page.locator("#preset option", has_text="DMSP-20")).to_be_attached()
    drop(page, {**sweeps, "name": "dropped.csv"})
    use(page)
    expect(page.locator(".file")).to_contain_text("dropped.csv")
    expect(page.locator("#compare-preset")).to_have_value("DMSP-20")
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)


def test_a_built_in_map_opens_with_one_click_and_guides(page: Page) -> None:
    remember(page)
    open_compare(page)
    page.get_by_role("button", name="Guided example").click()
    expect(page.locator(".guide")).to_be_visible()
    diagnosed(page)
    expect(page.locator(".guide")).to_contain_text("Press Add")
    page.get_by_role("button", name="Skip the guide").click()
    expect(page.locator(".guide")).to_be_hidden()
    page.get_by_role("button", name="Remove Martens").click()
    page.locator(".tile", has_text="DMSP-20-300").click()
    expect(page.locator("#compare-preset")).to_have_value("DMSP-20")
    diagnosed(page)
    assert error(page) > 100
    expect(page.locator(".measurements")).to_contain_text("60 of 126 rows; left out: 66 slack")


def test_the_link_restores_data_model_and_history(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    changed(page, page.locator("#add-all").click)
    left = error(page)
    link = link_of(page)
    page.goto("about:blank")
    page.goto(f"/{link}")
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    assert error(page) == left
    expect(page.locator(".path-table tbody tr")).to_have_count(4)
    expect(page.locator(".in-model")).to_have_count(3)
    expect(page.locator(".file")).to_contain_text("480 of 480 rows")


def test_data_and_residuals_as_csv(page: Page, sweeps: FilePayload, tmp_path: Path) -> None:
    opened(page, sweeps)
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem").filter(has_text="Data and residuals").click()
    target = tmp_path / "residuals.csv"
    saved.value.save_as(target)
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    counted = re.search(r"over (\d+) points", page.locator(".error-card").inner_text())
    assert counted
    # Left out may be rows where the motion turns, without direction, and the first after a new pressure.
    turning, unseen = 2 * len(REACH), 0.2 * POINTS * len(REACH)
    assert 2 * POINTS * len(REACH) - turning - unseen <= len(rows) == int(counted[1])
    squares = [float(row["residual [N]"]) ** 2 for row in rows]
    assert math.sqrt(sum(squares) / len(squares)) == pytest.approx(error(page), rel=0.01)
    row = rows[POINTS // 2]
    difference = float(row["measured [N]"]) - float(row["predicted [N]"])
    assert difference == pytest.approx(float(row["residual [N]"]), abs=1e-3)


def test_a_diagnosis_can_be_cancelled_and_asked_for_again(page: Page, sweeps: FilePayload) -> None:
    open_compare(page)
    page.route("**/api/diagnoses", lambda route: None)  # never answered
    choose(page, sweeps)
    use(page)
    page.get_by_role("button", name="Cancel").click(timeout=20_000)
    expect(page.locator(".verdict-card")).to_contain_text("cancelled")
    page.unroute("**/api/diagnoses")
    page.get_by_role("button", name="Diagnose", exact=True).click()
    diagnosed(page)


def test_an_impossible_muscle_says_so_at_its_field(
    page: Page, page_guard: PageGuard, sweeps: FilePayload
) -> None:
    page_guard.allow(REFUSED)
    opened(page, sweeps)
    page.get_by_text("Geometry", exact=True).click()
    angle = page.locator("[data-field='compare.braid_angle']")
    angle.locator("input").fill("88")
    angle.locator("input").press("Enter")
    expect(angle.locator(".error")).not_to_be_empty()
    expect(page.locator(".error-card")).to_have_class(re.compile("stale"))
    page.get_by_role("button", name="Undo: braid angle").click()
    expect(page.locator(".compare .notice.bad")).to_be_hidden()
    diagnosed(page)
