"""``POST /api/diagnoses``: the answer, streams, what can be sent back, refusals."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.diagnose.result import CandidateResult, DiagnosisResult
from mckibben.physics.errors import InputError
from mckibben.server import long_work
from mckibben.server.app import create_app
from mckibben.server.long_work import events
from mckibben.server.questions import model_question
from mckibben.server.schemas.models import DiagnosisRequest
from mckibben.server.settings import Settings
from mckibben.simulation.outcome import Outcome, Watch
from tests.identification.synthetic import BRAID, CYCLE_HEADER, LIFT, cycle_rows, text
from tests.looks import Looks
from tests.server.answers import valid
from tests.server.conftest import URL, assert_error, post, run_async
from tests.server.test_simulations import events_of
from tests.server.typescript import published
from tests.truth.generate import case

PATH = "/api/diagnoses"
PROMISED = {
    "run", "envelope", "covariance", "unread",
    "kind", "rows", "predicted", "unit", "baseline", "noise_floor", "where", "candidates", "path", "verdict",
    "model", "rows_used", "excluded", "channels", "parameters", "correlations", "geometry", "freed",
    "messages", "not_tried", "experiment", "assumptions", "specimens", "absorbed", "suspect_rows",
    "rivals", "context", "windows", "validation",
}  # fmt: skip
STATUS = {"adequate", "missing_effects", "ambiguous", "unknown_effect", "undecided", "unfinished"}


def coulomb(*, direction: float, **_: float) -> float:
    return 15.0 * direction


def growing_friction(*, kappa: float, direction: float, **_: float) -> float:
    return 3000.0 * kappa**2 * direction


def ripple(*, kappa: float, **_: float) -> float:
    return 12.0 * float(np.sin(150.0 * kappa))


def upload(client: TestClient, name: str, content: str) -> str:
    answer = client.put(f"/api/measurements?name={name}.csv", content=content.encode())
    assert answer.status_code < 300, answer.text
    return answer.json()["id"]


@pytest.fixture(scope="module")
def app(tmp_path_factory: pytest.TempPathFactory) -> FastAPI:
    folder = tmp_path_factory.mktemp("diagnoses")
    return create_app(Settings(data=folder / "data", user_presets=folder / "presets"))


@pytest.fixture(scope="module")
def client(app: FastAPI) -> Iterator[TestClient]:
    with TestClient(app, base_url=URL, raise_server_exceptions=False) as client:
        yield client


@pytest.fixture(scope="module")
def rubbing(client: TestClient) -> str:
    """Cycles with a bladder and Coulomb friction."""
    rows = cycle_rows(coulomb, noise=1.0, each=20, c10=0.4e6, second=3.0)
    return upload(client, "rubbing", text(rows, CYCLE_HEADER, "kind: isobaric"))


@pytest.fixture(scope="module")
def other(client: TestClient) -> str:
    """The same muscle at another pressure."""
    rows = cycle_rows(coulomb, noise=1.0, each=20, c10=0.4e6, levels=(3e5, 5e5), seed=8, second=3.0)
    return upload(client, "other", text(rows, CYCLE_HEADER, "kind: isobaric"))


def diagnose(client: TestClient, **options: Any) -> dict[str, Any]:
    """A checked answer."""
    response = post(client, PATH, {"muscle": BRAID, **options})
    assert response.status_code == 200, response.text
    valid(DiagnosisResult, response.content)
    return response.json()


def compare(client: TestClient, **options: Any) -> dict[str, Any]:
    response = post(client, "/api/comparisons", {"muscle": BRAID, **options})
    assert response.status_code == 200, response.text
    return response.json()


@pytest.fixture(scope="module")
def answer(client: TestClient, rubbing: str) -> dict[str, Any]:
    return diagnose(client, measurement=rubbing)


# --- the answer


def test_the_answer_is_the_promised_one(answer: dict[str, Any]) -> None:
    assert answer.keys() >= PROMISED
    assert (answer["kind"], answer["predicted"], answer["unit"]) == ("isobaric", "force", "N")
    assert answer["rows"] == 240
    assert answer["baseline"].keys() == {"rmse", "nrmse_percent", "holdout_rmse"}
    assert answer["noise_floor"].keys() == {"rmse", "how", "interval"}
    assert answer["channels"] == {}
    verdict = answer["verdict"]
    # The steps of the file do not show over which travel the friction changes sign.
    assert verdict["status"] == "ambiguous"
    assert set(verdict["effects"]) == {"bladder_elasticity", "coulomb_friction"}
    assert {"coulomb_friction", "dahl"} <= set().union(*verdict["indistinguishable"])
    assert verdict["proposed_term"] is None
    assert verdict["unexplained_share"] < 0.3
    assert verdict["sentence"].startswith("Missing: ")
    assert answer["noise_floor"]["rmse"] == pytest.approx(1.0, rel=0.25)
    table = answer["parameters"]
    assert table["coulomb_friction"]["force"]["value"] == pytest.approx(15.0, rel=0.03)
    assert table["bladder_elasticity"]["shear_modulus"]["value"] == pytest.approx(0.4e6, rel=0.03)
    assert {"value", "stderr", "unit", "at_bound", "fitted"} == table["coulomb_friction"]["force"].keys()


def test_the_baseline_is_the_start_model_as_given(
    client: TestClient, answer: dict[str, Any], rubbing: str
) -> None:
    given = compare(client, measurement=rubbing)
    assert answer["baseline"]["rmse"] == pytest.approx(given["rmse"])
    assert answer["baseline"]["nrmse_percent"] == pytest.approx(given["nrmse_percent"])
    assert [p["over"] for p in answer["where"]] == [p["over"] for p in given["where"]]
    assert answer["geometry"] == given["geometry"]


def test_the_path_falls_and_ends_at_the_verdict(answer: dict[str, Any]) -> None:
    path = answer["path"]
    assert path[0]["added"] is None
    assert path[0]["rmse"] == answer["baseline"]["rmse"]
    assert path[0]["model"] == {"effects": {}}
    assert [step["added"] for step in path[1:]] == answer["verdict"]["effects"]
    errors = [step["rmse"] for step in path]
    assert errors == sorted(errors, reverse=True)
    assert path[-1]["model"]["effects"] == answer["model"]["effects"]
    assert path[-1]["freed"] == answer["freed"]


def test_candidates_are_best_first_and_say_why(answer: dict[str, Any]) -> None:
    candidates = answer["candidates"]
    scores = [c["score_change"] for c in candidates]
    assert scores == sorted(scores)
    assert candidates[0]["effect"] == "bladder_elasticity"
    for c in candidates:
        assert c["title"]
        assert c["why"].startswith(c["title"])
        assert c["equation"]
        assert set(c["model"]["effects"]) == {c["effect"]}
        assert set(c["parameters"]) == set(c["model"]["effects"][c["effect"]])
        assert set(c["twins"]) <= {each["effect"] for each in candidates}
    useless = [c for c in candidates if c["gain_percent"] < 1.0]
    assert useless  # those that do not help are told too


# --- models go back in


def test_models_of_the_answer_give_their_errors_again(
    client: TestClient, answer: dict[str, Any], rubbing: str
) -> None:
    for step in answer["path"]:
        again = compare(client, measurement=rubbing, effects=step["model"]["effects"])
        assert again["rmse"] == pytest.approx(step["rmse"], rel=1e-6)
    first = answer["candidates"][0]
    again = compare(client, measurement=rubbing, effects=first["model"]["effects"])
    assert again["rmse"] == pytest.approx(first["rmse"], rel=1e-6)
    final = answer["model"]
    again = compare(client, measurement=rubbing, muscle=final["muscle"], effects=final["effects"])
    assert again["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)


def test_a_diagnosis_goes_on_from_its_candidate(
    client: TestClient, answer: dict[str, Any], rubbing: str
) -> None:
    first = answer["candidates"][0]
    further = diagnose(client, measurement=rubbing, effects=first["model"]["effects"])
    assert further["baseline"]["rmse"] == pytest.approx(first["rmse"], rel=1e-6)
    assert first["effect"] not in {c["effect"] for c in further["candidates"]}
    assert further["verdict"]["effects"] == ["coulomb_friction"]
    done = diagnose(client, measurement=rubbing, effects=further["model"]["effects"])
    assert done["verdict"]["status"] == "adequate"
    assert done["verdict"]["effects"] == []
    assert done["verdict"]["sentence"].startswith("Nothing is missing")


def test_a_fitted_geometry_goes_back_as_the_muscle(client: TestClient) -> None:
    rows = cycle_rows(noise=1.0, each=20, angle=25.5)
    bent = upload(client, "bent", text(rows, CYCLE_HEADER, "kind: isobaric"))
    answer = diagnose(client, measurement=bent, free=["braid_angle"])
    angle = answer["parameters"]["geometry"]["braid_angle"]
    assert np.degrees(angle["value"]) == pytest.approx(25.5, abs=0.05)
    assert answer["geometry"]["braid_angle"] == pytest.approx(angle["value"], rel=1e-12)
    model = answer["model"]
    assert model["muscle"]["braid_angle"] == pytest.approx(angle["value"], rel=1e-12)
    again = compare(client, measurement=bent, muscle=model["muscle"], effects=model["effects"])
    assert again["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)


def test_an_unknown_effect_brings_a_term_that_can_be_sent_back(client: TestClient) -> None:
    rows = cycle_rows(growing_friction, noise=1.0, each=40, second=3.0)
    rough = upload(client, "rough", text(rows, CYCLE_HEADER, "kind: isobaric"))
    answer = diagnose(client, measurement=rough)
    verdict = answer["verdict"]
    assert verdict["status"] == "unknown_effect"
    assert verdict["unexplained_share"] > 0.8
    assert set(verdict["unexplained_in"][:2]) == {"contraction", "direction"}
    assert verdict["where_to_look"] is None
    term = verdict["proposed_term"]
    assert set(term["model"]["effects"]["custom"]) == {"term", *term["coefficients"]}
    assert term["model"]["effects"]["custom"]["term"] == term["formula"]
    curve = term["curve"]
    assert curve["x"] == verdict["unexplained_in"][0]
    assert len(curve["values"]) == len(curve["term"]) == len(curve["residual"]) <= 200
    assert curve["values"] == sorted(curve["values"])
    again = compare(client, measurement=rough, effects=term["model"]["effects"])
    left = answer["path"][-1]["rmse"] * np.sqrt(1.0 - term["share"])
    assert again["rmse"] == pytest.approx(left, rel=0.05)
    # It stays in the model of the next diagnosis, with its text.
    further = diagnose(client, measurement=rough, effects=term["model"]["effects"])
    assert further["model"]["effects"]["custom"]["term"] == term["formula"]
    assert "custom" not in {c["effect"] for c in further["candidates"]}


@pytest.mark.examination(
    "tests/identification/diagnose/test_diagnosis.py::test_a_ripple_is_an_unknown_effect_told_with_its_period_but_without_a_formula"
)
def test_an_unknown_effect_without_a_short_formula_is_told_with_its_place(client: TestClient) -> None:
    rows = cycle_rows(ripple, noise=1.0, each=40)
    waved = upload(client, "waved", text(rows, CYCLE_HEADER, "kind: isobaric"))
    verdict = diagnose(client, measurement=waved)["verdict"]
    assert verdict["status"] == "unknown_effect"
    assert verdict["unexplained_in"][0] == "contraction"
    assert verdict["proposed_term"] is None
    look = verdict["where_to_look"]
    assert look.startswith("No short formula halves it; look where it is largest: contraction")
    assert look in verdict["sentence"]


# --- what is asked


@pytest.mark.examination("tests/cli/test_diagnose.py::test_several_files_are_diagnosed_together")
def test_several_measurements_and_one_to_judge_by(client: TestClient, rubbing: str, other: str) -> None:
    both = diagnose(client, measurements=[{"id": rubbing}, {"id": other, "use": "fit"}])
    assert both["rows"] == 400
    assert set(both["verdict"]["effects"]) == {"bladder_elasticity", "coulomb_friction"}
    used = [{"id": rubbing, "use": "fit"}, {"id": other, "use": "validation"}]
    alone = diagnose(client, measurements=used)
    assert alone["rows"] == 240  # what judges is not fitted to
    shown = compare(client, measurements=used, effects=alone["model"]["effects"])
    assert 140 < shown["validation"]["rows_used"] < 160  # without turning rows and the first after a break
    assert shown["validation"]["rmse"] == pytest.approx(1.0, rel=0.2)


def test_a_stated_noise_is_the_floor(client: TestClient, rubbing: str) -> None:
    effects = {"bladder_elasticity": {}, "coulomb_friction": {}}
    answer = diagnose(client, measurement=rubbing, noise="0.0013 kN", effects=effects)
    assert answer["noise_floor"] | {"interval": None} == {"rmse": 1.3, "how": "given", "interval": None}
    assert answer["verdict"]["status"] == "adequate"


def test_freed_constants_of_the_start_model_are_fitted(client: TestClient, rubbing: str) -> None:
    effects = {"bladder_elasticity": {}, "coulomb_friction": {}}
    freed = ["bladder_elasticity.mooney_constant"]
    answer = diagnose(client, measurement=rubbing, effects=effects, freed=freed)
    assert answer["freed"] == freed
    assert answer["parameters"]["bladder_elasticity"]["mooney_constant"]["fitted"]


def test_prestress_and_zero_error_of_the_sensor_are_one_group(client: TestClient) -> None:
    rows = cycle_rows(noise=1.0, each=20, prestress=40.0)
    shifted = upload(client, "shifted", text(rows, CYCLE_HEADER, "kind: isobaric"))
    verdict = diagnose(client, measurement=shifted)["verdict"]
    assert verdict["status"] == "ambiguous"
    assert [sorted(group) for group in verdict["indistinguishable"]] == [["force_offset", "prestress"]]
    assert "muscle removed" in verdict["experiments"][0]["declared"]
    assert "sigma" in verdict["next_measurement"]
    assert sorted(verdict["experiments"][0]["pair"]) == ["force_offset", "prestress"]
    assert "cannot tell" in verdict["sentence"]


# --- transients


@pytest.fixture(scope="module")
def lifted(client: TestClient) -> str:
    """A run of the drive with a damping that the model does not have."""
    hidden = {**LIFT, "effects": {"viscous_damping": {"coefficient": "300 N*s/m"}}}
    run = post(client, "/api/simulations", {"drive": hidden, "points": 201}).json()
    random = np.random.default_rng(2)
    rows = [
        f"{t:.4f},{1 if t < 1.0 else -1},{p + random.normal(0, 500):.6g},{x + random.normal(0, 5e-5):.6g}"
        for t, p, x in zip(run["time"], run["pressure"], run["position"], strict=True)
    ]
    return upload(client, "lifted", text(rows, "time_s,command,pressure_Pa,displacement_m"))


def test_a_transient_is_told_channel_by_channel(client: TestClient, lifted: str) -> None:
    shown = compare(client, muscle=None, drive=LIFT, measurement=lifted)
    assert (shown["unit"], shown["noise_floor"]) == ("1", 1.0)
    assert set(shown["channels"]) == {"pressure", "displacement"}
    known = compare(
        client, muscle=None, drive=LIFT, measurement=lifted,
        effects={"viscous_damping": {"coefficient": 300.0}},
    )  # fmt: skip
    assert known["channels"]["pressure"]["rmse"] == pytest.approx(500.0, rel=0.15)
    assert known["channels"]["displacement"]["rmse"] == pytest.approx(5e-5, rel=0.15)
    assert shown["rmse"] > 2 * known["rmse"]


@pytest.mark.examination("tests/cli/test_saved_model.py::test_a_transient_brings_its_whole_drive")
def test_the_model_of_a_transient_is_a_drive_that_a_comparison_takes(client: TestClient) -> None:
    made = case("leak-rests")
    ((name, content),) = made.files.items()
    trace = upload(client, name, content)
    answer = diagnose(client, muscle=None, effects=None, drive=made.drive, measurement=trace)
    assert answer["freed"] == ["leak.laminar_share"]
    drive = answer["model"]["drive"]
    assert drive["effects"] == answer["model"]["effects"]
    again = compare(client, muscle=None, effects=None, drive=drive, measurement=trace)
    assert again["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)


def test_beside_a_measured_command_the_drive_needs_none(client: TestClient, lifted: str) -> None:
    silent = {name: part for name, part in LIFT.items() if name != "command"}
    told, untold = (
        compare(client, muscle=None, drive=drive, measurement=lifted)["series"] for drive in (LIFT, silent)
    )
    assert untold == told
    body = {"muscle": None, "drive": silent, "measurement": lifted, "diagnose": False}
    assert post(client, "/api/reports", body).status_code == 200
    # A run has nothing else to go by.
    assert_error(post(client, "/api/simulations", {"drive": silent}), 422, field="drive.command")


@pytest.mark.parametrize("part", ["command", "no command"])
def test_a_file_without_what_moves_it_says_so(client: TestClient, part: str) -> None:
    drive = {name: value for name, value in LIFT.items() if part == "command" or name != "command"}
    for channel, field in (("pressure_bar", "displacement"), ("displacement_mm", "pressure")):
        content = f"# kind: transient\ntime_s,{channel}\n0,0\n0.1,1\n0.2,2\n0.3,2\n"
        body = {"drive": drive, "measurement": upload(client, "lacking", content)}
        for path in (PATH, "/api/comparisons"):
            error = assert_error(post(client, path, body), 422, field=field)
            assert "command" in error["message"]
            assert "add a command column" in error["hint"] or "or a command column" in error["hint"]


def test_rows_that_are_not_used_are_counted_with_their_reason(client: TestClient) -> None:
    time = np.linspace(0.0, 6.0, 1301)
    rows = [f"{t:.5f},{3 + np.sin(t):.5f},{10 + np.sin(t):.5f}" for t in time]
    header = "time_s,pressure_bar,displacement_mm"
    moved = upload(client, "moved", text(rows, header, "load_mass: 20 kg"))
    answer = compare(client, measurement=moved)
    assert (answer["rows"], answer["rows_used"]) == (1301, 1000)
    ((reason, count),) = answer["excluded"].items()
    assert "1000 rows" in reason
    assert count == 301
    shown = post(client, "/api/reports", {"muscle": BRAID, "measurement": moved, "diagnose": False}).text
    assert "1000 of 1301" in shown
    assert f"301 {reason}" in shown


def test_every_row_of_a_diagnosis_is_accounted_for(client: TestClient) -> None:
    rows = cycle_rows(coulomb, noise=1.0, each=300)
    for place in (5, 6, 900):  # no pulling force
        time, pressure, length, _, direction = rows[place].split(",")
        rows[place] = f"{time},{pressure},{length},0,{direction}"
    long = upload(client, "long", text(rows, CYCLE_HEADER, "kind: isobaric"))
    answer = diagnose(client, measurement=long, effects={"coulomb_friction": {}})
    assert answer["rows"] == 3600 > 3500 > answer["rows_used"]
    assert answer["rows_used"] + sum(answer["excluded"].values()) == answer["rows"]
    assert answer["excluded"]["slack"] == 3
    assert answer["excluded"]["averaged into the others"] > 500
    assert any("means of up to" in message for message in answer["messages"])


def test_several_channels_have_no_one_noise(client: TestClient, lifted: str) -> None:
    for noise in (5.0, "5 N"):
        body = {"drive": LIFT, "measurement": lifted, "noise": noise}
        assert_error(post(client, PATH, body), 422, field="noise")


# --- streams


def listened(client: TestClient, body: dict[str, Any]) -> list[tuple[str, Any]]:
    response = client.post(PATH, json=body, headers={"accept": "text/event-stream"})
    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/event-stream")
    return events_of(response.text)


def test_a_stream_tells_progress_candidates_and_the_answer(
    client: TestClient, rubbing: str, answer: dict[str, Any]
) -> None:
    client.delete("/api/kept/space/bin/diagnoses")  # or it is answered as before
    found = listened(client, {"muscle": BRAID, "measurement": rubbing})
    assert found[0] == ("progress", {"share": 0.0})
    assert [name for name, _ in found[:-1]] == ["progress"] * (len(found) - 1)
    shares = [data["share"] for name, data in found[:-1]]
    assert shares == sorted(shares)
    assert max(shares) <= 1.0
    told = [data["found"] for _, data in found[:-1] if data.get("found")]
    for candidate in told:
        valid(CandidateResult, candidate)
    assert {c["effect"] for c in told} == {c["effect"] for c in answer["candidates"]}
    name, done = found[-1]
    assert name == "done"
    valid(DiagnosisResult, done)
    assert done["verdict"]["effects"] == answer["verdict"]["effects"]


def test_refusals_come_before_a_stream_begins(client: TestClient, rubbing: str) -> None:
    body = {"muscle": BRAID, "measurement": rubbing, "effects": {"prestres": {}}}
    response = client.post(PATH, json=body, headers={"accept": "text/event-stream"})
    assert_error(response, 422, field="effects.prestres")


def work_of(app: FastAPI, measurement: str):
    request = DiagnosisRequest.model_validate({"muscle": BRAID, "measurement": measurement})
    studio = app.state.studio
    return prepare(model_question(request, studio, app.state.store), studio)


def test_closing_the_stream_ends_the_search(app: FastAPI, client: TestClient, rubbing: str) -> None:
    work = work_of(app, rubbing)
    ends: list[BaseException] = []
    over = threading.Event()

    def noted(watch: Watch) -> object:
        try:
            return work(watch)
        except InputError as stop:
            ends.append(stop)
            raise
        finally:
            over.set()

    async def listen_and_leave() -> None:
        stream = events(noted).body_iterator
        for _ in range(3):
            assert b"progress" in bytes(await anext(stream))  # type: ignore[arg-type]
        await stream.aclose()  # type: ignore[union-attr]

    run_async(listen_and_leave())
    assert over.wait(60)
    assert [getattr(end, "code", None) for end in ends] == ["stopped"]


def test_a_search_that_takes_too_long_ends_with_what_it_found(
    client: TestClient, rubbing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    client.delete("/api/kept/space/bin/diagnoses")  # or it is answered as before
    monkeypatch.setattr(long_work, "Watch", lambda **_: Looks(5))
    body = {"muscle": BRAID, "measurement": rubbing}
    response = post(client, PATH, body)
    assert response.status_code == 200, response.text
    answer = response.json()
    valid(DiagnosisResult, answer)
    verdict, path = answer["verdict"], answer["path"]
    assert verdict["status"] == "unfinished"
    assert path[-1]["rmse"] < 0.7 * path[0]["rmse"]
    assert verdict["effects"] == [step["added"] for step in path if step["added"]]
    tried = len(answer["candidates"])
    left = [each["effect"] for each in answer["not_tried"] if "limit of time" in each["why"]]
    assert f"after {tried} of {tried + len(left)} effects had been tried alone" in verdict["sentence"]
    assert "The limit of 7 s of processor time ended the diagnosis" in verdict["sentence"]
    assert {c["probability"] for c in answer["candidates"]} == {None}
    again = post(client, "/api/comparisons", {**body, "effects": path[-1]["model"]["effects"]})
    assert again.json()["rmse"] == pytest.approx(path[-1]["rmse"], rel=1e-6)
    report = post(client, "/api/reports", {**body, "effects": {}, "diagnose": True})
    assert report.status_code == 200, report.text
    for words in ("Not finished: the limit of time ended the diagnosis", "With the effects found so far"):
        assert words in report.text


def test_a_search_that_ends_before_it_began_says_what_would_help(
    app: FastAPI, client: TestClient, rubbing: str
) -> None:
    with pytest.raises(InputError, match="before the start model was fitted") as error:
        work_of(app, rubbing)(Looks(0))
    assert error.value.code == "stopped"
    assert "rows of the measurement" in (error.value.hint or "")
    watch = Watch(cancelled=lambda: True)
    with pytest.raises(InputError):
        work_of(app, rubbing)(watch)
    assert watch.ended(1.0) is Outcome.CANCELLED


# --- refusals

REFUSED: dict[str, tuple[dict[str, Any], int, str, str]] = {
    "unknown effect": ({"effects": {"prestres": {}}}, 422, "effects.prestres", "Did you mean 'prestress'"),
    "unknown parameter": ({"effects": {"prestress": {"forc": 1}}}, 422, "effects.prestress.forc", "'force'"),
    "beyond its bounds": ({"effects": {"prestress": {"force": 1e9}}}, 422, "effects.prestress.force", "110"),
    "wrong unit": ({"effects": {"prestress": {"force": "1 kg"}}}, 422, "effects.prestress.force", "N"),
    "wrong term": ({"effects": {"custom": {"term": "c*log(P)"}}}, 422, "effects.custom.term", "abs"),
    "endless term": (
        {"effects": {"custom": {"term": "c/(L-0.3)"}}}, 422, "effects.custom.term", "division by zero"
    ),
    "no wall": (
        {"muscle": {**BRAID, "wall_thickness": 0}, "effects": {"bladder_elasticity": {}}}, 422,
        "muscle.wall_thickness", "mm",
    ),
    "unknown geometry": ({"free": ["braid_angel"]}, 422, "free.0", "braid_angle"),
    "geometry that is not known": (
        {"muscle": {**BRAID, "wall_thickness": 0}, "free": ["wall_thickness"]}, 422,
        "muscle.wall_thickness", "",
    ),
    "unknown constant": ({"freed": ["prestress.forc"]}, 422, "freed.0", "prestress.force"),
    "constant of nothing": ({"freed": ["prestress.force", "nothing.force"]}, 422, "freed.1", ""),
    "no path": ({"freed": ["force"]}, 422, "freed.0", ""),
    "no noise": ({"noise": 0}, 422, "noise", ""),
    "noise below zero": ({"noise": "-1 N"}, 422, "noise", "estimated"),
    "infinite noise": ({"noise": "inf"}, 422, "noise", "estimated"),
    "noise of another channel": ({"noise": "1 bar"}, 422, "noise", "N"),
    "noise in words": ({"noise": "little"}, 422, "noise", ""),
    "unknown measurement": ({"measurement": "martens-dmsp-20"}, 404, "measurement", "martens-dmsp-20-300"),
    "unknown of several": (
        {"measurement": None, "measurements": [{"id": "musclesim-2"}]}, 404, "measurements.0.id", "Did you"
    ),
    "none": ({"measurement": None}, 422, "measurements", "fit"),
    "unknown use": ({"measurements": [{"id": "musclesim-20", "use": "test"}]}, 422, "measurements.0.use", ""),
    "no muscle": ({"muscle": None}, 422, "muscle", "DMSP-20"),
    "unknown preset": ({"muscle": {"preset": "DMSP-21"}}, 422, "muscle.preset", "DMSP-20"),
    "impossible muscle": ({"muscle": {**BRAID, "braid_angle": "95 deg"}}, 422, "muscle.braid_angle", ""),
    "unknown field": ({"fit": True}, 422, "fit", ""),
    "drive without supply": ({"drive": {"muscle": BRAID}}, 422, "drive.supply", ""),
    "unknown valve": (
        {"drive": {**LIFT, "valve": {"preset": "MPYE"}}}, 422, "drive.valve.preset", "Did you mean"
    ),
    "effect of the drive": (
        {"muscle": None, "drive": {**LIFT, "effects": {"creeep": {}}}}, 422, "effects.creeep", "creep"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_refusals_name_the_field(client: TestClient, rubbing: str, name: str) -> None:
    change, status, field, hint = REFUSED[name]
    body = {"muscle": BRAID, "measurement": rubbing, **change}
    error = assert_error(post(client, PATH, body), status, field=field)
    assert hint in (error["hint"] or "")


FILES = {
    "a command needs the drive": (
        "time_s,command,pressure_bar,displacement_mm\n0,1,0,0\n0.1,1,1,2\n0.2,0,2,3\n0.3,0,2,3\n", "drive"
    ),
    "a driven transient needs its load": (
        "time_s,pressure_bar,displacement_mm\n0,0,0\n0.1,1,2\n0.2,2,3\n0.3,2,3\n", "load_mass"
    ),
    "a transient needs a displacement": (
        "# load_mass: 5 kg\n# kind: transient\ntime_s,pressure_bar\n0,0\n0.1,1\n0.2,2\n", "displacement"
    ),
    "beyond the lock": ("# kind: static\npressure_bar,length_mm,force_N\n1,340,5\n2,341,6\n", "measurement"),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("path", [PATH, "/api/comparisons"])
def test_what_a_measurement_lacks_is_named(client: TestClient, path: str, name: str) -> None:
    content, field = FILES[name]
    body = {"muscle": BRAID, "measurement": upload(client, "lacking", content)}
    assert_error(post(client, path, body), 422, field=field)


def test_the_published_description_has_all_of_it() -> None:
    document = published()
    operation = document["paths"][PATH]["post"]
    assert "text/event-stream" in operation["responses"]["200"]["content"]
    assert set(document["components"]["schemas"]["DiagnosisResult"]["properties"]) == PROMISED
    values = document["components"]["schemas"]["Verdict"]["properties"]["status"]["enum"]
    assert set(values) == STATUS


@pytest.mark.examination(
    "tests/identification/diagnose/test_diagnosis.py::test_the_maps_of_martens_and_boblan_from_the_ideal_muscle"
)
def test_a_preset_and_its_map(client: TestClient) -> None:
    response = post(client, PATH, {"muscle": {"preset": "DMSP-20"}, "measurement": "martens-dmsp-20-300"})
    assert response.status_code == 200, response.text
    answer = response.json()
    own = {"bladder_elasticity", "prestress", "lost_stroke", "dahl", "viscous_damping"}
    assert set(answer["path"][0]["model"]["effects"]) == own
    assert answer["path"][-1]["rmse"] < answer["baseline"]["rmse"]
    assert answer["verdict"]["status"] in STATUS


@pytest.mark.examination(
    "tests/identification/diagnose/test_diagnosis.py::test_a_constant_without_a_slope_where_it_stands_is_found_where_it_has_one"
)
def test_a_start_term_without_a_slope_at_a_row_is_diagnosed(shared_client: TestClient) -> None:
    rows = cycle_rows(coulomb, noise=1.0, each=20)
    content = text(rows, CYCLE_HEADER, "kind: isobaric").encode()
    name = shared_client.put("/api/measurements?name=root.csv", content=content).json()["id"]
    effects = {"custom": {"term": "c*sqrt(L - 0.252)", "c": 1.0}}  # the shortest length of the file
    body = {"muscle": {"preset": "DMSP-20", "nominal_length": 0.3}, "measurement": name, "effects": effects}
    response = post(shared_client, "/api/diagnoses", body)
    assert response.status_code == 200, response.text
    assert response.json()["path"][-1]["rmse"] <= response.json()["baseline"]["rmse"]


def test_a_handful_of_rows_is_refused_in_words(client: TestClient) -> None:
    lines = ["1,300,100", "2,295,190", "3,290,260", "4,285,300"]
    few = upload(client, "few", text(lines, "pressure_bar,length_mm,force_N"))
    response = post(client, PATH, {"muscle": BRAID, "measurement": few})
    assert response.status_code == 422
    assert "4 values are too few for a diagnosis" in response.text


# --- entries that may be wrong


LONG = {**BRAID, "nominal_length": "345 mm"}


@pytest.fixture(scope="module")
def doubted(client: TestClient, rubbing: str) -> dict[str, Any]:
    """The same cycles, with a muscle of 345 mm stated instead of 300 mm."""
    return diagnose(client, measurement=rubbing, muscle=LONG)


@pytest.mark.examination(
    "tests/identification/diagnose/test_contest.py"
    "::test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first"
)
def test_a_wrong_rest_length_is_asked_about_first(doubted: dict[str, Any]) -> None:
    first = doubted["context"][0]
    assert (first["hypothesis"], first["field"], first["asked"]) == (
        "rest_length", "muscle.nominal_length", True,
    )  # fmt: skip
    assert first["stated"] == pytest.approx(0.345)
    assert first["value"] == pytest.approx(0.3, abs=2e-3)
    assert set(first["effects"]) == {"bladder_elasticity", "coulomb_friction"}
    assert first["rmse_after"] == pytest.approx(1.0, rel=0.15)
    verdict = doubted["verdict"]
    assert verdict["status"] == "ambiguous"
    assert verdict["proposed_term"] is None
    assert verdict["sentence"].startswith("Check an entry first: Rest length 300")
    assert "--keep rest_length" in verdict["sentence"]


@pytest.mark.examination(
    "tests/identification/diagnose/test_contest.py"
    "::test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first"
)
def test_an_accepted_entry_is_fitted_and_its_origin_is_a_suggestion(client: TestClient, rubbing: str) -> None:
    used = diagnose(client, measurement=rubbing, muscle=LONG, use=["rest_length"])
    assert set(used["verdict"]["effects"]) == {"bladder_elasticity", "coulomb_friction"}
    assert used["model"]["muscle"]["nominal_length"] == pytest.approx(0.3, abs=2e-3)
    said = used["experiment"]["rest_length"]
    assert (said["origin"], said["where"]) == ("suggested", '"use": ["rest_length"]')
    assert said["value"] == pytest.approx(0.3, abs=2e-3)
    assert not any(entry["asked"] for entry in used["context"])


@pytest.mark.examination(
    "tests/identification/diagnose/test_contest.py::test_kept_it_is_told_but_not_asked_about"
)
def test_a_kept_entry_is_told_and_not_asked(client: TestClient, rubbing: str) -> None:
    kept = diagnose(client, measurement=rubbing, muscle=LONG, keep=["rest_length"])
    (entry,) = [entry for entry in kept["context"] if entry["hypothesis"] == "rest_length"]
    assert (entry["kept"], entry["asked"]) == (True, False)
    assert any("is kept as stated, although" in message for message in kept["messages"])


@pytest.mark.examination("tests/identification/diagnose/test_contest.py::test_a_force_in_kgf_is_read_in_kgf")
def test_a_force_in_kgf_is_compared_in_newton_once_accepted(client: TestClient) -> None:
    rows = cycle_rows(noise=1.0, each=20, second=3.0)
    small = []
    for row in rows:
        time, pressure, length, force, direction = row.split(",")
        small.append(f"{time},{pressure},{length},{float(force) / 9.80665:.6f},{direction}")
    wrong = upload(client, "kgf", text(small, CYCLE_HEADER, "kind: isobaric"))
    answer = diagnose(client, measurement=wrong)
    assert answer["context"][0]["hypothesis"] == "force_in_kgf"
    assert answer["context"][0]["value"] == "in kgf"
    compared = compare(client, measurement=wrong, use=["force_in_kgf"])
    assert compared["rmse"] == pytest.approx(1.0, rel=0.15)
    assert compared["experiment"]["force"]["origin"] == "suggested"


@pytest.mark.parametrize("decision", ["use", "keep"])
@pytest.mark.parametrize("path", [PATH, "/api/comparisons"])
def test_a_decision_about_nothing_names_its_field(
    client: TestClient, rubbing: str, path: str, decision: str
) -> None:
    body = {"muscle": BRAID, "measurement": rubbing, decision: ["rest_lenght"]}
    error = assert_error(post(client, path, body), 422, field=decision)
    assert "rest_length" in error["hint"]
