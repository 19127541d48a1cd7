"""``/api/presets``: each kind, one preset, saving and refusing."""

from __future__ import annotations

import copy
import json
from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from mckibben.resources import presets_folder
from mckibben.server.app import create_app
from mckibben.server.schemas.presets import PresetsAnswer
from mckibben.server.settings import Settings
from tests.identification.synthetic import CYCLE_HEADER, MUSCLE, cycle_rows, text
from tests.server.answers import valid
from tests.server.conftest import URL, assert_error, post
from tests.server.test_diagnoses import upload

KINDS = ("muscles", "valves", "tubes", "fittings", "measurements", "curves", "designs")
MINE = json.loads((presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8")) | {"id": "mine-20"}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_listed_as_declared(shared_client: TestClient, kind: str) -> None:
    response = shared_client.get(f"/api/presets/{kind}")
    assert response.status_code == 200
    valid(PresetsAnswer, response.content)
    body = response.json()
    assert body["kind"] == kind
    assert body["presets"]
    assert body["problems"] == []
    for preset in body["presets"]:
        assert preset["origin"] == "built-in"
        one = shared_client.get(f"/api/presets/{kind}/{preset['id']}")
        assert one.json() == preset


def test_what_nobody_verified_says_so(shared_client: TestClient) -> None:
    presets = shared_client.get("/api/presets/muscles").json()["presets"]
    verified = {preset["id"]: preset["verified"] for preset in presets}
    assert verified["paper"] is True
    assert verified["DMSP-20"] is False


def test_an_unknown_kind_or_preset_names_the_nearest(shared_client: TestClient) -> None:
    error = assert_error(shared_client.get("/api/presets/muscels"), 404, code="not_found", field="kind")
    assert error["hint"] == "Did you mean 'muscles'?"
    error = assert_error(shared_client.get("/api/presets/muscles/DMSP-21"), 404, code="not_found")
    assert error["hint"] == "Did you mean 'DMSP-20'?"
    assert_error(shared_client.get("/api/presets/muscles/" + "x" * 65), 404)


def test_a_saved_muscle_can_be_used_at_once(client: TestClient) -> None:
    response = post(client, "/api/presets/muscles", MINE)
    assert response.status_code == 201, response.text
    assert response.json()["origin"] == "user"
    assert client.get("/api/presets/muscles/mine-20").json() == response.json()
    assert post(client, "/api/curves", {"muscle": {"preset": "mine-20"}}).status_code == 200


def test_saving_again_replaces_the_own_preset_and_its_curves(client: TestClient) -> None:
    post(client, "/api/presets/muscles", MINE)
    before = post(client, "/api/curves", {"muscle": {"preset": "mine-20"}}).json()["geometry"]
    changed = copy.deepcopy(MINE)
    changed["geometry"]["nominal_length"]["value"] = 450
    assert post(client, "/api/presets/muscles", changed).status_code == 201
    after = post(client, "/api/curves", {"muscle": {"preset": "mine-20"}}).json()["geometry"]
    assert (before["nominal_length"], after["nominal_length"]) == (0.3, 0.45)


def test_a_saved_muscle_is_there_after_a_restart(client: TestClient, settings: Settings) -> None:
    post(client, "/api/presets/muscles", MINE)
    with TestClient(create_app(settings), base_url=URL) as later:
        assert later.get("/api/presets/muscles/mine-20").json()["origin"] == "user"


def test_a_built_in_muscle_is_never_replaced(client: TestClient) -> None:
    for name in ("DMSP-20", "dmsp-20"):
        assert_error(post(client, "/api/presets/muscles", MINE | {"id": name}), 409, code="conflict")


@pytest.mark.parametrize("name", ["../x", "a/b", "a.b", ".hidden", "-x", "x" * 65, "", "a b", "ä"])
def test_an_id_that_could_be_a_path_is_refused(client: TestClient, settings: Settings, name: str) -> None:
    assert_error(post(client, "/api/presets/muscles", MINE | {"id": name}), 422, field="id")
    assert not list((settings.user_presets or Path()).rglob("*.json"))


def test_a_bad_preset_names_the_field(client: TestClient) -> None:
    bad = copy.deepcopy(MINE)
    bad["geometry"]["braid_angle"]["unit"] = "kg"
    assert_error(post(client, "/api/presets/muscles", bad), 422, field="geometry.braid_angle.unit")
    bad = copy.deepcopy(MINE)
    bad["geometry"]["braid_angel"] = bad["geometry"].pop("braid_angle")
    error = assert_error(post(client, "/api/presets/muscles", bad), 422, field="geometry.braid_angel")
    assert error["hint"] == "Did you mean 'braid_angle'?"
    bad = copy.deepcopy(MINE)
    bad["effects"] = {"prestres": {}}
    assert_error(post(client, "/api/presets/muscles", bad), 422, field="effects.prestres")


def test_without_a_folder_saving_is_refused(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data=tmp_path)), base_url=URL) as client:
        assert_error(post(client, "/api/presets/muscles", MINE), 409, code="conflict")


