"""``POST /api/simulations``: columns and timing, streams, cancelling, refusals."""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Callable
from contextlib import closing
from http.client import HTTPConnection
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import pytest
from fastapi import Request
from fastapi.testclient import TestClient

from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.facts.timing import TIMING as FIGURES
from mckibben.server.long_work import events, finished
from mckibben.simulation.integrate.lane_buffers import lane_kernels
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.timing.evaluation import ChokedInterval, choked_intervals, grid_of
from tests.running_server import AUTHORIZED, RunningServer
from tests.server.answers import valid
from tests.server.conftest import assert_error, post, run_async

PATH = "/api/simulations"
LIFT: dict[str, Any] = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"},
    "supply": {"pressure": "6 bar"},
    "valve": {"preset": "MPYE-5-1/8-HF"},
    "tube": {"inside_diameter": "4 mm", "length": "1 m"},
    "load": {"mass": "8 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "2 s"},
    "duration": "4 s",
}
CONTROLLED = {
    **LIFT,
    "controller": {
        "kp": 0.5,
        "ki": 5.0,
        "reference": {"shape": "triangle", "amplitude": "20 mm", "period": "2 s"},
    },
}
PROMISED = {
    "time", "position", "velocity", "acceleration", "pressure", "force", "mass_flow", "timing", "outcome",
    "wall_ms",
}  # fmt: skip
TIMING = {
    "positioning_time", "rise_time", "delay_time", "settling_time", "average_speed", "max_speed",
    "max_speed_at", "max_acceleration", "max_acceleration_at", "min_acceleration", "min_acceleration_at",
    "end_speed", "impact_energy", "pressure_rise_time", "pressure_delay_time", "pressure_settling_time",
    "supplied_mass", "supplied_volume_anr", "vented_mass", "vented_volume_anr",
}  # fmt: skip


@pytest.fixture(scope="module", autouse=True)
def _kernel_ready() -> None:
    lane_kernels.warm().join()


def events_of(text: str) -> list[tuple[str, Any]]:
    """Names and data of a stream of events."""
    found = []
    for block in text.strip().split("\n\n"):
        name, _, data = block.partition("\n")
        found.append((name.removeprefix("event: "), json.loads(data.removeprefix("data: "))))
    return found


@pytest.fixture(scope="module")
def lift(shared_client: TestClient) -> dict[str, Any]:
    """The answer for the lift."""
    response = post(shared_client, PATH, {"drive": LIFT, "points": 401})
    assert response.status_code == 200, response.text
    return response.json()


def test_the_answer_is_the_declared_one(lift: dict[str, Any]) -> None:
    valid(SimulationResult, lift)
    assert set(lift) >= PROMISED
    assert lift["outcome"] == "completed"
    assert lift["message"] is None
    mass = float(LIFT["load"]["mass"].removesuffix(" kg"))
    assert lift["weight"] == pytest.approx(9.80665 * mass), "it hangs"
    assert set(lift["timing"]["extend"]) >= TIMING
    assert set(lift["timing"]["retract"]) >= TIMING
    assert set(lift["timing"]["extend"]) == {*FIGURES, "state", "motion"}
    columns = [name for name, value in lift.items() if isinstance(value, list)]
    for name in set(columns) - {"choked", "flags", "events"}:
        assert len(lift[name]) == 401, name


def test_columns_belong_together(lift: dict[str, Any]) -> None:
    at = {name: np.asarray(lift[name]) for name in ("time", "position", "velocity", "length", "contraction")}
    assert at["time"][0] == 0.0
    assert at["time"][-1] == 4.0
    assert at["length"] + at["position"] == pytest.approx(0.8)
    assert at["contraction"] == pytest.approx(at["position"] / 0.8)
    assert 0.19 < at["position"].max() < 0.2003  # an impact presses into the stop
    slope = np.gradient(at["position"], at["time"])
    smooth = ~np.asarray(lift["contact"])
    assert np.median(np.abs(slope - at["velocity"])[smooth]) < 2e-3
    air = np.trapezoid(lift["mass_flow"], at["time"])
    assert abs(air) < 0.02 * lift["timing"]["extend"]["supplied_mass"]  # what went in has come out
    assert max(lift["pressure"]) == pytest.approx(6e5, rel=1e-2)


