"""The Design view: what an engineer does with it, from the first open to the exported file."""

from __future__ import annotations

import csv
import json
import math
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Download, Page, Route, expect

from tests.frontend.guard import PageGuard
from tests.frontend.views import (
    REFUSED,
    SIZES,
    add_effect,
    drawings,
    enter,
    field,
    link_of,
    marked,
    open_design,
    open_inputs,
    redrawn,
    rmse,
    run,
    settled,
)
from tests.running_server import RunningServer

pytestmark = pytest.mark.kept_page


def download(page: Page, item: str) -> Download:
    """Save something from the Export menu."""
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem").filter(has_text=item).click()
    return saved.value


def example(page: Page, title: str) -> None:
    """Open an example document."""
    page.get_by_role("button", name="Examples").click()
    page.get_by_role("menuitem").filter(has_text=title).click()
    expect(page.locator(".status")).to_contain_text(title)
    settled(page)


def test_first_open_shows_a_real_muscle_with_its_error(page: Page) -> None:
    open_design(page)
    expect(page.locator("#preset")).to_have_value("DMSP-20")
    expect(field(page, "Rest length")).to_have_value("300")
    expect(page.locator("#rmse")).to_contain_text("% of the largest")
    assert page.locator("#force .tracepoints .point").count() > 40
    assert page.locator("#force .js-line").count() == 6
    ideal = page.locator("#rmse .rmse").nth(1).locator("b").inner_text()
    assert rmse(page) < float(ideal.split()[0])


def test_the_whole_flow(page: Page, tmp_path: Path) -> None:
    open_inputs(page)
    page.locator("#preset").select_option("DMSP-10")
    expect(page.locator("#rmse")).to_contain_text("% of the largest")
    expect(page.get_by_label("Points to compare with")).to_have_value("martens-dmsp-10-250")

    # An order code sets preset and length; one that is not understood is named and changes nothing.
    line = page.get_by_label("Ask: muscle")
    line.fill("MAS-10-N-10O-AA-MCFK")
    line.press("Enter")
    expect(page.locator("#ask-said")).to_contain_text("N10O")
    expect(page.locator("#preset")).to_have_value("DMSP-10")
    line.fill("DMSP-20-310N-RM-CM")
    line.press("Enter")
    expect(page.locator("#preset")).to_have_value("DMSP-20")
    expect(field(page, "Rest length")).to_have_value("310")
    expect(page.locator("#ask-said")).to_be_empty()
    page.locator("#preset").select_option("DMSP-10")
    expect(page.locator("#rmse")).to_contain_text("% of the largest")

    # The angle changes the error; undo brings it back.
    enter(page, "Rest length", "25 cm")
    expect(field(page, "Rest length")).to_have_value("250")
    start = rmse(page)
    redrawn(page, lambda: enter(page, "Braid angle", "22°"))
    expect(page.locator("#rmse .rmse.first b")).not_to_contain_text(f"{start}")
    page.get_by_role("button", name="Undo: braid angle").click()
    expect(page.locator("#rmse .rmse.first b")).to_contain_text(f"{start}")
    page.keyboard.press("Control+Shift+Z")
    expect(field(page, "Braid angle")).to_have_value("22")

    # The link restores the state in another page.
    link = link_of(page)
    other = page.context.new_page()
    open_inputs(other, link)
    expect(field(other, "Braid angle")).to_have_value("22")
    expect(other.locator("#preset")).to_have_value("DMSP-10")
    other.close()

    # Units change what is shown, not what is meant.
    page.get_by_label("Units", exact=True).select_option("us")
    expect(field(page, "Rest length")).to_have_value("9.843")
    pounds = page.locator("#rmse .rmse.first b").inner_text()
    assert pounds.endswith("lbf")
    page.get_by_label("Units", exact=True).select_option("bar")

    table = list(csv.DictReader(Path(download(page, "Curves as CSV").path()).read_text().splitlines()))
    assert len(table) == 6 * 120
    assert float(table[0]["pressure [bar]"]) == pytest.approx(1.0)
    assert float(table[0]["length [mm]"]) == pytest.approx(250 * (1 + 0.03), rel=1e-3)
    assert {"force [N]", "stiffness [N/mm]", "volume [cm³]", "diameter [mm]"} <= set(table[0])

    saved = json.loads(Path(download(page, "Save JSON").path()).read_text())
    assert saved["schema"] == 1
    assert saved["design"]["muscle"]["values"]["braid_angle"] == pytest.approx(math.radians(22))
    copy = tmp_path / "design.json"
    copy.write_text(json.dumps({**saved, "design": {**saved["design"], "load": 321}}))
    page.get_by_role("button", name="Export").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem").filter(has_text="Open JSON").click()
    chooser.value.set_files(copy)
    expect(field(page, "Load")).to_have_value("321")


