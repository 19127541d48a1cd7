"""Whole cases, from a file to the end: clicks, what moves, one recommendation; by thumb and by key."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import FilePayload, Page, Route, expect

from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.json_text import to_json
from mckibben.measurement.store import MeasurementStore
from mckibben.server.questions import model_question
from mckibben.server.schemas.models import DiagnosisRequest
from tests.frontend.comparing import (
    NOISE,
    changed,
    choose,
    diagnosed,
    drop,
    error,
    file,
    measured,
    opened,
    setup,
    shifts,
    state,
    use,
    watch_shifts,
)
from tests.frontend.diagnoses import alter, remember, unanswered
from tests.frontend.guard import PageGuard
from tests.frontend.importing import CORPUS, answer_everything
from tests.frontend.views import marked, open_compare, open_design, run
from tests.looks import Looks
from tests.shipped import shipped_studio

needs_corpus = pytest.mark.skipif(
    not (CORPUS / "lab_de.csv").exists(), reason="the files of laboratories are not beside the project"
)


@pytest.fixture(scope="module")
def sweeps() -> FilePayload:
    """The measurement with three hidden effects."""
    return file("sweeps.csv", measured(1))


def recommendations(page: Page) -> list[str]:
    """What the blue buttons do: the strip's, and at most the same one in the list."""
    names = run(
        page,
        """
        const blue = [...document.querySelectorAll(".compare button.primary")];
        return blue.filter((el) => el.checkVisibility()).map((el) => el.ariaLabel ?? el.textContent);
        """,
    )
    assert isinstance(names, list)
    return names


def to_the_end(page: Page, most: int = 6) -> list[str]:
    """Do what the strip recommends until it recommends no effect any more; the errors on the way."""
    errors = [page.locator("#error-now").inner_text()]
    act = page.locator("#next-action").dblclick  # the second click must not stop the diagnosis that follows
    for _ in range(most):
        now = state(page)
        assert len(set(recommendations(page))) == 1, recommendations(page)
        if now not in ("verdict", "context"):
            return errors
        changed(page, act)
        errors.append(page.locator("#error-now").inner_text())
    raise AssertionError(f"the case does not end: {errors}")


def falling(errors: list[str]) -> bool:
    values = [float(re.sub(r"[^\d.]", "", text.partition("N")[0])) for text in errors]
    return all(after < before for before, after in pairwise(values))


def test_a_diagnosis_whose_time_is_over_shows_what_it_found(page: Page) -> None:
    studio, limits = shipped_studio(), [1, 7]  # first there is time for the start model alone

    def ended(route: Route) -> None:
        body = DiagnosisRequest.model_validate_json(route.request.post_data or "")
        work = prepare(model_question(body, studio, MeasurementStore(Path("unused"))), studio)
        found = to_json(work(Looks(limits.pop(0)))).decode()
        route.fulfill(content_type="text/event-stream", body=f"event: done\ndata: {found}\n\n")

    open_compare(page)
    page.route("**/api/diagnoses", ended)
    page.locator(".tile", has_text="DMSP-20-300").click()
    told = page.locator("#unfinished")
    expect(told).to_contain_text("Not finished. So far no effect lowers the error", timeout=60_000)
    expect(told).to_contain_text("ended the diagnosis after 0 of ")
    page.get_by_role("button", name="Diagnose", exact=True).click()
    expect(told).to_contain_text("Not finished. So far, with ", timeout=60_000)
    expect(told).to_contain_text(
        re.compile(r"The limit of 7 s of processor time ended the diagnosis after \d+ of \d+ effects")
    )
    card = page.get_by_role("region", name="What is missing")
    expect(card.locator(".card-head")).to_contain_text("not finished")
    expect(card.locator(".found-missing > li")).not_to_have_count(0)
    assert not limits
    page.unroute("**/api/diagnoses", ended)


def test_a_mystery_is_solved_by_the_recommendations_alone(page: Page) -> None:
    open_compare(page)
    remember(page)
    assert recommendations(page) == ["Open…"]
    page.locator(".tile", has_text="Weaker than drawn").click()
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    card = page.get_by_role("region", name="Mystery")
    expect(card).to_contain_text("Add the effects you think are missing")
    sketch = page.locator(".found-missing svg.sketch[role=img]").first
    expect(sketch).to_have_attribute("aria-label", re.compile(r"^Over \w+: the force that .* would explain"))
    errors = to_the_end(page)
    assert falling(errors)
    assert state(page) == "adequate"
    held = re.search(r"held-out ([\d.]+)", page.locator("#error-facts").inner_text())
    assert held
    expect(page.locator(".compare")).to_contain_text(f"is the noise of the data, held-out {held[1]}")
    expect(card).to_contain_text("Your diagnosis so far")
    card.get_by_role("button", name="Reveal what is hidden").click()
    expect(card.locator(".revealed")).to_have_count(1)
    expect(card.locator(".revealed.good")).to_have_count(1)
    expect(card.get_by_role("button")).to_have_count(0)