def test_timing_does_not_depend_on_the_rows_asked_for(
    shared_client: TestClient, lift: dict[str, Any]
) -> None:
    few = post(shared_client, PATH, {"drive": LIFT, "points": 21}).json()
    assert len(few["time"]) == 21
    for phase in ("extend", "retract"):
        for name, value in lift["timing"][phase].items():
            exact = value is None or isinstance(value, str)
            assert few["timing"][phase][name] == (
                value if exact else pytest.approx(value, rel=0.02, abs=2e-3)
            )


def test_a_window_holds_the_same_run(shared_client: TestClient, lift: dict[str, Any]) -> None:
    part = post(shared_client, PATH, {"drive": LIFT, "points": 51, "from": "1.9 s", "to": "2.4 s"}).json()
    assert part["time"] == pytest.approx(np.linspace(1.9, 2.4, 51))
    assert part["position"][10] == pytest.approx(lift["position"][200], abs=2e-5)
    assert part["timing"]["extend"]["rise_time"] == pytest.approx(
        lift["timing"]["extend"]["rise_time"], rel=5e-3
    )


def test_choked_intervals() -> None:
    time = np.arange(7.0)
    found = choked_intervals(time, np.array([0, 1, 1, 0, 2, 2, 2]))
    assert found == [ChokedInterval(1.0, 3.0, "fill"), ChokedInterval(4.0, 6.0, "exhaust")]
    assert choked_intervals(np.empty(0), np.empty(0)) == []


@pytest.mark.parametrize(
    ("duration", "begin", "end", "points"),
    [(4.0, 0.0, 4.0, 401), (4.0, 1.0, 2.0, 2), (600.0, 10.0, 599.0, 3), (0.01, 0.0, 0.01, 20_001)],
)
def test_the_rows_are_part_of_a_finer_grid(duration: float, begin: float, end: float, points: int) -> None:
    grid = grid_of(duration=duration, begin=begin, end=end, points=points)
    assert (np.diff(grid.time) > 0.0).all()
    assert (grid.time[0], grid.time[-1]) == (0.0, duration)
    assert grid.time[grid.rows] == pytest.approx(np.linspace(begin, end, points))
    assert len(grid.time) < 45_000


def test_a_preset_runs_by_its_id(shared_client: TestClient) -> None:
    answer = post(shared_client, PATH, {"drive": "paper-step", "points": 101}).json()
    assert answer["outcome"] == "completed"
    assert answer["duration"] == 0.5
    assert answer["timing"]["extend"]["rise_time"] == pytest.approx(0.0261, rel=0.05)


def test_a_load_at_rest_lies_between_its_static_contractions(shared_client: TestClient) -> None:
    """Dry friction holds it anywhere between where it would come to rest from below and from above."""
    body = {"drive": "paper-ramp", "points": 101, "static": True}
    answer = post(shared_client, PATH, body).json()
    assert post(shared_client, PATH, {**body, "static": False}).json()["static_filling"] is None
    assert answer["velocity"][-1] == 0.0
    assert answer["stuck"][-1]
    low, high = (answer[name][-1] for name in ("static_filling", "static_venting"))
    assert low < answer["contraction"][-1] < high
    assert len(answer["static_filling"]) == len(answer["time"])


def test_a_controlled_run_tells_how_it_follows(shared_client: TestClient) -> None:
    answer = post(shared_client, PATH, {"drive": CONTROLLED, "points": 201}).json()
    valid(SimulationResult, answer)
    assert answer["tracking"]["rms"] < 0.015
    assert max(answer["reference"]) == pytest.approx(0.02)
    assert answer["notes"]["command"].startswith("not used")
    # The phases are those of the reference: it rises for a second, then falls; it never jumps.
    assert answer["timing"]["extend"]["max_speed"] is not None
    assert answer["timing"]["extend"]["delay_time"] is None


