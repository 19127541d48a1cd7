"""The Transient view: a drive through time, from a changed mass to a pinned difference and a saved file."""

from __future__ import annotations

import csv
import json
import math
import re
import zipfile
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Page, Response, Route, expect

from mckibben.physics.errors import InputError
from mckibben.physics.units import Reference, si
from tests.frontend.axe import violations
from tests.frontend.comparing import use
from tests.frontend.guard import PageGuard
from tests.frontend.test_layout import SCROLLS
from tests.frontend.views import REFUSED, SIZES, enter, field, link_of, link_to, load, marked, run

pytestmark = pytest.mark.kept_page

TIMED = ("position", "valve", "pressure", "flow")


START = link_to({"schema": 1, "view": "transient", "design": {}})


def open_transient(page: Page, link: str = START) -> None:
    """The Transient view with its first run drawn; the Design view is not even built."""
    load(page, link)
    marked(page, "[data-ran]", 120_000)  # a busy machine takes its time


def show(page: Page, *signals: str) -> None:
    """Show further signals over time."""
    for name in signals:
        button = page.get_by_role("group", name="Signals shown").get_by_role("button", name=name, exact=True)
        if button.get_attribute("aria-pressed") == "false":
            button.click()


def runs(page: Page) -> int:
    """How often the plots were drawn."""
    return int(page.locator("html").get_attribute("data-ran") or 0)


def rerun(page: Page, act: Callable[[], object]) -> None:
    """Do something and wait until the plots are drawn with its answer."""
    with page.expect_response("**/api/simulations"):
        before = runs(page)
        act()
    marked(page, f':not([data-ran="{before}"])')


def figure(page: Page, name: str, column: int = 1) -> float | None:
    """A figure of the timing table: column 1 filling, 2 venting; None where there is a dash."""
    row = page.get_by_role("region", name="Timing table").locator("tr", has_text=name).first
    text = row.locator("td").nth(column - 1).inner_text().replace("−", "-")
    return None if text == "–" else float(text)


def download(page: Page, item: str) -> Path:
    """Save something from the Export menu."""
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as saved:
        page.get_by_role("menuitem").filter(has_text=item).click()
    return Path(saved.value.path())


def rows_of(saved: Path) -> list[str]:
    """The head and the rows of a file, without what it states above them."""
    return [line for line in saved.read_text().splitlines() if not line.startswith("#")]


def load_scenario(page: Page, scenario: str) -> None:
    """Choose a scenario and wait for its run."""
    rerun(page, lambda: page.locator("#scenario").select_option(scenario))


def test_the_first_run_is_complete_and_has_figures(page: Page, server_url: str) -> None:
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    open_transient(page)
    network = [url for url in asked if urlsplit(url).scheme not in ("data", "blob", "about")]
    assert {f"{urlsplit(url).scheme}://{urlsplit(url).netloc}" for url in network} == {server_url}
    expect(page.locator(".transient .verdict")).to_contain_text("the load arrives on the stop and holds")
    expect(page.locator(".runline")).to_contain_text(re.compile(r"Completed in .* ms · \d+ steps"))
    for name in TIMED:
        assert page.locator(f"#run-{name} .js-line").count() >= 1, name
    assert (figure(page, "Positioning time") or 0) > 50
    assert (figure(page, "Impact energy") or 0) > 0
    expect(page.locator("#key-figures")).to_contain_text("l (ANR)")
    expect(page.locator("#run-phase .js-line")).to_have_count(16)


@pytest.mark.examination("test_the_first_run_is_complete_and_has_figures")
def test_a_heavier_load_takes_longer(page: Page) -> None:
    open_transient(page)
    before = figure(page, "Positioning time")
    rerun(page, lambda: enter(page, "Mass", "55 kg"))
    after = figure(page, "Positioning time")
    assert before
    assert after
    assert after > before
    expect(page.locator("[data-field='load.mass']")).to_have_class(re.compile("changed"))
    rerun(page, lambda: page.get_by_role("button", name="Undo: mass").click())
    assert figure(page, "Positioning time") == before
    rerun(page, lambda: enter(page, "Mass", "2 t"))
    expect(page.locator(".transient .verdicts")).to_contain_text("Fill: the load stays on its stop")


@pytest.mark.examination(
    "tests/test_scenarios.py::test_its_figures_are_the_printed_ones_within_their_tolerance"
)
def test_a_scenario_brings_its_drive_and_the_printed_figures(page: Page) -> None:
    open_transient(page)
    load_scenario(page, "propneu-20")
    expect(page.locator("#drive-muscle")).to_contain_text("780 mm")
    expect(field(page, "Mass")).to_have_value("9.321")
    paper = page.get_by_role("region", name="Figures of the run and of the paper")
    row = paper.locator("tr", has_text="Time to 50 % of the stroke, fill")
    ours, theirs = (float(row.locator("td").nth(i).inner_text()) for i in (0, 1))
    assert theirs == 148
    assert ours == pytest.approx(theirs, rel=0.1)
    row = paper.locator("tr", has_text="Positioning time, fill")  # the load of the fit swings: it has none
    assert [row.locator("td").nth(i).inner_text() for i in (0, 1)] == ["–", "190"]
    rerun(page, lambda: page.get_by_role("button", name="Undo: scenario").click())
    expect(page.locator("#drive-muscle")).to_contain_text("300 mm")


def test_a_run_that_is_asked_nothing_bears_no_tick(page: Page) -> None:
    open_transient(page)
    load_scenario(page, "paper-ramp")
    verdict = page.locator(".transient .verdict")
    expect(verdict).to_have_class("verdict plain")
    expect(verdict).to_contain_text("Nothing is judged")