@pytest.mark.examination(
    "tests/frontend/test_compare.py::test_from_the_empty_page_to_the_noise_in_five_clicks"
)
@needs_corpus
def test_a_logger_file_of_a_laboratory_in_five_clicks_to_the_verdict(page: Page) -> None:
    open_design(page)
    watch_shifts(page)
    content = (CORPUS / "lab_de.csv").read_bytes()
    drop(page, {"name": "lab_de.csv", "mimeType": "text/csv", "buffer": content})
    clicks = 1 + answer_everything(page)
    use(page)
    clicks += 1
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    assert clicks <= 5
    assert shifts(page) == []
    # The strip says who said what.
    facts = page.locator(".strip .facts")
    expect(facts.locator("[data-fact='muscle']")).to_contain_text("DMSP-20")
    expect(facts.locator("[data-fact='rest_length']")).to_contain_text("250 mm")
    expect(facts.locator("[data-fact='rest_length']")).to_contain_text("from the file")
    assert len(set(recommendations(page))) == 1
    expect(page.locator("#next-what")).not_to_be_empty()


def checked(page: Page) -> float:
    """The error on the files that are only checked [N]."""
    return float(re.findall(r"[\d.]+", page.locator("#validation-error").inner_text())[0])


@pytest.mark.examination(
    "tests/frontend/test_import_experiment.py::test_each_of_several_files_has_its_rest_length"
)
def test_three_files_of_one_muscle_are_one_case(page: Page) -> None:
    open_compare(page)
    with unanswered(page):
        choose(page, *[file(f"run{n}.csv", measured(n)) for n in (1, 2, 3)])
        use(page)
        expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
        expect(page.locator(".strip button.name")).to_have_text("run1.csv + 2")
    remember(page)
    setup(page)
    page.get_by_role("radiogroup", name="Use of run3.csv").get_by_role("radio", name="Check").click()
    page.keyboard.press("Escape")
    expect(page.locator("#validation-error")).to_contain_text("check", timeout=20_000)
    diagnosed(page)
    assert error(page) > 50 * NOISE
    expect(page.locator(".heat .is-noise")).to_have_count(0)
    # One row of the map for each level, not for each file.
    expect(page.locator(".heat tbody th[scope='row']")).to_have_count(6)
    assert checked(page) == pytest.approx(error(page), rel=0.05)
    changed(page, page.locator("#add-all").click)
    assert error(page) <= 1.15 * NOISE
    expect(page.locator(".heat .is-noise")).to_have_count(6)  # each level is within the noise
    assert checked(page) <= 1.15 * NOISE
    assert state(page) == "adequate"
    setup(page)
    page.get_by_role("radiogroup", name="Use of run3.csv").get_by_role("radio", name="Off").click()
    expect(page.locator("#validation-error")).to_have_count(0, timeout=20_000)


