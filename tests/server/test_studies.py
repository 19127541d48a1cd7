"""``POST /api/studies``: answer, stream, refusals."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from mckibben.application.study import file as study_file
from mckibben.application.study.store import StudyStore
from mckibben.application.study.study import StudyResult, prepare, study_question
from mckibben.documents.study import read_study
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from mckibben.simulation.outcome import Watch
from tests.application.study.test_study import STUDY
from tests.server.answers import valid
from tests.server.conftest import assert_error, post
from tests.server.test_simulations import events_of
from tests.shipped import shipped_studio

PATH = "/api/studies"


def test_a_study_answers_with_all_its_runs(shared_client: TestClient) -> None:
    response = post(shared_client, PATH, STUDY)
    assert response.status_code == 200, response.text
    answer = response.json()
    valid(StudyResult, answer)
    assert answer["outcomes"] == {"completed": 20}
    assert answer["table"]["run"] == list(range(20))
    mean = answer["summary"][1]["mean"]
    assert mean["low"] < mean["value"] < mean["high"]


def test_every_method_answers_in_the_declared_form(shared_client: TestClient) -> None:
    ranges = [{"path": "load.mass", "from": "8 kg", "to": "12 kg", "points": 2}]
    goals = [{"figure": "timing.extend.rise_time"}, {"figure": "timing.extend.impact_energy"}]
    spread = {"path": "supply.pressure", "distribution": {"type": "normal", "mean": 6e5, "deviation": 1e4}}
    limits = [{"figure": "timing.extend.rise_time", "at_most": "1 s"}]
    for method, quantities, planned in [
        ({"type": "grid"}, ranges, 2),
        ({"type": "latin_hypercube", "runs": 4}, ranges, 4),
        ({"type": "sobol", "samples": 4}, ranges, 4 * (1 + 2)),
        ({"type": "morris", "trajectories": 2}, [*ranges, spread], 2 * (2 + 1)),
        ({"type": "optimisation", "population": 8, "generations": 2}, ranges, 8 * 2),
        ({"type": "robust", "runs": 4}, [*ranges, spread], 4 * 2),
    ]:
        study = STUDY | {"method": method, "quantities": quantities, "goals": goals, "limits": limits}
        before = post(shared_client, f"{PATH}/kept", study).json()
        assert before["planned"] == planned
        response = post(shared_client, PATH, study)
        assert response.status_code == 200, response.text
        valid(StudyResult, response.json())
        assert response.json()["planned"] == planned


def test_the_runs_come_as_events(shared_client: TestClient) -> None:
    response = shared_client.post(PATH, json=STUDY, headers={"accept": "text/event-stream"})
    events = events_of(response.text)
    tables = [data["found"]["table"] for name, data in events if name == "progress" and data.get("found")]
    assert sorted(run for table in tables for run in table["run"]) == list(range(20))
    name, answer = events[-1]
    assert name == "done"
    assert answer["runs"] == 20


def test_what_was_made_is_kept_for_the_next_server(
    shared_client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A study that was interrupted goes on in another process and gives the same table."""
    study = STUDY | {"method": {"type": "monte_carlo", "runs": 12, "seed": 9}}
    kept = {"runs": 0, "planned": 12}
    assert post(shared_client, f"{PATH}/kept", study).json() == kept
    question = study_question(read_study(study), shipped_studio())
    store, made = StudyStore(tmp_path), []
    stopped = Watch(found=made.append, cancelled=lambda: bool(made))
    half = prepare(question, journal=store.of(question), chunk=2)(stopped)
    assert 0 < half.runs < 12
    assert store.result(question).table == half.table
    client = TestClient(create_app(Settings(data=tmp_path)), base_url="http://127.0.0.1")
    with client:
        assert post(client, f"{PATH}/kept", study).json() == {"runs": half.runs, "planned": 12}
        answer = post(client, PATH, study).json()
        assert (answer["kept"], answer["runs"]) == (half.runs, 12)
        assert answer["table"] == post(shared_client, PATH, study).json()["table"]
        again = post(client, PATH, study | {"title": "another title"}).json()
        assert (again["kept"], again["table"]) == (12, answer["table"])
        refused = post(client, f"{PATH}/kept", study | {"method": {"type": "monte_carlo", "runs": 20_001}})
        assert "20000 are allowed" in assert_error(refused, 422, field="method")["message"]
        monkeypatch.setattr(study_file, "find_spec", lambda _: None)
        assert "pyarrow" in assert_error(post(client, f"{PATH}/parquet", study), 422)["message"]
        assert (
            post(client, f"{PATH}/options", {"subject": {"drive": "paper-step"}}).json()["parquet"] is False
        )
    tiny = StudyStore(tmp_path, quota=1)
    other = study_question(read_study(STUDY), shipped_studio())
    prepare(other, journal=tiny.of(other))(Watch())
    assert store.runs(question) == 0
    assert store.runs(other) == 20


