"""The Task side of the Design view: from an empty page to a printed report, and everything on the way."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, Route, expect

from mckibben.application.json_text import to_json
from mckibben.application.size.size import prepare, sizing_question
from mckibben.documents.task import SizingTask
from mckibben.resources import presets_folder
from mckibben.simulation.integrate.many import lane_kernels
from tests.frontend.axe import violations
from tests.frontend.guard import PageGuard
from tests.frontend.test_layout import OVERLAPS, SIDEWAYS, TOO_SMALL
from tests.frontend.views import REFUSED, SIZES, enter, field, link_of, load, marked, run
from tests.looks import Looks
from tests.shipped import shipped_studio

pytestmark = pytest.mark.kept_page

GRAVITY = 9.80665  # m/s^2
ACTIONS = 12


def open_task(page: Page, link: str = "") -> None:
    """The Task side of a fresh page, or of a link that says so."""
    load(page, link)
    if not link:
        page.get_by_role("radio", name="Find a drive", exact=True).click()
    expect(page.locator(".task-head")).to_be_visible(timeout=20_000)
    expect(page.locator(".parts-choice input").first).to_be_attached()


def example(page: Page, title: str) -> None:
    """Load an example task."""
    page.get_by_role("button", name="Examples of tasks").click()
    page.get_by_role("menuitem").filter(has_text=title).click()
    expect(page.locator(".status")).to_contain_text(title)


def unfold(page: Page) -> None:
    """Open every card and part that is collapsed."""
    page.evaluate("document.querySelectorAll('.sizing details').forEach((el) => { el.open = true; })")


def propose_button(page: Page) -> Locator:
    """That in the head of the task, which is there at all times."""
    return page.locator(".task-head").get_by_role("button", name="Propose drives")


def searched(page: Page) -> tuple[dict[str, Any], dict[str, Any]]:
    """Propose and wait for the drives on screen; what was asked for, and the answer that came."""
    with page.expect_request("**/api/sizings") as sent:
        propose_button(page).click()
    marked(page, '[data-sizing="done"]', 180_000)
    answer = run(page, "return (await import('/js/views/sizing/model.js')).answer.peek();")
    return json.loads(sent.value.post_data or ""), answer


def rows(page: Page) -> Locator:
    """One for each proposal."""
    return page.locator(".proposals tr.proposal")


def number(text: str) -> float:
    """The number a text starts with."""
    found = re.match(r"[\d.,]+", text.strip())
    assert found, text
    return float(found[0].replace(",", ""))


def fact(page: Page, name: str) -> str:
    """A figure of the chosen proposal."""
    return page.locator(".chosen-drive dt", has_text=re.compile(f"^{name}$")).locator("+ dd").inner_text()


def stored(page: Page) -> dict[str, Any]:
    """The document of the page."""
    return run(page, "return (await import('/js/state.js')).doc.peek();")


def test_from_the_empty_page_to_the_printed_report(page: Page, tmp_path: Path) -> None:
    page.goto("/")
    actions = 0

    def act(do: Callable[[], object]) -> None:
        nonlocal actions
        actions += 1
        do()

    act(lambda: page.get_by_role("radio", name="Find a drive", exact=True).click())
    expect(page.locator(".empty-state")).to_contain_text("An example is filled in")
    act(lambda: page.get_by_role("button", name="Examples of tasks").click())
    act(lambda: page.get_by_role("menuitem").filter(has_text="Lift 20 kg").click())
    act(lambda: enter(page, "Mass", "18 kg"))
    act(lambda: enter(page, "Stroke", "5 cm"))
    act(lambda: searched(page))
    expect(page.locator(".chosen-drive")).to_contain_text("simulated specimens reach the end in time")
    drive = page.locator(".chosen-drive h3").first.inner_text()
    time = number(fact(page, "Time for the stroke"))

    with page.expect_download(timeout=180_000) as saved:
        act(lambda: page.get_by_role("button", name="Report", exact=True).click())
    assert saved.value.suggested_filename.endswith(".html")
    paper = page.context.new_page()
    act(lambda: paper.set_content(saved.value.path().read_text("utf-8")))
    paper.emulate_media(media="print")
    paper.set_viewport_size({"width": 680, "height": 998})  # what A4 leaves inside the margins, in CSS px
    answer = paper.locator("section").first.bounding_box()
    assert answer
    assert answer["y"] + answer["height"] < 998  # the answer is on the first page
    heading = "Lift 18 kg by 50 mm in 0.5 s, with 6 bar"  # of the example as it was changed
    expect(paper.locator("h1")).to_have_text(heading)
    expect(page.locator(".proposals .of-task")).to_have_text(heading)
    for text in ("18", "50 mm", drive.split(",")[0].split(" ")[-1]):
        expect(paper.locator("body")).to_contain_text(text)
    pdf = tmp_path / "report.pdf"
    act(lambda: paper.pdf(path=pdf, format="A4"))
    assert pdf.read_bytes().startswith(b"%PDF")
    paper.close()

    with page.expect_response("**/api/simulations") as simulated:
        act(lambda: page.get_by_role("button", name="Open in Transient").click())
    extend = simulated.value.json()["timing"]["extend"]
    assert extend["positioning_time"] == pytest.approx(time, rel=0.01)
    expect(page.locator("#drive-muscle")).to_contain_text(drive.split(", ")[1])
    assert actions <= ACTIONS, actions


def test_a_typed_task_is_searched_sorted_and_two_drives_are_compared(page: Page) -> None:
    """The list sorts by any column; two ticks show what differs; a load that hangs is drawn so."""
    page.goto("/")
    marked(page, "[data-drawn]")
    page.keyboard.press("/")
    page.keyboard.type("lift 20 kg by 60 mm in 0.5 s, 6 bar, 600 mm of room")
    page.keyboard.press("Enter")
    marked(page, '[data-sizing="done"]', 180_000)
    expect(page.locator("#ask-said")).to_be_empty()
    proposals = run(page, "return (await import('/js/views/sizing/model.js')).proposals.peek();")
    table = page.get_by_role("region", name="Ranked drives")
    for key, name in (("time", "Time for the stroke"), ("air_volume_anr", "Air per cycle")):
        head = table.get_by_role("button", name=name)
        head.click()
        order = sorted(range(len(proposals)), key=lambda i: proposals[i][key])
        shown = [int(text.strip()) - 1 for text in table.locator(".rank").all_inner_texts()]
        assert [proposals[i][key] for i in shown] == [proposals[i][key] for i in order]
        expect(head).to_be_focused()
    expect(table.locator("th[aria-sort=ascending]")).to_have_count(1)
    page.get_by_role("checkbox", name="Compare proposal 1", exact=True).check()
    page.get_by_role("checkbox", name="Compare proposal 2", exact=True).check()
    card = page.get_by_role("region", name="Difference")
    gap = card.locator("tr", has_text="Time for the stroke").locator("td").last
    slower = proposals[1]["time"] > proposals[0]["time"]
    expect(gap).to_have_class("worse" if slower else "better")
    expect(page.locator(".mounting.hanging")).to_be_visible()


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_the_list_says_what_the_server_found(page: Page) -> None:
    open_task(page)
    asked, _ = searched(page)
    response = page.request.post("/api/sizings", data=asked, timeout=180_000)  # beside the page
    proposals = response.json()["proposals"]
    expect(rows(page)).to_have_count(len(proposals))
    for i, p in enumerate(proposals):
        row = rows(page).nth(i)
        expect(row.locator(".drive")).to_contain_text(p["muscle"])
        expect(row).to_contain_text(p["valve"])
        cells = row.locator("td").all_inner_texts()
        assert cells[0] == str(i + 1)
        assert number(cells[1]) == pytest.approx(p["time"], rel=0.01)
        assert number(cells[2]) == pytest.approx(100 * p["probability"], abs=0.51)
        assert number(cells[3]) == pytest.approx(1e3 * p["air_volume_anr"], rel=0.01)
        assert number(cells[4]) == pytest.approx(p["impact_energy"], rel=0.01, abs=0.01)
        assert number(cells[5]) == pytest.approx(100 * p["force_reserve"], abs=0.51)
        expect(row.locator("td.doubtful")).to_have_count(bool(p["reservations"]) + (p["probability"] < 0.5))
        expect(row.locator(".doubt")).to_have_count(1 if p["unverified"] else 0)

    expect(page.locator(".proposals .ranking")).to_have_text(response.json()["ranking"])
    # The prefilled task and the example of the same name are the same task.
    preset = json.loads((presets_folder() / "tasks" / "lift-20kg.json").read_text("utf-8"))["document"]
    completed = [SizingTask.model_validate(task).completed() for task in (asked, preset)]
    assert completed[0] == completed[1]

    page.get_by_role("button", name="Reasons for proposal 2", exact=True).click()
    more = page.locator(".proposals .more")
    expect(more).to_contain_text(proposals[1]["reason"][1:])
    expect(more.locator(".margins > div")).to_have_count(len(proposals[1]["margins"]))
    expect(more.locator(".margins .binding")).to_have_count(1)
    expect(more).to_contain_text("Pressure at lift-off")

    rows(page).nth(2).locator(".drive").click()
    expect(page.locator(".chosen-drive h2")).to_have_text(f"Proposal 3 of {len(proposals)}")
    assert number(fact(page, "Impact energy of the stroke")) == pytest.approx(
        proposals[2]["impact_energy_stroke"], rel=0.01, abs=0.01
    )
    assert number(fact(page, "Installed length")) == pytest.approx(
        1e3 * proposals[2]["installed_length"], rel=0.01
    )
    badge = page.locator(".chosen-drive .badge")
    badge.click()
    expect(page.get_by_role("dialog", name="Unverified values")).to_contain_text(proposals[2]["valve"])


def test_an_example_that_was_changed_is_headed_by_its_own_figures(page: Page) -> None:
    open_task(page)
    example(page, "Too fast")
    expect(page.get_by_label("Name of the task")).to_have_value("")
    enter(page, "Mass", "5000 kg")
    searched(page)
    own = "Lift 5000 kg by 80 mm in 0.15 s, with 6 bar"
    expect(page.get_by_role("region", name="No drive").locator(".of-task")).to_have_text(own)
    page.get_by_label("Name of the task").fill("Press 3")
    page.get_by_label("Name of the task").blur()
    searched(page)
    expect(page.get_by_role("region", name="No drive").locator(".of-task")).to_have_text(f"Press 3: {own}")


def test_a_search_whose_time_is_over_shows_the_drives_found_so_far(page: Page) -> None:
    lane_kernels.warm().join()
    studio, looks = shipped_studio(), [3, 1]

    def ended(route: Route) -> None:
        question = sizing_question(SizingTask.model_validate_json(route.request.post_data or ""), studio)
        found = to_json(prepare(question)(Looks(looks.pop(0)))).decode()
        route.fulfill(content_type="text/event-stream", body=f"event: done\ndata: {found}\n\n")

    open_task(page)
    page.route("**/api/sizings", ended)
    _, answer = searched(page)
    assert answer["outcome"] == "timed_out"
    expect(rows(page)).to_have_count(len(answer["proposals"]))
    expect(page.locator(".proposals .card-head")).to_contain_text("found so far")
    expect(page.locator(".ranked .notice")).to_contain_text(
        "Partial result. The limit of 7 s of processor time ended the search"
    )
    expect(page.locator(".chosen-drive")).to_contain_text("is not known: no specimens were simulated")
    expect(page.locator(".status")).to_contain_text("found so far")
    searched(page)
    empty = page.get_by_role("region", name="No drive")
    expect(empty).to_contain_text("None of the drives that were tried can do this")
    expect(page.locator(".ranked .notice")).to_contain_text("before any drive was simulated")
    expect(page.locator("body")).not_to_contain_text("No drive in the catalogue")
    page.unroute("**/api/sizings", ended)


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_trade_offs(page: Page) -> None:
    open_task(page)
    _, answer = searched(page)
    proposals = answer["proposals"]
    marks = page.locator(".rank-mark")
    expect(marks).to_have_count(len(proposals))
    front = [p["front"] for p in proposals]  # said by the list and by the plot, of the same drives
    assert [row.locator(".front-mark").count() == 0 for row in rows(page).all()] == front
    assert [bool(re.search(r"\bfront\b", mark.get_attribute("class") or "")) for mark in marks.all()] == front
    page.get_by_label("Aim on the vertical axis").select_option("stiffness")
    page.get_by_label("Aim on the horizontal axis").select_option("length")
    expect(page.locator("#pareto .xtitle")).to_have_text("Installed length (mm)")
    expect(page.locator("#pareto .ytitle")).to_have_text("Stiffness at the load, valve open (N/mm)")
    marks.nth(3).focus()
    page.keyboard.press("Enter")
    expect(page.locator(".chosen-drive h2")).to_contain_text("Proposal 4")
    expect(marks.nth(3)).to_have_attribute("aria-pressed", "true")
    expect(marks.nth(3)).to_be_focused()
    # No number lies on another, whatever the axes.
    boxes = [box for box in (mark.bounding_box() for mark in marks.all()) if box]
    assert len(boxes) == len(proposals)
    gaps = [math.hypot(a["x"] - b["x"], a["y"] - b["y"]) for i, a in enumerate(boxes) for b in boxes[:i]]
    assert min(gaps) > 20.0


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_open_in_design_is_one_step(page: Page) -> None:
    open_task(page)
    _, answer = searched(page)
    best = answer["proposals"][0]
    before = stored(page)["design"]
    page.get_by_role("button", name="Open in Design").click()
    expect(page.get_by_role("radio", name="Muscle", exact=True)).to_have_attribute("aria-checked", "true")
    expect(page.locator("#preset")).to_have_value(best["muscle"])
    design = stored(page)["design"]
    assert design["muscle"]["values"]["nominal_length"] == pytest.approx(best["nominal_length"])
    assert max(design["pressures"]) == pytest.approx(best["pressure"])
    # A hanging mass that parallel muscles share evenly.
    assert design["load"] == pytest.approx(20 * GRAVITY / best["parallel"], rel=1e-3)
    page.keyboard.press("Control+z")
    expect(page.locator(".chosen-drive")).to_be_visible()
    assert stored(page)["design"] == before


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_a_lever_and_a_pair(page: Page) -> None:
    open_task(page)
    page.get_by_role("radio", name="Lever", exact=True).click()
    enter(page, "Lever ratio", "0.4")
    asked, answer = searched(page)
    assert asked["load"]["lever_ratio"] == pytest.approx(0.4)
    best = answer["proposals"][0]
    page.get_by_role("button", name="Open in Design").click()
    # What a lever takes from the stroke it adds to the force.
    assert stored(page)["design"]["load"] == pytest.approx(20 * GRAVITY / 0.4 / best["parallel"], rel=1e-3)

    page.get_by_role("radio", name="Find a drive", exact=True).click()
    page.get_by_role("radio", name="Antagonist", exact=True).click()
    expect(field(page, "Stroke")).to_have_count(0)
    enter(page, "Angle", "1 rad")
    asked, _ = searched(page)
    assert set(asked["load"]) == {"pair"}
    assert asked["load"]["pair"]["angle"] == pytest.approx(1.0)
    assert "stroke" not in asked
    expect(rows(page).first).to_contain_text("pulley of")
    page.get_by_role("radio", name="Lift", exact=True).click()
    expect(field(page, "Mass")).to_have_value("20")  # what the pair had no use for is still there


def test_nothing_does_it(page: Page) -> None:
    open_task(page)
    example(page, "Too fast")
    _, answer = searched(page)
    rejected = answer["rejected"]
    expect(page.locator(".ranked")).to_contain_text("No drive in the catalogue can do this")
    expect(rows(page)).to_have_count(0)
    first = page.locator(".rejected li").first
    expect(first).to_contain_text(rejected[0]["muscle"])
    expect(first).to_contain_text(rejected[0]["why"][1:])
    expect(first).to_contain_text(f"Would work with {rejected[0]['would_work_if']}")
    shown = page.locator(".rejected li").count()
    page.get_by_role("button", name=re.compile("^Show .* more")).click()
    assert page.locator(".rejected li").count() > shown


@pytest.mark.parametrize(
    ("name", "text", "path", "says"),
    [
        ("Mass", "-3 kg", "load.mass", "at least 0 kg"),
        ("Largest contraction", "90 %", "limits.max_contraction", "at most 0.6"),
        ("Average speed", "0.1 m/s", "speed", "not both"),
    ],
)
def test_errors_stand_at_the_field(
    page: Page, page_guard: PageGuard, name: str, text: str, path: str, says: str
) -> None:
    page_guard.allow(REFUSED)
    open_task(page)
    unfold(page)
    enter(page, name, text)
    page.evaluate("document.querySelectorAll('.sizing details').forEach((el) => { el.open = false; })")
    propose_button(page).click()
    box = page.locator(f'.sizing [data-field="{path}"]')
    expect(box.locator(".error")).to_contain_text(says, timeout=20_000)
    expect(box.locator("input")).to_be_visible()  # what was folded is open
    page.get_by_role("button", name="Go to the field").click()
    expect(box.locator("input")).to_be_focused()
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(page.locator(".sizing .notice.bad")).to_have_count(0)


def test_wrong_units_and_rows_are_told_before_the_server_is_asked(page: Page) -> None:
    open_task(page)
    enter(page, "Stroke", "6 bar")
    expect(page.locator('[data-field="stroke"] .error')).to_contain_text("this is a length")
    unfold(page)
    area = page.locator("#force-over-stroke")
    area.fill("0 100\n30")
    area.blur()
    expect(page.locator('[data-field="load.force_over_stroke"] .error')).to_contain_text("Row 2")
    area.fill("0 100\n30; 120,5")
    area.blur()
    profile = stored(page)["sizing"]["task"]["load"]["force_over_stroke"]
    assert profile == {"strokes": [0, pytest.approx(0.03)], "forces": [100, pytest.approx(120.5)]}


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_cancel_keeps_what_was_there(page: Page) -> None:
    open_task(page)
    searched(page)
    found = rows(page).count()
    unfold(page)
    page.locator(".parts-choice").nth(1).get_by_role("checkbox").nth(1).check()
    enter(page, "Specimens", "5000")
    expect(page.locator(".notice")).to_contain_text("The task has changed")
    field(page, "Mass").press("Control+Enter")
    expect(page.get_by_role("progressbar")).to_be_visible()
    page.locator(".searching").get_by_role("button", name="Cancel").click()
    marked(page, '[data-sizing="cancelled"]')
    expect(page.get_by_role("progressbar")).to_have_count(0)
    expect(rows(page)).to_have_count(found)
    expect(page.locator(".notice")).to_contain_text("The task has changed")
    # The server is free again: the next search is answered.
    enter(page, "Specimens", "0")
    searched(page)
    expect(page.locator(".chosen-drive")).to_contain_text("no specimens were simulated")


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_undo_brings_back_task_and_drives(page: Page) -> None:
    open_task(page)
    searched(page)
    first = rows(page).first.inner_text()
    enter(page, "Mass", "35 kg")
    expect(page.locator(".ranked .stale")).to_have_count(2)  # the list and the place of “no drive”
    searched(page)
    assert rows(page).first.inner_text() != first
    page.keyboard.press("Control+z")
    expect(field(page, "Mass")).to_have_value("20")
    expect(page.locator(".ranked .stale")).to_have_count(0)
    assert rows(page).first.inner_text() == first
    page.keyboard.press("Control+Shift+z")
    expect(field(page, "Mass")).to_have_value("35")


def test_a_link_restores_the_task_and_an_old_one_still_opens(page: Page) -> None:
    open_task(page)
    example(page, "Joint of two")
    enter(page, "Torque", "1.5")
    unfold(page)
    page.locator("#rank-by").select_option("time")
    document, link = stored(page), link_of(page)
    open_task(page, link)
    expect(field(page, "Torque")).to_have_value("1.5")
    expect(page.get_by_role("radio", name="Antagonist")).to_have_attribute("aria-checked", "true")
    expect(page.locator("#rank-by")).to_have_value("time")
    assert stored(page)["sizing"] == document["sizing"]

    del document["sizing"]
    page.goto("about:blank")
    page.goto("/" + run_hash(page, document))
    expect(page.locator("#preset")).to_be_visible()
    expect(page.get_by_role("radio", name="Muscle", exact=True)).to_have_attribute("aria-checked", "true")


def run_hash(page: Page, document: dict[str, Any]) -> str:
    """The link of a document."""
    page.goto("/")
    return run(page, "return (await import('/js/link.js')).toHash(argument);", document)


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_the_drives_survive_a_look_at_another_view(page: Page) -> None:
    open_task(page)
    propose_button(page).click()
    page.get_by_role("button", name="Catalogue", exact=True).click()
    marked(page, '[data-sizing="done"]', 180_000)
    expect(page.locator(".status")).to_contain_text("found; first")
    page.get_by_role("button", name="Design", exact=True).click()
    expect(rows(page).first).to_be_visible()
    link_of(page)
    page.reload()
    expect(rows(page).first).to_be_visible()


def test_parts_that_may_be_used(page: Page) -> None:
    open_task(page)
    muscles = page.locator('[data-field="catalogue.muscles"]')
    catalogue = page.get_by_role("region", name="Catalogue")
    expect(catalogue.locator("summary small").first).to_have_text("3 muscles, MPYE-5-1/8-HF")
    catalogue.locator("summary").first.click()
    muscles.locator("summary").click()
    for name in ("DMSP-10", "DMSP-20", "DMSP-40"):  # those of the example
        muscles.get_by_role("checkbox", name=re.compile(f"^{name}")).uncheck()
    expect(muscles.locator("summary")).to_contain_text("all with complete data")
    muscles.get_by_role("checkbox", name=re.compile("^DMSP-20")).check()
    expect(muscles.locator("summary")).to_contain_text("DMSP-20")
    asked, _ = searched(page)
    assert asked["catalogue"]["muscles"] == ["DMSP-20"]
    drives = rows(page).locator(".drive").all_inner_texts()
    assert drives
    assert all("DMSP-20" in drive for drive in drives)
    muscles.get_by_role("checkbox", name=re.compile("^DMSP-20")).uncheck()
    expect(muscles.locator("summary")).to_contain_text("all with complete data")
    assert "muscles" not in stored(page)["sizing"]["task"]["catalogue"]


def leaves(schema: dict[str, Any], definitions: dict[str, Any], path: str = "") -> dict[str, Any]:
    """Path of each field of a task -> its default; None where there is none."""
    found: dict[str, Any] = {}
    for name, part in schema["properties"].items():
        here = f"{path}.{name}" if path else name
        refs = [p["$ref"] for p in (part, *part.get("anyOf", [])) if "$ref" in p]
        inner = definitions[refs[0].rpartition("/")[2]] if refs else None
        if inner is None or here == "load.force_over_stroke":
            found[here] = part.get("default")
        else:
            found |= leaves(inner, definitions, here)
    return found


def test_every_field_of_a_task_has_its_default_and_a_reason(page: Page) -> None:
    schema = SizingTask.model_json_schema()
    fields = leaves(schema, schema["$defs"])
    del fields["schema"], fields["kind"], fields["operation.currency"]  # not of the page
    open_task(page)
    usual = run(
        page,
        """
        const { fieldOf, USUAL_RANKING } = await import('/js/views/sizing/specs.js');
        const own = argument.map((path) => [path, fieldOf(path).default]);
        return Object.fromEntries([...own, ["rank_by", USUAL_RANKING]]);
        """,
        [path for path in fields if path != "title"],
    )
    assert usual == {path: default for path, default in fields.items() if path != "title"}

    shown: set[str] = set()
    for arrangement in ("Antagonist", "Lever"):
        page.get_by_role("radio", name=arrangement, exact=True).click()
        shown |= set(
            run(
                page,
                """
                const boxes = [...document.querySelectorAll(".sizing [data-field]")];
                const told = (el) => (el.closest(".task-field") ?? el).querySelector(".hint")?.textContent;
                return boxes.filter((el) => el.dataset.field === "title" || told(el))
                  .map((el) => el.dataset.field);
                """,
            )
        )
    assert shown == set(fields)


@pytest.mark.examination("test_a_link_restores_the_task_and_an_old_one_still_opens")
def test_the_task_can_be_saved_for_the_command_line_and_opened(page: Page) -> None:
    open_task(page)
    asked, _ = searched(page)
    page.get_by_role("button", name="Proposals: save").click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem").filter(has_text="Task as JSON").click()
    document = json.loads(Path(saved.value.path()).read_text("utf-8"))
    assert document == {"schema": 1, **asked}
    SizingTask.model_validate(document)
    enter(page, "Mass", "31")
    page.get_by_role("button", name="Export").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem").filter(has_text="Open JSON").click()
    chooser.value.set_files(saved.value.path())
    expect(field(page, "Mass")).to_have_value("20")
    page.get_by_role("button", name="Proposals: save").click()
    with page.expect_download() as table:
        page.get_by_role("menuitem").filter(has_text="Proposals as CSV").click()
    assert len(Path(table.value.path()).read_text("utf-8").splitlines()) == 1 + rows(page).count()


@pytest.mark.examination("test_from_the_empty_page_to_the_printed_report")
def test_whatever_leads_to_the_muscle_shows_the_muscle(page: Page) -> None:
    open_task(page)
    page.get_by_role("button", name="Examples", exact=True).click()
    page.get_by_role("menuitem").first.click()
    expect(page.locator("#preset")).to_be_visible()
    page.get_by_role("radio", name="Find a drive", exact=True).click()
    page.get_by_role("button", name="Catalogue", exact=True).click()
    page.get_by_role("button", name="Use in design").click()
    expect(page.locator("#preset")).to_be_visible()
    page.get_by_role("radio", name="Find a drive", exact=True).click()
    page.get_by_role("button", name="Transient", exact=True).click()
    page.get_by_role("button", name="Change in Design").click()
    expect(page.locator("#preset")).to_be_visible()


@pytest.mark.examination("test_a_link_restores_the_task_and_an_old_one_still_opens")
def test_the_views_stay_apart(page: Page) -> None:
    """Switching is a step of the document, and the muscle's own page is untouched by the task."""
    page.goto("/")
    marked(page, "[data-drawn]", 20_000)
    page.get_by_role("radio", name="Find a drive", exact=True).click()
    expect(page.locator("#force")).to_be_hidden()
    expect(page.locator(".task-head")).to_be_visible(timeout=20_000)
    page.get_by_role("button", name="Undo: from a task").click()
    expect(page.locator("#force")).to_be_visible()
    expect(page.locator(".task-head")).to_be_hidden()