@pytest.mark.examination("test_a_mystery_is_solved_by_the_recommendations_alone")
def test_the_board_compares_pinned_models(page: Page, sweeps: FilePayload, tmp_path: Path) -> None:
    opened(page, sweeps)
    pin = page.get_by_role("button", name="Pin this model")
    pin.click()
    changed(page, page.locator("#add-all").click)
    pin.click()
    board = page.get_by_role("region", name="Model board")
    expect(board.locator(".pin-chip")).to_have_count(3)
    board.get_by_role("button", name="Open").click()
    head = board.locator("thead th")
    expect(head).to_have_count(3)
    expect(head.nth(0)).to_contain_text("Ideal muscle")
    errors = board.locator("tbody tr").first.locator("td b")
    expect(errors.nth(2)).to_have_text(page.locator("#error-now").inner_text().partition("\xa0")[0])
    values = [float(text) for text in errors.all_inner_texts()]
    assert values[0] > 50 * NOISE
    assert values[1] == values[2]
    rows = board.locator("tbody tr").count()
    board.get_by_label("Differences only").check()
    expect(board).to_contain_text(re.compile(r"\d+ equal rows hidden"))
    assert board.locator("tbody tr").count() < rows
    board.get_by_role("button", name="Compare the others with Ideal muscle").click()
    expect(board.locator("tbody tr").first).to_contain_text("−99 %")
    board.get_by_role("button", name="Error N: sort the models", exact=True).click()
    expect(head.nth(2)).to_contain_text("Ideal muscle")
    line = page.locator("#overlay-force .scatterlayer .tracepin0")
    board.get_by_role("button", name="Draw Ideal muscle in the overlay").click()
    expect(line).to_have_count(1)
    # Its points in the residual, its loops, and its fit beside its name.
    points = page.locator("#residual .scatterlayer .tracepin0 .point")
    expect(points.first).to_be_attached()
    page.get_by_role("button", name="Area of each loop of the residual").click()
    expect(page.locator(".brush-line")).to_contain_text(re.compile(r"Ideal muscle: 6 loops, mean \+\d"))
    drawn = page.locator(".legend-toggle", has_text="Ideal muscle")
    fit = board.locator("tbody tr", has_text="100 % is perfect").locator("td b").last.inner_text()
    expect(drawn).to_contain_text(re.compile(rf"\s{float(fit):.1f}\s%"))
    drawn.click()
    expect(line).to_have_count(0)
    expect(points).to_have_count(0)
    with page.expect_download() as saved:
        board.get_by_role("button", name="Table .csv").click()
    saved.value.save_as(tmp_path / "models.csv")
    table = list(csv.reader((tmp_path / "models.csv").read_text(encoding="utf-8").splitlines()))
    assert {"Error", "Held-out error", "Fit (100 % is perfect)"} <= {row[0] for row in table}
    changed(page, board.get_by_role("button", name="Use Ideal muscle").click)
    expect(page.locator(".in-model")).to_have_count(0)
    board.get_by_role("button", name="Unpin Ideal muscle").click()
    expect(head).to_have_count(2)


@pytest.mark.examination("tests/cli/test_saved_model.py::test_a_diagnosed_model_becomes_a_muscle_of_the_user")
def test_the_model_becomes_a_muscle_whose_curves_show_how_sure_they_are(
    page: Page, sweeps: FilePayload, page_guard: PageGuard
) -> None:
    page_guard.allow("status of 409")
    opened(page, sweeps)
    changed(page, page.locator("#add-all").click)
    page.get_by_role("button", name="My preset").click()
    dialog = page.get_by_role("dialog", name="Save as my preset")
    dialog.get_by_label("Id").fill("DMSP-20")
    dialog.get_by_role("button", name="Save").click()
    expect(dialog.get_by_role("alert")).to_contain_text("taken by a built-in preset")
    dialog.get_by_label("Id").fill("of-the-case")
    dialog.get_by_label("Title").fill("Muscle of the case")  # other tests look for DMSP-20
    dialog.get_by_role("button", name="Save").click()
    expect(dialog).to_have_count(0)
    page.get_by_role("button", name="Design", exact=True).click()
    page.locator("#preset").select_option("of-the-case")
    # Two dotted ends beside each of the lines.
    expect(page.locator("#force .scatterlayer .tracelow0")).to_have_count(1)
    expect(page.locator("#force .scatterlayer .tracehigh0")).to_have_count(1)
    expect(page.locator("main")).to_contain_text("the model was measured up to")

    # From the repaired model to the spread of its figures in three clicks.
    page.get_by_role("button", name="Compare & diagnose", exact=True).click()
    page.get_by_role("button", name="Tolerance").click()
    page.get_by_role("button", name="Run 200 runs").click()
    marked(page, '[data-study="done"]', 180_000)
    answer = run(page, "return (await import('/js/views/studies/model.js')).answer.peek();")
    assert answer["outcomes"] == {"completed": 200}
    expect(page.get_by_role("region", name="Result", exact=True)).to_contain_text("200 completed")


