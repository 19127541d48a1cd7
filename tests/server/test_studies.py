"""``POST /api/studies``: answer, stream, refusals."""

from __future__ import annotations

from fastapi.testclient import TestClient

from mckibben.server.schemas.studies import StudyAnswer
from tests.application.test_study import STUDY
from tests.server.conftest import assert_error, post
from tests.server.test_simulations import events_of

PATH = "/api/studies"


def test_a_study_answers_with_all_its_runs(shared_client: TestClient) -> None:
    response = post(shared_client, PATH, STUDY)
    assert response.status_code == 200, response.text
    answer = response.json()
    StudyAnswer.model_validate(answer)
    assert answer["outcomes"] == {"completed": 20}
    assert answer["table"]["run"] == list(range(20))
    mean = answer["summary"][1]["mean"]
    assert mean["low"] < mean["value"] < mean["high"]


def test_every_method_answers_in_the_declared_form(shared_client: TestClient) -> None:
    ranges = [{"path": "load.mass", "from": "8 kg", "to": "12 kg", "points": 2}]
    goals = [{"figure": "timing.extend.rise_time"}, {"figure": "timing.extend.impact_energy"}]
    spread = {"path": "supply.pressure", "distribution": {"type": "normal", "mean": 6e5, "deviation": 1e4}}
    limits = [{"figure": "timing.extend.rise_time", "at_most": "1 s"}]
    for method, quantities in [
        ({"type": "grid"}, ranges),
        ({"type": "latin_hypercube", "runs": 4}, ranges),
        ({"type": "sobol", "samples": 4}, ranges),
        ({"type": "morris", "trajectories": 2}, [*ranges, spread]),
        ({"type": "optimisation", "population": 8, "generations": 2}, ranges),
        ({"type": "robust", "runs": 4}, [*ranges, spread]),
    ]:
        study = STUDY | {"method": method, "quantities": quantities, "goals": goals, "limits": limits}
        response = post(shared_client, PATH, study)
        assert response.status_code == 200, response.text
        StudyAnswer.model_validate(response.json())


def test_the_runs_come_as_events(shared_client: TestClient) -> None:
    response = shared_client.post(PATH, json=STUDY, headers={"accept": "text/event-stream"})
    events = events_of(response.text)
    tables = [data["found"]["table"] for name, data in events if name == "progress" and data.get("found")]
    assert sorted(run for table in tables for run in table["run"]) == list(range(20))
    name, answer = events[-1]
    assert name == "done"
    assert answer["runs"] == 20


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
