"""Projects on the page: saved by themselves, found after a reload, never overwritten by another window."""

from __future__ import annotations

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from tests.frontend.axe import violations
from tests.frontend.guard import PageGuard


def opened(page: Page) -> Page:
    page.goto("/")
    page.wait_for_selector("html[data-ready]")
    return page


def choose(page: Page, item: str) -> None:
    page.locator("button.project").click()
    page.get_by_role("menuitem", name=item).click()


def change_units(page: Page, units: str) -> None:
    page.get_by_role("combobox", name="Units").select_option(units)


def test_a_project_in_two_windows(context: BrowserContext, page_guard: PageGuard) -> None:
    page_guard.allow("status of 409")
    one = opened(context.new_page())
    choose(one, "Save as project…")
    assert violations(one, "dialog[open]") == []
    one.get_by_label("Title").fill("Lift, two windows")
    one.keyboard.press("Enter")
    expect(one.locator(".project-state.saved")).to_be_visible()
    change_units(one, "si")
    expect(one.locator(".project-state.changed")).to_be_visible()
    expect(one.locator(".project-state.saved")).to_be_visible()

    two = opened(context.new_page())
    choose(two, "Open project…")
    expect(two.locator("table.projects")).to_contain_text("Lift, two windows")
    assert violations(two, "dialog[open]") == []
    size = two.viewport_size
    assert size is not None
    two.set_viewport_size({"width": 390, "height": 844})
    for what in ("Open", "Duplicate", "Delete"):
        expect(two.get_by_role("button", name=f"{what} Lift, two windows")).to_be_in_viewport(ratio=1)
    two.set_viewport_size(size)
    two.get_by_role("button", name="Open Lift, two windows").click()
    expect(two.get_by_role("combobox", name="Units")).to_have_value("si")
    change_units(two, "us")
    expect(two.locator(".project-state.changed")).to_be_visible()
    expect(two.locator(".project-state.saved")).to_be_visible()

    change_units(one, "bar")
    dialog = one.get_by_role("dialog", name="Saved in another window")
    expect(dialog).to_contain_text("units US")
    assert violations(one, "dialog[open]") == []
    dialog.get_by_role("button", name="Open theirs").click()
    expect(one.get_by_role("combobox", name="Units")).to_have_value("us")
    one.keyboard.press("Control+z")
    expect(one.get_by_role("combobox", name="Units")).to_have_value("bar")
    expect(one.locator(".project-state.saved")).to_be_visible()

    choose(one, "Title and notes…")
    one.get_by_role("textbox", name="Notes").fill("Braid from the second batch.")
    assert violations(one, "dialog[open]") == []
    one.get_by_role("button", name="Save", exact=True).click()
    expect(one.get_by_role("dialog")).to_have_count(0)

    one.reload()
    expect(one.locator(".project-title")).to_have_text("Lift, two windows")
    expect(one.locator(".project-state.saved")).to_be_visible()
    choose(one, "History…")
    versions = one.locator(".versions li")
    expect(versions.last).to_contain_text("created")
    versions.last.get_by_role("button").click()
    expect(one.locator(".versions")).to_have_count(0)

    choose(one, "Open project…")
    expect(one.locator("table.projects .notes")).to_have_text("Braid from the second batch.")
    one.get_by_role("button", name="Delete Lift, two windows").click()
    expect(one.locator(".undone")).to_contain_text("in the bin")
    one.get_by_role("button", name="Undo", exact=True).click()
    expect(one.locator("table.projects")).to_contain_text("Lift, two windows")
    expect(one.locator(".project-title")).to_have_text("Project")


@pytest.mark.examination("test_a_project_in_two_windows")
def test_work_of_the_last_moment_is_kept(context: BrowserContext, page_guard: PageGuard) -> None:
    page_guard.allow("status of 409|ERR_FAILED")
    page = opened(context.new_page())
    choose(page, "Save as project…")
    page.get_by_label("Title").fill("Lift, last moment")
    page.keyboard.press("Enter")
    expect(page.locator(".project-state.saved")).to_be_visible()
    units = page.get_by_role("combobox", name="Units")

    change_units(page, "si")
    page.reload()  # before the address is written, and while the page saves what it leaves
    page.wait_for_selector("html[data-ready]")
    expect(units).to_have_value("si")
    expect(page.locator(".project-state.saved")).to_be_visible()
    page.wait_for_timeout(2500)  # it would be asked then
    expect(page.get_by_role("dialog")).to_have_count(0)

    page.route("**/api/projects/*", lambda route: route.abort())
    change_units(page, "us")
    expect(page.locator(".project-state.failed")).to_be_visible()
    page.unroute_all(behavior="wait")
    expect(page.locator(".project-state.saved")).to_be_visible(timeout=30_000)  # nothing was clicked
    choose(page, "History…")
    expect(page.locator(".versions li").first).to_contain_text("units US")