def test_lever_and_load_are_told_at_the_load(shared_client: TestClient) -> None:
    drive = {**LIFT, "load": {"mass": "2 kg", "arrangement": "lever", "lever_ratio": 0.5}}
    answer = post(shared_client, PATH, {"drive": drive, "points": 101}).json()
    stroke = 0.8 - np.asarray(answer["length"])
    assert np.asarray(answer["position"]) == pytest.approx(stroke / 0.5)
    assert answer["limits"]["position_max"] == pytest.approx(0.4)


def test_sensors_are_told_when_an_effect_changes_them(
    shared_client: TestClient, lift: dict[str, Any]
) -> None:
    assert lift["readings"] is None
    drive = {**LIFT, "effects": {"pressure_offset": {"offset": "0.1 bar"}}}
    answer = post(shared_client, PATH, {"drive": drive, "points": 11}).json()
    assert np.asarray(answer["readings"]["pressure"]) - answer["pressure"] == pytest.approx(1e4)


def test_limits_are_told_and_never_clipped(shared_client: TestClient) -> None:
    heavy = {
        **LIFT,
        "supply": {"pressure": "9 bar"},
        "load": {"mass": "300 kg"},
        "stops": {"min_contraction": -0.06, "max_contraction": 0.3},
        "duration": "8 s",
    }
    answer = post(shared_client, PATH, {"drive": heavy, "points": 101}).json()
    codes = [flag["code"] for flag in answer["flags"]]
    assert {"over_pressure", "over_force_limit", "over_pretension_limit"} <= set(codes)
    assert len({(flag["code"], flag["message"]) for flag in answer["flags"]}) == len(codes)
    assert max(answer["pressure"]) > 8e5


def test_a_stream_ends_with_the_answer(shared_client: TestClient) -> None:
    response = shared_client.post(
        PATH, json={"drive": CONTROLLED, "points": 11}, headers={"accept": "text/event-stream"}
    )
    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/event-stream")
    found = events_of(response.text)
    assert found[0] == ("progress", {"share": 0.0})
    assert found[-1][0] == "done"
    shares = [data["share"] for name, data in found if name == "progress"]
    assert shares == sorted(shares)
    valid(SimulationResult, found[-1][1])


def test_an_error_inside_a_stream_is_an_event(shared_client: TestClient) -> None:
    beyond = {**LIFT, "start": {"position": "2 m"}}
    response = shared_client.post(PATH, json={"drive": beyond}, headers={"accept": "text/event-stream"})
    name, data = events_of(response.text)[-1]
    assert name == "error"
    assert data["error"]["field"] == "drive.start.position"
    assert_error(post(shared_client, PATH, {"drive": beyond}), 422, field="drive.start.position")


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "drive"),
        ({"drive": LIFT, "points": 1}, "points"),
        ({"drive": LIFT, "points": 20_002}, "points"),
        ({"drive": LIFT, "rows": 5}, "rows"),
        ({"drive": LIFT, "from": "3 s", "to": "2 s"}, "from"),
        ({"drive": LIFT, "to": "5 s"}, "to"),
        ({"drive": 7}, "drive"),
        ({"drive": "no such"}, "drive"),
        ({"drive": "paper-stepp"}, "drive"),
        ({"drive": {**LIFT, "vavle": {}}}, "drive.vavle"),
        ({"drive": {**LIFT, "load": {"mass": -1}}}, "drive.load.mass"),
        ({"drive": {**LIFT, "command": {"shape": "pulse", "off": "2 m"}}}, "drive.command.off"),
        ({"drive": {**LIFT, "effects": {"creeep": {}}}}, "drive.effects.creeep"),
        ({"drive": {**LIFT, "valve": {"preset": "MPYE"}}}, "drive.valve.preset"),
        ({"drive": {**LIFT, "stops": {"min_contraction": "-50 %"}}}, "drive.stops.min_contraction"),
    ],
)
def test_refusals_name_the_field(shared_client: TestClient, body: dict[str, Any], field: str) -> None:
    error = assert_error(post(shared_client, PATH, body), 422)
    assert error["field"] == field


