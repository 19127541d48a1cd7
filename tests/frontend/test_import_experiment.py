"""The second step of an import: the experiment, its origins, what is required, what contradicts the file.

The fields come from a stand-in for the server, so that every origin occurs; `test_import` has the real ones.
"""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, Route, expect

from tests.frontend.comparing import choose, setup, use
from tests.frontend.importing import panel, plain

NOTHING: dict[str, Any] = {
    "value": None,
    "unit": "",
    "units": [],
    "origin": None,
    "where": "",
    "required": False,
    "unanswered": False,
    "question": "What is it?",
    "why": "it matters",
    "proposed": None,
    "least": None,
    "most": None,
    "choices": [],
    "closed": False,
    "example": "",
    "option": "",
}
MUSCLE = {
    **NOTHING,
    "field": "muscle",
    "title": "Muscle",
    "value": "DMSP-20",
    "origin": "file",
    "where": "line 2",
    "required": True,
}
LENGTH = {
    **NOTHING,
    "field": "rest_length",
    "title": "Rest length",
    "unit": "m",
    "units": ["mm", "m"],
    "value": 0.3,
    "origin": "assumed",
    "where": "the preset DMSP-20",
    "required": True,
    "unanswered": True,
    "least": 1e-3,
    "most": 50.0,
    "proposed": 0.2512,
    "example": "300 mm",
    "question": "How long is the muscle?",
}
LOAD = {
    **NOTHING,
    "field": "load",
    "title": "Load",
    "unit": "kg",
    "units": ["kg", "N"],
    "required": True,
    "unanswered": True,
    "example": "6 kg",
}
FIXED = {
    **NOTHING,
    "field": "fixed_end",
    "title": "Fixed end",
    "choices": ["upper", "lower", "both"],
    "closed": True,
}
ACCURACY = {
    **NOTHING,
    "field": "accuracy_length",
    "title": "Accuracy of the length",
    "unit": "m",
    "units": ["mm", "%"],
    "value": 1e-3,
    "origin": "assumed",
    "example": "1 mm",
}


def stand_in(page: Page, *fields: dict[str, Any]) -> list[str]:
    """Previews with these fields; returns the muscles that were asked with, which fills while pages run."""
    muscles: list[str] = []

    def answer(route: Route) -> None:
        found = re.search(r"[?&]muscle=([^&]*)", route.request.url)
        muscles.append(found[1] if found else "")
        response = route.fetch()
        route.fulfill(response=response, json={**response.json(), "experiment": list(fields)})

    page.route("**/api/measurements/preview*", answer)
    return muscles


def row(page: Page, field: str) -> Locator:
    return panel(page).locator(f"[data-field='experiment.{field}']")


def accept(page: Page) -> Locator:
    return panel(page).get_by_role("button", name=re.compile("^Use th"))


def compared(page: Page) -> list[dict[str, Any]]:
    """Accept the files; the measurements of the comparison that follows."""
    return request_after(page)["measurements"]


def request_after(page: Page) -> dict[str, Any]:
    """Accept the files; the comparison that follows."""
    with page.expect_request("**/api/comparisons") as asked:
        use(page)
    body = asked.value.post_data_json
    assert isinstance(body, dict)
    return body


@pytest.mark.examination("test_an_assumption_or_a_suggestion_is_taken_over_by_a_click")
def test_each_value_shows_who_says_it(case: Page) -> None:
    stand_in(case, MUSCLE, {**LENGTH, "unanswered": False}, FIXED, ACCURACY)
    choose(case, plain("a.csv"))
    expect(row(case, "muscle").get_by_label("Muscle")).to_have_value("DMSP-20")
    expect(row(case, "muscle")).to_contain_text("file: line 2")
    expect(row(case, "rest_length").get_by_label("Rest length")).to_have_value("300 mm")
    expect(row(case, "rest_length").locator(".origin.assumed")).to_be_visible()
    expect(row(case, "accuracy_length").get_by_label("Accuracy of the length")).to_have_value("1 mm")
    expect(row(case, "accuracy_length").locator(".origin.assumed")).to_be_visible()
    expect(row(case, "fixed_end")).to_be_hidden()  # nobody needs it
    panel(case).get_by_text("More about the experiment").click()
    row(case, "fixed_end").get_by_label("Fixed end").select_option("lower")
    expect(row(case, "fixed_end")).to_contain_text("you")
    expect(accept(case)).to_be_enabled()


def test_what_is_required_is_asked_before_anything_is_compared(case: Page) -> None:
    stand_in(case, MUSCLE, LENGTH, LOAD)
    choose(case, plain("a.csv"))
    length, load = row(case, "rest_length"), row(case, "load")
    expect(accept(case)).to_be_disabled()
    expect(panel(case).locator(".state-now")).to_have_text("missing: rest length, load")
    expect(length.get_by_label("Rest length")).to_be_focused()
    expect(length).to_have_class(re.compile("open"))
    expect(length).to_contain_text("How long is the muscle?")
    length.get_by_label("Rest length").fill("25 kg")
    case.keyboard.press("Tab")
    expect(length).to_contain_text("“kg” measures a mass, this is a length")
    length.get_by_label("Rest length").fill("99 m")
    case.keyboard.press("Tab")
    expect(length).to_contain_text("At most 50000 mm")
    length.get_by_label("Rest length").fill("250")
    case.keyboard.press("Tab")
    expect(length.get_by_label("Rest length")).to_have_value("250 mm")
    expect(length).not_to_have_class(re.compile("open"))
    load.get_by_label("Load").fill("60 N")
    case.keyboard.press("Tab")
    expect(load.get_by_label("Load")).to_have_value("60 N")
    expect(panel(case).locator(".state-now")).to_be_empty()
    (measurement,) = compared(case)
    assert measurement["experiment"] == {"rest_length": "0.25 m", "load": "60 N"}
    expect(case.locator("[data-field='compare.nominal_length'] input")).to_have_value("250")


