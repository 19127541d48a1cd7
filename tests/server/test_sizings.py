"""``POST /api/sizings``: answer, stream, refusals, description."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben.application.size.size import TIME_LIMIT, SizingResult
from mckibben.server import long_work
from mckibben.server.jobs import JOBS
from mckibben.simulation.integrate.many import lane_kernels
from tests.looks import Looks
from tests.server.answers import valid
from tests.server.conftest import assert_error, post
from tests.server.test_simulations import events_of

PATH = "/api/sizings"
TASK: dict[str, Any] = {
    "load": {"mass": "20 kg", "inclination": "90 deg", "force": "0 N"},
    "stroke": "60 mm",
    "time": "0.5 s",
    "supply_pressure": "6 bar",
    "limits": {
        "max_contraction": 0.2, "force_reserve": 0.1, "max_length": "600 mm", "max_diameter": "60 mm",
        "max_parallel": 2,
    },
    "catalogue": {
        "muscles": ["DMSP-10", "DMSP-20", "DMSP-40"], "valves": ["MPYE-5-1/8-HF"], "tube_length": "1 m",
    },
    "uncertainty": {"specimens": 20},
}  # fmt: skip
IMPOSSIBLE = {**TASK, "load": {"mass": "5 t"}}
PROMISED = {
    "muscle", "nominal_length", "parallel", "valve", "tube", "pressure", "time", "contraction",
    "force_reserve", "air_volume_anr", "impact_energy", "probability", "binding", "drive",
}  # fmt: skip


def test_a_task_gives_ranked_proposals(shared_client: TestClient) -> None:
    response = post(shared_client, PATH, TASK)
    assert response.status_code == 200, response.text
    answer = response.json()
    valid(SizingResult, answer)
    assert answer["proposals"]
    assert answer["combinations"] > 2000
    for proposal in answer["proposals"]:
        assert set(proposal) >= PROMISED
        assert 0.0 <= proposal["probability"] <= 1.0
    for rejected in answer["rejected"]:
        assert set(rejected) >= {"muscle", "why", "binding", "would_work_if"}
    assert {"DMSP-10"} <= {item["muscle"] for item in answer["rejected"]}
    assert any(flag["code"] == "unverified" for flag in answer["flags"])


def test_a_proposed_drive_can_be_simulated(shared_client: TestClient) -> None:
    first = post(shared_client, PATH, TASK).json()["proposals"][0]
    run = post(shared_client, "/api/simulations", {"drive": first["drive"], "points": 11}).json()
    assert run["timing"]["extend"]["positioning_time"] == pytest.approx(first["time"], rel=2e-3)


def test_no_proposal_is_an_answer(shared_client: TestClient) -> None:
    response = post(shared_client, PATH, IMPOSSIBLE)
    assert response.status_code == 200
    answer = response.json()
    valid(SizingResult, answer)
    assert answer["proposals"] == []
    assert {item["binding"] for item in answer["rejected"]} == {"force", "suspended_mass"}


def test_a_search_whose_time_is_over_answers_with_the_drives_found_so_far(
    shared_client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    lane_kernels.warm().join()  # or looks at the compiler count
    monkeypatch.setattr(long_work, "Watch", lambda **_: Looks(3))
    response = post(shared_client, PATH, TASK)
    assert response.status_code == 200, response.text
    answer = response.json()
    valid(SizingResult, answer)
    assert answer["outcome"] == "timed_out"
    assert answer["proposals"]
    assert "Partial result. The limit of 7 s of processor time ended the search" in answer["message"]
    text = post(shared_client, f"{PATH}/reports", {"task": TASK}).text
    assert "Not everything was tried" in text
    assert answer["message"] in text.replace(" ", " ")
    monkeypatch.setattr(long_work, "Watch", lambda **_: Looks(1))
    text = post(shared_client, f"{PATH}/reports", {"task": TASK}).text
    assert "None of the drives that were tried fulfils this task" in text
    assert "No drive in the catalogue" not in text


def test_a_search_has_its_own_limit_and_the_words_of_a_task() -> None:
    for name in ("sizing", "sizing report"):
        assert JOBS[name].time_limit == TIME_LIMIT
        assert "rows" not in (JOBS[name].hint or "")  # a task has none


@pytest.mark.parametrize("task", [TASK, IMPOSSIBLE])
def test_a_stream_ends_with_the_answer(shared_client: TestClient, task: dict[str, Any]) -> None:
    headers = {"content-type": "application/json", "accept": "text/event-stream"}
    response = shared_client.post(PATH, content=json.dumps(task), headers=headers)
    assert response.headers["content-type"].startswith("text/event-stream")
    events = events_of(response.text)
    *progress, (last, answer) = events
    assert {name for name, _ in progress} == {"progress"}
    shares = [data["share"] for _, data in progress]
    assert shares == sorted(shares)
    assert last == "done"
    valid(SizingResult, answer)


@pytest.mark.parametrize(
    ("change", "field", "code", "hint"),
    [
        ({"limit": {}}, "limit", "unknown_field", "limits"),
        ({"load": {"mas": "20 kg"}}, "load.mas", "unknown_field", "mass"),
        ({"limits": {"max_lenght": "1 m"}}, "limits.max_lenght", "unknown_field", "max_length"),
        ({"stroke": "60 kg"}, "stroke", "bad_input", None),
        ({"stroke": "-60 mm"}, "stroke", "bad_input", "60 mm"),
        ({"time": 0}, "time", "bad_input", "0.5 s"),
        ({"rank_by": "price"}, "rank_by", "bad_input", None),
        ({"limits": {"max_parallel": 0}}, "limits.max_parallel", "bad_input", None),
        ({"catalogue": {"muscles": ["DMPS-20"]}}, "catalogue.muscles.0", "unknown_preset", "DMSP-20"),
        ({"catalogue": {"valves": ["MPYE"]}}, "catalogue.valves.0", "unknown_preset", None),
        ({"catalogue": {"tubes": ["PUN"]}}, "catalogue.tubes.0", "unknown_preset", None),
        ({"load": {"mass": 0}}, "load", "bad_input", None),
        ({"speed": "1 m/s"}, "speed", "bad_input", None),
    ],
)
def test_what_cannot_be_meant_is_refused(
    shared_client: TestClient, change: dict[str, Any], field: str, code: str, hint: str | None
) -> None:
    error = assert_error(post(shared_client, PATH, {**TASK, **change}), 422, code=code, field=field)
    if hint is not None:
        assert hint in error["hint"]


def test_the_description_has_examples_units_and_a_reason_for_every_default(
    shared_client: TestClient,
) -> None:
    schemas = shared_client.get("/openapi.json").json()["components"]["schemas"]
    task = schemas["SizingTask"]
    for example in task["examples"]:
        assert post(shared_client, PATH, {**example, "uncertainty": {"specimens": 0}}).json()["proposals"]
    for name in ("SizingTask", "TaskLoad", "TaskLimits", "TaskCatalogue", "TaskUncertainty", "PairInput"):
        for field, schema in schemas[name]["properties"].items():
            nested = "$ref" in schema or "schema" in field or "title" in field
            assert nested or schema.get("description"), f"{name}.{field}"
