"""One document language: each use case says the same at every door, in long form and in shorthand."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from mckibben.documents.task import named_task, read_task
from mckibben.door.workspace import studio
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.cli.conftest import Run, write
from tests.door.test_equal import differences

PULSE = {"shape": "pulse", "on": "0 s", "off": "0.2 s"}
SHORT = {
    "muscle": "DMSP-20:300mm", "valve": "MPYE-5-1/8-LF", "tube": "PUN-H-6x1", "supply": "7 bar(a)",
    "load": "12 kg", "command": PULSE, "duration": "0.4 s", "gas": {"ambient_pressure": "1 bar"},
}  # fmt: skip
LONG = {
    **SHORT, "kind": "drive", "muscle": {"preset": "DMSP-20", "nominal_length": 0.3},
    "valve": {"preset": "MPYE-5-1/8-LF"}, "tube": {"preset": "PUN-H-6x1"}, "supply": {"pressure": 6e5},
    "load": {"mass": 12.0},
}  # fmt: skip
MUSCLES = ("DMSP-20:310mm", {"preset": "DMSP-20", "nominal_length": "310 mm"})
STUDY = {
    "subject": {"drive": SHORT}, "quantities": [{"path": "supply.pressure", "values": ["5 bar", "6 bar"]}],
    "figures": ["largest.pressure"], "method": {"type": "list"},
}  # fmt: skip
MAP = "pressure_bar,length_mm,force_N\n" + "".join(
    f"{p},{length},{p * 2.5 * (length - 220) + 5 * (length % 3)}\n"
    for p in (2, 4, 6)
    for length in range(240, 300, 5)
)
TASK = {
    "load": "5 kg", "stroke": "20 mm", "limits": {"max_length": "250 mm", "max_parallel": 1},
    "catalogue": {"muscles": ["DMSP-20"], "valves": ["MPYE-5-1/8-LF"]}, "uncertainty": {"specimens": 0},
}  # fmt: skip
PRESSURES = ("1 bar, 3 bar", ["1 bar", 3e5])
FORCE = {"force": "500 N", "contraction": "10 %"}


class Http:
    """The server, asked in this process."""

    def __init__(self) -> None:
        self.client = TestClient(create_app(Settings()), base_url="http://127.0.0.1")

    def __call__(self, path: str, body: dict[str, Any]) -> dict[str, Any]:
        answer = self.client.post(f"/api/{path}", json=body)
        assert answer.status_code == 200, answer.text
        return answer.json()


@pytest.fixture(scope="module")
def http() -> Http:
    return Http()


def said(run: Run, *words: str) -> dict[str, Any]:
    code, out, err = run(*words, "--json")
    assert code == 0, err
    return json.loads(out)


def model(muscle: Any) -> mk.Model:
    return mk.load(write("m.json", {"muscle": muscle})) if isinstance(muscle, str) else mk.Model(**muscle)


def curves(run: Run, http: Http) -> list[dict[str, Any]]:
    names = [MUSCLES[0], write("a.json", {"muscle": MUSCLES[0]}), write("b.json", MUSCLES[1])]
    both = [(muscle, pressures) for muscle in MUSCLES for pressures in PRESSURES]
    return [
        *(said(run, "curves", "--muscle", str(name), "--pressure", "1 bar, 3 bar") for name in names),
        *(model(muscle).curves(pressures).to_dict() for muscle, pressures in both),
        *(http("curves", {"muscle": muscle, "pressures": pressures}) for muscle, pressures in both),
    ]


def inverse(run: Run, http: Http) -> list[dict[str, Any]]:
    words = [word for name, value in FORCE.items() for word in (f"--{name}", value)]
    return [
        said(run, "inverse", "pressure", "--muscle", str(MUSCLES[0]), *words),
        *(model(muscle).inverse("pressure", **FORCE).to_dict() for muscle in MUSCLES),
        *(http("inverse", {"muscle": muscle, "question": "pressure", **FORCE}) for muscle in MUSCLES),
    ]


JOINT = {
    "muscle": "DMSP-20:300mm",
    "muscles": [
        {"path": {"lever": "30 mm", "contraction": "10 %"}}, {"path": {"lever": -0.03, "contraction": 0.1}},
    ],
    "stops": {"min_angle": "-30 deg", "max_angle": "30 deg"},
}  # fmt: skip


def joints(run: Run, http: Http) -> list[dict[str, Any]]:
    asked = {"pressures": ["4 bar, 2 bar"], "angle": "10 deg", "stiffness": "22 N*m/rad"}
    long = {"pressures": [[4e5, 2e5]], "angle": "10 deg", "stiffness": 22.0}
    file = write("joint.json", {**JOINT, "kind": "joint"})
    words = [word for name in ("angle", "stiffness") for word in (f"--{name}", asked[name])]
    parts = {name: part for name, part in JOINT.items() if name != "muscles"}
    joint = mk.Joint(JOINT["muscles"], **parts)
    return [
        said(run, "joint", file, "--pressures", "4 bar, 2 bar", *words),
        *(joint.statics(**each).to_dict() for each in (asked, long)),
        *(http("joints", {"joint": JOINT, **each}) for each in (asked, long)),
    ]


def simulations(run: Run, http: Http) -> list[dict[str, Any]]:
    preset = {"schema": 1, "kind": "drive", "id": "x", "title": "x", "document": LONG, "references": []}
    return [
        *(said(run, "simulate", write("drive.json", drive)) for drive in (SHORT, LONG, preset)),
        *(mk.Drive(**drive).run().to_dict() for drive in (SHORT, LONG)),
        *(http("simulations", {"drive": drive}) for drive in (SHORT, LONG)),
    ]


def studies(run: Run, http: Http) -> list[dict[str, Any]]:
    both = (STUDY, {**STUDY, "kind": "study", "subject": {"drive": LONG}})
    return [
        *(said(run, "study", write("study.json", study)) for study in both),
        *(mk.study(study).to_dict() for study in both),
        *(http("studies", study) for study in both),
    ]


def sizings(run: Run, http: Http) -> list[dict[str, Any]]:
    """The completed tasks: what is searched is tested beside, and takes seconds."""
    both = (TASK, {**TASK, "kind": "task", "load": {"mass": 5.0}})
    files = [named_task(write("task.json", task), studio()) for task in both]
    return [dict(task.completed().to_document()) for task in (*files, *map(read_task, both))]


def comparisons(run: Run, http: Http) -> list[dict[str, Any]]:
    file = write("map.csv", MAP)
    measurement = http.client.put("/api/measurements?name=map.csv", content=MAP).json()["id"]
    return [
        said(run, "compare", file, "--muscle", str(MUSCLES[0])),
        said(run, "compare", file, "--drive", write("drive.json", {"muscle": MUSCLES[0]})),
        *(model(muscle).compare(file).to_dict() for muscle in MUSCLES),
        *(http("comparisons", {"measurement": measurement, "muscle": muscle}) for muscle in MUSCLES),
    ]


# What the doors word in their own way, and what they answer beside.
VOLATILE = {
    "schema",
    "kind",
    "wall_ms",
    "messages",
    "flags",
    "about",
    "experiment",
    "files",
    "specimens",
    "context",
}


@pytest.mark.parametrize("use_case", [curves, inverse, joints, simulations, studies, sizings, comparisons])
def test_every_door_and_form_says_the_same(use_case: Any, run: Run, http: Http) -> None:
    first, *others = use_case(run, http)
    shared = first.keys() - VOLATILE
    assert len(others) >= 3
    assert len(shared) >= 4
    for other in others:
        assert differences({name: other.get(name) for name in shared}, {n: first[n] for n in shared}) == []


@pytest.mark.parametrize(
    ("command", "content", "right"),
    [
        ("simulate", TASK, "this is a sizing task, not a drive (use mckibben size)"),
        ("size", SHORT, "this is a drive, not a sizing task (use mckibben simulate)"),
        ("study", SHORT, "this is a drive, not a study (use mckibben simulate)"),
        ("curves --muscle", STUDY, "this is a study, not a muscle (use mckibben study)"),
        ("simulate", {"kind": "valve", "id": "x"}, "this is a preset of the kind 'valve', not a drive"),
    ],
)
def test_a_file_of_another_kind_is_told_what_takes_it(
    run: Run, command: str, content: dict[str, Any], right: str
) -> None:
    code, _, err = run(*command.split(), write("file.json", content))
    assert code == 2
    assert f"file.json: {right}" in err


@pytest.mark.parametrize(
    ("words", "right"),
    [
        ("simulate paper-step --out run.xlsx", "run.csv or .json"),
        ("size lift-20kg --report lift.pdf", "lift.html or .htm"),
        ("export DMSP-20:300mm --as c -o muscle.txt", "muscle.c or .zip"),
        ("simulate lift-20kg", "use mckibben size"),
        ("size paper-step", "use mckibben simulate"),
    ],
)
def test_an_ending_or_an_id_that_cannot_be_used_is_refused(run: Run, words: str, right: str) -> None:
    code, _, err = run(*words.split())
    assert code == 2
    assert right in err


def test_a_pressure_of_6_is_asked_about() -> None:
    with pytest.warns(UserWarning, match="6 Pa; did you mean 6 bar"):
        mk.Model.preset("DMSP-20").force(pressure=6, contraction=0.1)
