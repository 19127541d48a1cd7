"""Several cases in one document: new, copied, renamed, removed; in the link, in the history, by key."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.comparing import changed, diagnosed, error, file, measured, opened, state
from tests.frontend.views import link_of, load, marked, open_design, run

NAMES = "(await import('/js/views/compare/cases.js')).casesOf(doc.peek()).map(({ name }) => name)"


def names(page: Page) -> list[str]:
    """The names of all cases, in order."""
    return list(run(page, f"const {{ doc }} = await import('/js/state.js'); return {NAMES};"))


def menu(page: Page, item: str) -> None:
    """Do something in the menu of the cases, by keys alone."""
    page.locator(".strip button.case-menu").focus()
    page.keyboard.press("Enter")
    entry = page.get_by_role("menu", name="Cases of this project").locator("button", has_text=item)
    entry.focus()
    page.keyboard.press("Enter")


@pytest.mark.examination("test_cases_of_damaged_and_of_old_documents")
def test_several_cases_in_one_document(page: Page) -> None:
    opened(page, file("sweeps.csv", measured(1)))
    switch = page.locator(".strip button.case-menu")
    expect(switch).to_have_text("Case 1")
    start = error(page)

    # A copy goes another way; the first case stays as it is.
    menu(page, "Copy this case")
    expect(switch).to_have_text("Case 2")
    solved = changed(page, page.locator("#add-all").click)
    assert solved < start / 20
    menu(page, "Rename this case…")
    page.get_by_role("dialog", name="Rename case").get_by_label("Name").fill("All effects")
    page.keyboard.press("Enter")
    expect(switch).to_have_text("All effects")
    menu(page, "Case 1")
    diagnosed(page)
    assert error(page) == start  # at once: it does not count down from the other case
    page.go_back()  # each case that is shown is an entry of the browser's history
    expect(switch).to_have_text("All effects")
    diagnosed(page)
    assert error(page) == solved

    # An empty one brings its own files; nothing of the others stands in it.
    menu(page, "New case")
    expect(switch).to_have_text("Case 3")
    assert state(page) == "empty"
    expect(page.locator("#error-now")).to_be_hidden()
    switch.click()
    assert violations(page, "[role=menu]") == []
    expect(page.get_by_role("menuitemradio")).to_have_count(3)
    expect(page.get_by_role("menuitem", name="New case")).to_have_count(0)  # this one is empty
    page.keyboard.press("Escape")
    link = link_of(page)
    menu(page, "Remove this case")
    expect(page.get_by_role("status").last).to_contain_text("Undo brings it back")
    assert names(page) == ["Case 1", "All effects"]
    page.keyboard.press("Control+z")
    assert names(page) == ["Case 1", "All effects", "Case 3"]
    expect(switch).to_have_text("Case 3")

    # The link holds them all; the palette finds them from any view; on a phone the switch is there too.
    load(page, link)
    marked(page, "[data-ready]")
    assert names(page) == ["Case 1", "All effects", "Case 3"]
    page.keyboard.press("1")
    page.keyboard.press("Control+k")
    page.get_by_role("combobox", name="Search").fill("all effects")
    page.keyboard.press("Enter")
    expect(switch).to_have_text("All effects")
    diagnosed(page)
    assert error(page) == solved
    page.set_viewport_size({"width": 390, "height": 844})
    page.locator(".case-card button.case-menu").click()
    page.get_by_role("menuitemradio", name="Case 3").click()
    page.locator(".other-cases button.case-menu").click()
    page.get_by_role("menuitemradio", name="Case 1").click()
    diagnosed(page)
    assert error(page) == start


DAMAGED = """
const { readDoc, defaultDoc } = await import('/js/state.js');
await import('/js/views/compare/cases.js');
const read = (cases) => {
  try {
    return readDoc({ ...defaultDoc(), cases }).cases.name;
  } catch (error) {
    return error.message;
  }
};
return argument.map(read);
"""


def test_cases_of_damaged_and_of_old_documents(page: Page) -> None:
    open_design(page)
    one = {"id": 2, "name": "Other", "compare": {}}
    good = {"id": 1, "name": "Mine", "at": 7, "rest": [one]}
    twice = {**good, "rest": [{**one, "id": 1}]}
    broken = {**good, "rest": [{**one, "compare": {"free": 3}}]}
    many = {**good, "rest": [{**one, "id": n} for n in range(2, 30)]}
    found = run(page, DAMAGED, [None, good, {**good, "id": "x"}, twice, broken, many])
    assert found[:2] == ["“cases” is invalid", "Mine"]
    assert found[2:] == [
        "“cases” is invalid",
        "“cases” has two of one number",
        "“compare.free” is invalid",
        "“cases.rest” is invalid",
    ]


LONG = """
const { doc, edit, readDoc } = await import('/js/state.js');
let seed = 1;
const value = () => (seed = (seed * 16807) % 2147483647) / 2147483647;  // nothing that packs well
const effects = () => Object.fromEntries(["stiffness", "friction", "offset", "creep", "slip"].map((id) =>
  [id, { force: value(), rate: value(), exponent: value() }]));
const step = (label) => ({
  label, effects: effects(), freed: [], values: { nominal_length: value(), braid_angle: value() },
  fit: {}, rmse: value(), holdout: value(),
});
const list = (length, make) => Array.from({ length }, (_, i) => make(i));
const compare = () => ({ ...doc.peek().compare, history: list(argument.steps, (i) => step(`+ ${i}`)) });
const rest = list(argument.cases - 1, (i) => ({ id: i + 2, name: `Case ${i + 2}`, compare: compare() }));
edit((d) => readDoc({ ...d, compare: compare(), cases: { id: 1, name: "Case 1", at: 0, rest } }), "long");
"""
SIZES = f"""
const {{ doc }} = await import('/js/state.js');
return [{NAMES}.length, doc.peek().compare.history.length];
"""


@pytest.mark.examination("test_cases_of_damaged_and_of_old_documents")
def test_work_too_long_for_a_link_is_kept_and_the_page_says_what_the_link_holds(page: Page) -> None:
    open_design(page)
    title = re.compile("Copy a link that holds only the open case")
    run(page, LONG, {"cases": 12, "steps": 40})
    share = page.locator("[title^='Copy a link']")
    expect(share).to_have_attribute("title", title)
    words = page.locator(".status")
    expect(words).to_contain_text("The link of this work holds only the open case. Nothing is lost")
    link = page.evaluate("location.hash")
    assert 1000 < len(link) <= 60_000
    page.reload()  # this window has all of it
    marked(page, "[data-ready]")
    assert run(page, SIZES) == [12, 40]
    share.click()
    expect(page.locator("body")).to_contain_text(re.compile("holds only the open case|Link to this state"))
    other = page.context.new_page()  # another one has what the link holds, and is offered the rest
    load(other, link)
    marked(other, "[data-ready]")
    assert run(other, SIZES) == [1, 40]
    load(other)
    other.get_by_role("button", name="Continue", exact=True).click()
    expect(other.locator("[title^='Copy a link']")).to_have_attribute("title", title)
    assert run(other, SIZES) == [12, 40]
    # Short again: the link holds everything, and the window keeps nothing beside it.
    run(other, LONG, {"cases": 2, "steps": 1})
    expect(other.locator("[title^='Copy a link']")).to_have_attribute(
        "title", "Copy a link that restores everything"
    )
    load(page, other.evaluate("location.hash"))
    marked(page, "[data-ready]")
    assert run(page, SIZES) == [2, 1]