def test_the_period_of_a_sine_is_shown_as_its_frequency(page: Page) -> None:
    sine = {"shape": "sine", "amplitude": "10 mm", "offset": "30 mm", "period": "8 s"}
    drive = {"load": {"mass": "10 kg"}, "valve": {"preset": "VPPM-6"}, "supply": "6 bar", "duration": "20 s",
             "controller": {"kp": 1, "ki": 5, "reference": sine}}  # fmt: skip
    state = {
        "schema": 1,
        "view": "transient",
        "design": {},
        "transient": {"drive": drive, "mode": "controller"},
    }
    open_transient(page, link_to(state))
    expect(field(page, "Frequency")).to_have_value("0.125")


def test_a_loop_that_swings_bears_no_tick(page: Page) -> None:
    open_transient(page)
    load_scenario(page, "paper-pid-pulse")
    verdict = page.locator(".transient .verdict")
    expect(verdict).to_have_class("verdict good")
    expect(verdict).to_contain_text(re.compile(r"Settles within 2\s% of each step"))
    steps = page.get_by_role("region", name="Tracking").locator("summary")
    expect(steps).to_have_text("6 steps of the reference")
    rerun(page, lambda: run(page, GAINS, [3, 60]))
    expect(verdict).to_have_class("verdict warn")
    expect(verdict).to_contain_text("the load swings to the end")
    expect(verdict).to_contain_text("Lower the gains")


GAINS = """
(await import("/js/state.js")).edit((d) => {
  const [kp, ki] = argument, { drive } = d.transient;
  const controller = { ...drive.controller, kp, ki };
  return { ...d, transient: { ...d.transient, drive: { ...drive, controller } } };
}, "gains");
"""

CHANGED_BY = """
(await import("/js/state.js")).edit((d) => {
  const design = structuredClone(d.design);
  CHANGE
  return { ...d, design };
}, "changed");
"""


def test_a_changed_drive_no_longer_bears_the_words_of_its_scenario(page: Page) -> None:
    open_transient(page)
    scenario = page.locator(".scenario")
    longer = "design.muscle.values.nominal_length = 0.79;"
    changes: list[Callable[[], object]] = [
        lambda: enter(page, "Mass", "12 kg"),
        lambda: run(page, CHANGED_BY.replace("CHANGE", longer)),
    ]
    for change in changes:
        load_scenario(page, "paper-step")
        chosen, words = scenario.locator("option:checked"), scenario.locator(".hint")
        title, description = chosen.inner_text(), words.inner_text()
        assert not title.startswith("Changed")
        rerun(page, change)
        expect(chosen).to_have_text(f"Changed from: {title}")
        expect(words).to_have_text("The drive below is no longer that of the scenario.")
        assert description != words.inner_text()
    rerun(page, lambda: page.get_by_role("button", name="Reset to the scenario").click())
    expect(scenario.locator("option:checked")).to_have_text(title)
    expect(scenario.locator(".hint")).to_have_text(description)


REFERENCED = (
    "bar(a)", "bar(g)", "barg", "bara", "bar abs", "bar (gauge)", "psig", "psia", "PSIA", "psi(g)", "MPa(g)",
    "MPa a", "kg", "mm", "m/s", "N/mm^2", "kPa(abs)", "mbar(a)", "hPa abs.", "Bar rel",
    "bar(x)", "bar g g", "mPa",
)  # fmt: skip
COUNTED = """
const { siNumber } = await import("/js/quantities.js");
return argument.texts.map((text) => siNumber(text, { unit: "Pa", reference: argument.reference }));
"""


def as_server(text: str, reference: Reference | None) -> float | None:
    """The pressure as the server reads it [Pa]; None where the page leaves the text to the server."""
    if text.endswith("mPa"):  # the page knows no such unit
        return None
    try:
        return si(text, "Pa", reference=reference)
    except InputError:
        return None


@pytest.mark.examination(
    "tests/test_scenarios.py::test_its_figures_are_the_printed_ones_within_their_tolerance"
)
def test_units_of_drive_documents_are_read_and_every_scenario_runs(page: Page) -> None:
    open_transient(page)
    texts = [
        "6 bar",
        "120 N*s/m",
        "1.2 l/(s*bar)",
        "20 degC",
        "90 deg",
        "35.6 ms",
        "25.2 kN/m",
        "3",
        "6 stone",
    ]
    read = run(
        page,
        """
        const { siNumber } = await import("/js/quantities.js");
        return argument.map(siNumber);
        """,
        texts,
    )
    assert read[-1] is None
    assert read[:-1] == pytest.approx([6e5, 120, 1.2e-8, 293.15, 1.5707963267949, 0.0356, 25200, 3])
    pressures = [f"3 {unit}" for unit in REFERENCED]
    for reference in (None, "gauge", "absolute"):
        wanted = [as_server(text, reference) for text in pressures]
        read = run(page, COUNTED, {"texts": pressures, "reference": reference})
        assert read == [None if value is None else pytest.approx(value, rel=1e-11) for value in wanted]
    offered = page.locator("#scenario option")
    expect(offered).not_to_have_count(1)
    for scenario in [option.get_attribute("value") or "" for option in offered.all()][1:]:
        load_scenario(page, scenario)
        expect(page.locator(".transient .notice")).to_be_hidden()
        expect(page.locator(".transient .verdict b")).not_to_be_empty()
    load_scenario(page, "paper-pid-random")
    followed = page.get_by_role("region", name="Tracking", exact=True)
    expect(followed).to_contain_text("RMS error of the position")
    expect(page.locator(".run-position .legend")).to_contain_text("reference")


def test_an_impossible_value_says_so_at_its_field(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    open_transient(page)
    count = runs(page)
    page.locator("[data-field='stops.max_contraction'] input[type=text]").fill("95 %")
    page.keyboard.press("Enter")
    wrong = page.locator("[data-field='stops.max_contraction']")
    expect(wrong.locator(".error")).to_contain_text("95 %")
    expect(wrong.locator("input[type=text]")).to_have_attribute("aria-invalid", "true")
    expect(page.locator(".runs")).to_have_class(re.compile("stale"))
    assert runs(page) == count
    page.get_by_role("button", name="Go to the field").click()
    expect(wrong.locator("input[type=text]")).to_be_focused()
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".transient .notice")).to_be_hidden()