def test_probabilities_reasons_and_minutes_of_the_server_are_shown(page: Page, sweeps: FilePayload) -> None:
    def change(done: dict[str, Any]) -> None:
        verdict = done["verdict"]
        verdict["probabilities"] = dict.fromkeys(verdict["effects"], 0.974)
        verdict["applied"] = {verdict["effects"][0]: "it has the fewest values"}
        for experiment in verdict["experiments"]:
            experiment.update(minutes=10.0, separation=2.0, protocol="a ramp")
        # The values of the model come closer when they are fitted again: that is done first.
        start, first = done["path"][:2]
        refitted = {**first, "added": None, "refitted": True, "rmse": 0.8 * start["rmse"]}
        done["path"].insert(1, refitted)

    raw: list[float] = []

    def with_accuracy(route: Route) -> None:
        body = route.fetch().json()
        raw.append(body["rmse"])
        route.fulfill(json={**body, "rmse_beyond_accuracy": body["rmse"] / 2})

    open_compare(page)
    alter(page, change)
    page.route("**/api/comparisons", with_accuracy)
    choose(page, sweeps)
    use(page)
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    rows = page.locator(".found-missing > li")
    expect(rows.locator(".likely")).to_have_text(["97 % likely"] * 3)
    expect(rows.first).to_contain_text("It has the fewest values")
    expect(rows.locator(".tell").first).to_contain_text("Would tell (10 min)")
    expect(rows.locator(".tell").first).to_contain_text("Best simulated test: a ramp")
    expect(page.locator("#next-what")).to_have_text("Refit the values of the model")
    assert recommendations(page) == ["Refit", "Refit"]
    # One number: the error that the diagnosis counts, without what the accuracy of the readings explains.
    assert error(page) == pytest.approx(raw[0] / 2, rel=0.01)
    expect(page.locator("#error-facts")).to_have_attribute("title", re.compile("RMS error: [0-9]"))


def tab_to(page: Page, wanted: str, most: int = 60) -> None:
    """Press Tab until an element of this selector has the focus."""
    for _ in range(most):
        if run(page, "return document.activeElement?.matches(argument) ?? false;", wanted):
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"{wanted} is not reached by Tab")


@pytest.mark.examination("test_a_mystery_is_solved_by_the_recommendations_alone")
def test_a_whole_case_without_a_mouse(page: Page, sweeps: FilePayload) -> None:
    open_compare(page)
    remember(page)
    choose(page, sweeps)  # the browser's own dialog
    expect(page.locator("dialog.import")).to_be_visible()
    tab_to(page, "dialog.import button.primary")
    page.keyboard.press("Enter")
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    page.locator("body").click(position={"x": 700, "y": 130})  # where the browser begins after its dialog
    tab_to(page, "#next-action")
    while state(page) == "verdict":
        changed(page, lambda: page.keyboard.press("Enter"))
        expect(page.locator("#next-action")).to_be_focused()
    assert error(page) <= 1.15 * NOISE
    spoken = page.locator(".error-value [aria-live]")
    expect(spoken).to_contain_text(re.compile(r"Error [\d.]+.N, [01]\.\d\d times the noise"))
    tab_to(page, ".heat button")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    expect(page.locator(".heat [aria-pressed='true']")).to_be_focused()
    page.keyboard.press("Escape")
    expect(page.locator(".heat [aria-pressed='true']")).to_have_count(0)
    tab_to(page, ".pick input")
    with page.expect_response("**/api/diagnoses"):
        page.keyboard.press("ArrowDown")  # the other one of two that cannot be told apart
    diagnosed(page)
    expect(page.locator(".path-table")).to_contain_text("Force sensor: zero error")


@pytest.mark.examination("test_a_mystery_is_solved_by_the_recommendations_alone")
def test_a_whole_case_with_the_thumb(new_context: Callable[..., object], sweeps: FilePayload) -> None:
    context = new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    page: Page = context.new_page()  # type: ignore[attr-defined]
    open_compare(page)
    remember(page)
    choose(page, sweeps)
    page.locator("dialog.import").get_by_role("button", name=re.compile("^Use th")).tap()
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    diagnosed(page)
    box = "return document.querySelector('.strip').getBoundingClientRect().toJSON();"
    height = run(page, box)["height"]
    page.evaluate("scrollTo(0, 900)")
    while state(page) == "verdict":
        strip = run(page, box)
        assert strip["top"] == 0  # number and next action never scroll away
        assert strip["height"] == height <= 60
        button = page.locator("#next-action").bounding_box()
        assert button
        assert min(button["width"], button["height"]) >= 40
        changed(page, page.locator("#next-action").tap)
    assert error(page) <= 1.15 * NOISE
    page.locator("#next-action").tap()
    expect(page.locator("#take-along").get_by_role("button", name="Report")).to_be_in_viewport()
