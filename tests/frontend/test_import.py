"""The import of a measurement: what is read, what is asked, what is remembered."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import FilePayload, Locator, Page, Response, expect

from tests.frontend.comparing import choose, drop, error, setup, use
from tests.frontend.guard import PageGuard
from tests.frontend.importing import (
    CORPUS,
    accept_button,
    answer_everything,
    bare,
    laboratory,
    panel,
    plain,
    preview_of,
    trace,
)
from tests.frontend.views import REFUSED, run
from tests.measurement.reading.muscle_test import isobaric
from tests.measurement.reading.open_files import WRITERS, OpenFile

needs_corpus = pytest.mark.skipif(
    not CORPUS.is_dir(), reason="the files of the laboratories are not beside this checkout"
)


def handle(page: Page) -> Locator:
    return panel(page).get_by_role("slider", name="Row of the column names")


def read_anew(page: Page) -> Any:
    """Waits for the next answer to a preview."""
    return page.expect_response("**/api/measurements/preview*")


def of_a_file(response: Response) -> bool:
    """The comparison with a file, not that of the Design view with its preset, which may come meanwhile."""
    asked = response.request.post_data_json if response.url.endswith("/api/comparisons") else {}
    return any(re.fullmatch("[0-9a-f]{64}", str(one.get("id"))) for one in asked.get("measurements", []))


@needs_corpus
def test_from_a_dropped_file_to_the_first_comparison(page: Page) -> None:
    """A new user with a file of a laboratory: at most five actions, none of which is taken back."""
    page.route("**/api/diagnoses", lambda route: None)
    page.goto("/")
    expect(page.locator('#preset option[value="DMSP-20"]')).to_be_attached()
    content = (CORPUS / "lab_de.csv").read_bytes()
    drop(page, {"name": "lab_de.csv", "mimeType": "text/csv", "buffer": content})
    actions = 1
    dialog = panel(page)
    expect(dialog.locator(".is-head")).to_contain_text("Zeit")
    expect(dialog.locator(".is-units")).to_contain_text("mbar")
    expect(dialog.locator("[data-field='experiment.muscle'] .origin.from-file")).to_have_text("file: line 2")
    expect(dialog.locator("[data-field='experiment.rest_length'] input")).to_have_value("250 mm")
    actions += answer_everything(page)
    with page.expect_response(of_a_file) as answer:
        accept_button(page).click()
    actions += 1
    assert actions <= 5
    (specimen,) = answer.value.json()["specimens"]
    said = {name: (one["value"], one["origin"]) for name, one in specimen["experiment"].items()}
    assert said["muscle"][0] == "DMSP-20"
    assert said["rest_length"] == (0.25, "file")
    expect(page.locator("#error-now")).to_be_visible(timeout=20_000)
    # The right comparison: the file's muscle and length (its "Probe" is a DMSP-20 of 250 mm), 360 readings.
    expect(page.locator("#compare-preset")).to_have_value("DMSP-20")
    expect(page.locator("[data-field='compare.nominal_length'] input")).to_have_value("250")
    expect(page.locator(".file")).to_contain_text("360 of 360 rows")
    # An ideal braid is too strong by hundreds of newtons at most; a wrong unit or length would be far off.
    assert error(page) < 400


@needs_corpus
@pytest.mark.examination("test_from_a_dropped_file_to_the_first_comparison")
def test_a_logger_that_calls_milliseconds_seconds_in_five_actions(case: Page) -> None:
    """What its readings rule out is assumed to be what they show, and the strip says so."""
    path = CORPUS.parents[1] / "logger_S001P001.TXT"
    choose(case, {"name": path.name, "mimeType": "text/csv", "buffer": path.read_bytes()})
    dialog = panel(case)
    actions = 1
    said = (("muscle", "DMSP-10"), ("rest_length", "155 mm"), ("load", "0.3 kg"))
    for field, value in said:
        entry = dialog.locator(f"#experiment-{field}")
        if field == "muscle":
            entry.select_option(value)
        else:
            entry.fill(value)
            entry.press("Tab")
        actions += 1
    expect(dialog.locator(".ask.assumed")).to_contain_text("Is its unit ms or s?")
    expect(dialog.locator("th[data-column='t (s)']")).to_contain_text("ms is assumed")
    with case.expect_response(of_a_file) as answer:
        accept_button(case).click()
    actions += 1
    assert actions <= 5
    assert "assuming ms as the unit of column 't (s)'" in answer.value.json()["assumptions"][0]
    facts = case.locator(".strip .facts")
    for field, value in said:
        expect(facts.locator(f"[data-fact='{field}']")).to_contain_text(value)
    also = facts.locator("[data-fact='assumed']")
    expect(also).to_contain_text("assumed!")
    expect(also).to_have_accessible_name(re.compile("Unit of time ms"))
    also.click()
    with read_anew(case):
        dialog.locator(".ask.assumed").get_by_role("button", name="ms").click()  # confirmed
    expect(dialog.locator("th[data-column='t (s)']")).to_contain_text("unit from you")


@needs_corpus
@pytest.mark.examination("test_a_proposed_unit_is_marked_and_confirmed_or_changed")
def test_letters_without_units_in_four_actions(case: Page) -> None:
    """Units that nobody states and the readings leave open are assumed, named, and changed in one click."""
    path = CORPUS / "test3.csv"
    choose(case, {"name": path.name, "mimeType": "text/csv", "buffer": path.read_bytes()})
    dialog = panel(case)
    dialog.locator("#experiment-muscle").select_option("DMSP-20")
    dialog.locator("#experiment-rest_length").fill("300 mm")
    dialog.locator("#experiment-rest_length").press("Tab")
    asked = dialog.locator(".ask.assumed")
    expect(asked).to_have_count(3)
    expect(asked.first).to_contain_text("'p' (pressure) has no unit; its readings are 199.7 to 400.2")
    with read_anew(case):
        asked.first.get_by_role("button", name="mbar").click()
    expect(dialog.locator("th[data-column='p']")).to_contain_text("unit from you")
    with read_anew(case):
        dialog.locator("th[data-column='p'] select").nth(1).select_option("kPa")
    with case.expect_response(of_a_file) as answer:
        accept_button(case).click()
    assumptions = "; ".join(answer.value.json()["assumptions"])
    assert "mm as the unit of column 'x'" in assumptions
    assert "N as the unit of column 'F'" in assumptions
    assert "'p'" not in assumptions  # answered
    facts = case.locator(".strip .fact.assumed")
    expect(facts).to_have_count(2)
    expect(facts.first).to_contain_text("mm")
    expect(facts.last).to_contain_text("N")


def values_to_see(preview: dict[str, Any]) -> list[tuple[str, str]]:
    """(where, text) of every value that nobody said: proposed or assumed."""
    found = []
    for column in preview["columns"]:
        if column["unit_origin"] == "proposed":
            found.append((f"[data-column='{column['header']}']", f"{column['unit']} is proposed"))
        if column["channel"] == "pressure" and column["absolute"] is None:
            found.append((".countings", "gauge is assumed"))
    for one in preview["experiment"]:
        row = f"[data-field='experiment.{one['field']}']"
        if one["origin"] in ("assumed", "proposed", "suggested"):
            found.append((row, "assumed" if one["origin"] == "assumed" else one["origin"]))
        if one["proposed"] is not None and one["unanswered"]:
            found.append((row, "suggested by the data"))
    for stated in preview["stated"]:
        assert stated["origin"] in ("file", "you")
    found += [(".unread", one["column"]) for one in preview["unread"]]
    found += [(".unread", one["why"]) for one in preview["unread"]]
    return found


@pytest.mark.examination("test_every_question_is_answered_in_the_view")
@needs_corpus
def test_a_run_of_a_valve_asks_for_its_valve(case: Page) -> None:
    """A recording that says muscle, length, load and supply, but not the valve."""
    content = (CORPUS / "rec1_003.mat").read_bytes()
    choose(case, {"name": "rec.mat", "mimeType": "application/octet-stream", "buffer": content})
    dialog = panel(case)
    expect(dialog.locator(".state-now")).to_have_text("missing: valve")
    expect(dialog.locator("[data-field='experiment.load'] input")).to_have_value("8 kg")
    expect(dialog.locator("[data-field='experiment.supply'] input")).to_have_value("6 bar")
    expect(dialog.locator(".thumbnail")).to_have_attribute(
        "aria-label", "Stroke and pressure over time of the file"
    )
    dialog.get_by_role("combobox", name="Valve", exact=True).select_option("MHE2")
    with case.expect_request("**/api/comparisons") as asked:
        use(case)
    body = asked.value.post_data_json
    assert isinstance(body, dict)
    assert body["measurements"][0]["experiment"] == {"valve": "MHE2"}
    assert body["drive"]["valve"] == {"preset": "MHE2"}
    assert (body["drive"]["load"]["mass"], body["drive"]["supply"]["pressure"]) == (8.0, 6e5)
    setup(case)
    expect(case.get_by_role("region", name="Rig").get_by_label("Valve")).to_have_value("MHE2")


@pytest.mark.examination("test_from_a_dropped_file_to_the_first_comparison")
@needs_corpus
def test_whatever_nobody_said_is_visible_for_every_file_of_the_corpus(case: Page) -> None:
    seen = 0
    for path in sorted(CORPUS.iterdir()):
        payload: FilePayload = {
            "name": path.name.replace(" ", "_"), "mimeType": "text/csv", "buffer": path.read_bytes(),
        }  # fmt: skip
        choose(case, payload)
        dialog = panel(case)
        preview = preview_of(case, payload)
        stops = [question["proposed"] for question in preview["questions"] if question["stops"]]
        if preview["measurement"] is None and stops and all(stops):  # the page assumes it, and says so
            expect(dialog.get_by_text("assumed").first, path.name).to_be_visible()
            case.keyboard.press("Escape")
            expect(dialog).to_be_hidden()
            continue
        for row, text in values_to_see(preview):
            expect(dialog.locator(row).filter(has_text=text).first, path.name).to_be_visible()
            seen += 1
        for question in preview["questions"]:
            if question["stops"]:
                ask = dialog.locator(f".ask[data-about='{question['about']}']")
                expect(ask.get_by_role("button").first, path.name).to_be_visible()
        assert accept_button(case).is_enabled() == (
            preview["measurement"] is not None and not any(one["unanswered"] for one in preview["experiment"])
        ), path.name
        case.keyboard.press("Escape")
        expect(dialog).to_be_hidden()
    assert seen > 24


def test_a_column_in_mm_that_is_not_read_stops_until_it_is_answered_for(case: Page) -> None:
    choose(case, laboratory("a.csv", rest="250 mm"))
    dialog = panel(case)
    expect(accept_button(case)).to_be_disabled()
    expect(dialog.get_by_role("status").last).to_contain_text("1 question open")
    row = dialog.locator("[data-unread='Kanal 4']")
    tick = row.get_by_role("checkbox", name="Ignore Kanal 4")
    with read_anew(case):
        tick.check()
    expect(row).to_contain_text("you do not want it")
    expect(dialog.locator(".ask:not(.may-wait)")).to_have_count(0)
    with read_anew(case):
        tick.uncheck()
    expect(accept_button(case)).to_be_disabled()
    # Or it is said what it is.
    with read_anew(case):
        dialog.get_by_label("Quantity of Kanal 4").select_option("diameter")
    expect(dialog.locator(".unread-part")).to_contain_text("Every column of the file is read")


def test_a_proposed_unit_is_marked_and_confirmed_or_changed(case: Page) -> None:
    choose(case, bare("b.csv"))
    dialog = panel(case)
    for header, unit in (("p", "kPa"), ("x", "mm"), ("F", "N")):
        cell = dialog.locator(f"th[data-column='{header}']")
        expect(cell.get_by_label(f"Unit of {header}")).to_have_value(unit)
        expect(cell).to_contain_text(f"{unit} is assumed")
    said = dialog.locator("th[data-column='F'] .state")
    expect(said).to_have_attribute("title", re.compile(r"^force: 'F' \(line 1, column 3\)"))
    pressure = dialog.locator(".ask[data-about='unit of pressure']")
    expect(pressure.get_by_role("button").first).to_have_text("kPaassumed")
    with read_anew(case):
        pressure.get_by_role("button", name="mbar").click()
    cell = dialog.locator("th[data-column='p']")
    expect(cell).to_contain_text("unit from you")
    expect(cell).to_contain_text("0.400 bar")  # 400 mbar
    with read_anew(case):
        dialog.get_by_label("Unit of p").select_option("kPa")
    expect(cell).to_contain_text("4.00 bar")
    with read_anew(case):
        dialog.locator(".ask[data-about='unit of displacement']").get_by_role("button", name="mm").click()
    with read_anew(case):
        dialog.locator(".ask[data-about='unit of force']").get_by_role("button").first.click()
    for header in "xF":
        expect(dialog.locator(f"th[data-column='{header}']")).to_contain_text("unit from you")


def test_the_head_row_is_dragged_and_moved_by_key(case: Page) -> None:
    choose(case, laboratory("c.csv"))
    dialog = panel(case)
    expect(handle(case)).to_have_attribute("aria-valuetext", "row 3: Druck, Hub, Kraft, Kanal 4")
    row = dialog.locator("tr[data-row='1']")
    row.scroll_into_view_if_needed()
    box, start = row.bounding_box(), handle(case).bounding_box()
    assert box
    assert start
    case.mouse.move(start["x"] + 10, start["y"] + 8)
    case.mouse.down()
    case.mouse.move(box["x"] + 40, box["y"] + 12, steps=4)
    expect(row).to_have_class(re.compile("target"))
    with read_anew(case):
        case.mouse.up()
    expect(handle(case)).to_have_attribute("aria-valuenow", "1")
    expect(dialog.locator("tr.is-head")).to_contain_text("Protokoll")
    expect(accept_button(case)).to_be_disabled()
    # Row 2 is empty: the next one down is row 3, and the key keeps the focus.
    handle(case).focus()
    with read_anew(case):
        case.keyboard.press("ArrowDown")
    expect(handle(case)).to_have_attribute("aria-valuenow", "3")
    expect(handle(case)).to_be_focused()
    expect(dialog.get_by_label("Quantity of Kraft")).to_have_value("force")


def test_signs_and_the_reference_are_turned_over(case: Page) -> None:
    choose(case, bare("d.csv"))
    dialog = panel(case)
    force = dialog.get_by_role("radiogroup", name="Force is positive when the muscle")
    with read_anew(case) as answer:
        force.get_by_role("radio", name="pushes").click()
    column = next(c for c in answer.value.json()["columns"] if c["header"] == "F")
    assert column["sign"] == -1
    assert column["maximum"] <= 0.0
    expect(dialog.locator(".plausible")).to_contain_text("Check signs and units")
    with read_anew(case):
        force.get_by_role("radio", name="pulls").click()
    expect(dialog.locator(".plausible")).to_contain_text("Plausible")
    with read_anew(case) as answer:
        dialog.get_by_role("radiogroup", name="Pressure is").get_by_role("radio", name="gauge").click()
    expect(dialog.locator(".countings")).not_to_contain_text("assumed")
    assert next(c for c in answer.value.json()["columns"] if c["header"] == "p")["absolute"] is False


def test_a_mapping_is_remembered_for_the_next_file_of_its_kind(case: Page) -> None:
    choose(case, laboratory("first.csv", rest="250 mm"))
    with read_anew(case):
        panel(case).get_by_role("checkbox", name="Ignore Kanal 4").check()
    answer_everything(case)
    use(case)
    expect(case.locator(".file")).to_have_count(1)
    choose(case, laboratory("second.csv", scale=0.9, rest="250 mm"))
    expect(case.locator(".file").or_(case.locator("dialog.import")).nth(1)).to_be_attached()
    if case.locator("dialog.import").count():  # something of the experiment is to be seen once more
        expect(panel(case).locator(".kept")).to_contain_text("Read as first.csv")
        answer_everything(case)
        use(case)
    second = case.locator(".file").nth(1)
    expect(second).to_contain_text("Mapping of first.csv used")
    setup(case)
    # Undo asks anew, without the mapping.
    second.get_by_role("button", name="Undo").click()
    expect(accept_button(case)).to_be_disabled()
    expect(panel(case).get_by_role("checkbox", name="Ignore Kanal 4")).not_to_be_checked()
    case.keyboard.press("Escape")
    # Another kind of file is asked about.
    choose(case, bare("third.csv"))
    expect(panel(case).locator(".kept")).to_have_count(0)


@pytest.mark.examination("test_files_of_two_kinds_are_two_questions")
def test_ten_files_of_a_kind_are_one_question(case: Page) -> None:
    choose(case, *[laboratory(f"run{n}.csv", scale=1 + n / 100, rest="250 mm") for n in range(10)])
    expect(case.get_by_role("dialog", name="How 10 files are read")).to_be_visible()
    dialog = panel(case)
    expect(dialog.locator(".several tbody tr")).to_have_count(10)
    expect(dialog.locator(".several tbody tr").nth(3)).to_contain_text("run3.csv")
    dialog.get_by_role("checkbox", name="Ignore Kanal 4").check()
    answer_everything(case)
    dialog.get_by_role("button", name="Use these 10 files").click()
    expect(case.locator(".file")).to_have_count(10)
    expect(case.locator("dialog.import")).to_have_count(0)
    expect(case.locator("#error-now")).to_be_visible(timeout=20_000)
    case.keyboard.press("Control+z")  # one step
    expect(case.locator(".file")).to_have_count(0)


def test_notes_dropped_with_a_file_count_for_it(case: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)  # notes are no table
    notes = {
        "name": "notes.md",
        "mimeType": "text/plain",
        "buffer": "Versuch 12\nRuhelänge 250 mm\n".encode(),
    }
    choose(case, bare("b.csv"), notes)
    row = panel(case).locator("[data-field='experiment.rest_length']")
    expect(row.locator("input")).to_have_value("250 mm")
    expect(row.locator(".origin.from-file")).to_have_text("file: notes.md, line 2")
    panel(case).get_by_role("button", name="Cancel").click()
    expect(case.locator(".case-notices")).to_contain_text("notes.md: it holds no readings")


def test_files_of_two_kinds_are_two_questions(case: Page) -> None:
    choose(case, plain("one.csv"), bare("other.csv"), plain("two.csv", rest="251 mm"))
    expect(case.get_by_role("dialog", name="How 2 files are read")).to_be_visible()
    answer_everything(case)
    use(case)
    expect(case.get_by_role("dialog", name="How other.csv is read")).to_be_visible()
    case.keyboard.press("Escape")
    expect(case.locator(".file")).to_have_count(2)


def test_a_sheet_is_picked(case: Page) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    import io

    book = openpyxl.Workbook()
    del book["Sheet"]
    for title, factor in (("slow", 1), ("fast", 2)):
        sheet = book.create_sheet(title)
        sheet.append(["pressure [bar]", "length [mm]", "force [N]"])
        for n in range(60):
            sheet.append([3 + n % 3, 300 - n // 3, factor * (600 - 8 * (n // 3) + 100 * (n % 3))])
    stream = io.BytesIO()
    book.save(stream)
    choose(case, {"name": "a.xlsx", "mimeType": "application/octet-stream", "buffer": stream.getvalue()})
    dialog = panel(case)
    expect(dialog.locator(".ask[data-about='sheet']")).to_contain_text("2 tables hold readings")
    with read_anew(case):
        dialog.get_by_role("group", name="Tables of the file").get_by_role("button", name="fast").click()
    expect(dialog.locator(".ask[data-about='sheet']")).to_have_count(0)
    expect(dialog.locator("tr[data-row='2']")).to_contain_text("1200")


def test_everything_by_key(case: Page) -> None:
    choose(case, bare("e.csv", "muscle: DMSP-20"))
    length = panel(case).get_by_label("Rest length")
    expect(length).to_be_focused()  # the first that is open: the units are assumed
    panel(case).locator(".ask[data-about='unit of pressure'] button").first.focus()
    with read_anew(case):
        case.keyboard.press("Enter")
    expect(panel(case).locator("th[data-column='p']")).to_contain_text("unit from you")
    length.focus()
    case.keyboard.type("250")
    case.keyboard.press("Enter")
    expect(accept_button(case)).to_be_focused()
    case.keyboard.press("Enter")
    expect(case.locator(".file")).to_have_count(1)
    expect(case.locator("[data-field='compare.nominal_length'] input")).to_have_value("250")


def test_a_muscle_is_chosen_by_key(case: Page) -> None:
    choose(case, plain("e.csv", muscle=""))
    select = panel(case).get_by_role("combobox", name="Muscle", exact=True)
    expect(select).to_be_focused()
    for wanted in ("DMSP-5", "DMSP-10", "DMSP-20"):
        with read_anew(case):
            case.keyboard.press("ArrowDown")
        expect(select).to_have_value(wanted)
        expect(select).to_be_focused()
    expect(accept_button(case)).to_be_enabled()


def test_bad_rows_are_left_out_only_when_the_user_says_so(case: Page) -> None:
    content = plain("f.csv")["buffer"].decode().replace("\n2,0000;0,0000;", "\n2,0000;x;", 1)
    choose(case, {**plain("f.csv"), "buffer": content.encode()})
    dialog = panel(case)
    expect(dialog.get_by_role("alert")).to_contain_text("'x' is not a number")
    expect(accept_button(case)).to_be_disabled()
    with read_anew(case):
        dialog.get_by_label("Leave out 1 row").check()
    answer_everything(case)
    use(case)
    expect(case.locator(".file")).to_contain_text("left out: 1 not a number")
    setup(case).get_by_role("button", name="Import…").click()
    expect(panel(case).get_by_label("Leave out 1 row")).to_be_checked()


def test_a_phone_shows_the_columns_one_below_the_other(case: Page) -> None:
    case.set_viewport_size({"width": 390, "height": 844})
    choose(case, laboratory("g.csv", rest="250 mm"))
    dialog = panel(case)
    columns = dialog.locator(".column-list > li")
    expect(columns).to_have_count(4)
    expect(columns.nth(1)).to_contain_text("0,0000 · 1,5000")
    wide = run(
        case,
        """
        const body = document.querySelector(".import .dialog-body");
        return [body.scrollWidth - body.clientWidth, document.documentElement.scrollWidth - innerWidth];
        """,
    )
    assert wide == [0, 0]
    small = run(
        case,
        """
        return [...document.querySelectorAll(".import :is(button, select, input, summary)")]
          .filter((el) => el.checkVisibility() && !el.matches("label input"))
          .map((el) => [el.getBoundingClientRect(), el.outerHTML.slice(0, 90)])
          .filter(([box]) => box.width < 23.5 || box.height < 23.5).map(([, html]) => html);
        """,
    )
    assert small == []
    expect(accept_button(case)).to_be_in_viewport()
    tick = dialog.get_by_role("checkbox", name="Ignore Kanal 4")
    with read_anew(case):
        tick.check()
    expect(handle(case)).to_be_visible()


def test_a_head_that_leaves_no_table_can_be_moved_back(case: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    short = "p [bar];s [mm];F [N]\n" + "\n".join(f"3;{n};{500 - n}" for n in range(6)) + "\n"
    choose(case, {"name": "h.csv", "mimeType": "text/csv", "buffer": short.encode()})
    handle(case).focus()
    for row in range(2, 7):
        with read_anew(case):
            case.keyboard.press("ArrowDown")
        expect(handle(case)).to_have_attribute("aria-valuenow", str(row))
    with read_anew(case):
        case.keyboard.press("ArrowDown")  # below the last row there is nothing
    expect(panel(case).get_by_role("alert")).to_contain_text("below it")
    expect(accept_button(case)).to_be_disabled()
    for row in range(5, 0, -1):
        with read_anew(case):
            case.keyboard.press("ArrowUp")
        expect(handle(case)).to_have_attribute("aria-valuenow", str(row))
    expect(panel(case).get_by_role("alert")).to_have_count(0)


@pytest.mark.examination("test_from_a_dropped_file_to_the_first_comparison")
def test_a_transient_trace_is_imported_the_same_way(page: Page) -> None:
    page.goto("/")
    page.get_by_role("button", name="Transient", exact=True).click()
    page.locator("#measured-file").set_input_files([trace("t.csv")])
    dialog = panel(page)
    expect(dialog.locator("th[data-column='Druck']")).to_contain_text("kPa is proposed")
    with read_anew(page):
        dialog.locator(".ask[data-about='unit of pressure']").get_by_role("button", name="kPa").click()
    use(page)
    card = page.get_by_role("region", name="Measured trace")
    expect(card).to_contain_text("Dots in the plots: pressure, stroke")
    # The next one of its kind needs no panel.
    page.get_by_role("button", name="Remove t.csv").click()
    page.locator("#measured-file").set_input_files([trace("u.csv")])
    expect(card).to_contain_text("u.csv")
    expect(page.locator("dialog.import")).to_have_count(0)


def test_specimens_of_different_lengths_keep_their_own(case: Page) -> None:
    choose(case, plain("short.csv", rest="250 mm"), plain("long.csv", rest="300 mm"))
    files = panel(case).locator(".several tbody tr")
    for name, length in (("short.csv", "250 mm"), ("long.csv", "300 mm")):
        expect(files.filter(has_text=name).locator("input")).to_have_value(length)
    answer_everything(case)
    with case.expect_response("**/api/comparisons") as answer:
        use(case)
    assert answer.value.ok, answer.value.text()
    lengths = [one["experiment"]["rest_length"] for one in answer.value.json()["specimens"]]
    assert [(one["value"], one["origin"]) for one in lengths] == [(0.25, "file"), (0.3, "file")]
    expect(case.locator("#error-now")).to_be_visible(timeout=20_000)


def test_a_length_that_contradicts_the_file_is_decided_in_the_view(case: Page, page_guard: PageGuard) -> None:
    page_guard.allow(REFUSED)
    choose(case, plain("a.csv"))
    use(case)
    expect(case.locator("#error-now")).to_be_visible(timeout=20_000)
    length = case.locator("[data-field='compare.nominal_length'] input")
    expect(length).to_have_value("250")
    setup(case)
    length.fill("320")
    with case.expect_response("**/api/comparisons") as answer:
        length.press("Enter")
    assert answer.value.status == 422
    conflict = case.locator(".conflict")
    expect(conflict).to_contain_text("a.csv says a rest length of 250 mm, the field says 320 mm")
    with case.expect_response("**/api/comparisons") as answer:
        conflict.get_by_role("button", name="320 mm is right").click()
    (specimen,) = answer.value.json()["specimens"]
    said = specimen["experiment"]["rest_length"]
    assert (said["value"], said["origin"]) == (0.32, "you")
    expect(conflict).to_have_count(0)
    length.fill("250")  # and back, as the file says
    with case.expect_response("**/api/comparisons") as answer:
        length.press("Enter")
    assert answer.value.json()["specimens"][0]["experiment"]["rest_length"]["value"] == 0.25


def test_a_stroke_that_was_turned_keeps_its_sign_when_the_user_says_so(case: Page) -> None:
    """It does not stop; both answers stand there, and what is chosen is read and asked no more."""
    r = isobaric(2e5, 3e5)
    rows = [f"{p},{-s},{f}" for p, s, f in zip(r.pressure / 1e5, r.stroke * 1e3, r.force, strict=True)]
    data = "\n".join(["# rest length 250 mm", "p [bar],Displacement [mm],F [N]", *rows]).encode()
    choose(case, {"name": "e.csv", "mimeType": "text/csv", "buffer": data})
    ask = panel(case).locator(".ask.may-wait[data-about='sign of displacement']")
    expect(ask).to_contain_text("read with its sign reversed")
    expect(ask.get_by_role("button")).to_have_count(2)
    expect(ask.get_by_role("button", name="Reverse the sign")).to_contain_text("proposed")
    expect(panel(case).locator(".ask:not(.may-wait)")).to_have_count(0)
    with read_anew(case) as answer:
        ask.get_by_role("button", name="Keep the sign").click()
    assert answer.value.json()["points"]["displacement"] == pytest.approx(list(-r.stroke), abs=1e-6)
    expect(panel(case).locator("[data-about='sign of displacement']")).to_have_count(0)


def test_a_proposed_stroke_that_is_confirmed_stays_turned(case: Page) -> None:
    r = isobaric(2e5, 3e5)
    rows = [f"{p},{-s},{f}" for p, s, f in zip(r.pressure / 1e5, r.stroke * 1e3, r.force, strict=True)]
    data = "\n".join(["# rest length 250 mm", "p [bar],Wire [mm],F [N]", *rows]).encode()
    choose(case, {"name": "e.csv", "mimeType": "text/csv", "buffer": data})
    ask = panel(case).locator(".ask.may-wait[data-about=\"column 'Wire'\"]")
    with read_anew(case) as answer:
        ask.get_by_role("button").filter(has_text="proposed").click()
    assert answer.value.json()["points"]["displacement"] == pytest.approx(list(r.stroke), abs=1e-6)


@pytest.mark.parametrize(
    "made", [made for write in WRITERS if (made := write()).stops], ids=lambda m: m.about[0]
)
def test_every_question_is_answered_in_the_view(case: Page, made: OpenFile) -> None:
    """The readings are then those of the answer on the command line."""
    choose(case, {"name": made.name, "mimeType": "application/octet-stream", "buffer": made.data})
    dialog = panel(case)
    points: dict[str, list[float]] = {}
    for _ in range(4):
        expect(dialog.locator(".state-now")).not_to_contain_text("Reading")
        asks = dialog.locator(".ask:not(.may-wait)")
        if not asks.count():
            break
        about = asks.first.get_attribute("data-about")
        tick = dialog.locator(".unread .open input")
        typed = asks.first.locator("input")
        said = " ".join(made.options)
        for field, value in zip(typed.all(), re.findall(r"[\d.]+(?=[ ,]| bar)", said), strict=False):
            field.fill(f"{value} bar")
        with read_anew(case) as answer:
            if tick.count():
                tick.first.click()
            else:
                answers = asks.first.get_by_role("button")
                words = [re.sub(r"\s*(proposed|assumed)$", "", text) for text in answers.all_inner_texts()]
                right = [n for n, text in enumerate(words) if text.partition(" [")[0].strip() in said]
                answers.nth(right[0] if right else 0).click()
        points = answer.value.json()["points"]
        expect(dialog.locator(f'.ask:not(.may-wait)[data-about="{about}"]')).to_have_count(0)
    expect(dialog.locator(".state-now")).not_to_contain_text("question")
    assert made.channel is not None
    channel, values = made.channel
    assert points[channel] == pytest.approx(list(values), abs=1e-4 * float(max(abs(values))))
