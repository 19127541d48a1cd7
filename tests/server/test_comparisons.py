"""``POST /api/comparisons``: presets and uploaded files, with and without a fit."""

from __future__ import annotations

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.series import MAX_POINTS_PER_SERIES
from tests.identification.synthetic import CYCLE_HEADER, cycle_rows, text
from tests.server.answers import valid
from tests.server.conftest import CSV, assert_error, post
from tests.stopping import SECONDS, STEPS, record, stop_runs

IDEAL = {
    "braid_diameter": "21.8 mm", "braid_angle": "26.5 deg", "nominal_length": "300 mm",
    "wall_thickness": "1.8 mm", "inside_diameter": "20 mm",
}  # fmt: skip
PROMISED = {
    "kind", "rows", "rows_used", "predicted", "unit", "rmse", "nrmse_percent", "holdout_rmse", "noise_floor",
    "residual_mean", "parameters", "full_scale", "excluded", "correlations", "messages", "geometry", "series",
}  # fmt: skip


def compare(client: TestClient, muscle: dict, measurement: str, **options: object) -> dict:
    """A checked answer."""
    response = post(client, "/api/comparisons", {"muscle": muscle, "measurement": measurement, **options})
    assert response.status_code == 200, response.text
    valid(ComparisonResult, response.content)
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
    assert any("a rest length of 300 mm" in message and "330 mm" in message for message in answer["messages"])


def test_an_unknown_measurement_is_not_found(shared_client: TestClient) -> None:
    body = {"muscle": {"preset": "DMSP-20"}, "measurement": "musclesim-21"}
    error = assert_error(post(shared_client, "/api/comparisons", body), 404, field="measurement")
    assert error["hint"] == "Did you mean 'musclesim-20'?"
    error = assert_error(post(shared_client, "/api/comparisons", {**body, "measurement": "0" * 64}), 404)
    assert "upload the file again" in error["hint"]


# --- where it fails


@pytest.fixture(scope="module")
def rubbing(shared_client: TestClient) -> str:
    """Cycles of the ideal muscle with 15 N of friction that the model does not have."""
    rows = cycle_rows(lambda direction, **_: 15.0 * direction, noise=1.0, each=40)
    content = text(rows, CYCLE_HEADER, "kind: isobaric").encode()
    return shared_client.put("/api/measurements?name=rubbing.csv", content=content).json()["id"]


def test_friction_is_seen_over_the_direction_and_in_the_loops(
    shared_client: TestClient, rubbing: str
) -> None:
    answer = compare(shared_client, IDEAL, rubbing)
    first = answer["where"][0]
    assert first["over"] == "direction"
    assert first["share_explained"] > 0.95
    assert first["mean"] == pytest.approx([-15.0, 15.0], abs=0.5)
    assert sum(first["count"]) == answer["rows_used"]
    assert len(first["edges"]) == len(first["count"]) + 1
    # Each pressure is cycled twice over 48 mm in steps of 1.2 mm: 2 F_c times the way, turning rows left out.
    assert len(answer["loops"]) == 3
    for loop in answer["loops"]:
        assert 0.048 - 2 * 0.0012 - 1e-9 < loop["span"] < 0.048 + 1e-9
        # After the first pressure 15 % of the first and of the last way are not counted, 7.5 % of all.
        assert 0.89 < loop["area"] / (2 * 2 * 15.0 * loop["span"]) < 1.03
    assert answer["whiteness"]["white"] is False
    assert answer["verdict"]["status"] != "adequate"
    assert "direction" in answer["sentences"][0] or "lengthening" in answer["sentences"][0]
    assert answer["sentences"][-1] == answer["verdict"]["sentence"]
    assert answer["sentences"][-1].startswith("What is left is no noise")