@pytest.mark.examination("tests/server/test_simulations.py::test_a_controlled_run_tells_how_it_follows")
def test_shapes_and_controller(page: Page) -> None:
    open_transient(page)
    shape = page.get_by_label("Shape", exact=True)
    for name in ("step", "square", "triangle", "ramp", "sine", "chirp", "random", "table"):
        rerun(page, lambda name=name: shape.select_option(name))
        expect(page.locator(".transient .notice")).to_be_hidden()
    rows = page.get_by_label("Rows of time (s) and value (%)")
    rows.fill("0 0\nlater 5")
    rows.blur()
    expect(page.locator(".signal .error", has_text="Row")).to_contain_text("Row 2")
    rows.fill("0 -100\n0.5 100\n1.5 -100")
    rerun(page, rows.blur)
    rerun(page, lambda: page.get_by_role("radio", name="Controller").click())
    expect(page.locator("#key-figures")).to_contain_text("RMS error of the position")
    rerun(page, lambda: enter(page, "Proportional gain", "4"))
    expect(page.locator(".transient .notice")).to_be_hidden()


@pytest.mark.examination("tests/server/test_simulations.py::test_a_controlled_run_tells_how_it_follows")
def test_another_valve_brings_its_dead_time(page: Page) -> None:
    open_transient(page)
    own = page.locator(".transient [data-effect].on")
    expect(own).to_have_count(6)  # five of the muscle
    rerun(page, lambda: page.get_by_label("Valve", exact=True).select_option("own"))
    expect(own).to_have_count(5)
    expect(field(page, "Conductance, filling")).to_have_value("3")
    rerun(page, lambda: page.get_by_label("Tube", exact=True).select_option("none"))
    expect(page.locator(".run-pressure .legend")).not_to_contain_text("tube")


def asked_drive(page: Page, act: Callable[[], object]) -> dict[str, Any]:
    """The drive that is asked for when something is done, once its run is drawn."""
    with page.expect_request("**/api/simulations") as asked:
        rerun(page, act)
    return asked.value.post_data_json["drive"]


def test_one_model_of_the_air_at_a_time(page: Page) -> None:
    open_transient(page)
    card = page.get_by_role("region", name="Air and start")
    told = page.locator("#run-start")
    expect(card.locator("summary")).to_contain_text("Air: energy balance")
    expect(told).to_contain_text("heat exchange with the wall 100 W/(m²·K)")
    card.locator("summary").click()
    model = page.get_by_label("Air model")
    drive = asked_drive(page, lambda: enter(page, "Heat transfer to the wall", "250 W/(m^2*K)"))
    assert drive["gas"] == {"wall_heat_transfer": 250}
    drive = asked_drive(page, lambda: model.select_option("polytropic"))
    assert drive["gas"] == {"polytropic_exponent": 1.2}
    expect(card.locator("summary")).to_contain_text("Air: exponent 1.2")
    expect(told).to_contain_text("polytropic exponent 1.2")
    expect(field(page, "Heat transfer to the wall")).to_have_count(0)
    expect(page.locator(".figure-notes", has_text="Remarks")).to_contain_text(
        "the flows do not conserve mass"
    )
    drive = asked_drive(page, lambda: model.select_option("energy"))
    assert "gas" not in drive
    expect(field(page, "Polytropic exponent")).to_have_count(0)
    load_scenario(page, "paper-step")  # it states an exponent
    expect(card.locator("summary")).to_contain_text("Air: exponent 1.2")


def test_rebound_and_start_position(page: Page) -> None:
    open_transient(page)
    show(page, "Velocity")
    told = page.locator("#run-start")
    expect(told).to_contain_text("Starts at 0 mm (0 %), on the lower end stop")
    page.get_by_role("region", name="Load", exact=True).locator("summary", has_text="End stops").focus()
    speeds = """
      const { data } = document.querySelector("#run-speed .canvas");
      const { x, y } = data.find((t) => t.uid === "velocity");
      return y.filter((_, i) => x[i] < 1);
    """
    assert min(run(page, speeds)) > -1e-6  # filling: the load stays on the upper stop
    drive = asked_drive(page, lambda: enter(page, "Rebound", "50 %"))
    assert drive["stops"]["restitution"] == 0.5
    end = figure(page, "Speed on arrival")
    assert end
    page.wait_for_function(  # Plotly has the data of a plot once its lines have been moved
        """() => document.querySelector("#run-speed .canvas").data[0].y.some((v, i) => i < 200 && v < 0)"""
    )
    assert min(run(page, speeds)) == pytest.approx(-0.5 * end, rel=0.1)  # rows every 5 ms
    drive = asked_drive(page, lambda: enter(page, "Start position", "20 mm"))
    assert drive["start"] == {"position": 0.02}
    expect(told).to_contain_text("Starts at 20.0 mm (6.67 %), at the stated start position")
    drive = asked_drive(page, lambda: enter(page, "Start position", ""))
    assert "start" not in drive
    expect(field(page, "Start position")).to_have_attribute("placeholder", "at rest")
    expect(told).to_contain_text("Starts at 0 mm")


def test_a_load_that_sticks_is_marked_and_told(page: Page) -> None:
    open_transient(page)
    expect(page.locator(".key")).not_to_contain_text("stuck", use_inner_text=True)
    with page.expect_response("**/api/simulations") as answered:
        load_scenario(page, "paper-ramp")
    answer = answered.value.json()
    assert any(answer["stuck"])
    expect(page.locator(".key")).to_contain_text("stuck by friction", use_inner_text=True)
    stuck = [False, *answer["stuck"], False]  # a band has two rows or more
    bands = sum(not a and b and c for a, b, c in zip(stuck, stuck[1:], stuck[2:], strict=False))
    assert bands > 0
    for name in TIMED:
        assert page.locator(f"#run-{name} .band.stuck").count() == bands
    events = page.locator("#run-start + details")
    events.locator("summary").click()
    expect(events.locator("li")).to_have_count(len(answer["events"]))
    for event, line in zip(answer["events"], events.locator("li").all_inner_texts(), strict=True):
        assert event["text"] in line
    assert "sticks: dry friction holds the load" in [event["text"] for event in answer["events"]]