def test_a_file_that_is_no_document_is_refused_in_words(page: Page, tmp_path: Path) -> None:
    open_design(page)
    wrong = tmp_path / "wrong.json"
    wrong.write_text('{"schema": 9}')
    page.get_by_role("button", name="Export").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem").filter(has_text="Open JSON").click()
    chooser.value.set_files(wrong)
    expect(page.locator(".status")).to_contain_text("version 9")


@pytest.mark.examination("test_the_whole_flow")
def test_pictures_and_tables_are_saved(page: Page) -> None:
    open_design(page)
    svg = Path(download(page, "Plots as SVG").path()).read_text()
    assert svg.startswith("<svg")
    assert "Force (N)" in svg
    assert "contraction limit" in svg
    assert Path(download(page, "Plots as PNG").path()).read_bytes()[:4] == b"\x89PNG"
    menu = page.get_by_role("button", name="Stiffness: save or show as table")
    menu.click()
    page.get_by_role("menuitem", name="Show as table").click()
    dialog = page.get_by_role("dialog", name="Stiffness")
    expect(dialog.locator("thead")).to_contain_text("closed valve, 6 bar")
    expect(dialog.locator("tbody tr")).to_have_count(120)
    page.keyboard.press("Escape")
    menu.click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem", name="Save as CSV").click()
    assert Path(saved.value.path()).read_text().startswith("Contraction [%],6 bar [N/mm]")


def test_three_forms_of_one_geometry(page: Page) -> None:
    open_inputs(page)
    start = rmse(page)
    page.get_by_role("radio", name="Thread", exact=True).click()
    expect(field(page, "Turns")).not_to_have_value("")
    thread = float(field(page, "Thread length").input_value())
    assert thread == pytest.approx(300 / math.cos(math.radians(26.53)), rel=1e-3)
    page.get_by_role("radio", name="Rhombus").click()
    along, side = (float(field(page, name).input_value()) for name in ("Rhombi along", "Rhombus side"))
    assert 2 * along * side == pytest.approx(thread, rel=1e-3)
    # A changed number goes back to that of the preset's braid.
    redrawn(page, lambda: enter(page, "Rhombi along", "90"))
    redrawn(page, lambda: page.get_by_role("button", name="Reset Rhombi along").click())
    expect(field(page, "Rhombi along")).to_have_value(f"{along:g}")
    page.get_by_role("radio", name="Angle").click()
    expect(field(page, "Braid angle")).to_have_value("26.53")
    assert rmse(page) == pytest.approx(start, abs=0.1)


def test_own_geometry_starts_from_the_preset(page: Page) -> None:
    open_inputs(page)
    redrawn(page, lambda: page.locator("#preset").select_option(""))
    expect(field(page, "Braid diameter")).to_have_value("21.8")
    expect(page.get_by_label("Points to compare with")).to_have_value("none")
    expect(page.locator(".all-inputs .badge")).to_be_hidden()


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [("Braid angle", "60°", "neutral angle"), ("Rest length", "0 mm", "above 0")],
)
def test_messages_stand_at_the_field(
    page: Page, page_guard: PageGuard, name: str, text: str, words: str
) -> None:
    page_guard.allow(REFUSED)
    open_inputs(page)
    enter(page, name, text)
    expect(page.locator(".field.wrong .error")).to_contain_text(words)
    expect(field(page, name)).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".notice")).to_contain_text(words)
    page.get_by_role("button", name="Go to the field").click()
    expect(field(page, name)).to_be_focused()
    page.keyboard.press("Control+z")
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".notice")).to_be_hidden()


def test_an_entry_that_is_no_number_changes_nothing(page: Page) -> None:
    open_design(page)
    count = drawings(page)
    enter(page, "Load", "much")
    expect(page.locator("[data-field=load] .error")).to_contain_text("not a number")
    assert drawings(page) == count
    field(page, "Load").press("Escape")
    expect(field(page, "Load")).to_have_value("500")
    expect(page.locator("[data-field=load] .error")).to_be_hidden()


