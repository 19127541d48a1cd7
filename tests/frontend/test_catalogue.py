"""The Catalogue view: find a part, see where its figures come from, take it into the design."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.test_layout import SCROLLS
from tests.frontend.views import enter, load, open_catalogue, open_design, run
from tests.running_server import RunningServer

pytestmark = pytest.mark.kept_page


def parts(page: Page) -> list[str]:
    """The titles in the table, in order."""
    return page.locator(".parts .part").all_inner_texts()


@pytest.fixture
def built_in_only(server: RunningServer) -> None:
    """The catalogue without what tests before kept in the server they share."""
    for path in server.presets.rglob("*.json"):
        path.unlink()


@pytest.mark.usefixtures("built_in_only")
def test_sort_by_any_column(page: Page) -> None:
    open_catalogue(page)
    page.get_by_role("button", name="F max").click()
    forces = page.locator(".parts tbody tr td:nth-child(6)").all_inner_texts()
    numbers = [float(text.split()[0]) for text in forces if text != "–"]
    assert numbers == sorted(numbers)
    expect(page.locator(".parts th[aria-sort]")).to_have_attribute("aria-sort", "ascending")
    page.get_by_role("button", name="F max").click()
    expect(page.locator(".parts th[aria-sort]")).to_have_attribute("aria-sort", "descending")
    assert parts(page)[0] in ("Festo DMSP-40", "Festo MAS-40")


@pytest.mark.usefixtures("built_in_only")
def test_filter_by_kind_maker_size_and_words(page: Page) -> None:
    open_catalogue(page)
    total = len(parts(page))
    enter(page, "from", "1.5 cm")
    enter(page, "to", "25")
    expect(page.locator(".parts .part")).to_have_count(3)
    assert set(parts(page)) == {"Festo DMSP-20", "Festo MAS-20", "Muscle of the LAAS 7R arm"}
    page.get_by_label("Search the catalogue").fill("mas")
    expect(page.locator(".parts .part")).to_have_count(1)
    page.get_by_label("Search the catalogue").fill("nothing like this")
    expect(page.locator(".empty")).to_contain_text("No part matches")
    page.get_by_role("button", name="Clear the filter").click()
    expect(page.locator(".parts .part")).to_have_count(total)
    page.get_by_label("Maker").select_option("Festo")
    assert 0 < len(parts(page)) < total
    for kind in ("Valves", "Tubes", "Fittings", "Measurements", "Reference curves"):
        page.get_by_role("radio", name=kind).click()
        expect(page.locator(".parts h2")).to_have_text(kind)
        assert parts(page)
        expect(page.locator(".detail h2")).to_have_text(parts(page)[0])


def test_detail_shows_unit_source_and_grade_of_each_value(page: Page) -> None:
    open_catalogue(page)
    page.get_by_role("button", name="Festo DMSP-20", exact=True).click()
    detail = page.locator(".detail")
    expect(detail.locator("h2")).to_have_text("Festo DMSP-20")
    rows = detail.locator(".values li")
    assert rows.count() > 12
    for row in rows.all():
        assert row.locator("b").inner_text().strip()
        assert len(row.locator("small.source").inner_text()) > 3
        expect(row.locator(".grade")).to_have_count(1)
    detail.get_by_role("button", name="unverified values").click()
    doubtful = page.get_by_role("dialog", name="Unverified values")
    expect(doubtful).to_contain_text("max pressure")
    expect(doubtful).to_contain_text("Dahl friction: break strain")
    expect(detail.locator(".js-line")).to_have_count(6)


def test_use_in_design(page: Page) -> None:
    open_catalogue(page)
    page.get_by_role("button", name="Festo MAS-40").click()
    page.get_by_role("button", name="Use in design").click()
    expect(page.locator("#preset")).to_have_value("MAS-40")
    expect(page.locator("#force")).to_be_visible()
    page.get_by_role("button", name="Undo: preset MAS-40").click()
    expect(page.locator("#preset")).to_have_value("DMSP-20")


def test_units_of_the_table(page: Page) -> None:
    open_catalogue(page)
    row = page.locator(".parts tr", has_text="Festo DMSP-20")
    expect(row).to_contain_text("20 mm")
    page.get_by_label("Units", exact=True).select_option("us")
    expect(row).to_contain_text("0.787 in")
    page.locator(".kinds button", has_text="Valves").click()
    flows = {text.partition("\xa0")[2] for text in page.locator(".parts td:last-child").all_inner_texts()}
    assert flows - {""} == {"ft³/min"}  # one source states that of its valve so, the others l/min
    page.set_viewport_size({"width": 390, "height": 844})
    assert run(page, SCROLLS) == []


@pytest.fixture
def broken_preset(server: RunningServer) -> Iterator[str]:
    """A user's preset file that is refused."""
    path = server.presets / "muscles" / "broken.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"schema": 1, "kind": "muscle", "id": "broken", "title": "Broken"}))
    yield path.name
    path.unlink()