def test_from_which_side_a_load_has_come_to_rest(page: Page) -> None:
    muscle = {"preset": "DMSP-20", "form": "braid", "values": {"nominal_length": 0.3}}
    effects = {"bladder_elasticity": {}, "coulomb_friction": {"force": 50}}
    drive = {
        "supply": {"pressure": 4e5}, "valve": {"preset": "MPYE-5-1/8-HF"}, "start_pressure": 4e5,
        "load": {"mass": 20, "arrangement": "hanging"}, "duration": 1,
        "command": {"shape": "step", "level": 0, "initial": 0},
    }  # fmt: skip
    design = {"muscle": muscle, "effects": effects}
    state = {"schema": 1, "view": "transient", "design": design, "transient": {"drive": drive}}
    open_transient(page, link_to(state))
    page.get_by_text("End stops").first.click()
    choice = page.get_by_label("Has come to rest")

    def asked(response: Response) -> bool:  # the answer to another state may still be on its way
        return response.url.endswith("/api/simulations") and "from above" in (
            response.request.post_data or ""
        )

    with page.expect_response(asked) as answered:
        rerun(page, lambda: choice.select_option("from above"))
    start = answered.value.json()["start"]
    assert start["position"] == pytest.approx(start["highest"])
    expect(page.locator("#run-start")).to_contain_text("comes to rest from above")
    expect(page.locator("#run-start")).to_contain_text("Dry friction holds it there from")


