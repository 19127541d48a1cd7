"""The shell: views in the browser's history, work to continue, the command palette, tabs at 200 % zoom."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.views import enter, field, link_of, open_design, run

VIEW = "return (await import('/js/state.js')).doc.peek().view;"


def view(page: Page) -> str:
    """The view that is shown."""
    return str(run(page, VIEW))


def test_back_forward_reload_and_a_fresh_start(page: Page) -> None:
    open_design(page)
    page.get_by_role("button", name="Catalogue", exact=True).click()
    page.get_by_role("button", name="Transient", exact=True).click()
    page.go_back()
    expect(page).to_have_title(re.compile("^Catalogue"))
    page.go_back()
    expect(page).to_have_title(re.compile("^Design"))
    enter(page, "Rest length", "240")
    page.go_forward()  # the view changes, the work stays
    expect(page).to_have_title(re.compile("^Catalogue"))
    page.go_back()
    expect(field(page, "Rest length")).to_have_value("240")
    link_of(page)
    page.reload()
    expect(field(page, "Rest length")).to_have_value("240")
    page.go_forward()
    expect(page).to_have_title(re.compile("^Catalogue"))

    other = page.context.new_page()  # a second tab has a history and a state of its own
    other.goto("/#catalogue")
    expect(other).to_have_title(re.compile("^Catalogue"))
    other.goto("about:blank")
    other.goto("/")
    offer = other.get_by_role("complementary", name="Last time")
    expect(offer).to_contain_text("Continue where you stopped?")
    expect(field(other, "Rest length")).not_to_have_value("240")
    assert violations(other, ".continue") == []
    offer.get_by_role("button", name="Continue").click()
    expect(offer).to_have_count(0)
    expect(field(other, "Rest length")).to_have_value("240")


def test_the_palette_and_the_tabs_of_a_narrow_window(page: Page) -> None:
    open_design(page)
    page.get_by_role("button", name="Compare & diagnose", exact=True).click()  # the longest title
    views = page.get_by_role("navigation", name="Views")
    for width in (390, 701, 899, 900, 960, 1101, 1120, 1200):
        page.set_viewport_size({"width": width, "height": 800})
        # The tabs are measured anew after the window has another width.
        page.wait_for_function("() => document.documentElement.scrollWidth <= innerWidth")
        boxes = [button.bounding_box() for button in views.get_by_role("button").all()]
        assert len(boxes) == 5  # all in sight, in one row
        assert {round(box["y"]) for box in boxes if box}.__len__() == 1, width
        over = run(page, "const b = argument; return b.scrollWidth - b.clientWidth;", views.element_handle())
        assert over <= 0, width
    views.get_by_role("button", name="Catalogue").click()
    expect(page).to_have_title(re.compile("^Catalogue"))

    page.keyboard.press("Control+k")
    palette = page.get_by_role("dialog", name="Go to")
    assert violations(page, "dialog[open]") == []
    for typed, found in (
        ("transi", "Transient"),
        ("coulomb friction", "Coulomb friction"),
        ("dmsp-40", "Festo DMSP-40"),
    ):
        palette.get_by_role("combobox").fill(typed)
        expect(palette.get_by_role("option").first).to_contain_text(found)
    palette.get_by_role("combobox").fill("no such thing")
    expect(palette.get_by_role("status")).to_contain_text("Nothing has this name")
    palette.get_by_role("combobox").fill("undo")
    expect(palette.get_by_role("option", selected=True)).to_contain_text("Undo")
    palette.get_by_role("combobox").fill("dmsp-40")
    page.keyboard.press("Enter")
    expect(palette).to_have_count(0)
    assert view(page) == "design"
    expect(page.locator("#preset")).to_have_value("DMSP-40")