def test_a_bad_file_is_reported_and_the_others_still_load(tmp_path: Path) -> None:
    folder = tmp_path / "presets" / "muscles"
    folder.mkdir(parents=True)
    (folder / "broken.json").write_text("{", "utf-8")
    (folder / "mine-20.json").write_text(json.dumps(MINE), "utf-8")
    settings = Settings(data=tmp_path, user_presets=tmp_path / "presets")
    with TestClient(create_app(settings), base_url=URL) as client:
        body = client.get("/api/presets/muscles").json()
    assert "mine-20" in {preset["id"] for preset in body["presets"]}
    assert len(body["problems"]) == 1
    assert "broken.json" in body["problems"][0]["file"]
    assert body["problems"][0]["message"]


def test_a_preset_that_was_refused_says_why_where_it_is_named(client: TestClient, settings: Settings) -> None:
    folder = (settings.user_presets or Path()) / "muscles"
    folder.mkdir(parents=True)
    wrong = {("titel" if key == "title" else key): value for key, value in MINE.items()}
    (folder / "mine-20.json").write_text(json.dumps(wrong), "utf-8")
    (folder.parent / "valves.json").write_text(json.dumps(MINE | {"kind": "valve"}), "utf-8")
    error = assert_error(client.get("/api/presets/muscles/mine-20"), 404, code="not_found")
    assert "user/muscles/mine-20.json, titel: 'titel' is not a known key" in error["message"]
    assert error["hint"] == "Did you mean 'title'?"
    error = assert_error(post(client, "/api/curves", {"muscle": {"preset": "Mine-20"}}), 422)
    assert "titel" in error["message"]
    assert {p["file"] for p in client.get("/api/presets/muscles").json()["problems"]} == {
        "user/muscles/mine-20.json"
    }
    (stray,) = client.get("/api/presets/valves").json()["problems"]
    assert (stray["file"], stray["hint"]) == ("user/valves.json", "put it into valves/")


def test_only_muscles_can_be_saved(client: TestClient) -> None:
    assert_error(post(client, "/api/presets/valves", MINE), 405)


def test_the_app_needs_no_user_folder_to_exist(app: FastAPI, settings: Settings) -> None:
    assert settings.user_presets is not None
    assert not settings.user_presets.exists()


def test_a_rest_length_that_was_decided_against_the_file_stays_decided(client: TestClient) -> None:
    """Files of a muscle of 300 mm that say 330: a kept muscle is compared with the next such file."""
    rows = cycle_rows(lambda **_: 0.0, noise=0.5, each=20, second=3.0)
    said = "kind: isobaric\nnominal_length: 330 mm"
    stating = upload(client, "stating", text(rows, CYCLE_HEADER, said))
    other = upload(client, "other", text(rows[::2], CYCLE_HEADER, said))
    decided = {
        "muscle": {"braid_diameter": MUSCLE.braid_diameter, "braid_angle": MUSCLE.braid_angle},
        "effects": {},
        "measurements": [{"id": stating}, {"id": other}],
        "experiment": {"rest_length": {"value": "300 mm", "origin": "suggested"}},
    }
    first = post(client, "/api/comparisons", decided).json()
    kept = post(client, "/api/presets/muscles/fitted", decided | {"id": "bench-300"}).json()
    assert kept["fit"]["stated"] == {"nominal_length": 0.33}
    asked = {"muscle": {"preset": "bench-300", "nominal_length": 0.3}, "measurement": stating}
    again = post(client, "/api/comparisons", asked).json()
    assert again["rmse"] == pytest.approx(first["rmse"], rel=0.02)
    assert any("330 mm was stated" in message for message in again["messages"])


def test_a_fitted_model_becomes_a_muscle_with_intervals(client: TestClient) -> None:
    """As the page keeps it: the model with its values, and the measurements that it was fitted to."""
    asked = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {"bladder_elasticity": {}, "effectiveness": {}},
        "measurement": "martens-dmsp-20-300",
    }
    fitted = post(client, "/api/comparisons", asked | {"fit": True}).json()
    model = asked | {"effects": fitted["model"]["effects"]}
    answer = post(client, "/api/presets/muscles/fitted", model | {"id": "bench-3", "title": "Bench 3"})
    assert answer.status_code == 201, answer.text
    fit = answer.json()["fit"]
    assert fit["errors"]["force"] == pytest.approx(fitted["rmse"], rel=1e-6)
    table = fit["covariance"]
    stated = fitted["parameters"]["effectiveness"]["factor"]
    place = table["names"].index("effectiveness.factor")
    # Nothing is fitted again: how sure the values are is that of the fit before.
    assert table["matrix"][place][place] ** 0.5 == pytest.approx(stated["stderr"], rel=1e-3)
    curves = post(client, "/api/curves", {"muscle": {"preset": "bench-3"}}).json()
    assert curves["interval"]["share"] == 0.9
    refused = post(client, "/api/presets/muscles/fitted", model | {"id": "DMSP-20"})
    assert_error(refused, 409, code="conflict", field="id")
    refused = post(client, "/api/presets/muscles/fitted", model | {"id": "a b"})
    assert_error(refused, 422, field="id")