def test_a_slack_muscle_is_marked_and_saved(page: Page) -> None:
    open_transient(page)
    expect(page.locator(".key")).to_contain_text("muscle slack")
    arrange(page, "horizontal")
    with page.expect_response("**/api/simulations") as answered:
        rerun(page, lambda: enter(page, "Mass", "20"))
    answer = answered.value.json()
    # Vented, nothing pulls a load on a table back: the muscle hangs slack at the end.
    assert answer["slack"][-1]
    assert not answer["slack"][len(answer["slack"]) // 2]
    edges = [now != before for before, now in pairwise([False, *answer["slack"]])]
    for name in TIMED:
        assert page.locator(f"#run-{name} .band.slack").count() == sum(
            edge and now for edge, now in zip(edges, answer["slack"], strict=True)
        )
    table = list(csv.DictReader(rows_of(download(page, "Run as CSV"))))
    for name in ("contact", "slack"):
        share = sum(float(row[name]) for row in table) / len(table)
        assert share == pytest.approx(sum(answer[name]) / len(answer[name]), abs=0.01)
    page.get_by_role("button", name="Position: save or show as table").click()
    page.get_by_role("menuitem", name="Show as table").click()
    last = page.get_by_role("dialog").locator("tbody tr").last.locator("td")
    assert last.all_inner_texts()[-3:] == ["1", "1", "0"]  # contact, slack, stuck


FIGURES_OF_RUNS = """
return [...document.querySelectorAll(".pinned tbody:last-child tr:not(.group-row)")]
  .map((row) => [...row.querySelectorAll("td")].map((cell) => cell.firstChild.textContent.trim()))
  .filter((texts) => texts.every((text) => Number(text.replace("−", "-"))));
"""


def test_pin_and_difference(page: Page) -> None:
    open_transient(page)
    page.get_by_role("button", name="Pin this run").click()
    table = page.get_by_role("region", name="Pinned runs and the current run")
    expect(table.locator("thead")).to_contain_text("50 kg")
    rerun(page, lambda: enter(page, "Mass", "40"))
    expect(table.locator("tr", has=page.get_by_role("rowheader", name="Mass", exact=True))).to_contain_text(
        "40 kg"
    )
    row = table.locator("tr", has_text="Positioning time, fill")
    expect(row).to_contain_text(re.compile("▼.*%"))
    for texts in run(page, FIGURES_OF_RUNS):  # one number of decimals in each row
        assert len({len(text.partition(".")[2]) for text in texts}) == 1, texts
    page.set_viewport_size({"width": 390, "height": 844})
    assert run(page, SCROLLS) == []
    page.set_viewport_size({"width": 1280, "height": 720})
    expect(page.locator("#run-position .js-line")).to_have_count(4)
    # The run is named by what differs from the first one.
    expect(table.locator("thead")).to_contain_text(re.compile("Mass 50 → 40.kg"))
    every = table.locator("tbody tr").count()
    page.get_by_label("Differences only").check()
    assert table.locator("tbody tr").count() < every
    rerun(page, lambda: page.get_by_role("button", name="Go back to").click())
    expect(field(page, "Mass")).to_have_value("50")
    page.get_by_role("button", name="Unpin").click()
    expect(table).to_be_hidden()


@pytest.mark.examination("tests/frontend/test_state.py::test_a_link_holds_the_whole_document")
def test_the_link_restores_drive_window_and_pins(page: Page) -> None:
    open_transient(page)
    rerun(page, lambda: enter(page, "Mass", "42"))
    page.get_by_role("button", name="Pin this run").click()
    window = page.get_by_label("Window to, in seconds")
    window.fill("0.8")
    rerun(page, lambda: window.press("Enter"))
    other = page.context.new_page()
    open_transient(other, link_of(page))
    expect(field(other, "Mass")).to_have_value("42")
    expect(other.get_by_label("Window to, in seconds")).to_have_value("0.800")
    pinned = other.get_by_role("region", name="Pinned runs and the current run")
    expect(pinned.locator("thead")).to_contain_text("42 kg")
    other.close()


def test_the_cursors_move_over_all_strips(page: Page) -> None:
    page.emulate_media(reduced_motion="no-preference")
    open_transient(page)
    count = runs(page)
    box = page.locator("#run-valve").bounding_box()
    assert box
    page.mouse.move(box["x"] + 200, box["y"] + 40)
    lines = """
      const seen = document.querySelectorAll(".transient .cursor:not([hidden])");
      return [...seen].map((el) => el.style.transform);
    """
    places = {text.split(",")[0] for text in run(page, lines)}
    assert len(places) == 1, places
    expect(page.locator(".transient .cursor:visible")).to_have_count(4)
    clock = page.locator(".at-cursors.heads > *").first
    before = clock.inner_text()
    page.locator("#run-valve").focus()
    page.keyboard.press("Shift+ArrowRight")
    expect(clock).not_to_have_text(before)
    page.keyboard.press("Home")
    expect(clock).to_have_text(re.compile(r"0.s$"))
    assert runs(page) == count
    # A click puts the second cursor, which stays; both values and their difference stand beside each strip.
    page.locator("#run-valve").scroll_into_view_if_needed()
    box = page.locator("#run-valve").bounding_box()
    assert box
    page.mouse.click(box["x"] + 120, box["y"] + 40)
    page.mouse.move(box["x"] + 300, box["y"] + 40)
    expect(page.locator(".transient .cursor.second:visible")).to_have_count(4)
    cells = page.locator(".run-valve .at-cursors > *")
    first, last, gap = (float(text.replace("−", "-")) for text in cells.all_inner_texts())
    assert gap == pytest.approx(last - first, abs=0.2)
    page.locator("#run-valve").focus()
    page.keyboard.press("b")
    expect(page.locator(".transient .cursor.second:visible")).to_have_count(0)
    assert runs(page) == count


def test_dragging_chooses_a_window_for_all_plots(page: Page) -> None:
    open_transient(page)
    box = page.locator("#run-pressure").bounding_box()
    assert box

    def drag() -> None:
        page.mouse.move(box["x"] + 90, box["y"] + 20)
        page.mouse.down()
        page.mouse.move(box["x"] + 200, box["y"] + 50, steps=6)
        page.mouse.up()

    rerun(page, drag)
    shown = """
      const axis = (name) => document.querySelector(`#run-${name} .canvas`)._fullLayout.xaxis.range;
      return ["position", "flow"].map(axis);
    """
    first, second = run(page, shown)
    assert first == second
    assert first[1] - first[0] < 1.5
    rerun(page, lambda: page.get_by_role("button", name="All", exact=True).click())
    assert run(page, shown)[0] == [0, 2]


@pytest.mark.examination("test_the_first_run_is_complete_and_has_figures")
def test_exports(page: Page, tmp_path: Path) -> None:
    open_transient(page)
    table = list(csv.DictReader(rows_of(download(page, "Run as CSV"))))
    assert len(table) == 2001
    assert {"time [s]", "load_position [mm]", "pressure [bar]", "force [N]", "diameter [mm]"} <= set(table[0])
    assert float(table[-1]["time [s]"]) == pytest.approx(2.0)
    assert max(float(row["load_position [mm]"]) for row in table) == pytest.approx(36, abs=0.5)
    assert "Pressure (bar)" in download(page, "Plots as SVG").read_text()
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem").filter(has_text="Take it along").click()
    dialog = page.get_by_role("dialog", name="Take it along")
    with page.expect_download() as saved:
        dialog.get_by_role("button", name="Python").click()
    assert "def jacobian(y, k, u, w):" in Path(saved.value.path()).read_text("utf-8")
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem").filter(has_text="Take it along").click()
    with page.expect_download() as saved:
        dialog.get_by_role("button", name="Linear models").click()
    with zipfile.ZipFile(saved.value.path()) as archive:
        assert [name.rpartition(".")[2] for name in archive.namelist()] == ["mat", "json"]
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem").filter(has_text="Take it along").click()
    with page.expect_download() as saved:
        dialog.get_by_role("button", name="JSON").click()
    taken = tmp_path / "taken.json"
    taken.write_bytes(Path(saved.value.path()).read_bytes())
    document = json.loads(download(page, "Drive as JSON").read_text())
    page.get_by_role("button", name="Export").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem").filter(has_text="Open JSON").click()
    chooser.value.set_files(taken)
    expect(page.locator(".status")).to_contain_text("Opened taken.json")
    assert document["muscle"]["preset"] == "DMSP-20"
    assert document["load"]["mass"] == 50
    assert "controller" not in document
    document |= {"kind": "drive", "load": "33 kg", "supply": "7 bar(a)", "muscle": "DMSP-20:350mm"}
    document["start_pressure"] = "0.2 bar(g)"
    document["gas"] = {"ambient_pressure": "950 mbar"}
    copy = tmp_path / "drive.json"
    copy.write_text(json.dumps(document))
    page.get_by_role("button", name="Export").click()
    with page.expect_file_chooser() as chooser:
        page.get_by_role("menuitem").filter(has_text="Open JSON").click()
    rerun(page, lambda: chooser.value.set_files(copy))
    expect(field(page, "Mass")).to_have_value("33")
    expect(field(page, "Supply pressure")).to_have_value("6.05")
    expect(page.locator("[data-field='start_pressure'] input[type=text]")).to_have_value("0.2")
    enter(page, "Supply pressure", "100 psia")
    expect(field(page, "Supply pressure")).to_have_value("5.945")  # 6.8948 bar less 0.95 bar


def test_a_measured_trace_lies_over_the_run(page: Page, page_guard: PageGuard, tmp_path: Path) -> None:
    page_guard.allow("status of 4")
    open_transient(page)
    trace = tmp_path / "trace.csv"
    rows = "\n".join(f"{0.01 * k:.2f},{min(5, 0.1 * k):.3f},{min(40, 0.5 * k):.2f}" for k in range(150))
    trace.write_text(f"time [s],pressure [bar],displacement [mm]\n{rows}\n")
    page.locator("#measured-file").set_input_files(trace)
    use(page)
    card = page.get_by_role("region", name="Measured trace")
    expect(card).to_contain_text("pressure, stroke")
    expect(page.locator("#run-position .point")).to_have_count(150)
    page.get_by_role("button", name="Remove trace.csv").click()
    expect(page.locator("#run-position .point")).to_have_count(0)
    trace.write_text("nothing,here\nat,all\n")
    page.locator("#measured-file").set_input_files(trace)
    expect(page.get_by_role("alert")).to_contain_text("no rows of numbers")
    page.keyboard.press("Escape")
    expect(page.locator("#run-position .point")).to_have_count(0)


PLOTTED = """
const trace = document.querySelector(`#run-${argument[0]} .canvas`).data.find((t) => t.uid === argument[1]);
return trace ? { x: [...trace.x], y: [...trace.y] } : null;
"""


def arrange(page: Page, how: str) -> None:
    """Choose an arrangement of the load and wait for its run."""
    rerun(page, lambda: page.get_by_label("Arrangement", exact=True).select_option(how))


@pytest.mark.examination(
    "tests/server/test_simulations.py::test_a_joint_has_two_set_points_and_both_muscles_in_the_answer"
)
def test_an_antagonist_pair_turns_a_pulley(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    open_transient(page)
    expect(field(page, "Pulley radius")).to_be_hidden()
    expect(page.locator("#run-torque")).to_be_hidden()
    arrange(page, "antagonist")
    expect(field(page, "Precontraction")).to_have_value("6")
    rerun(page, lambda: enter(page, "Pulley radius", "36 mm"))
    joint = page.get_by_role("region", name="Joint", exact=True)
    # Stops at 0 and 12 % of 300 mm: 18 mm either way, on 36 mm half a radian.
    for radius in (36, 72):
        if radius == 72:
            rerun(page, lambda: enter(page, "Pulley radius", "72 mm"))
        told = joint.locator("dd").first.inner_text().replace("−", "-")
        ends = [float(text) for text in re.findall(r"-?[\d.]+", told)]
        assert ends == pytest.approx([-math.degrees(18 / radius), math.degrees(18 / radius)], rel=1e-2)
    for name in ("angle", "torque", "stiffness"):
        assert page.locator(f"#run-{name} .js-line").count() == 1, name
    expect(page.locator(".run-pressure .legend")).to_contain_text("muscle 2")
    angle, torque = (run(page, PLOTTED, [name, name])["y"] for name in ("angle", "torque"))
    assert max(angle) == pytest.approx(-min(angle), rel=1e-2)
    assert torque[0] == pytest.approx(0, abs=1e-6)
    # Without pressure the joint would begin on a stop.
    expect(page.locator("#run-start")).to_contain_text("would rest anywhere")
    rerun(page, lambda: enter(page, "Start position", "0 mm"))
    page.locator("[data-field='load.precontraction'] input[type=text]").fill("30 %")
    page.keyboard.press("Enter")
    expect(page.locator("[data-field='load.precontraction'] .error")).to_contain_text("30 %")
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".transient .notice")).to_be_hidden()
    table = list(csv.DictReader(rows_of(download(page, "Run as CSV"))))
    assert {"joint_angle [°]", "joint_torque [N·m]", "counter_pressure [bar]"} <= set(table[0])
    arrange(page, "hanging")
    expect(joint).to_be_hidden()
    expect(page.locator("#run-torque")).to_be_hidden()