def test_an_assumption_or_a_suggestion_is_taken_over_by_a_click(case: Page) -> None:
    stand_in(case, MUSCLE, LENGTH)
    choose(case, plain("a.csv"))
    length = row(case, "rest_length")
    length.get_by_role("button", name="I don’t know: assume 300 mm").click()
    expect(length.get_by_label("Rest length")).to_have_value("300 mm")
    expect(length).to_contain_text("assumed, check it later")
    expect(accept(case)).to_be_focused()
    (measurement,) = compared(case)
    assert "experiment" not in measurement  # nobody said anything: the server goes on assuming
    setup(case).get_by_role("button", name="Import…").click()
    length.get_by_role("button", name="251.2 mm is suggested by the data").click()
    expect(length).to_contain_text("suggestion accepted")
    (measurement,) = compared(case)
    assert measurement["experiment"] == {"rest_length": {"value": "0.2512 m", "origin": "suggested"}}


def test_who_contradicts_the_file_is_told(case: Page) -> None:
    said = {**LENGTH, "value": 0.25, "origin": "file", "where": "line 3", "unanswered": False}
    stand_in(case, MUSCLE, said)
    choose(case, plain("a.csv"))
    length = row(case, "rest_length")
    length.get_by_label("Rest length").fill("300 mm")
    case.keyboard.press("Tab")
    expect(length).to_contain_text("The file says 250 mm (line 3)")
    length.get_by_role("button", name="Back to 250 mm").click()
    expect(length.get_by_label("Rest length")).to_have_value("250 mm")
    expect(length).to_contain_text("file: line 3")
    expect(length).not_to_contain_text("The file says")


def test_a_chosen_muscle_is_asked_with(case: Page) -> None:
    muscle = {**MUSCLE, "value": None, "origin": None, "where": "", "unanswered": True}
    muscles = stand_in(case, muscle, {**LENGTH, "unanswered": False})
    choose(case, plain("a.csv"))
    expect(accept(case)).to_be_disabled()
    with case.expect_response("**/api/measurements/preview*"):
        row(case, "muscle").get_by_label("Muscle").select_option("DMSP-10")
    expect(accept(case)).to_be_enabled()
    assert muscles == ["", "DMSP-10"]
    # It is the muscle of the view, where it can be changed.
    body = request_after(case)
    assert body["muscle"]["preset"] == "DMSP-10"
    assert "experiment" not in body["measurements"][0]
    expect(case.locator("#compare-preset")).to_have_value("DMSP-10")


def test_the_length_in_the_view_and_that_of_the_import_are_one(case: Page) -> None:
    stand_in(case, MUSCLE, LENGTH)
    choose(case, plain("a.csv"))
    row(case, "rest_length").get_by_label("Rest length").fill("260")
    case.keyboard.press("Tab")
    compared(case)
    field = case.locator("[data-field='compare.nominal_length'] input")
    expect(field).to_have_value("260")
    setup(case)
    field.fill("270")
    with case.expect_request("**/api/comparisons") as asked:
        field.press("Enter")
    body = asked.value.post_data_json
    assert body["measurements"][0]["experiment"]["rest_length"] == "0.27 m"
    setup(case).get_by_role("button", name="Import…").click()
    expect(row(case, "rest_length").get_by_label("Rest length")).to_have_value("270 mm")


def test_each_of_several_files_has_its_rest_length(case: Page) -> None:
    stand_in(case, MUSCLE, LENGTH)
    choose(case, *[plain(f"run{n}.csv", rest=f"{250 + n} mm") for n in range(3)])
    files = panel(case).locator(".several tbody tr")
    expect(files).to_have_count(3)
    own = panel(case).get_by_label("Rest length of run1.csv")
    own.fill("260")
    case.keyboard.press("Tab")
    expect(files.nth(1)).to_contain_text("you")
    expect(accept(case)).to_be_disabled()  # two are missing
    row(case, "rest_length").get_by_role("textbox", name="Rest length", exact=True).fill("250")
    case.keyboard.press("Tab")
    expect(files.nth(2)).to_contain_text("as above")
    expect(accept(case)).to_be_enabled()
    measurements = compared(case)
    lengths = [one["experiment"]["rest_length"] for one in measurements]
    assert lengths == ["0.25 m", "0.26 m", "0.25 m"]


def test_answers_of_the_file_before_are_offered_not_taken(case: Page) -> None:
    stand_in(case, MUSCLE, LENGTH)
    choose(case, plain("first.csv"))
    row(case, "rest_length").get_by_label("Rest length").fill("250")
    case.keyboard.press("Tab")
    use(case)
    expect(case.locator(".file")).to_have_count(1)
    choose(case, plain("second.csv", rest="255 mm"))
    expect(panel(case).locator(".kept")).to_contain_text("Read as first.csv")
    expect(accept(case)).to_be_disabled()
    row(case, "rest_length").get_by_role("button", name="250 mm, as for first.csv").click()
    expect(row(case, "rest_length")).to_contain_text("you")
    expect(accept(case)).to_be_enabled()


@pytest.mark.parametrize("field", ["muscle", "rest_length"])
def test_every_field_has_a_label(case: Page, field: str) -> None:
    stand_in(case, MUSCLE, LENGTH)
    choose(case, plain("a.csv"))
    entry = row(case, field).locator("input, select")
    expect(entry).to_have_accessible_name(re.compile("Muscle|Rest length"))
    expect(entry).to_have_attribute("aria-required", "true")
