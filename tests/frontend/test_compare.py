"""The Compare & diagnose view: from a file to the noise of its data, and everything on the way."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Page, Route, expect

from tests.frontend.comparing import (
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
    fitted,
    measured,
    opened,
    setup,
    shifts,
    state,
    unasked,
    use,
    watch_shifts,
)
from tests.frontend.diagnoses import remember
from tests.frontend.guard import PageGuard
from tests.frontend.views import REFUSED, link_of, load, open_compare, open_design, redo, run

pytestmark = pytest.mark.kept_page


@pytest.fixture(scope="module")
def sweeps() -> FilePayload:
    """The measurement with three hidden effects."""
    return file("sweeps.csv", measured(1))


def test_from_the_empty_page_to_the_noise_in_five_clicks(page: Page, sweeps: FilePayload) -> None:
    open_design(page)
    page.set_viewport_size({"width": 1440, "height": 1000})  # of a window on a desk, the ladder is in it
    watch_shifts(page)
    drop(page, sweeps)
    page.get_by_role("button", name="Use this file").click()
    clicks = 2
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    assert shifts(page) == []  # nothing moved from the drop to the verdict
    expect(page.locator(".file")).to_contain_text("sweeps.csv")
    expect(page.locator("#compare-preset")).to_have_value("DMSP-20")
    start = error(page)
    assert start > 50 * NOISE
    path, next_ = [start], page.locator("#next-action")
    while state(page) == "verdict":
        # One recommendation: the strip's, the same as the first entry's; no other button is blue.
        expect(page.locator(".compare button.primary:visible")).to_have_count(2)
        first = page.locator(".found-missing button.primary")
        assert first.get_attribute("aria-label") == next_.get_attribute("aria-label")
        path.append(changed(page, next_.click))
        clicks += 1
        expect(next_).to_be_focused()
    assert (
        unasked(page) == []
    )  # an entry goes with the click that adds it; the verdicts after that move nothing
    assert clicks <= 5
    assert len(path) == 4
    assert path == sorted(path, reverse=True)
    assert path[-1] <= 1.15 * NOISE
    expect(page.locator("#verdict-status")).to_have_text("Nothing is missing")
    expect(page.locator("#next-what")).to_have_text("Nothing is missing")
    # Every effect that was no candidate is listed with the reason.
    page.locator(".not-tried summary").click()
    expect(page.locator(".not-tried")).to_contain_text("It does not show in isobaric data, only in transient")
    expect(page.locator(".not-tried")).to_contain_text("Leak")
    expect(page.locator(".path-table tbody tr")).to_have_count(5)
    # The values are those the file was made with, within their errors.
    fields = page.locator(".model-card .parameter")
    texts = [fields.nth(i).locator("input").input_value() for i in range(fields.count())]
    values = [abs(float(text.replace("−", "-"))) for text in texts]
    for hidden in (C10 / 1e6, FRICTION, PRESTRESS):
        assert any(value == pytest.approx(hidden, rel=0.02) for value in values), values


@pytest.mark.examination("test_from_the_empty_page_to_the_noise_in_five_clicks")
def test_all_at_once_undo_refit_and_one_step_taken_out(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    start = error(page)
    noise = fitted(page, page.locator("#add-all").click)
    assert noise <= 1.15 * NOISE
    assert fitted(page, lambda: page.keyboard.press("Control+z")) == start
    expect(page.locator(".path-table tr.past")).to_have_count(0)
    assert fitted(page, lambda: redo(page)) == noise
    # R fits again after a value was changed.
    value = page.locator(".model-card .parameter input").first
    value.fill("0.1")
    assert fitted(page, lambda: value.press("Enter")) > 5 * noise
    page.locator("h1").click()
    assert fitted(page, lambda: page.keyboard.press("r")) == pytest.approx(noise, rel=0.05)
    fitted(page, lambda: page.keyboard.press("Control+z"))
    assert fitted(page, lambda: page.keyboard.press("Control+z")) == noise
    # One step is taken out; the steps after it stay and are fitted again.
    removed = changed(page, page.get_by_role("button", name="Take out Bladder elasticity").click)
    assert removed > 2 * noise
    expect(page.locator(".in-model")).to_have_count(2)
    expect(page.locator(".path-table tr:is(.past, .now)")).to_have_count(3)
    again = fitted(page, page.locator("#next-action").click)
    assert again < removed
    back = page.locator(".path-table tr.past").first.get_by_role("button")
    assert fitted(page, back.click) == start
    expect(page.locator(".path-table tr.past")).to_have_count(0)


def test_an_entry_is_looked_at_before_it_is_added_and_b_flips_back(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    model, number = page.locator("#overlay-force .js-line").last, page.locator("#error-now")
    start, value = model.get_attribute("d") or "", number.inner_text()
    page.locator(".found-missing button.primary").hover()
    expect(page.locator(".on-tag")).to_contain_text("Preview: + Bladder elasticity")
    expect(model).not_to_have_attribute("d", start)
    assert number.inner_text() == value  # the number is that of the model, not of the preview
    page.locator("h1").hover()
    expect(page.locator(".on-tag")).to_have_count(0)
    expect(model).to_have_attribute("d", start)
    changed(page, page.locator("#add-all").click)
    page.locator("h1").hover()
    expect(page.locator(".on-tag")).to_have_count(0)
    after = model.get_attribute("d") or ""
    page.keyboard.press("b")
    expect(page.locator(".before-tag")).to_contain_text("Before")
    expect(model).not_to_have_attribute("d", after)
    page.keyboard.press("b")
    expect(page.locator(".before-tag")).to_have_count(0)
    expect(model).to_have_attribute("d", after)


def depths(page: Page) -> list[int]:
    """The colours of the cells of the map, in percent of the full one."""
    styles = [half.get_attribute("style") or "" for half in page.locator(".heat .half[style]").all()]
    return [int(share) for style in styles for share in re.findall(r"(\d+)%", style)]


def test_the_map_is_dark_when_bad_and_plain_when_solved_and_the_parts_add_up(
    page: Page, sweeps: FilePayload
) -> None:
    opened(page, sweeps)
    key, rows = page.locator(".heat-key"), page.locator(".heat tbody th[scope='row']")
    expect(rows).to_have_count(len(REACH))  # the measured levels
    expect(rows.first).to_contain_text("6 bar")
    scale, bad = key.inner_text(), depths(page)
    assert max(bad) > 80
    expect(page.locator(".heat .half[data-way='□']").first).to_be_visible()  # the directions disagree
    parts = page.get_by_role("list", name="What the squared error is made of")
    shares = [int(one) for one in re.findall(r"(\d+)\s%", parts.inner_text())]
    assert sum(shares) == 100
    changed(page, page.locator("#add-all").click)
    expect(page.locator(".heat .half[data-way]")).to_have_count(0)
    solved = depths(page)
    assert max(solved) < 20
    assert sum(share == 0 for share in solved) > 0.8 * len(solved)
    assert key.inner_text() == scale  # one scale, fixed by the first error
    expect(parts).to_contain_text(re.compile(r"(9\d|100) % noise"))


@pytest.mark.examination("test_the_map_is_dark_when_bad_and_plain_when_solved_and_the_parts_add_up")
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
    # A cell asks what would cause it: the list answers with what shows there.
    page.locator(".heat [data-at='3,0']").click()
    expect(page.locator("#brush-rms")).to_contain_text("pressure 6 bar")
    expect(page.locator(".asked-range")).to_contain_text("What would cause this?")
    expect(page.locator(".found-missing > li")).to_have_count(2)  # the friction is small there
    expect(page.locator(".found-missing .inside").first).to_contain_text("Would explain −")
    page.keyboard.press("Shift+ArrowRight")
    expect(page.locator(".heat [aria-pressed='true']")).to_have_count(2)
    page.get_by_role("button", name="Clear the chosen range").click()
    expect(page.locator(".found-missing > li")).to_have_count(3)
    box = page.locator("#residual .brush-area").bounding_box()
    assert box
    page.mouse.move(box["x"] + 0.1 * box["width"], box["y"] + 20)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 30, steps=4)
    page.mouse.up()
    expect(page.locator("#brush-rms")).to_contain_text("ε")
    for name in ("pressure", "time"):
        page.get_by_role("button", name=f"Residual over {name}").click()
        expect(page.locator("#residual .xtitle")).to_contain_text(name.capitalize())
    page.get_by_role("button", name="How often each size").click()
    expect(page.locator("#residual .js-line")).to_have_count(2)


def test_a_file_that_is_no_measurement_says_so(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    open_compare(page)
    choose(page, file("notes.csv", "only words\nand more words\n"))
    told = page.locator(".case-notices [role=alert]").or_(page.locator("dialog [role=alert]"))
    expect(told.first).to_contain_text("notes.csv")
    assert run(page, "return document.querySelectorAll('.file').length;") == 0


@pytest.mark.examination("test_from_the_empty_page_to_the_noise_in_five_clicks")
def test_a_built_in_map_opens_with_one_click(page: Page) -> None:
    open_compare(page)
    remember(page)
    expect(page.locator("#next-what")).to_have_text("Bring a measurement")
    page.locator(".tile", has_text="DMSP-20-300").click()
    expect(page.locator("#compare-preset")).to_have_value("DMSP-20")
    diagnosed(page)
    assert error(page) > 100
    page.get_by_role("button", name="Area of each loop of the residual").click()
    expect(page.locator(".brush-line")).to_contain_text("No loops in these data")
    expect(page.locator("#residual")).to_be_hidden()
    page.get_by_role("button", name="Residual over pressure").click()
    expect(page.locator("#residual")).to_be_visible()
    expect(setup(page)).to_contain_text("60 of 126 rows; left out: 66 slack")
    page.get_by_role("button", name="Remove ").click()
    expect(page.locator("#next-what")).to_have_text("Bring a measurement")


@pytest.mark.examination("tests/frontend/test_cases.py::test_cases_of_damaged_and_of_old_documents")
def test_the_link_restores_data_model_and_history(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    changed(page, page.locator("#add-all").click)
    left = error(page)
    link = link_of(page)
    load(page, link)
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    assert error(page) == left
    expect(page.locator(".path-table tr:is(.past, .now)")).to_have_count(4)
    expect(page.locator(".in-model")).to_have_count(3)
    rows = 2 * POINTS * len(REACH)
    expect(page.locator(".file")).to_contain_text(f"{rows} of {rows} rows")


def test_data_and_residuals_as_csv(page: Page, sweeps: FilePayload, tmp_path: Path) -> None:
    opened(page, sweeps)
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem").filter(has_text="Data and residuals").click()
    target = tmp_path / "residuals.csv"
    saved.value.save_as(target)
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()))
    counted = re.search(r"(\d+) of \d+ rows used", page.locator(".strip").inner_text())
    assert counted
    # Left out may be rows where the motion turns, without direction, and the first after a new pressure.
    turning, unseen = 2 * len(REACH), 0.2 * POINTS * len(REACH)
    assert 2 * POINTS * len(REACH) - turning - unseen <= len(rows) == int(counted[1])
    squares = [float(row["residual [N]"]) ** 2 for row in rows]
    assert math.sqrt(sum(squares) / len(squares)) == pytest.approx(error(page), rel=0.01)
    row = rows[POINTS // 2]
    difference = float(row["measured [N]"]) - float(row["predicted [N]"])
    assert difference == pytest.approx(float(row["residual [N]"]), abs=1e-3)
    # The model as code, from the card of the case.
    page.locator("#take-along").get_by_role("button", name="Code and tables").click()
    with page.expect_download() as saved:
        page.get_by_role("dialog", name="Take it along").get_by_role("button", name="MATLAB").click()
    code = Path(saved.value.path()).read_text("utf-8")
    assert code.startswith("function m = ")
    assert re.search(r"force|length|pressure from .* \(measured\)", code)


LEFT = 'const { whatIsLeft } = await import("/js/views/compare/words.js"); return whatIsLeft(argument);'


def test_what_repeats_is_told_in_place_of_no_variable_and_beside_others(page: Page) -> None:
    open_compare(page)
    repeats = {"text": "it repeats every 3.20 mm of length", "share": 0.38}

    def left(names: list[str], what: dict[str, object] | None) -> str:
        verdict = {"unexplained_share": 0.62, "unexplained_in": names, "repeats": what}
        return str(run(page, LEFT, verdict)).replace("\u00a0", " ")

    size = "62.0 % of the squared error is left to explain"
    assert left([], None) == f"{size} and depends on no measured variable"
    assert left([], repeats) == f"{size}: {repeats['text']}"
    assert left(["pressure"], None) == f"{size} and depends on pressure"
    assert left(["pressure"], repeats) == f"{size} and depends on pressure; {repeats['text']}"
    assert left(["pressure"], repeats | {"share": 0.62}) == f"{size}: {repeats['text']}"


@pytest.mark.examination("tests/frontend/test_sizing.py::test_from_the_empty_page_to_the_printed_report")
def test_a_diagnosis_can_be_cancelled_and_asked_for_again(page: Page, sweeps: FilePayload) -> None:
    open_compare(page)
    page.route("**/api/diagnoses", lambda route: None)  # never answered
    choose(page, sweeps)
    use(page)
    page.get_by_role("button", name="Stop").click(timeout=20_000)
    expect(page.locator("#next-what")).to_contain_text("Stopped")
    page.unroute("**/api/diagnoses")
    remember(page)
    page.get_by_role("button", name="Diagnose", exact=True).click()
    diagnosed(page)


@pytest.mark.examination("tests/frontend/test_design.py::test_messages_stand_at_the_field")
def test_an_impossible_muscle_says_so_at_its_field(
    page: Page, page_guard: PageGuard, sweeps: FilePayload
) -> None:
    page_guard.allow(REFUSED)
    opened(page, sweeps)
    setup(page, "muscle").get_by_text("Geometry", exact=True).click()
    angle = page.locator("[data-field='compare.braid_angle']")
    angle.locator("input").fill("88")
    angle.locator("input").press("Enter")
    expect(angle.locator(".error")).not_to_be_empty()
    expect(page.locator("#next-what")).to_have_text("Correct an entry")
    page.get_by_role("button", name="Undo: braid angle").click()
    expect(page.locator(".compare .notice.bad")).to_have_count(0)
    diagnosed(page)


def test_a_run_of_the_model_that_stopped_is_said_above_all_figures(page: Page) -> None:
    said = "the run of the model stopped at 41 of 120 s: the solver needed more than 400 000 steps"

    def stopped(route: Route) -> None:
        body = route.fetch().json()
        run = {"of": "", "run": 0, "reached": 41.0, "duration": 120.0, "share": 0.66, "reason": "steps"}
        route.fulfill(json={**body, "stopped": [run], "sentences": [said, *body["sentences"]]})

    open_compare(page)
    page.route("**/api/diagnoses", lambda route: None)  # never answered
    page.route("**/api/comparisons", stopped)
    choose(page, file("stopped.csv", measured(5)))  # a kept page remembers the answers of another file
    use(page)
    expect(page.locator(".case-notices")).to_contain_text(f"T{said[1:]}.", timeout=20_000)