@pytest.mark.examination(
    "tests/server/test_simulations.py::test_a_joint_has_two_set_points_and_both_muscles_in_the_answer"
)
def test_a_joint_follows_angle_and_stiffness(page: Page) -> None:
    open_transient(page)
    rerun(page, lambda: page.locator("#scenario").select_option("joint-20"))
    expect(page.get_by_label("Set points")).to_have_value("both")
    joint = page.get_by_role("region", name="Joint", exact=True)
    expect(joint).to_contain_text("it misses its set point by")
    for name in ("angle", "stiffness"):
        assert page.locator(f"#run-{name} .js-line").count() == 2, name  # with its set point
    stiffness = run(page, PLOTTED, ["stiffness", "stiffness"])["y"]
    assert stiffness[-1] == pytest.approx(22.0, rel=0.03)
    expect(page.locator(".run-flow .legend")).to_contain_text("muscle 2")
    table = list(csv.DictReader(rows_of(download(page, "Run as CSV"))))
    assert {"counter_air_flow [g/s]", "counter_diameter [mm]", "stiffness_reference [N·m/rad]"} <= set(
        table[0]
    )
    rerun(page, lambda: page.get_by_label("Set points").select_option("angle"))
    expect(joint).not_to_contain_text("misses its set point")
    # Without a joint there is no angle to follow.
    arrange(page, "hanging")
    expect(page.locator("[data-field='controller.reference'] select")).to_be_visible()
    expect(page.locator(".transient .notice")).to_be_hidden()


@pytest.mark.examination(
    "tests/server/test_simulations.py::test_a_joint_has_two_set_points_and_both_muscles_in_the_answer"
)
def test_each_arrangement_has_its_fields_and_runs(page: Page) -> None:
    open_transient(page)
    own = ("Inclination", "Lever ratio", "Pulley radius")
    wanted = {
        "inclined": {"Inclination"},
        "lever": {"Inclination", "Lever ratio"},
        "horizontal": set(),
        "antagonist": {"Pulley radius"},
        "hanging": set(),
    }
    for how, names in wanted.items():
        arrange(page, how)
        expect(page.locator(".transient .notice")).to_be_hidden()
        card = page.get_by_role("region", name="Load", exact=True)
        seen = {name for name in own if card.get_by_role("textbox", name=name, exact=True).is_visible()}
        assert seen == names, how
    rerun(page, lambda: page.get_by_role("button", name="Undo").click())
    expect(page.get_by_label("Arrangement", exact=True)).to_have_value("antagonist")