def test_the_right_model_leaves_noise(shared_client: TestClient, rubbing: str) -> None:
    answer = compare(shared_client, IDEAL, rubbing, effects={"coulomb_friction": {"force": 15.0}})
    assert answer["rmse"] == pytest.approx(1.0, rel=0.1)
    assert answer["noise_floor"] == pytest.approx(1.0, rel=0.2)
    assert answer["noise_how"] == "third differences of the residual within sweeps"
    assert answer["whiteness"]["white"] is True
    assert answer["verdict"]["status"] == "adequate"
    assert set(answer["verdict"]["proofs"].values()) == {True}
    assert all(profile["share_explained"] < 0.1 for profile in answer["where"])
    assert answer["sentences"] == ["Nothing is missing: the error of 0.994 N is noise."]
    assert all(abs(loop["area"]) < 0.2 for loop in answer["loops"])


def test_the_map_has_a_row_for_each_level(shared_client: TestClient, rubbing: str) -> None:
    answer = compare(shared_client, IDEAL, rubbing)
    chart = answer["heat_map"]
    assert (chart["x"], chart["y"], chart["scaled"]) == ("contraction", "pressure", False)
    assert chart["split"] is True, "the friction changes its sign with the direction"
    assert [row["level"] for row in chart["rows"]] == pytest.approx([6e5, 4e5, 2e5], rel=0.02)
    # The turning rows at both ends, 0.004 apart from the next ones, may be left out.
    assert chart["edges"][0] == pytest.approx(0.0, abs=0.0041)
    assert chart["edges"][-1] == pytest.approx(0.16, abs=0.0041)
    cells = [cell for row in chart["rows"] for cell in row["cells"] if cell]
    assert sum(cell["count"] for cell in cells) == answer["rows_used"] > 440
    for cell in cells:
        assert cell["lengthening"] - cell["shortening"] == pytest.approx(30.0, abs=3.0), "twice 15 N"


def test_the_rows_of_a_range_by_themselves(shared_client: TestClient, rubbing: str) -> None:
    """Residuals of the curves, which hold all rows here, chosen by hand."""
    within = {"pressure": [3.5e5, 4.5e5], "contraction": [0.05, 0.1], "direction": [1, 1]}
    answer = compare(shared_client, IDEAL, rubbing, within=within)
    chosen = [
        residual
        for s in answer["series"]
        for residual, *place in zip(
            s["residual"], s["x_pressure"], s["contraction"], s["direction"], strict=True
        )
        if all(low <= value <= high for value, (low, high) in zip(place, within.values(), strict=True))
    ]
    (inside,) = answer["inside"]
    assert (inside["channel"], inside["count"]) == ("force", len(chosen))
    assert len(chosen) > 10
    assert inside["rms"] == pytest.approx(np.sqrt(np.mean(np.square(chosen))))
    assert inside["mean"] == pytest.approx(np.mean(chosen))
    (nothing,) = compare(shared_client, IDEAL, rubbing, within={"time": [-2.0, -1.0]})["inside"]
    assert (nothing["rms"], nothing["count"]) == (None, 0)
    assert compare(shared_client, IDEAL, rubbing)["inside"] == []


def test_what_an_effect_explains_in_a_range_is_the_model_less_it(
    shared_client: TestClient, rubbing: str
) -> None:
    effects = {"coulomb_friction": {"force": 10.0}, "prestress": {"force": 5.0}}
    within = {"contraction": [0.0, 0.05]}
    answer = compare(shared_client, IDEAL, rubbing, effects=effects, within=within, explain=True)
    found = {one["effect"]: one for one in answer["explains"]}
    assert set(found) == set(effects)
    assert {one["channel"] for one in found.values()} == {"force"}
    # A constant force against the pull, and one against the motion, by the laws of both effects.
    assert found["prestress"]["explained_mean"] == pytest.approx(-5.0)
    assert found["prestress"]["explained_rms"] == pytest.approx(5.0)
    assert found["coulomb_friction"]["explained_rms"] == pytest.approx(10.0, rel=0.05)
    assert compare(shared_client, IDEAL, rubbing, effects=effects, within=within)["explains"] == []