def test_changed_values_are_marked_and_reset(page: Page) -> None:
    open_inputs(page)
    mark = page.locator("[data-field=braid_angle]")
    redrawn(page, lambda: enter(page, "Braid angle", "24"))
    expect(mark).to_have_class("field changed")
    redrawn(page, lambda: page.get_by_role("button", name="Reset Braid angle").click())
    expect(field(page, "Braid angle")).to_have_value("26.53")
    redrawn(page, lambda: enter(page, "Braid angle", "24"))
    slider = page.get_by_role("slider", name="Braid angle slider")
    redrawn(page, lambda: slider.dispatch_event("dblclick"))
    expect(field(page, "Braid angle")).to_have_value("26.53")


def test_pressures_of_the_family(page: Page) -> None:
    open_inputs(page)
    chips = page.get_by_role("list", name="Pressures of the curves").get_by_role("listitem")
    page.get_by_label("Pressure to add").fill("250 kPa")
    redrawn(page, lambda: page.keyboard.press("Enter"))
    expect(chips).to_have_count(7)
    expect(page.locator("#force .js-line")).to_have_count(7)
    redrawn(page, lambda: page.get_by_role("button", name="Remove 1 bar").click())
    page.get_by_role("button", name="space evenly").click()
    enter(page, "How many", "3")
    redrawn(page, lambda: page.get_by_role("button", name="Use these").click())
    assert [text.strip() for text in chips.all_inner_texts()] == ["1", "3.5", "6"]


def test_effects_are_one_sentence_and_the_others_a_search_away(page: Page) -> None:
    open_design(page)
    listed = run(page, "return (await (await fetch('/api/effects')).json()).effects.map((e) => e.title);")
    chips = page.locator(".design [data-effect]")
    expect(chips).to_have_count(5)  # wall, prestress, lost stroke of the ends, friction, damping
    page.get_by_role("button", name="Add Ctrl K").click()
    expect(page.locator("#commands [role=option]")).to_have_count(len(listed) - 5)
    page.keyboard.press("Escape")
    own = rmse(page)
    redrawn(page, lambda: page.get_by_role("button", name="Ideal", exact=True).click())
    expect(chips).to_have_count(0)
    expect(page.get_by_role("heading", name="The model is the ideal braid")).to_be_visible()
    expect(page.locator("#rmse .rmse.first b")).not_to_contain_text(f"{own}")
    redrawn(page, lambda: page.get_by_role("button", name="Preset’s effects").click())
    expect(chips).to_have_count(5)
    expect(page.locator("#rmse .rmse.first b")).to_contain_text(f"{own}")


def test_the_loop_of_the_preset_is_drawn_and_in_figures(page: Page) -> None:
    open_design(page)
    page.get_by_text("Tables", exact=True).click()
    rows = page.get_by_role("region", name="Width of the loop at the load").locator("tbody tr")
    expect(rows).to_have_count(6)
    widths = [float(text) for text in rows.locator("td:nth-child(2)").all_inner_texts() if text != "–"]
    assert all(0.5 < width < 6.0 for width in widths)  # mm, of 300
    redrawn(page, lambda: page.get_by_role("button", name="Ideal", exact=True).click())
    expect(rows.nth(5).locator("td").nth(0)).to_have_text(re.compile(r"^0(\.0+)?$"))


def test_an_effect_is_found_by_its_cause_added_set_and_removed(page: Page) -> None:
    open_design(page)
    chip = add_effect(page, "narrower")  # a word of its cause, not of its name
    expect(chip).to_be_visible()
    title = str(chip.locator("button span").first.inner_text())
    chip.get_by_role("button").first.click()
    values = page.get_by_role("dialog").first
    entry = values.locator("input[type=text]").first
    entry.fill("99999")
    entry.press("Enter")
    expect(values.locator(".error").first).to_contain_text("must be")  # the bounds the server declares
    redrawn(page, lambda: entry.press("ArrowUp"))
    expect(values.locator(".field").first).to_have_class("field changed")
    values.get_by_role("button", name=f"About {title}").click()
    note = page.get_by_role("dialog").last
    expect(note.locator("math").first).to_be_visible()
    for heading in ("What it looks like in the residual", "Range", "References"):
        expect(note).to_contain_text(heading)
    page.keyboard.press("Escape")
    # The focus stays in the row when what had it goes.
    redrawn(
        page, lambda: page.get_by_role("button", name=re.compile(f"Remove {re.escape(title)}")).press("Enter")
    )
    expect(chip).to_have_count(0)
    assert page.evaluate("document.activeElement.closest('.effects-row') !== null")


