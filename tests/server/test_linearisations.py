"""``POST /api/linearisations``: the answer keeps to its schema, streams, and refuses in sentences."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.linear.result import LinearResult
from tests.server.answers import valid
from tests.server.conftest import assert_error, post
from tests.simulation.linear.drives import DOCUMENTS

PATH = "/api/linearisations"
BODY: dict[str, Any] = {"drive": DOCUMENTS["regulator"], "amplitudes": [0.05]}


def test_an_answer_keeps_to_its_schema(shared_client: TestClient) -> None:
    body = {**BODY, "at": {"pressure": "2.5 bar"}, "design": {"overshoot": "5 %", "settling": "1 s"}}
    answer = post(shared_client, PATH, body).json()
    valid(LinearResult, answer)
    assert answer["point"]["pressure"] == pytest.approx(2.5e5)
    assert answer["point"]["command"] == pytest.approx(2.5 / 6.0, rel=1e-6)
    (model,) = answer["models"]
    assert len(model["a"]) == len(model["states"]) == 5
    assert len(model["gain"]) == len(answer["frequency"])
    # The states count pressures from zero, inputs and outputs from the ambient.
    states = {state["name"]: state["value"] for state in model["states"]}
    outputs = {port["name"]: port["value"] for port in model["outputs"]}
    assert outputs["pressure"] == pytest.approx(2.5e5)
    assert states["absolute_pressure"] == pytest.approx(2.5e5 + 101325.0)
    assert not states.keys() & {"pressure", "tube_pressure", "regulator_pressure"}
    assert answer["gain_unit"] == "m"
    design = answer["design"]
    assert [trial["name"] for trial in design["trials"]] == ["rule", "refined"]
    assert len(design["robust"]) == 9


def test_a_gain_is_in_the_unit_of_the_output_per_that_of_the_input(shared_client: TestClient) -> None:
    """The load on a spring-like muscle at constant set point: a stiffness is 1 over the static gain."""
    answer = post(shared_client, PATH, {**BODY, "amplitudes": [], "input": "load_force"}).json()
    (model,) = answer["models"]
    assert answer["gain_unit"] == "m/N"
    a, b, c = (np.array(model[name]) for name in "abc")
    source = [port["name"] for port in model["inputs"]].index("load_force")
    out = [port["name"] for port in model["outputs"]].index("position")
    assert model["static_gain"] == pytest.approx(-c[out] @ np.linalg.solve(a, b[:, source]), rel=1e-6)


def test_the_designed_controller_can_be_put_into_the_drive(shared_client: TestClient) -> None:
    design = post(shared_client, PATH, {**BODY, "amplitudes": [], "design": {}}).json()["design"]
    reference = {"shape": "step", "level": "40 mm", "initial": "37.5 mm"}
    controller = {**design["trials"][-1]["controller"]["document"], "reference": reference}
    drive = {**BODY["drive"], "controller": controller}
    again = post(shared_client, PATH, {"drive": drive, "amplitudes": []}).json()
    for name in ("kp", "ki", "kd"):
        assert again["loop"]["controller"][name] == pytest.approx(
            design["trials"][-1]["controller"][name], rel=1e-8
        )
    assert again["loop"]["margins"]["phase_margin"] == pytest.approx(
        design["trials"][-1]["margins"]["phase_margin"], rel=1e-6
    )


def test_a_stream_ends_with_the_answer(shared_client: TestClient) -> None:
    reply = shared_client.post(PATH, json=BODY, headers={"accept": "text/event-stream"})
    last = reply.text.strip().split("\n\n")[-1]
    assert last.startswith("event: done")
    assert json.loads(last.split("data: ", 1)[1])["smooth"] is True


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"at": {"position": "900 mm"}}, "at"),
        ({"at": {"position": "30 mm", "pressure": "2 bar"}}, "at"),
        ({"at": {}}, "at"),
        ({"input": "voltage"}, "input"),
        ({"output": "voltage"}, "output"),
        ({"design": {"step": "300 mm"}}, "design"),
        ({"drive": "propneu-21"}, "drive"),
        ({"drive": {**DOCUMENTS["regulator"], "load": {"mass": "5 t"}}, "at": {"position": "30 mm"}}, "at"),
    ],
)
def test_what_cannot_be_is_a_sentence(shared_client: TestClient, change: dict[str, Any], field: str) -> None:
    assert_error(shared_client.post(PATH, json={**BODY, **change}), 422, field=field)