def test_the_table_as_parquet(shared_client: TestClient) -> None:
    parquet = pytest.importorskip(
        "pyarrow.parquet", reason="needs the extra parquet: pip install 'mckibben[parquet]'"
    )
    answer = post(shared_client, PATH, STUDY).json()
    response = post(shared_client, f"{PATH}/parquet", STUDY)
    assert response.headers["content-type"] == "application/vnd.apache.parquet"
    table = parquet.read_table(io.BytesIO(response.content)).to_pydict()
    assert table["largest.force"] == answer["table"]["largest.force"]


def test_what_is_refused(shared_client: TestClient) -> None:
    for change, field in [
        ({"method": {"type": "monte_carlo", "runs": 20_001}}, "method"),
        ({"method": {"type": "monte_carlo", "run": 20}}, "method.run"),
        ({"figures": ["timing.extend.risetime"]}, "figures"),
        ({"subject": {"drive": "nothing"}}, "subject.drive"),
        ({"subject": {"drive": "../secret.json"}}, "subject.drive"),
    ]:
        error = assert_error(post(shared_client, PATH, STUDY | change), 422)
        assert error["field"] == field


def test_what_can_be_varied_and_watched(shared_client: TestClient) -> None:
    drive = post(shared_client, f"{PATH}/options", {"subject": {"drive": "propneu-20"}}).json()
    known = {item["path"]: item for item in drive["quantities"]}
    assert known["load.mass"]["unit"] == "kg"
    assert known["muscle.nominal_length"]["value"] > 0.0
    assert known["gas.temperature"]["value"] == 293.15  # the default: 20 degC
    assert "regulator.time" not in known  # varying it would make the valve a regulator
    assert any(path.startswith("effects.") for path in known)
    assert "timing.extend.positioning_time" in {item["path"] for item in drive["figures"]}
    task = post(shared_client, f"{PATH}/options", {"subject": {"task": "lift-20kg"}}).json()
    known = {item["path"]: item["value"] for item in task["quantities"]}
    assert known["load.mass"] == 20.0
    assert known["stroke"] == 0.06
    assert "best.time" in {item["path"] for item in task["figures"]}
    error = assert_error(post(shared_client, f"{PATH}/options", {"subject": {"drive": "no"}}), 422)
    assert error["field"] == "subject.drive"


def test_every_offered_quantity_can_be_varied(shared_client: TestClient) -> None:
    options = post(shared_client, f"{PATH}/options", {"subject": {"drive": "propneu-20"}}).json()
    offered = [item for item in options["quantities"] if item["value"]]
    ranges = [{"path": q["path"], "values": [q["value"]]} for q in offered]
    study = STUDY | {"subject": {"drive": "propneu-20"}, "quantities": ranges, "method": {"type": "list"}}
    study["figures"], study["limits"] = ["timing.extend.positioning_time"], []
    table = post(shared_client, PATH, study).json()["table"]
    assert table["outcome"] == ["completed"]
