"""``POST /api/comparisons``: presets and uploaded files, with and without a fit."""

from __future__ import annotations

import pytest
from fastapi.testclient import TestClient

from mckibben.api.answers.comparisons import MAX_POINTS_PER_SERIES
from mckibben.api.schemas.comparisons import ComparisonAnswer
from tests.api.conftest import CSV, assert_error, post

PROMISED = {
    "kind", "rows", "rows_used", "predicted", "unit", "rmse", "nrmse_percent", "holdout_rmse", "noise_floor",
    "residual_mean", "parameters", "full_scale", "excluded", "correlations", "messages", "geometry", "series",
}  # fmt: skip


def compare(client: TestClient, muscle: dict, measurement: str, **options: object) -> dict:
    """A checked answer."""
    response = post(client, "/api/comparisons", {"muscle": muscle, "measurement": measurement, **options})
    assert response.status_code == 200, response.text
    ComparisonAnswer.model_validate_json(response.content)
    return response.json()


def test_a_measured_map_beside_its_preset(shared_client: TestClient) -> None:
    answer = compare(shared_client, {"preset": "DMSP-20"}, "martens-dmsp-20-300")
    assert answer.keys() >= PROMISED
    assert (answer["kind"], answer["predicted"], answer["unit"]) == ("static", "force", "N")
    assert answer["rows_used"] + sum(answer["excluded"].values()) == answer["rows"]
    assert answer["nrmse_percent"] == pytest.approx(100 * answer["rmse"] / answer["full_scale"])
    points = [r for series in answer["series"] for r in series["residual"]]
    assert len(points) == answer["rows_used"]
    assert (sum(r * r for r in points) / len(points)) ** 0.5 == pytest.approx(answer["rmse"])
    ideal = compare(shared_client, {"preset": "DMSP-20"}, "martens-dmsp-20-300", effects={})
    assert ideal["rmse"] > 2 * answer["rmse"]
    assert ideal["parameters"] == {}


def test_a_fit_lowers_the_error_and_reports_its_parameters(shared_client: TestClient) -> None:
    given = compare(shared_client, {"preset": "DMSP-20"}, "martens-dmsp-20-300")
    fitted = compare(
        shared_client, {"preset": "DMSP-20"}, "martens-dmsp-20-300", fit=True, free=["braid_angle"]
    )
    assert fitted["rmse"] < given["rmse"]
    angle = fitted["parameters"]["geometry"]["braid_angle"]
    assert angle["fitted"] is True
    assert angle["stderr"] > 0
    assert fitted["geometry"]["braid_angle"] == angle["value"]
    assert given["geometry"]["braid_angle"] != angle["value"]


def test_a_makers_curve_is_compared_where_the_muscle_pulls(shared_client: TestClient) -> None:
    answer = compare(shared_client, {"preset": "DMSP-20"}, "musclesim-20")
    assert answer["excluded"] == {"by its source": 1, "slack": answer["excluded"]["slack"]}
    assert min(value for series in answer["series"] for value in series["measured"]) > 0
    assert {series["label"] for series in answer["series"]} >= {"1 bar", "6 bar", "6.2 bar"}


def test_an_uploaded_file_is_compared_by_its_id(client: TestClient) -> None:
    identity = client.put("/api/measurements?name=a.csv", content=CSV).json()["id"]
    answer = compare(client, {"preset": "DMSP-20"}, identity)
    assert answer["rows_used"] == 9
    assert [series["pressure"] for series in answer["series"]] == pytest.approx([1e5, 2e5, 3e5])
    assert answer["series"][0]["contraction"] == pytest.approx([1 - 0.28 / 0.3, 1 - 0.29 / 0.3, 0.0])


def test_long_curves_are_thinned_and_the_figures_use_all_rows(client: TestClient) -> None:
    rows = "".join(f"2,{0.26 + 0.04 * k / 2999:.6f},{100 + k / 10:.2f}\n" for k in range(3000))
    content = f"# kind: isobaric\npressure_bar,length_m,force_N\n{rows}".encode()
    identity = client.put("/api/measurements?name=long.csv", content=content).json()["id"]
    answer = compare(client, {"preset": "DMSP-20"}, identity)
    assert answer["rows_used"] == 3000
    assert all(len(series["measured"]) <= MAX_POINTS_PER_SERIES for series in answer["series"])
    assert any("at most" in message for message in answer["messages"])


def test_a_sample_of_another_length_is_pointed_out(shared_client: TestClient) -> None:
    answer = compare(shared_client, {"preset": "DMSP-20", "nominal_length": "330 mm"}, "martens-dmsp-20-300")
    assert any("do not belong together" in message for message in answer["messages"])


def test_an_unknown_measurement_is_not_found(shared_client: TestClient) -> None:
    body = {"muscle": {"preset": "DMSP-20"}, "measurement": "musclesim-21"}
    error = assert_error(post(shared_client, "/api/comparisons", body), 404, field="measurement")
    assert error["hint"] == "Did you mean 'musclesim-20'?"
    error = assert_error(post(shared_client, "/api/comparisons", {**body, "measurement": "0" * 64}), 404)
    assert "send the file again" in error["hint"]


def test_a_transient_measurement_is_refused_with_the_reason(client: TestClient) -> None:
    content = b"# kind: transient\ntime_s,pressure_bar,length_mm\n0,1,300\n0.1,2,290\n0.2,3,280\n"
    identity = client.put("/api/measurements?name=t.csv", content=content).json()["id"]
    body = {"muscle": {"preset": "DMSP-20"}, "measurement": identity}
    assert "transient" in assert_error(post(client, "/api/comparisons", body), 422)["message"]