def test_the_load_follows_line_and_field(page: Page) -> None:
    open_design(page)
    line = page.get_by_role("slider", name="Load line in the force plot")
    box = line.bounding_box()
    assert box
    page.mouse.move(box["x"] + 200, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + 200, box["y"] - 40, steps=5)
    page.mouse.up()
    moved = float(field(page, "Load").input_value())
    assert moved > 600
    assert re.match(
        r"Undo: load 500 → \d+\sN", str(page.locator(".history button").first.get_attribute("title"))
    )
    enter(page, "Load", "100 lbf")
    expect(line).to_have_attribute("aria-valuetext", "Load 445 N")
    # A mass stays a mass and says its weight; an expression is worked out.
    enter(page, "Load", "20 kg")
    expect(line).to_have_attribute("aria-valuetext", re.compile("^Load 20.kg = 196 N$"))
    expect(field(page, "Load")).to_have_value("20")
    enter(page, "Load", "20*9.81 N")
    expect(field(page, "Load")).to_have_value("196.2")


def test_the_cursor_is_linked_and_redraws_nothing(page: Page) -> None:
    open_design(page)
    count = drawings(page)
    page.locator("#stiffness").scroll_into_view_if_needed()
    box = page.locator("#stiffness").bounding_box()
    assert box
    page.mouse.move(box["x"] + 200, box["y"] + 100)
    expect(page.locator(".cursor:visible")).to_have_count(3)
    expect(page.locator(".readout")).to_contain_text("%")
    assert drawings(page) == count
    page.mouse.move(2, 500)
    expect(page.locator(".cursor:visible")).to_have_count(0)


def test_verdicts_name_the_limit(page: Page) -> None:
    open_design(page)
    expect(page.locator(".verdict").first).to_contain_text("Within all limits")
    redrawn(page, lambda: enter(page, "Load", "2 kN"))
    expect(page.locator(".verdict.bad")).to_contain_text("Outside the limits")
    expect(page.locator(".verdicts .flag.bad").first).to_be_visible()


def test_a_typed_question_is_answered_in_one_action(page: Page) -> None:
    """The figures of the card are those of the answer; what is not read is named."""
    open_design(page)
    page.keyboard.press("/")
    page.keyboard.type("How far does a DMSP-20 of 300 mm at 5 bar lift 20 kg, which pressure for 12 % soon?")
    redrawn(page, lambda: page.keyboard.press("Enter"))
    expect(page.locator("#ask-said")).to_have_text("Not read: “soon”.")
    lift = run(
        page,
        """
        const answer = await fetch("/api/curves", { method: "POST",
          headers: { "content-type": "application/json" },
          body: JSON.stringify({ muscle: { preset: "DMSP-20", nominal_length: 0.3 }, load: 20 * 9.80665,
            at_pressure: 5e5, at_contraction: 0.12, points: 2 }) });
        return (await answer.json()).lift;
        """,
    )
    expect(page.locator(".sentence")).to_contain_text(f"{lift['lift'] * 1e3:.1f}")
    expect(page.locator(".large b").nth(2)).to_contain_text(
        f"{lift['pressure_filling'] / 1e5:.2f}".rstrip("0")
    )
    expect(field(page, "Pressure")).to_have_value("5")
    enter(page, "for", "45 mm")  # a stroke from the rest length
    expect(field(page, "for")).to_have_value("15")
    for _ in range(2):
        page.get_by_role("button", name="Undo").click()
    expect(field(page, "Load")).to_have_value("500")
    expect(page.get_by_label("Ask: muscle")).to_have_value("DMSP-20 300 mm, 6 bar, 500 N, 15 %")


def test_the_load_is_the_third_tab_stop_of_the_view_and_groups_are_one(page: Page) -> None:
    open_design(page)
    page.locator("#main").focus()
    for _ in range(3):
        page.keyboard.press("Tab")
    expect(field(page, "Load")).to_be_focused()
    page.locator("#main").focus()
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowRight")
    expect(page.get_by_role("radio", name="Find a drive")).to_be_focused()
    expect(page.get_by_role("radio", name="Find a drive")).to_be_checked()