def test_curves_carry_what_plots_need(shared_client: TestClient, rubbing: str) -> None:
    answer = compare(shared_client, IDEAL, rubbing)
    for series in answer["series"]:
        assert (series["channel"], series["unit"], series["use"]) == ("force", "N", "fit")
        count = len(series["measured"])
        for name in ("time", "contraction", "length", "x_pressure", "velocity", "direction", "residual"):
            assert len(series[name]) == count, name
        assert series["length"] == pytest.approx([0.3 * (1 - kappa) for kappa in series["contraction"]])
        expected = [m - p for m, p in zip(series["measured"], series["predicted"], strict=True)]
        assert series["residual"] == pytest.approx(expected, abs=1e-9)
        assert set(series["direction"]) <= {-1.0, 0.0, 1.0}


def test_a_stated_noise_and_freed_constants(shared_client: TestClient, rubbing: str) -> None:
    stated = compare(shared_client, IDEAL, rubbing, noise=1.5)
    assert (stated["noise_floor"], stated["noise_how"]) == (1.5, "given")
    effects = {"dahl": {"force": 10.0}}
    usual = compare(shared_client, IDEAL, rubbing, effects=effects, fit=True)
    freed = compare(shared_client, IDEAL, rubbing, effects=effects, fit=True, freed=["dahl.break_strain"])
    assert not usual["parameters"]["dahl"]["break_strain"]["fitted"]
    assert freed["parameters"]["dahl"]["break_strain"]["fitted"]
    assert freed["rmse"] < usual["rmse"]
    assert freed["parameters"]["dahl"]["break_strain"]["value"] < 1e-3  # Coulomb friction yields at once


def test_a_fitted_model_goes_back_in(shared_client: TestClient, rubbing: str) -> None:
    fitted = compare(shared_client, IDEAL, rubbing, effects={"coulomb_friction": {}}, fit=True)
    again = compare(shared_client, IDEAL, rubbing, effects=fitted["model"]["effects"])
    assert again["rmse"] == pytest.approx(fitted["rmse"], rel=1e-9)
    assert again["model"] == fitted["model"]


def test_a_typed_term_is_compared_and_fitted(shared_client: TestClient, rubbing: str) -> None:
    custom = {"term": "c*sign(v)", "c": 3.0}
    given = compare(shared_client, IDEAL, rubbing, effects={"custom": custom})
    assert given["model"]["effects"]["custom"] == custom
    assert given["rmse"] == pytest.approx((12.0**2 + 1.0) ** 0.5, rel=0.02)
    fitted = compare(shared_client, IDEAL, rubbing, effects={"custom": custom}, fit=True)
    assert fitted["parameters"]["custom"]["c"]["value"] == pytest.approx(15.0, abs=0.3)
    assert fitted["model"]["effects"]["custom"]["term"] == "c*sign(v)"


@pytest.mark.parametrize("term", ["c/(L - 0.3)", "c/(L - 0.252)", "c*exp(P)", "c*sqrt(-P)"])
def test_a_term_without_a_value_in_the_data_is_refused(
    shared_client: TestClient, rubbing: str, term: str
) -> None:
    for fit in (False, True):
        body = {"muscle": IDEAL, "measurement": rubbing, "effects": {"custom": {"term": term}}, "fit": fit}
        assert_error(post(shared_client, "/api/comparisons", body), 422, field="effects.custom.term")


def test_a_term_without_a_slope_at_a_row_is_compared(shared_client: TestClient, rubbing: str) -> None:
    effects = {"custom": {"term": "c*sqrt(L - 0.252)", "c": 1.0}}
    answer = compare(shared_client, IDEAL, rubbing, effects=effects)
    assert answer["rmse"] > 0.0
    assert compare(shared_client, IDEAL, rubbing, effects=effects, fit=True)["rmse"] <= answer["rmse"]