def test_refusals_come_before_a_stream_begins(shared_client: TestClient) -> None:
    response = shared_client.post(
        PATH, json={"drive": {**LIFT, "duration": 0}}, headers={"accept": "text/event-stream"}
    )
    assert_error(response, 422, field="drive.duration")


# --- ending early


def test_a_watch_ends_by_work_and_by_the_caller() -> None:
    watch = Watch(time_limit=0.01)
    watch.ended(0.0)
    time.sleep(0.1)  # while others have the processor
    assert watch.ended(0.1) is None
    while time.process_time() - (watch._began or 0.0) < 0.02:
        pass
    assert watch.ended(0.1) is Outcome.TIMED_OUT
    gone = threading.Event()
    shares: list[float] = []
    watch = Watch(cancelled=gone.is_set, progress=shares.append)
    assert watch.ended(0.0) is None
    time.sleep(0.15)
    assert watch.ended(0.5) is None
    assert shares == [0.5]
    gone.set()
    assert watch.ended(0.6) is Outcome.CANCELLED


def test_a_run_that_is_stopped_ends_with_a_name_and_what_there_is(shared_client: TestClient) -> None:
    studio = shared_client.app.state.studio  # type: ignore[attr-defined]
    # 400 000 samples take half a second at least.
    sampled = {**CONTROLLED, "controller": {**CONTROLLED["controller"], "sample_time": "10 us"}}
    given = drive_of(read_document(sampled, "the drive"), studio)
    for limit in (0.0, 0.05):
        stopped = simulate(SimulationQuestion(given, points=401), Watch(time_limit=limit))
        assert stopped.outcome == "timed_out"
        assert stopped.message is not None
        assert "Shorten" in stopped.message
        assert len(stopped.time) < 401


def until_cancelled(ends: list[Outcome]) -> Callable[[Watch], str]:
    """Work that goes on until it is told not to, and notes what it was told."""

    def work(watch: Watch) -> str:
        while (ended := watch.ended(0.5)) is None:
            time.sleep(0.005)
        ends.append(ended)
        return ended.label

    return work


def test_closing_a_stream_ends_the_work() -> None:
    ends: list[Outcome] = []

    async def listen_and_leave() -> None:
        stream = events(until_cancelled(ends)).body_iterator
        assert b"progress" in bytes(await anext(stream))  # type: ignore[arg-type]
        await stream.aclose()  # type: ignore[union-attr]

    run_async(listen_and_leave())  # waits for the thread
    assert ends == [Outcome.CANCELLED]


def test_leaving_without_a_stream_ends_the_work() -> None:
    ends: list[Outcome] = []

    async def gone() -> dict[str, str]:
        return {"type": "http.disconnect"}

    request = Request({"type": "http", "headers": []}, gone)
    assert run_async(finished(request, until_cancelled(ends), str.encode)) == b"cancelled"
    assert ends == [Outcome.CANCELLED]


def test_an_unexpected_error_in_a_stream_tells_no_traceback(caplog: pytest.LogCaptureFixture) -> None:
    def broken(watch: Watch) -> None:
        raise RuntimeError("secret")

    async def listen() -> list[bytes]:
        return [bytes(part) async for part in events(broken).body_iterator]  # type: ignore[arg-type]

    name, data = events_of(b"".join(run_async(listen())).decode())[-1]
    assert name == "error"
    assert data["error"]["code"] == "internal_error"
    assert "secret" not in json.dumps(data)
    assert "secret" in caplog.text


def test_the_first_run_of_a_new_process_is_answered(server: RunningServer) -> None:
    with closing(HTTPConnection(urlsplit(server.url).netloc, timeout=30)) as connection:
        body = json.dumps({"drive": LIFT, "points": 401})
        connection.request("POST", PATH, body, {"content-type": "application/json", **AUTHORIZED})
        answer = json.loads(connection.getresponse().read())
    assert answer["outcome"] == "completed"


