"""Longer ways through Compare & diagnose: drive, mystery, report, a term of one's own, what is left."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import FilePayload, Locator, Page, expect

from tests.frontend.axe import violations
from tests.frontend.comparing import (
    ADD,
    FRICTION,
    NOISE,
    REACH,
    changed,
    choose,
    diagnosed,
    error,
    file,
    fitted,
    measured,
    opened,
    setup,
    shifts,
    use,
    watch_shifts,
)
from tests.frontend.guard import PageGuard
from tests.frontend.views import REFUSED, open_compare, open_compared, redo, run
from tests.truth.generate import case

pytestmark = pytest.mark.kept_page

A_DRIVE = 150_000  # ms; each effect tried is a run of the simulation
LINEAR = "offset + stiffness*kappa + loss*sign(v)"  # beside the true wall force, which is not linear


@pytest.fixture(scope="module")
def sweeps() -> FilePayload:
    """The measurement with three hidden effects."""
    return file("sweeps.csv", measured(1))


def over_noise(page: Page) -> float:
    """The error of several channels on screen, in units of their noise."""
    found = re.match(r"([\d.]+)\s*× noise", page.locator("#error-now").inner_text())
    assert found
    return float(found[1])


def own_term(page: Page) -> Locator:
    """The field of a term by hand."""
    return page.get_by_role("textbox", name="Formula of your own term")


@pytest.mark.examination("test_a_mystery_with_a_drive_brings_it_along")
def test_a_run_of_a_drive_shows_what_its_valve_does(page: Page) -> None:
    made = case("flow-steps")
    (text,) = made.files.values()
    open_compare(page)
    page.route("**/api/diagnoses", lambda route: None)  # with the rig of the Transient view, which is another
    choose(page, file("steps.csv", text))
    page.get_by_role("button", name="A drive document has all of this").click()
    use(page)
    card = page.locator(".file")
    expect(card).to_contain_text("transient")
    setup(page).get_by_role("button", name="Drive document…").click()
    rig = {name: part for name, part in made.drive.items() if name != "command"}  # it was recorded
    page.get_by_label("Drive document as JSON").fill(json.dumps(rig))
    page.unroute("**/api/diagnoses")
    with page.expect_request("**/api/comparisons") as asked:
        page.get_by_role("button", name="Use this drive").click()
    assert "command" not in asked.value.post_data_json["drive"]
    expect(page.locator(".in-model")).to_have_count(len(made.effects), timeout=20_000)
    diagnosed(page, A_DRIVE)
    for channel in made.noise:
        expect(page.locator(f"#overlay-{channel} .js-line").last).to_be_attached()
    start = over_noise(page)
    assert start > 5.0
    best = page.locator(".found-missing > li").first
    (hidden,) = made.hidden
    assert best.get_attribute("data-candidate") in hidden
    sketch = best.locator("svg.sketch[role=img]")
    expect(sketch).to_have_attribute("aria-label", re.compile(r"^Over time: the (pressure|stroke) that "))
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Input: correlation of the residual with the input").click()
    expect(page.locator(".brush-line")).to_contain_text(re.compile(r"\d+ of 51 lags outside the 95 % band"))
    expect(page.locator("#residual .trace .point").first).to_be_attached()
    # A part of the time asks what would cause it: each channel is answered in its unit.
    page.locator(".heat [data-at='1,0']").click()
    told = page.locator(".found-missing .inside").first
    amount = r"[−+][\d.]+\s%s of the [−+][\d.]+\s%s"
    expect(told).to_contain_text(re.compile("pressure " + amount % ("m?bar", "m?bar")))
    expect(told).to_contain_text(re.compile("stroke " + amount % ("mm", "mm")))
    page.get_by_role("button", name="Show all", exact=True).click()
    # Errors of the stroke are lengths, and shares of the stroke.
    errors = page.get_by_role("list", name="Error of each channel")
    expect(errors).to_contain_text(re.compile(r"stroke [\d.]+.mm, [\d.]+ % of stroke"))
    before = page.locator("#error-now").inner_text()
    page.keyboard.press("Escape")  # the panel of files and experiment
    best.get_by_role("button", name=ADD).click()
    expect(page.locator("#error-now")).not_to_have_text(before, use_inner_text=True, timeout=20_000)
    diagnosed(page, A_DRIVE)
    assert over_noise(page) < min(2.0, 0.3 * start)
    expect(page.locator(".strip")).to_have_attribute("data-state", "adequate")


def test_a_mystery_with_a_drive_brings_it_along(page: Page) -> None:
    open_compare(page)
    page.route("**/api/diagnoses", lambda route: None)  # only what the mystery brings is looked at
    page.set_viewport_size({"width": 1440, "height": 1000})
    watch_shifts(page)
    page.locator(".tile", has_text="Slow to let go").click()
    expect(page.locator("#error-now")).to_contain_text("× noise", timeout=20_000)
    expect(page.locator("#overlay-pressure .js-line").last).to_be_attached()
    assert shifts(page) == []  # the places of two plots are kept free
    expect(page.locator("#overlay-pressure .js-line").last).to_be_attached()
    expect(page.locator("#overlay-displacement .js-line").last).to_be_attached()
    setup(page)
    expect(page.get_by_role("region", name="Rig").get_by_label("Mass")).to_have_value("31.4")
    expect(page.locator(".path-table")).to_contain_text("Start model")
    expect(page.locator(".measurements")).to_contain_text("1000 of 1301 rows; left out: 301 in between")


@pytest.mark.examination("tests/server/test_reports.py::test_figures_are_those_of_the_comparison")
def test_the_report_is_one_file_that_says_it_all(page: Page, sweeps: FilePayload, tmp_path: Path) -> None:
    opened(page, sweeps)
    changed(page, page.locator("#add-all").click)
    with page.expect_download() as saved:
        page.get_by_role("button", name=re.compile("^Report ")).click()
    target = tmp_path / "report.html"
    saved.value.save_as(target)
    assert saved.value.suggested_filename.endswith(".html")
    text = target.read_text(encoding="utf-8")
    identity = page.locator(".file").get_attribute("data-file")
    assert identity
    assert identity in text
    for name in page.locator(".in-model .effect-head b").all_inner_texts():
        assert name in text
    assert "sweeps.csv" in text
    # The map of the page, by the page's own code, and that of the report: the same levels and values.
    drawn = re.search(
        r"<title>Mean residual over contraction at each pressure level</title>(.*?)</svg>", text
    )
    assert drawn
    words = [one.replace("−", "-") for one in re.findall(r"<text[^>]*>([^<]*)</text>", drawn[1])]
    halves = page.locator(".heat .half").all_inner_texts()
    cells = [one.replace("−", "-") for one in halves if one]
    assert len(cells) > 20
    assert words[: len(cells)].count("·") == cells.count("·")
    values = [sorted(float(one) for one in texts if one != "·") for texts in (words[: len(cells)], cells)]
    assert values[0] == pytest.approx(values[1], abs=0.051)  # one decimal each
    rows = [text.split()[0] for text in page.locator(".heat tbody th[scope='row']").all_inner_texts()]
    assert rows == words[-2 - len(rows) : -2][::-1]
    # Nothing is fetched: no script, no picture or style from elsewhere.
    assert re.findall(r"<script|(?:src|href)=[\"'](?!#|data:)", text) == []


def test_a_term_by_hand_is_checked_fitted_changed_and_removed(
    page: Page, page_guard: PageGuard, sweeps: FilePayload
) -> None:
    page_guard.allow(REFUSED)
    opened(page, sweeps)
    start = error(page)
    page.get_by_role("button", name="Add a term of your own…").click()
    form = page.locator(".model-card .term-form")
    form.get_by_role("button", name="Add and fit").click()
    expect(form.get_by_role("alert")).to_contain_text("Enter a formula")
    own_term(page).fill("loss*'P'")
    form.get_by_role("button", name="Add and fit").click()
    expect(form.get_by_role("alert")).to_contain_text("single quote")
    expect(own_term(page)).to_have_attribute("aria-invalid", "true")
    expect(own_term(page)).to_be_focused()
    expect(page.locator(".path-table tr.past")).to_have_count(0)
    own_term(page).fill("offset + stiffness*")
    form.get_by_role("button", name="Insert kappa").click()
    expect(own_term(page)).to_have_value("offset + stiffness*kappa")
    linear = fitted(page, form.get_by_role("button", name="Add and fit").click)
    assert linear < 0.5 * start
    expect(form).to_be_hidden()
    row = page.locator(".in-model", has_text="Own term")
    expect(row.locator(".parameter")).to_have_count(2)
    row.get_by_role("button", name="Edit…").click()
    own_term(page).fill(LINEAR)
    lossy = fitted(page, form.get_by_role("button", name="Change and fit").click)
    assert lossy < linear
    loss = float(row.get_by_label("loss").input_value())
    assert loss == pytest.approx(FRICTION, rel=0.3)
    assert fitted(page, lambda: page.keyboard.press("Control+z")) == linear
    assert fitted(page, lambda: redo(page)) == lossy
    assert fitted(page, row.get_by_role("button", name="Remove Own term").click) == start
    expect(page.get_by_role("button", name="Add a term of your own…")).to_be_visible()


PLANNED = """
const { plan } = await import("/js/views/compare/list/unknown.js");
const { diagnosis } = await import("/js/views/compare/answers.js");
return plan({ ...diagnosis.peek(), not_tried: argument }).map(({ what }) => what);
"""


@pytest.mark.examination(
    "tests/identification/diagnose/test_diagnosis.py::test_a_ripple_is_an_unknown_effect_told_with_its_period_but_without_a_formula"
)
def test_what_no_effect_explains_is_told_with_its_place_and_a_term_by_hand_explains_it(page: Page) -> None:
    open_compare(page)
    page.locator(".tile", has_text="The bump at one stroke").click()
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    expect(page.locator("#verdict-status")).to_have_text(
        "Something is missing that no catalogued effect explains"
    )
    expect(page.locator(".strip")).to_have_attribute("data-state", "unknown")
    expect(page.locator("#next-what")).to_contain_text("ε")
    expect(page.locator("#next-action")).to_have_text("Copy plan")
    # Where rows without times keep effects from being tried, times are asked for.
    untimed = {"effect": "coulomb_friction", "why": "the rows have no time", "needs_time": True}
    assert run(page, PLANNED, [untimed]) == [
        "Repeat contraction 8.8 to 10.8 % in finer steps",
        "Record the time of each row",
        "Repeat the whole run with the clamps turned or the sensor exchanged",
    ]
    assert violations(page) == []
    start = error(page)
    left = page.get_by_role("region", name="What is left")
    expect(left).to_contain_text("ook where it is largest: contraction")
    expect(left).to_contain_text("not added")
    expect(page.get_by_role("button", name="Add as own term")).to_have_count(0)
    page.get_by_role("button", name="Add a term of your own…").click()
    own_term(page).fill("pull*exp(-((kappa - 0.09)/0.02)**2)")
    add = page.locator(".model-card .term-form").get_by_role("button", name="Add and fit")
    assert fitted(page, add.click) < 0.6 * start
    expect(page.locator(".in-model", has_text="Own term")).to_be_visible()
    page.get_by_role("button", name="Reveal what is hidden").click()
    expect(page.locator(".revealed.good")).to_have_count(1)
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem", name="Use this model in Design").click()
    expect(page.locator(".status")).to_contain_text("Left out")
    expect(page.locator(".status")).to_contain_text("Own term")


@pytest.mark.examination(
    "tests/frontend/test_compare.py::test_the_map_is_dark_when_bad_and_plain_when_solved_and_the_parts_add_up"
)
def test_what_is_left_as_autocorrelation_and_loops(page: Page, sweeps: FilePayload) -> None:
    opened(page, sweeps)
    page.get_by_role("button", name="Autocorrelation of the residual").click()
    expect(page.locator("#white")).to_contain_text("not only noise")
    expect(page.locator("#residual .trace .point").first).to_be_attached()
    expect(page.locator(".brush-handle").first).to_be_hidden()
    page.get_by_role("button", name="Input: correlation of the residual with the input").click()
    expect(page.locator(".brush-line")).to_contain_text("sweeps of at least 100 rows")  # these have 60
    expect(page.locator("#residual")).to_be_hidden()
    page.get_by_role("button", name="Area of each loop of the residual").click()
    # Friction alone takes 2 F per way out of a cycle, whatever else the model lacks.
    told = page.locator(".brush-line")
    expect(told).to_contain_text(f"{len(REACH)} loops")
    found = re.search(r"equivalent friction ([\d.]+)\s*N", told.inner_text())
    assert found
    assert float(found[1]) == pytest.approx(FRICTION, rel=0.15)
    page.get_by_role("button", name=re.compile("Residual.*save or show as table")).click()
    page.get_by_role("menuitem", name="Show as table").click()
    expect(page.get_by_role("dialog").locator("tbody tr")).to_have_count(len(REACH))
    page.keyboard.press("Escape")
    changed(page, page.locator("#add-all").click)
    expect(told).to_contain_text("within the noise")
    page.get_by_role("button", name="Autocorrelation of the residual").click()
    expect(page.locator("#white")).to_contain_text("Neighbouring rows are not correlated")


@pytest.mark.examination(
    "tests/server/test_diagnoses.py::test_prestress_and_zero_error_of_the_sensor_are_one_group"
)
def test_effects_that_data_cannot_tell_apart_stay_a_choice_after_success(
    page: Page, sweeps: FilePayload
) -> None:
    opened(page, sweeps)
    found = page.locator(".found-missing > li")
    expect(found).to_have_count(3)
    expect(page.locator("#verdict-fall")).to_contain_text("the noise is")
    # Each order of the model can be taken from the ladder, with the error that it promises.
    promised = page.locator(".path-table tr.ahead").nth(1).locator("td").nth(1).inner_text()
    two = page.get_by_role("button", name="Add 2 effects, up to Prestress of the bladder")
    assert fitted(page, two.click) == float(promised)
    expect(page.locator(".in-model")).to_have_count(2)
    page.keyboard.press("Control+z")
    diagnosed(page)
    entry = found.filter(has_text="Prestress")
    expect(entry.get_by_role("radio")).to_have_count(2)
    expect(entry).to_contain_text("Would tell")
    entry.get_by_role("radio", name="Force sensor: zero error").check()
    # The choice changes the name of the entry and that of its step at once.
    expect(found.nth(1).get_by_role("heading")).to_have_text("Force sensor: zero error")
    expect(page.locator(".path-table tr.ahead").nth(1)).to_contain_text("Force sensor: zero error")
    noise = changed(page, page.locator("#add-all").click)
    assert noise <= 1.15 * NOISE
    open_ = page.get_by_role("region", name="Chosen, not proven")
    expect(open_.get_by_role("radio", name="Force sensor: zero error")).to_be_checked()
    with page.expect_response("**/api/diagnoses"):
        open_.get_by_role("radio", name="Prestress of the bladder").check()
    diagnosed(page)
    expect(page.locator(".path-table")).not_to_contain_text("Force sensor")
    assert error(page) == pytest.approx(noise, rel=0.05)
    expect(open_.get_by_role("radio", name="Prestress of the bladder")).to_be_checked()


@pytest.mark.examination("tests/frontend/test_layout.py::test_every_width")
def test_no_equation_is_cut_without_a_way_to_see_it(page: Page) -> None:
    page.set_viewport_size({"width": 1440, "height": 1000})
    open_compared(page)
    page.evaluate("document.querySelectorAll('.missing-card details').forEach((el) => { el.open = true; })")
    cut = run(
        page,
        """
        return [...document.querySelectorAll(".missing-card .equation")].filter((box) =>
          box.scrollWidth > box.clientWidth + 1
          && (getComputedStyle(box).overflowX !== "auto" || box.tabIndex !== 0)).map((box) => box.ariaLabel);
        """,
    )
    assert cut == []
    # Most stand in the card as they are.
    shares = run(
        page,
        """
        const all = [...document.querySelectorAll(".missing-card .equation")];
        return all.filter((box) => box.scrollWidth <= box.clientWidth + 1).length / all.length;
        """,
    )
    assert shares > 0.6
    # On a phone a long one is set smaller, and none is scrolled.
    page.set_viewport_size({"width": 390, "height": 844})
    page.wait_for_timeout(300)
    found = run(
        page,
        """
        const all = [...document.querySelectorAll(".missing-card .equation")].filter((e) => e.clientWidth);
        const size = (box) => parseFloat(getComputedStyle(box).fontSize);
        return all.map((box) => [box.scrollWidth - box.clientWidth, size(box)]);
        """,
    )
    assert max(over for over, _ in found) <= 1
    assert 9 <= min(size for _, size in found) < max(size for _, size in found) == 15
