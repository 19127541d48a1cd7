"""``mckibben simulate``: JSON, table, trace, one line for whatever is wrong."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.resources import presets_folder
from tests.cli.conftest import Run, write
from tests.documents.test_drive_reading import CONTROLLER, EXAMPLE
from tests.shipped import shipped_studio


def test_a_document_gives_one_json_object(run: Run) -> None:
    code, out, _ = run("simulate", write("lift.json", EXAMPLE), "--json")
    assert code == 0
    answer = json.loads(out)
    assert answer["outcome"] == "completed"
    assert len(answer["time"]) == len(answer["position"]) == 2001
    assert answer["timing"]["extend"]["rise_time"] > 0.0
    assert answer["position"][0] == pytest.approx(0.0, abs=1e-4)


def test_it_gives_the_digits_of_the_other_doors(run: Run) -> None:
    from mckibben.application.run.simulate import SimulationQuestion, simulate
    from mckibben.documents.drive_reading import drive_of, read_document

    answer = json.loads(run("simulate", write("lift.json", EXAMPLE), "--json")[1])
    given = drive_of(read_document(EXAMPLE, "the drive"), shipped_studio())
    other = simulate(SimulationQuestion(given))
    assert answer["position"] == list(other.position)
    assert answer["timing"]["extend"]["rise_time"] == other.timing.extend.rise_time


def test_the_table_shows_both_phases_and_the_outcome(run: Run) -> None:
    code, out, err = run("simulate", write("lift.json", EXAMPLE))
    assert code == 0
    assert "completed" in out
    for word in ("fill", "vent", "Positioning time", "Impact energy", "passes choked"):
        assert word in out
    for word in ("air: energy balance", "lower end stop"):
        assert word in err
    assert "unverified" not in out
    assert "MPYE" in err  # its figures are not verified


def test_a_controlled_drive_shows_how_it_follows(run: Run) -> None:
    code, out, _ = run("simulate", write("pid.json", {**EXAMPLE, "controller": CONTROLLER, "duration": 1}))
    assert code == 0
    assert "Following the reference" in out


def test_the_trace_can_be_read_back_as_a_measurement(run: Run) -> None:
    code, _, _ = run("simulate", write("lift.json", EXAMPLE), "--out", "trace.csv")
    assert code == 0
    measurement = read_measurement(Path("trace.csv").read_bytes(), "trace.csv")
    assert measurement.kind == "transient"
    assert measurement.rows == 2001
    assert set(measurement.columns) == {"time", "command", "pressure", "force", "length", "diameter", "group"}
    assert not [text for text in measurement.messages if "column" in text]
    assert measurement.conditions["muscle"] == "DMSP-20:800mm"
    assert measurement.conditions["load_mass"] == 10.0
    assert measurement.columns["length"].min() == pytest.approx(0.6, abs=2e-3)


SPOOL = {"preset": "MPYE-5-1/8-HF"}  # its spool begins where the command stood before the run
ROUND_TRIPS = {
    "hanging": {"valve": SPOOL},
    "lever": {"valve": SPOOL, "load": {"mass": "5 kg", "arrangement": "lever", "lever_ratio": 0.5}},
    "jumps beside the rows": {"command": {"shape": "pulse", "on": "33.3 ms", "off": "617.1 ms"}},
    "joint": {
        "valve": {"preset": "VPPM-6"},
        "load": {
            "mass": "4 kg", "arrangement": "antagonist", "pulley_radius": "30 mm", "precontraction": "10 %",
        },
        "stops": {"min_contraction": "-2 %", "max_contraction": "22 %"},
        "command": {"shape": "step", "at": "0.2 s", "initial": 0.5, "level": 0.7},
        "start_pressure": "3 bar",
    },
}  # fmt: skip


@pytest.mark.parametrize("name", ROUND_TRIPS)
def test_a_run_read_back_is_the_run_of_its_drive(run: Run, name: str) -> None:
    """Sign, reference and size of every column: the error is that of twelve printed digits."""
    drive = write("drive.json", {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"}, "supply": {"pressure": "6 bar"},
        "valve": {"preset": "MHE4"}, "command": {"shape": "pulse", "on": "0 s", "off": "0.6 s"},
        "load": {"mass": "10 kg", "arrangement": "hanging"}, "duration": "1 s", **ROUND_TRIPS[name],
    })  # fmt: skip
    assert run("simulate", drive, "--out", "run.csv")[0] == 0
    code, out, err = run("compare", "run.csv", "--drive", drive, "--json")
    assert code == 0, err
    channels = json.loads(out)["channels"]
    assert set(channels) == {"pressure", "displacement", "force"}
    for channel in channels.values():
        assert channel["rmse"] < 1e-10 * channel["full_scale"]


def test_a_joint_with_two_commands_is_not_compared(run: Run) -> None:
    shutil.copy(presets_folder() / "drives" / "joint-20.json", "joint.json")
    assert run("simulate", "joint.json", "--out", "run.csv")[0] == 0
    code, _, err = run("compare", "run.csv", "--drive", "joint.json")
    assert code == 2
    assert "stiffness is controlled is not compared" in err


def test_presets_run_by_id_and_by_file(run: Run) -> None:
    shutil.copy(presets_folder() / "drives" / "paper-step.json", "own.json")
    by_id = json.loads(run("simulate", "paper-step", "--json")[1])
    by_file = json.loads(run("simulate", "own.json", "--json")[1])
    assert by_id["position"] == by_file["position"]


REFUSED = {
    "no such file": ("nope.json", None, ["nope.json", "No such file"]),
    "no such preset": ("paper-stp", None, ["paper-stp", "Did you mean 'paper-step'"]),
    "no JSON": ("bad.json", "{", ["bad.json", "line 1"]),
    "a list": ("bad.json", [], ["bad.json", "object"]),
    "twice": ("bad.json", '{"duration": 1, "duration": 2}', ["bad.json", "duration"]),
    "unknown key": ("bad.json", {**EXAMPLE, "vavle": {}}, ["bad.json", "vavle", "Did you mean 'valve'"]),
    "negative": ("bad.json", {**EXAMPLE, "load": {"mass": "-1 kg"}}, ["bad.json", "load.mass", "kg"]),
    "unknown preset": (
        "bad.json", {**EXAMPLE, "valve": {"preset": "MPYE"}}, ["bad.json", "valve", "MPYE", "Did you mean"]
    ),
    "unknown effect": (
        "bad.json", {**EXAMPLE, "effects": {"creeep": {}}}, ["creeep", "Did you mean 'creep'"]
    ),
    "start beyond a stop": (
        "bad.json", {**EXAMPLE, "start": {"position": "2 m"}}, ["bad.json", "start.position", "end stops"]
    ),
    "another preset": ("bad.json", {"schema": 1, "kind": "valve", "id": "x"}, ["bad.json", "kind"]),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_one_line_says_what_is_wrong(run: Run, name: str) -> None:
    file, content, words = REFUSED[name]
    if content is not None:
        write(file, content)
    code, out, err = run("simulate", file)
    assert code == 2
    assert out == ""
    assert err.count("\n") == 1
    assert "Traceback" not in err
    for word in words:
        assert word in err


def test_a_trace_that_cannot_be_written(run: Run) -> None:
    code, _, err = run("simulate", write("lift.json", EXAMPLE), "--out", "no/folder/trace.csv")
    assert code == 2
    assert "--out no/folder/trace.csv" in err


def test_a_joint_prints_its_stiffness(run: Run) -> None:
    code, out, _ = run("simulate", "joint-20")
    assert code == 0
    table = out.split("Joint\n")[-1]
    assert "RMS error of the joint stiffness" in table
    (at_end,) = [line for line in table.splitlines() if "Stiffness at the end" in line]
    assert float(at_end.split()[-2]) == pytest.approx(22.0, rel=0.02)