def test_refused_files_are_named(page: Page, broken_preset: str) -> None:
    page.goto("about:blank")  # the page has asked for its presets before
    open_design(page)
    page.get_by_role("button", name="Catalogue", exact=True).click()
    expect(page.get_by_role("region", name="Refused files")).to_contain_text(broken_preset)
    expect(page.get_by_role("button", name="Festo DMSP-20", exact=True)).to_be_visible()


def test_the_atlas_shows_each_effect_and_puts_it_into_the_model(page: Page) -> None:
    load(page, "#effects")
    cards = page.locator(".atlas-grid > li")
    expect(cards.first.locator("svg")).to_be_visible(timeout=20_000)
    assert cards.count() > 40
    captions = "return [...document.querySelectorAll('.atlas-grid figcaption, .atlas-grid figure > small')]"
    lines = run(page, f"{captions}.filter((el) => el.checkVisibility()).map((el) => el.clientHeight);")
    assert lines
    assert max(lines) < 24  # one line each
    page.get_by_label("Search the catalogue").fill("coulomb")
    page.locator(".atlas-grid").get_by_role("button", name="Coulomb friction").click()
    detail = page.get_by_role("region", name="Effect", exact=True)
    figures = detail.locator(".pictures figure")
    expect(figures.locator("b")).to_have_text(["isobaric", "isotonic", "static", "transient"])
    expect(figures.first).to_contain_text("± 10 N", use_inner_text=True)
    with page.expect_response("**/api/signatures"):
        enter(page, "Force", "20")
    expect(figures.first).to_contain_text("± 20 N", use_inner_text=True)  # its own slider moves the picture
    twins = detail.locator(".twin-pair").first
    expect(twins.locator("svg.signature")).to_have_count(2)
    expect(twins.locator("p")).not_to_be_empty()
    assert violations(page, "[aria-label='Effect']") == []
    detail.get_by_role("button", name="Put it into my model").click()
    expect(page).to_have_title(re.compile("^Design"))
    expect(page.locator(".design [data-effect]", has_text="Coulomb friction")).to_be_visible()


@pytest.mark.examination("tests/frontend/test_catalogue.py::test_refused_files_are_named")
def test_what_is_kept_is_renamed_deleted_and_restored(page: Page, server: RunningServer) -> None:
    content = b"# kind: static\npressure_bar;length_mm;force_N\n1;300;100\n1;290;80\n1;280;50\n"
    answer = page.request.put(f"{server.url}/api/measurements?name=kept-run.csv", data=content)
    assert answer.ok
    open_catalogue(page)
    kept = page.get_by_role("region", name="Kept")
    expect(kept).to_contain_text("kept-run.csv")
    kept.get_by_role("button", name="Rename kept-run.csv").click()
    kept.get_by_role("textbox", name="New name").fill("kept bench 3.csv")
    page.keyboard.press("Enter")
    kept.get_by_role("button", name="Delete kept bench 3.csv").click()
    expect(kept).to_contain_text("Deleted “kept bench 3.csv”")
    kept.get_by_role("button", name="Undo").click()
    expect(kept.get_by_role("button", name="Delete kept bench 3.csv")).to_be_visible()
    assert not violations(page)
    kept.get_by_role("button", name="Delete kept bench 3.csv").click()
    expect(kept.get_by_text("Deleted (1)")).to_be_visible()