@pytest.mark.examination("tests/frontend/test_accessibility.py::test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing(page: Page) -> None:
    open_task(page)
    searched(page)
    expect(page.locator(".rank-mark").first).to_be_attached()
    page.get_by_role("button", name="Reasons for proposal 1", exact=True).click()
    page.evaluate("document.querySelectorAll('details').forEach((el) => { el.open = true; })")
    assert violations(page, themes=2) == []
    page.get_by_role("radio", name="Antagonist", exact=True).click()
    page.get_by_role("button", name="Examples of tasks").click()
    page.evaluate("document.querySelectorAll('.stale').forEach((el) => el.classList.remove('stale'))")
    assert violations(page, themes=2) == []


@pytest.mark.examination("tests/frontend/test_layout.py::test_every_width")
@pytest.mark.parametrize("title", ["Lift 20 kg", "Too fast", None])
def test_every_width(page: Page, title: str | None) -> None:
    """No sideways scroll, no overlaps, targets of at least 24 px."""
    open_task(page)
    if title:
        example(page, title)
        searched(page)
    page.evaluate("document.querySelectorAll('details').forEach((el) => { el.open = true; })")
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(300)  # Plotly draws again at the new size
        wide = run(page, SIDEWAYS)
        assert wide["page"] <= 0, width
        assert wide["out"] == [], width
        assert run(page, OVERLAPS) == [], width
        assert run(page, TOO_SMALL) == [], width