def test_a_guess_of_a_fit_without_a_value_is_only_a_bad_guess(
    shared_client: TestClient, rubbing: str
) -> None:
    # Most values of a between -1000 and 1000 leave a root of a negative number.
    custom = {"term": "c*sign(v)*sqrt(a - kappa)", "a": 1.0, "c": 10.0}
    answer = compare(shared_client, IDEAL, rubbing, effects={"custom": custom}, fit=True)
    assert answer["rmse"] < 1.5


def test_validation_is_judged_by_and_not_fitted_to(shared_client: TestClient, rubbing: str) -> None:
    rows = cycle_rows(lambda direction, **_: 30.0 * direction, noise=1.0, each=40, levels=(5e5,), seed=9)
    # A held pressure is read with its noise.
    rows = [row.replace(",500000.0,", f",{500000 + k % 3},") for k, row in enumerate(rows)]
    content = text(rows, CYCLE_HEADER, "kind: isobaric").encode()
    judge = shared_client.put("/api/measurements?name=judge.csv", content=content).json()["id"]
    used = [{"id": rubbing, "use": "fit"}, {"id": judge, "use": "validation"}]
    body = {"muscle": IDEAL, "measurements": used, "effects": {"coulomb_friction": {}}, "fit": True}
    response = post(shared_client, "/api/comparisons", body)
    valid(ComparisonResult, response.content)
    answer = response.json()
    assert answer["parameters"]["coulomb_friction"]["force"]["value"] == pytest.approx(15.0, abs=0.3)
    assert answer["rows_used"] + sum(answer["excluded"].values()) == 480
    validation = answer["validation"]
    assert 140 < validation["rows_used"] < 160  # without turning rows and the first after a break
    assert validation["rmse"] == pytest.approx((15.0**2 + 1.0) ** 0.5, rel=0.03)
    assert {series["use"] for series in validation["series"]} == {"validation"}
    assert compare(shared_client, IDEAL, rubbing)["validation"] is None


def test_a_driven_transient_needs_its_load(client: TestClient) -> None:
    content = b"# kind: transient\ntime_s,pressure_bar,length_mm\n0,1,300\n0.1,2,290\n0.2,3,280\n"
    identity = client.put("/api/measurements?name=t.csv", content=content).json()["id"]
    body = {"muscle": {"preset": "DMSP-20"}, "measurement": identity}
    error = assert_error(post(client, "/api/comparisons", body), 422, field="load_mass")
    assert "transient" in error["message"]
    loaded = b"# load_mass: 20 kg\n" + content
    identity = client.put("/api/measurements?name=u.csv", content=loaded).json()["id"]
    answer = compare(client, {"preset": "DMSP-20"}, identity)
    assert (answer["predicted"], answer["unit"]) == ("displacement", "m")
    assert answer["series"][0]["time"] == [0.0, 0.1, 0.2]


def test_a_run_that_stops_is_said_in_the_answer_and_in_the_report(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    stop_runs(monkeypatch)
    identity = client.put("/api/measurements?name=chirp.csv", content=record().encode()).json()["id"]
    stated = {"experiment": {"rest_length": "400 mm", "load": "5 kg"}}
    answer = compare(client, {"preset": "hand-made"}, identity, **stated)
    (stopped,) = answer["stopped"]
    assert 0.0 < stopped["reached"] < stopped["duration"] == pytest.approx(SECONDS)
    assert f"more than {STEPS} steps" in stopped["reason"]
    assert answer["sentences"][0].startswith("the run of the model stopped at")
    body = {"muscle": {"preset": "hand-made"}, "measurement": identity, **stated}
    report = post(client, "/api/reports", {**body, "diagnose": False})
    assert report.status_code == 200
    assert f"{answer['sentences'][0][1:]}." in report.text
    assert_error(post(client, "/api/reports", {**body, "diagnose": True}), 422, field="measurement")
