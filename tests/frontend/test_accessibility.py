"""axe finds nothing in any view and either theme; everything works without a pointer."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.comparing import ADD, bring, changed, file, measured, setup
from tests.frontend.guard import PageGuard
from tests.frontend.views import (
    link_to,
    load,
    marked,
    open_catalogue,
    open_compare,
    open_design,
    open_inputs,
    redrawn,
    run,
)

pytestmark = pytest.mark.kept_page

VIEWS = {
    "design": lambda page: open_design(page),
    "transient": lambda page: open_view(page, "transient", "[data-ran]"),
    "compare": open_compare,
    "catalogue": open_catalogue,
    "studies": lambda page: open_view(page, "studies", "[data-ready]"),
    "help": lambda page: page.goto("/help"),
}


def open_view(page: Page, view: str, mark: str) -> None:
    load(page, link_to({"schema": 1, "view": view, "design": {}}))
    marked(page, mark, 120_000)  # the first run of a fresh checkout waits for the compiler
    expect(page.get_by_role("main").get_by_role("button").first).to_be_visible()


@pytest.mark.parametrize("view", VIEWS)
def test_axe_finds_nothing_in_a_view_as_it_opens(page: Page, view: str) -> None:
    VIEWS[view](page)
    assert violations(page) == []


def test_a_pale_text_is_found(page: Page) -> None:
    page.goto("/help")
    page.add_style_tag(content="main p { color: #bbb !important; background: #fff !important }")
    assert [found for found in violations(page) if found.startswith("color-contrast")]


@pytest.mark.examination("test_axe_finds_nothing_in_a_view_as_it_opens")
@pytest.mark.parametrize("view", VIEWS)
def test_axe_finds_nothing_in_the_dark(page: Page, view: str) -> None:
    page.emulate_media(color_scheme="dark")
    VIEWS[view](page)
    assert page.locator("html").get_attribute("data-theme") == "dark"
    assert violations(page, themes=2) == []


@pytest.mark.examination("test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing_in_the_design_view(page: Page) -> None:
    open_design(page)
    page.evaluate("document.querySelectorAll('details').forEach((el) => { el.open = true; })")
    for unfold in page.locator(".fold:visible").all():
        unfold.click()
    assert violations(page, themes=2) == []
    page.locator("[data-effect] button").first.click()
    assert violations(page, ".effect-values", themes=2) == []
    page.locator(".effect-values button[aria-label^='About']").first.click()
    assert violations(page, "[role=dialog], dialog[open]", themes=2) == []
    page.keyboard.press("Escape")
    page.keyboard.press("?")
    assert violations(page, "dialog[open]", themes=2) == []
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Export").click()
    assert violations(page, "[role=menu]", themes=2) == []


THINNED = """
(() => {
  const ids = [...document.querySelectorAll("[id]")].map((el) => el.id);
  const repeated = ids.filter((id, at) => ids.indexOf(id) !== at);
  for (const parent of document.querySelectorAll("main, main *")) {
    const seen = {};
    for (const child of [...parent.children]) {
      const kind = child.tagName + "." + child.className;
      seen[kind] = (seen[kind] ?? 0) + 1;
      if (seen[kind] > 8) child.remove();
    }
  }
  return repeated;
})()
"""


@pytest.mark.examination("test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing_in_the_help(page: Page) -> None:
    # The reference is written by a few patterns, thousands of times: axe reads some of each.
    for path in ("/help", "/help/python", "/help/python/mckibben/door/curves.html", "/help/http"):
        page.goto(path)
        assert page.evaluate(THINNED) == [], path
        assert violations(page) == [], path


@pytest.mark.examination("test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing_in_the_catalogue(page: Page) -> None:
    open_catalogue(page)
    assert violations(page, themes=2) == []


@pytest.mark.examination("test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing_in_the_compare_view(page: Page, page_guard: PageGuard) -> None:
    open_compare(page)
    assert violations(page, themes=2) == []
    bring(page, file("sweeps.csv", measured(1)))
    changed(page, page.locator(".missing-card").get_by_role("button", name=ADD).first.click)
    page.evaluate("document.querySelectorAll('details').forEach((el) => { el.open = true; })")
    page.locator(".heat button").first.click()
    page.get_by_role("button", name="Pin this model").click()
    page.get_by_role("region", name="Model board").get_by_role("button", name="Open").click()
    assert violations(page, themes=2) == []
    setup(page)
    assert violations(page, ".setup-panel", themes=2) == []
    page.keyboard.press("Escape")
    odd = {"name": "odd.csv", "mimeType": "text/csv", "buffer": b"p,x,F\n3,1,2\n3,2,3\n3,3,a\n4,5,5\n"}
    page.locator("#measurement-files").set_input_files([odd])
    expect(page.get_by_role("dialog", name="How odd.csv is read")).to_be_visible()
    assert violations(page, "dialog.import", themes=2) == []


def test_keys_views_search_and_typing(page: Page) -> None:
    open_design(page)
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Keyboard")
    expect(dialog).to_contain_text("Undo")
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    page.keyboard.press("/")
    expect(page.get_by_label("Ask: muscle")).to_be_focused()
    page.keyboard.type("2?")  # typed into the field: neither a view nor the list
    expect(page.get_by_label("Ask: muscle")).to_have_value("2?")
    page.keyboard.press("Escape")
    page.locator("body").click(position={"x": 4, "y": 400})
    page.keyboard.press("4")
    expect(page.get_by_role("region", name="Table of parts")).to_be_visible()
    page.keyboard.press("g")
    page.keyboard.press("d")
    expect(page.locator("#force")).to_be_visible()
    page.keyboard.press("/")
    page.keyboard.type("gp")  # in a field these are letters
    expect(page.locator("#force")).to_be_visible()


def test_load_line_and_sliders_by_keyboard(page: Page) -> None:
    open_inputs(page)
    line = page.get_by_role("slider", name="Load line in the force plot")
    start = float(line.get_attribute("aria-valuenow") or 0)
    line.focus()
    redrawn(page, lambda: page.keyboard.press("ArrowUp"))
    assert float(line.get_attribute("aria-valuenow") or 0) > start
    slider = page.get_by_role("slider", name="Braid angle slider")
    before = slider.get_attribute("aria-valuetext")
    slider.focus()
    redrawn(page, lambda: page.keyboard.press("ArrowRight"))
    assert slider.get_attribute("aria-valuetext") != before
    more = page.get_by_role("button", name="Braid angle more")
    more.focus()
    redrawn(page, lambda: page.keyboard.press("Enter"))


def test_focus_returns_to_the_button_of_a_closed_menu(page: Page) -> None:
    open_design(page)
    button = page.get_by_role("button", name="Export")
    button.focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("menuitem").first).to_be_focused()
    page.keyboard.press("ArrowDown")
    expect(page.get_by_role("menuitem").nth(1)).to_be_focused()
    page.keyboard.press("Escape")
    expect(button).to_be_focused()


def test_named_figures_and_reduced_motion(page: Page) -> None:
    page.emulate_media(reduced_motion="reduce")
    open_design(page)
    assert page.get_by_role("figure").count() == 4
    names = run(page, "return [...document.querySelectorAll('[role=figure]')].map((f) => f.ariaLabel);")
    assert all(names)
    slow = run(
        page,
        """
        const times = (el) => getComputedStyle(el).transitionDuration.split(",");
        const moves = (el) => times(el).some((time) => parseFloat(time) > 0);
        return [...document.querySelectorAll("*")].filter(moves).map((el) => el.className);
        """,
    )
    assert slow == []
