"""The linear view in Transient: Bode with the nonlinear points, poles, design, controller taken over."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.frontend.axe import violations
from tests.frontend.guard import PageGuard
from tests.frontend.test_transient import link_to, open_transient, rerun

# A regulated lift without friction; the middle of its range is held at about 2.2 bar.
DRIVE = {
    "supply": {"pressure": 6e5},
    "valve": {"preset": "VPPM-6"},
    "load": {"mass": 10, "arrangement": "hanging"},
    "command": {"shape": "pulse", "on": 0, "off": 1},
    "duration": 2,
}
START = link_to(
    {
        "schema": 1,
        "view": "transient",
        "design": {
            "muscle": {"preset": "DMSP-20", "form": "braid", "values": {"nominal_length": 0.3}},
            "effects": {"bladder_elasticity": {}, "viscous_damping": {"coefficient": 120}},
        },
        "transient": {"drive": DRIVE},
    }
)


def ask(page: Page, button: str) -> dict:
    """Press a button of the card; the answer of the server."""
    with page.expect_response("**/api/linearisations", timeout=180_000) as answered:
        page.get_by_role("button", name=button).click()
    return answered.value.json()


@pytest.mark.examination("tests/cli/test_linearise.py::test_a_document_gives_one_json_object")
def test_from_the_drive_to_a_designed_controller(page: Page) -> None:
    open_transient(page, START)
    card = page.get_by_role("region", name="Linear view")
    answer = ask(page, "Linearise")
    expect(card.get_by_text("Nothing sticks or switches here in a way")).to_be_visible()
    poles = card.get_by_role("region", name="Poles and zeros")
    expect(poles.locator("tbody tr").first).to_contain_text("real")
    traces = page.locator("#run-linear-gain .js-plotly-plot, #run-linear-gain .canvas").first
    drawn = traces.evaluate("plot => plot.data.map((t) => [t.name, t.mode, t.x.length])")
    assert drawn[0] == ["mean of both sides", "lines", len(answer["frequency"])]
    assert [mode for _, mode, _ in drawn[1:]] == ["markers"] * 3
    design = ask(page, "Design a controller")["design"]
    table = card.get_by_role("region", name="Controllers: steps of")
    expect(table.locator("tr", has_text="meets the goals").locator("td").last).to_have_text("yes")
    expect(card.get_by_role("region", name="another mass and supply").locator("tbody tr")).to_have_count(9)
    rerun(page, lambda: page.get_by_role("button", name="Use the refined controller").click())
    expect(page.get_by_role("radio", name="Controller")).to_have_attribute("aria-checked", "true")
    expect(card.get_by_text("The drive has changed since.")).to_be_visible()
    kp = page.locator('[data-field="controller.kp"] input[type="text"]').input_value()
    assert float(kp) == pytest.approx(design["trials"][-1]["controller"]["kp"] / 10.0, rel=1e-3)
    assert violations(page) == []


@pytest.mark.examination("tests/cli/test_linearise.py::test_a_document_gives_one_json_object")
def test_another_channel_and_the_matrices(page: Page) -> None:
    """The load on the force of the muscle: Bode diagram, words and table are of that channel."""
    open_transient(page, START)
    card = page.get_by_role("region", name="Linear view")
    card.get_by_label("From which input").select_option("external force")
    card.get_by_label("to which output").select_option("velocity")
    answer = ask(page, "Linearise")
    assert (answer["input"]["name"], answer["output"]["name"]) == ("load_force", "velocity")
    expect(card.get_by_text("poles and zeros from external force to velocity")).to_be_visible()
    expect(card.get_by_text("nonlinear, 0.981 N")).to_be_visible()
    card.get_by_text("Matrices A, B, C, D").click()
    rows = card.get_by_role("region", name="A and B").locator("tbody tr")
    model = next(each for each in answer["models"] if each["primary"])
    expect(rows).to_have_count(len(model["states"]))
    heads = card.get_by_role("region", name="A and B").locator("thead th").all_inner_texts()
    assert heads[-1] == "load_force (N)"
    speed = [state["name"] for state in model["states"]].index("speed")
    shown = rows.nth(speed).locator("td").last.inner_text().replace("−", "-")
    assert float(shown) == pytest.approx(model["b"][speed][-1], rel=5e-3)
    assert violations(page) == []


def test_a_point_that_does_not_exist_is_a_sentence(page: Page, page_guard: PageGuard) -> None:
    page_guard.allow("status of 422")
    open_transient(page, START)
    card = page.get_by_role("region", name="Linear view")
    card.get_by_label("Operating point").select_option("position")
    field = card.get_by_label("position of the operating point")
    field.fill("900 mm")
    field.press("Enter")
    ask(page, "Linearise")
    expect(card.get_by_role("alert")).to_contain_text("900 mm is not between the ends")