@pytest.mark.parametrize("load", ["500 N", "20 kg"])
def test_the_view_fits_a_screen_of_1440_by_900(page: Page, load: str) -> None:
    page.set_viewport_size({"width": 1440, "height": 900})
    open_design(page)
    settled(page)
    enter(page, "Load", load)
    assert run(page, "return document.documentElement.scrollHeight") <= 900


def test_no_name_of_a_line_is_lost(page: Page) -> None:
    open_design(page)
    lines = {"force": 6, "stiffness": 2, "volume": 2, "over-pressure": 2}
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        for plot, count in lines.items():
            expect(page.locator(f"#{plot} .labels span:not(.zone)")).to_have_count(count)


def test_nothing_moves_when_the_answer_comes(page: Page) -> None:
    page.set_viewport_size({"width": 1440, "height": 900})
    held: list[Route] = []
    page.route("**/api/curves", lambda route: held.append(route))
    page.goto("about:blank")
    page.goto("/")
    expect(page.locator(".effects-row .chip").first).to_be_visible()
    places = """
      const all = [".answer-card", ".sureness", "#force", "#stiffness", ".effects-row", ".tables"];
      return all.map((what) => Math.round(document.querySelector(what).getBoundingClientRect().top));
    """
    before = run(page, places)
    page.unroute_all()  # lets them go
    assert held
    marked(page, "[data-drawn]")
    settled(page)
    assert run(page, places) == before


@pytest.fixture
def no_presets_left(server: RunningServer) -> Iterator[None]:
    """The server is shared by all tests: what one saves is gone before the next."""
    yield
    for path in server.presets.rglob("DMSP-20-*.json"):
        path.unlink()