@pytest.mark.examination("test_tables_as_instruments_write_them")
def test_a_table_comes_from_a_file(page: Page, tmp_path: Path) -> None:
    open_transient(page)
    rerun(page, lambda: page.get_by_label("Force over time", exact=True).select_option("table"))
    file = tmp_path / "force.csv"
    chooser = page.locator("#t-load-force-file")
    file.write_text("Zeit [ms];Kraft [kN]\n0;0\n500;0,4\n1500;0,1\n", encoding="utf-8")
    with page.expect_request("**/api/simulations") as asked:
        rerun(page, lambda: chooser.set_input_files(file))
    force = asked.value.post_data_json["drive"]["load"]["force"]
    assert force["times"] == [0, 0.5, 1.5]
    assert force["values"] == pytest.approx([0, 400, 100])
    card = page.get_by_role("region", name="Load", exact=True)
    expect(card.locator(".points")).to_contain_text(
        "force.csv: 3 points, 0 to 1.5 s; times in ms, values in kN"
    )
    expect(page.get_by_label("Rows of time (s) and value (N)")).to_have_value("0  0\n0.5  400\n1.5  100")
    expect(page.locator("[id^=run-phase] ~ .hint")).to_contain_text("external force at that time")
    wrong = card.locator(".table > .error")
    for text, words in {
        "0;0\n0,5;12\nlater;3\n": "force.csv: Row 3: “later” is not a number",
        "0;0;1\n": "has 3 columns",
        "t;F\n": "no rows of numbers",
        "t [s];p [bar]\n0;1\n": "“bar” measures a pressure",
        "0;0\n1;1\n0,5;2\n": "Row 3: the time 0.5 is earlier",
    }.items():
        file.write_text(text, encoding="utf-8")
        chooser.set_input_files(file)
        expect(wrong).to_contain_text(words)
    expect(card.locator(".points")).to_contain_text("3 points")
    file.write_text("0 0\n1 50\n", encoding="utf-8")
    rerun(page, lambda: chooser.set_input_files(file))
    expect(wrong).to_be_empty()


READ = """
const { readTable } = await import("/js/views/transient/inputs/table-file.js");
return argument[0].map((text) => {
  const { times, values, words } = readTable(text, argument[1], "bar", { header: true });
  return { times, values, words };
});
"""


def test_tables_as_instruments_write_them(page: Page) -> None:
    open_transient(page)
    same = [
        "0,0\n0.5,0.02\n",
        "time,position in m\r\n0,0\r\n0.5,0.02\r\n",
        "\ufeff0\t0\n0,5\t20\n",
        "# from the rig\n0  0\n0,5  20\n",
        "time;position\nms;mm\n0;0\n500;20\n",
        '"t (s)","x (mm)"\n0,0\n5e-1,2e1\n',
        "t/ms; x/cm\n0;0;\n500;2;\n",
    ]
    for one, text in zip(run(page, READ, [same[1:], "length"]), same[1:], strict=True):
        assert one["times"] == pytest.approx([0, 0.5]), text
        assert one["values"] == pytest.approx([0, 0.02]), text
    shares = run(page, READ, [["0;0\n1;0,5\n", "0;0\n1;50\n", "t;u [%]\n0;0\n1;50\n"], "ratio"])
    assert [one["values"] for one in shares] == [[0, 0.5]] * 3
    assert "shares of 1 (the file names no unit)" in shares[0]["words"]
    # A triangle of 5001 points is three; noise keeps as many as a link can carry, and says what that costs.
    triangle = "\n".join(f"{k / 1000:.3f} {min(k, 5000 - k) / 100:.2f}" for k in range(5001))
    noise = "\n".join(f"{k} {math.sin(k * k):.6f}" for k in range(5001))
    exact, thinned = run(page, READ, [[triangle, noise], "force"])
    assert exact["times"] == [0, 2.5, 5]
    assert len(thinned["times"]) == 1000
    assert "5001 points" in thinned["words"]
    assert "1000 of them are kept" in thinned["words"]


@pytest.mark.examination("test_pin_and_difference")
def test_pinned_runs_are_as_fine_as_the_run(page: Page, server_url: str) -> None:
    open_transient(page)
    page.get_by_role("button", name="Pin this run").click()
    rerun(page, lambda: enter(page, "Mass", "40"))
    expect(page.locator("#run-position .js-line")).to_have_count(4)
    asked: list[dict[str, Any]] = []
    page.on(
        "request",
        lambda request: asked.append(request.post_data_json) if "/api/simulations" in request.url else None,
    )
    begin, end = 0.40, 0.46
    for name, value in (("from", begin), ("to", end)):
        window = page.get_by_label(f"Window {name}, in seconds")
        window.fill(str(value))
        rerun(page, lambda window=window: window.press("Enter"))
    pinned = [body for body in asked if body["drive"]["load"]["mass"] == 50]
    assert (pinned[-1]["from"], pinned[-1]["to"]) == (begin, end)
    post = page.request.post(f"{server_url}/api/simulations", data=pinned[-1])
    fine = post.json()
    coarse = page.request.post(
        f"{server_url}/api/simulations", data={**pinned[-1], "from": 0, "to": 2}
    ).json()
    page.wait_for_function(
        """(first) => {
          const data = document.querySelector("#run-pressure .canvas").data.find((t) => t.uid === "pin0");
          return data && Math.abs(data.y[200] - first) < 1e-9;
        }""",
        arg=fine["pressure"][200] / 1e5,
    )
    drawn = run(page, PLOTTED, ["position", "pin0"])
    assert drawn["x"] == pytest.approx(fine["time"])
    assert drawn["y"] == pytest.approx([1e3 * x for x in fine["position"]], abs=1e-9)
    inside = [x for x in coarse["time"] if begin <= x <= end]
    assert len(inside) < 20  # what the pin had before the window changed


