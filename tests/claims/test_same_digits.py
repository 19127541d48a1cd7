"""The same question has the same digits, whichever door it comes through."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from mckibben.cli import run
from mckibben.resources import presets_folder

DRIVE: dict[str, Any] = json.loads((presets_folder() / "drives" / "paper-pid-pulse.json").read_text())[
    "document"
]
TASK: dict[str, Any] = {
    **json.loads((presets_folder() / "tasks" / "lift-20kg.json").read_text())["document"],
    "catalogue": {
        "muscles": ["DMSP-20"],
        "valves": ["MPYE-5-1/8-HF"],
        "tubes": ["PUN-H-6x1"],
        "tube_length": "1 m",
    },
    "uncertainty": {"specimens": 0},
}


@pytest.fixture
def printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Any:
    """The JSON that a command prints of a document."""

    def answer(command: str, document: dict[str, Any], *options: str) -> dict[str, Any]:
        file = tmp_path / "document.json"
        file.write_text(json.dumps(document))
        assert run([command, str(file), *options, "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return answer


def test_a_run_and_its_figures(shared_client: TestClient, printed: Any) -> None:
    over_http = shared_client.post("/api/simulations", json={"drive": DRIVE, "points": 2001}).json()
    on_terminal, in_python = printed("simulate", DRIVE), mk.Drive.preset("paper-pid-pulse").run().to_dict()
    for name in ("position", "pressure", "timing", "tracking", "steps", "outcome"):
        assert over_http[name] == on_terminal[name], name
        assert json.loads(json.dumps(in_python[name])) == on_terminal[name], name


def test_a_designed_controller(shared_client: TestClient, printed: Any) -> None:
    goals = {"overshoot": 0.05, "settling": 0.5, "step": 0.01}
    body = {"drive": DRIVE, "amplitudes": [], "design": goals}
    over_http = shared_client.post("/api/linearisations", json=body).json()["design"]
    words = "overshoot 5 %, settling 0.5 s, step 10 mm"
    on_terminal = printed("linearise", DRIVE, "--design", words, "--amplitudes", "none")["design"]
    view = mk.Drive.preset("paper-pid-pulse").linearise(design=words, amplitudes=())
    gains = [trial["controller"] for trial in over_http["trials"]]
    assert gains == [trial["controller"] for trial in on_terminal["trials"]]
    assert gains == [
        trial["controller"] for trial in json.loads(json.dumps(view.to_dict()["design"]["trials"]))
    ]


def test_a_sizing(shared_client: TestClient, printed: Any) -> None:
    over_http = shared_client.post("/api/sizings", json=TASK).json()["proposals"]
    on_terminal, in_python = printed("size", TASK)["proposals"], mk.size(TASK).to_dict()["proposals"]
    for name in ("nominal_length", "pressure", "time", "air_volume_anr", "force_reserve", "reason"):
        found = [each[name] for each in over_http]
        assert found == [each[name] for each in on_terminal] == [each[name] for each in in_python], name


@pytest.mark.parametrize("name", ["propneu-20-physical", "paper-pid-pulse", "joint-20"])
def test_figures_do_not_depend_on_the_rows_that_are_asked_for(name: str) -> None:
    drive = mk.Drive.preset(name)
    usual = drive.run().to_dict()
    kept = ("timing", "tracking", "verdict", "choked", "events", "supplied_volume_anr", "flags", "notes")
    for rows in ({"points": 11}, {"points": 1000}, {"points": 777, "begin": "0.1 s", "end": 0.7}):
        found = drive.run(**rows).to_dict()
        assert {key: found[key] for key in kept} == {key: usual[key] for key in kept}
        if found["joint"]:
            assert found["joint"]["stiffness_error"] == usual["joint"]["stiffness_error"]