def test_an_antagonist_pair_turns_its_pulley(shared_client: TestClient) -> None:
    """Fill one, vent the other from 3 bar: torque and angle the same way, stiffness of both muscles."""
    drive = {
        "muscle": {"preset": "DMSP-20"},
        "supply": {"pressure": "6 bar"},
        "valve": {"sonic_conductance": "0.2 l/(s*bar)"},
        "load": {
            "arrangement": "antagonist",
            "mass": "5 kg",
            "pulley_radius": "25 mm",
            "precontraction": "8 %",
        },
        "command": {"shape": "pulse", "on": "0.2 s", "off": "0.3 s", "initial": 0.0},
        "start_pressure": "3 bar",
        "duration": "1 s",
    }
    answer = shared_client.post("/api/simulations", json={"drive": drive, "points": 101}).json()
    assert answer["outcome"] == "completed"
    joint = answer["joint"]
    assert joint["angle"][0] == pytest.approx(0.0, abs=1e-6)
    assert joint["torque"][0] == pytest.approx(0.0, abs=1e-6)
    assert answer["contraction"][0] == pytest.approx(0.08, abs=1e-6)
    assert max(joint["angle"]) > 0.05
    assert answer["pressure"][-1] > 3e5 > joint["counter_pressure"][-1]
    # At the start both muscles are equal: twice one muscle's stiffness at the radius squared.
    curves = {"muscle": {"preset": "DMSP-20"}, "pressures": ["3 bar"], "points": 2}
    curves |= {"contraction_from": 0.08, "contraction_to": 0.09}
    stiffness = shared_client.post("/api/curves", json=curves).json()["stiffness"][0][0]
    assert joint["stiffness"][0] == pytest.approx(2 * 0.025**2 * stiffness, rel=1e-3)


@pytest.mark.parametrize(
    ("load", "field"),
    [
        ({"arrangement": "antagonist", "mass": "5 kg"}, "drive.load.pulley_radius"),
        ({"mass": "5 kg", "pulley_radius": "25 mm"}, "drive.load.pulley_radius"),
        (
            {"arrangement": "antagonist", "pulley_radius": "25 mm", "precontraction": "40 %"},
            "drive.load.precontraction",
        ),
    ],
)
def test_a_pair_that_cannot_be_is_refused_at_its_field(
    shared_client: TestClient, load: dict, field: str
) -> None:
    drive = {
        "muscle": {"preset": "DMSP-20"},
        "supply": {"pressure": "6 bar"},
        "valve": {"sonic_conductance": "0.2 l/(s*bar)"},
        "load": load,
        "command": {"shape": "step"},
        "duration": "1 s",
    }
    answer = shared_client.post("/api/simulations", json={"drive": drive})
    assert answer.status_code == 422
    assert answer.json()["error"]["field"] == field


def test_a_joint_has_two_set_points_and_both_muscles_in_the_answer(shared_client: TestClient) -> None:
    drive = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "supply": {"pressure": "6 bar"},
        "valve": {"preset": "VPPM-6"},
        "load": {"mass": "4 kg", "arrangement": "antagonist", "pulley_radius": "30 mm"},
        "controller": {
            "kp": 2.5, "ki": 15, "kd": 0.03, "sample_time": "2 ms", "angle": "8 deg",
            "stiffness": {"reference": "22 N*m/rad"},
        },
        "start_pressure": "3 bar",
        "duration": "2 s",
    }  # fmt: skip
    joint = post(shared_client, "/api/simulations", {"drive": drive, "points": 51}).json()["joint"]
    assert joint["angle_reference"] == pytest.approx([math.radians(8.0)] * 51)
    assert joint["stiffness"][-1] == pytest.approx(22.0, rel=0.02)
    assert math.degrees(joint["angle"][-1]) == pytest.approx(8.0, abs=0.5)
    for name in ("mass_flow", "supply_flow", "exhaust_flow", "diameter", "command"):
        assert len(joint[f"counter_{name}"]) == 51
    refused = post(shared_client, "/api/simulations", {"drive": {**drive, "load": {"mass": "4 kg"}}})
    assert_error(refused, 422, field="drive.controller.angle")