@pytest.mark.examination("test_pin_and_difference")
def test_another_window_ends_what_pinned_runs_were_asked_for(page: Page) -> None:
    open_transient(page)
    page.get_by_role("button", name="Pin this run").click()
    rerun(page, lambda: enter(page, "Mass", "40"))
    held: list[Route] = []

    def hold(route: Route) -> None:
        body = route.request.post_data_json
        if body["drive"]["load"]["mass"] == 50 and body.get("to") == 1:
            held.append(route)  # never answered
        else:
            route.continue_()

    page.route("**/api/simulations", hold)
    window = page.get_by_label("Window to, in seconds")
    window.fill("1")
    # Others may end as well: a run of its own that a newer one replaced.
    with page.expect_event("requestfailed", lambda request: (request.post_data_json or {}).get("to") == 1):
        rerun(page, lambda: window.press("Enter"))
        window.fill("0.6")
        rerun(page, lambda: window.press("Enter"))
    assert len(held) == 1
    page.wait_for_function(
        """() => {
          const canvas = document.querySelector("#run-position .canvas");
          const pin = canvas.data.find((t) => t.uid === "pin0");
          return pin.x.length === 401 && pin.x.at(-1) === 0.6;
        }"""
    )
    page.unroute("**/api/simulations")


@pytest.mark.examination("tests/frontend/test_state.py::test_a_link_holds_the_whole_document")
def test_the_link_restores_the_zoomed_phase_plot(page: Page) -> None:
    page.goto("about:blank")  # as it opens, whatever the page showed before
    open_transient(page)
    range_of = """
      const { xaxis, yaxis } = document.querySelector("#run-phase .canvas")._fullLayout;
      return [...xaxis.range, ...yaxis.range];
    """
    whole = run(page, range_of)
    box = page.locator("#run-phase").bounding_box()
    assert box
    page.locator("#run-phase").scroll_into_view_if_needed()
    box = page.locator("#run-phase").bounding_box()
    assert box
    page.mouse.move(box["x"] + 120, box["y"] + 30)
    page.mouse.down()
    page.mouse.move(box["x"] + 220, box["y"] + 90, steps=6)
    page.mouse.up()
    zoomed = run(page, range_of)
    assert whole[0] < zoomed[0] < zoomed[1] < whole[1]
    other = page.context.new_page()
    open_transient(other, link_of(page))
    expect(other.locator("#run-phase .js-line").first).to_be_attached()
    assert run(other, range_of) == pytest.approx(zoomed, rel=1e-4)
    other.locator("#run-phase").dblclick(position={"x": 150, "y": 60})
    assert run(other, range_of) == pytest.approx(whole)
    other.close()


@pytest.mark.examination("test_dragging_chooses_a_window_for_all_plots")
def test_a_window_never_outlasts_the_run(page: Page) -> None:
    open_transient(page)
    window = page.get_by_label("Window from, in seconds")
    window.fill("0.5")
    rerun(page, lambda: window.press("Enter"))
    rerun(page, lambda: enter(page, "Duration", "1"))
    expect(page.get_by_label("Window to, in seconds")).to_have_value("1.00")
    rerun(page, lambda: enter(page, "Duration", "0.4"))
    expect(page.locator(".transient .notice")).to_be_hidden()
    expect(page.get_by_label("Window to, in seconds")).to_have_value("0.400")


@pytest.mark.examination("tests/frontend/test_accessibility.py::test_axe_finds_nothing_in_a_view_as_it_opens")
def test_axe_finds_nothing(page: Page) -> None:
    open_transient(page)
    page.get_by_role("button", name="Pin this run").click()
    rerun(page, lambda: page.get_by_role("radio", name="Controller").click())
    arrange(page, "antagonist")
    rerun(page, lambda: page.get_by_label("Force over time", exact=True).select_option("table"))
    page.evaluate("document.querySelectorAll('details').forEach((el) => { el.open = true; })")
    expect(page.get_by_role("region", name="Pinned runs and the current run")).to_be_visible()
    assert violations(page, themes=2) == []


SIDEWAYS = """
const clips = (el) => el.closest(".scroll, .plot, nav, dialog, [hidden], .unseen, .stage");
const out = [...document.querySelectorAll("#main *")].filter((el) =>
  !clips(el) && el.checkVisibility() && el.getBoundingClientRect().right > innerWidth + 1);
const targets = "button, select, input, summary, a[href], label.switch, textarea";
const small = [...document.querySelectorAll(targets)]
  .filter((el) => el.checkVisibility() && !el.matches(".skip, .unseen, label input"))
  .map((el) => [el.getBoundingClientRect(), el.outerHTML.slice(0, 90)])
  .filter(([box]) => box.width < 23.5 || box.height < 23.5).map(([, html]) => html);
return { page: document.documentElement.scrollWidth - innerWidth, small,
  out: out.slice(0, 5).map((el) => el.outerHTML.slice(0, 90)) };
"""


@pytest.mark.examination("tests/frontend/test_layout.py::test_every_width")
def test_no_sideways_scroll_and_large_targets(page: Page) -> None:
    open_transient(page)
    page.get_by_role("button", name="Pin this run").click()
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(300)
        wide = run(page, SIDEWAYS)
        assert wide["page"] <= 0, width
        assert wide["out"] == [], width
        assert wide["small"] == [], width
    tops = run(
        page,
        """
        const top = (what) => document.querySelector(what).getBoundingClientRect().top;
        return ["#key-figures", "#run-position", "#scenario"].map(top);
        """,
    )
    assert tops == sorted(tops)
