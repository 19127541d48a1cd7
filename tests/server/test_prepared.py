"""Prepared measurements over HTTP: in comparisons, read back, refused at their field."""

from __future__ import annotations

import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from tests.cli.test_prepare import ROWS, STEPS, sweeps
from tests.identification.synthetic import BRAID
from tests.server.conftest import assert_error, post


@pytest.fixture(scope="module")
def stored(shared_client: TestClient) -> str:
    """Id of an uploaded file."""
    answer = shared_client.put("/api/measurements", params={"name": "a.csv"}, content=sweeps().encode())
    assert answer.status_code == 200, answer.text
    return answer.json()["id"]


def test_a_request_prepares_as_the_python_door_does(shared_client: TestClient, stored: str, tmp_path) -> None:
    file = tmp_path / "a.csv"
    file.write_text(sweeps(), "utf-8")
    mine = mk.Model(**BRAID).compare(mk.read(file, prepare=STEPS))
    for body in (
        {"measurements": [{"id": stored, "prepare": list(STEPS)}]},
        {"measurement": stored, "prepare": list(STEPS)},
    ):
        response = post(shared_client, "/api/comparisons", {"muscle": BRAID, **body})
        assert response.status_code == 200, response.text
        assert response.json()["rmse"] == pytest.approx(mine.rmse, rel=1e-12)
        assert [one["step"] for one in response.json()["specimens"][0]["prepared"]] == list(STEPS)


def test_a_file_may_take_none_of_the_steps_of_the_request(shared_client: TestClient, stored: str) -> None:
    body = {"muscle": BRAID, "measurements": [{"id": stored, "prepare": []}], "prepare": list(STEPS)}
    response = post(shared_client, "/api/comparisons", body)
    assert response.status_code == 200, response.text
    assert response.json()["specimens"][0]["prepared"] == []


def test_a_stored_measurement_is_read_prepared(shared_client: TestClient, stored: str) -> None:
    plain = shared_client.get(f"/api/measurements/{stored}").json()
    assert plain["prepared"] == []
    assert "row" not in plain["columns"]
    shown = shared_client.get(f"/api/measurements/{stored}", params={"prepare": STEPS}).json()
    assert (plain["rows"], shown["rows"]) == (6 * ROWS, 6 * ROWS - 25)
    assert shown["columns"]["row"][0] == 26  # of the file, from 1
    assert [one["step"] for one in shown["prepared"]] == list(STEPS)
    assert shown["columns"]["time"][0] == plain["columns"]["time"][25]


def test_a_step_is_refused_at_its_field(shared_client: TestClient, stored: str) -> None:
    body = {"muscle": BRAID, "measurements": [{"id": stored, "prepare": ["lowpas 5 Hz"]}]}
    error = assert_error(post(shared_client, "/api/comparisons", body), 422, field="measurements.0.prepare")
    assert "low pass 20 Hz" in error["hint"]
    body = {"muscle": BRAID, "measurement": stored, "prepare": ["range time 50 s to 60 s"]}
    error = assert_error(post(shared_client, "/api/comparisons", body), 422, field="prepare")
    assert "leaves 0 of" in error["message"]
    answer = shared_client.get(f"/api/measurements/{stored}", params={"prepare": ["lowpas 5 Hz"]})
    assert_error(answer, 422, field="prepare")