@pytest.mark.examination("tests/frontend/test_catalogue.py::test_refused_files_are_named")
@pytest.mark.usefixtures("no_presets_left")
def test_save_as_my_preset(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("status of 4")
    open_inputs(page)
    redrawn(page, lambda: enter(page, "Braid angle", "26"))
    page.get_by_role("button", name="Save as my preset…").click()
    page.get_by_label("Id", exact=True).fill("DMSP-20")
    page.get_by_role("button", name="Save", exact=True).click()
    expect(page.get_by_role("dialog").get_by_role("alert")).not_to_be_empty()  # a built-in id stays as it is
    page.get_by_label("Id", exact=True).fill("DMSP-20-mine")
    page.get_by_role("button", name="Save", exact=True).click()
    expect(page.locator("#preset")).to_have_value("DMSP-20-mine")
    expect(field(page, "Braid angle")).to_have_value("26")
    # A second one stands beside the first, and the muscles of the maker stay where they were.
    page.get_by_role("button", name="Save as my preset…").click()
    page.get_by_label("Id", exact=True).fill("DMSP-20-second")
    page.get_by_role("button", name="Save", exact=True).click()
    expect(page.locator("#preset")).to_have_value("DMSP-20-second")
    mine = page.locator("#preset optgroup[label='My presets'] option")
    assert {"DMSP-20-mine", "DMSP-20-second"} <= {option.get_attribute("value") for option in mine.all()}
    for id in ("DMSP-20", "DMSP-20-mine"):
        expect(page.locator(f"#preset option[value='{id}']")).to_have_count(1)


FIGURES = ["5", "6", "7", "9", "10a", "10b", "11a", "11b", "12a", "12b", "13"]


@pytest.mark.examination(
    "tests/test_scenarios.py::test_its_figures_are_the_printed_ones_within_their_tolerance"
)
def test_the_figures_of_the_paper(page: Page) -> None:
    page.goto("about:blank")  # as it opens, whatever the page showed before
    open_design(page)
    for figure in FIGURES:
        example(page, f"Figure {figure}:")
        expect(page.locator(".notice")).to_be_hidden()
        expect(page.locator("#force .js-line").nth(2)).to_be_attached()
        expect(page.locator("#over-pressure .js-line")).to_have_count(2)

    # Figure 9 has the printed forces.
    example(page, "Figure 9:")
    page.get_by_text("Tables", exact=True).click()
    rows = page.get_by_role("region", name="Characteristics per pressure").locator("tbody tr")
    expect(rows.locator("td:first-of-type")).to_have_text(["64", "193", "386"])
    note = page.get_by_role("region", name="Example")
    expect(note).to_contain_text("They are no data to validate against.")
    table = list(csv.DictReader(Path(download(page, "Curves as CSV").path()).read_text().splitlines()))
    first = [float(row["force [N]"]) for row in table if float(row["contraction [%]"]) == 0]
    assert first == pytest.approx([64.39, 193.16, 386.31], abs=0.01)


@pytest.mark.examination("test_the_whole_flow")
def test_the_stiffness_has_three_definitions(page: Page) -> None:
    open_design(page)
    choice = page.get_by_label("Definition of the stiffness", exact=True)
    plot = page.locator("section.stiffness")
    expect(plot.locator(".labels")).to_contain_text("valve open")
    redrawn(page, lambda: choice.select_option("secant"))
    expect(plot.locator(".labels")).to_contain_text("secant")
    expect(choice).to_have_attribute("title", re.compile(r"^F/\(L − L_free\)"))
    other = page.context.new_page()
    open_design(other, link_of(page))
    expect(other.get_by_label("Definition of the stiffness", exact=True)).to_have_value("secant")
    other.close()
    choice.select_option("from_force")
    expect(plot.locator(".labels")).to_contain_text("of the force")
    table = csv.DictReader(download(page, "Curves as CSV").path().read_text(encoding="utf-8").splitlines())
    assert any("stiffness_from_force" in name for name in table.fieldnames or [])


def test_points_over_the_braid_angle_lie_on_the_curves_of_a_braid_that_stretches(page: Page) -> None:
    """A braid that stretches has another angle than its geometry at rest says; the server's holds."""
    open_design(page)
    found = page.evaluate(
        """async () => {
          const { acrossAt } = await import(new URL("js/muscle/curve-axes.js", document.baseURI).href);
          const answer = await fetch("/api/curves", { method: "POST",
            headers: { "content-type": "application/json" },
            body: JSON.stringify({ muscle: { preset: "DMSP-20" }, effects: { thread_extensibility: {} },
              pressures: [6e5], points: 20 }) });
          const c = await answer.json(), at = (k) => acrossAt(c, "braid_angle", k);
          return { columns: c.contraction.map(at), angles: c.braid_angle, rest: c.geometry.braid_angle,
            zero: at(0), middle: at((c.contraction[3] + c.contraction[4]) / 2), beside: at(0.9) };
        }"""
    )
    assert found["columns"] == pytest.approx(found["angles"], rel=1e-12)
    assert found["middle"] == pytest.approx(sum(found["angles"][3:5]) / 2)
    assert found["zero"] > found["rest"] + 1e-4  # a longer thread at the same length
    assert found["beside"] is None


def test_moved_lines_are_where_plotly_draws_them(page: Page) -> None:
    """The quick redraw of a moving slider and Plotly's own drawing of the same data agree to a pixel."""
    open_inputs(page)
    shapes = """
      const numbers = (text) => text.match(/-?[\\d.]+/g).map(Number);
      const all = (what, name) =>
        [...document.querySelectorAll(what)].map((el) => numbers(el.getAttribute(name)));
      const lines = all("#force .js-line, #volume .js-line", "d");
      const ends = lines.map((n) => [...n.slice(0, 2), ...n.slice(-2)]);
      const dots = all("#force .point", "transform").map((n) => n.slice(0, 2));
      return [...ends.flat(), ...dots.flat()];
    """
    redrawn(page, lambda: enter(page, "Braid angle", "26.2"))
    quick = run(page, shapes)
    page.wait_for_timeout(900)
    settled = run(page, shapes)
    assert len(quick) == len(settled) > 30
    assert max(abs(a - b) for a, b in zip(quick, settled, strict=True)) < 0.5


def test_the_muscle_is_taken_along(page: Page) -> None:
    open_design(page)
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem").filter(has_text="Take it along").click()
    dialog = page.get_by_role("dialog", name="Take it along")
    expect(dialog.get_by_role("button", name="C99")).to_be_focused()
    expect(dialog.get_by_role("button", name="Linear models")).to_have_count(0)  # of drives only
    with page.expect_download() as saved:
        page.keyboard.press("Enter")
    assert saved.value.suggested_filename == "dmsp_20_300_mm.zip"
    with zipfile.ZipFile(saved.value.path()) as archive:
        assert archive.namelist() == ["dmsp_20_300_mm.c", "dmsp_20_300_mm.h"]
        assert "static const double nominal_length = 0.3;" in archive.read("dmsp_20_300_mm.c").decode()
    expect(dialog).not_to_be_visible()
    expect(page.locator(".status")).to_contain_text("Saved dmsp_20_300_mm.zip")
