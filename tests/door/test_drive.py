"""Drives: from parts, presets and files, changed, run, and read back as measurements."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben as mk

PARTS: dict[str, Any] = {
    "valve": "MPYE-5-1/8-HF",
    "load": {"mass": "10 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "1 s"},
    "duration": "2 s",
}


def test_a_muscle_is_a_model_an_id_or_a_document() -> None:
    model = mk.Model.preset("DMSP-20", length="400 mm")
    drives = [
        mk.Drive(model, **PARTS),
        mk.Drive("DMSP-20:400mm", **PARTS),
        mk.Drive({"preset": "DMSP-20", "nominal_length": 0.4}, **PARTS),
    ]
    ends = [drive.run(points=201).position for drive in drives]
    assert ends[0].tolist() == ends[1].tolist() == ends[2].tolist()
    # The spool of the valve belongs to the drive, not to the muscle.
    assert {**model.effects, "spool_lag": drives[0].model.effects["spool_lag"]} == drives[0].model.effects


def test_the_effects_of_a_model_act_in_its_drive() -> None:
    model = mk.Model.preset("DMSP-20", length="400 mm")
    lift = {**PARTS, "load": {"mass": "10 kg", "force": "600 N"}, "stops": {"max_contraction": "34 %"}}
    ideal, real = (mk.Drive(each, **lift).run(points=201) for each in (model.ideal(), model))
    assert ideal.position.max() > real.position.max() > 0.0


def test_the_valve_keeps_its_effects_whatever_the_model_has() -> None:
    model = mk.Model.preset("DMSP-20", length="400 mm")
    whole = mk.Drive(model, **PARTS).run(points=11).details.model.effects
    fewer = mk.Drive(model.without("dahl"), **PARTS).run(points=11).details.model.effects
    assert set(whole) - set(model.effects)  # the valve's
    assert set(fewer) == set(whole) - {"dahl"}
    assert set(mk.Drive(model, effects={}, **PARTS).run(points=11).details.model.effects) == set()


def test_at_rest_the_muscle_carries_its_load() -> None:
    drive = mk.Drive(mk.Model.preset("DMSP-20", length="400 mm"), **PARTS).changed(
        load={"mass": "40 kg"}, supply="4 bar", command={"shape": "step", "at": "0 s", "level": 1}
    )
    run = drive.changed(stops={"max_contraction": "30 %"}, duration="6 s").run()
    assert 0.0 < run.position[-1] < 0.3 * 0.4
    assert run.force[-1] == pytest.approx(40.0 * 9.80665, rel=1e-3)


def test_a_changed_drive_leaves_the_first_as_it_is() -> None:
    drive = mk.Drive.preset("propneu-20")
    before = json.dumps(drive.document)
    heavier = drive.changed(load={"mass": "30 kg"}, title=None)
    assert heavier.document["load"] == {"mass": 30.0}
    assert json.dumps(drive.document) == before
    with pytest.raises(AttributeError, match="does not change"):
        drive._document = None  # type: ignore[assignment]


def test_a_saved_drive_is_the_same_drive() -> None:
    drive = mk.Drive("DMSP-20:400mm", **PARTS)
    drive.save("drive.json")
    again = mk.Drive.load("drive.json")
    assert again.document == drive.document
    assert again.run(points=101).position.tolist() == drive.run(points=101).position.tolist()


def test_a_trace_is_a_measurement() -> None:
    run = mk.Drive("DMSP-20:400mm", **PARTS).run()
    run.save("trace.csv")
    read = mk.read("trace.csv")
    assert read.kind == "transient"
    assert 0.4 - read.columns["length"] == pytest.approx(run.position, abs=1e-9)
    frame = run.to_frame()
    assert frame["force_N"].tolist() == run.force.tolist()
    travelled = np.trapezoid(frame["load_velocity_m/s"][:400], frame["time_s"][:400])
    assert travelled == pytest.approx(run.position[399] - run.position[0], abs=1e-3)


def test_the_share_that_is_done_and_the_rows_asked_for() -> None:
    shares: list[float] = []
    run = mk.Drive.preset("propneu-20").run(points=11, begin="0.1 s", end=0.2, progress=shares.append)
    assert run.time.tolist() == pytest.approx(np.linspace(0.1, 0.2, 11).tolist())
    assert all(0.0 <= share <= 1.0 for share in shares)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"valve": "MPYE-5-1/8-XX"}, ["MPYE-5-1/8-"]),
        ({"lode": {"mass": "1 kg"}}, ["lode", "load"]),
        ({"load": {"mass": "1 mm"}}, ["1 mm", "a mass"]),
        ({"command": {"shape": "puls"}}, ["puls"]),
        ({"supply": "6 mm"}, ["6 mm", "a pressure"]),
        ({"muscle": "DMSP-21"}, ["DMSP-20"]),
        ({"muscle": 3}, ["muscle"]),
    ],
)
def test_bad_parts_are_one_sentence(parts: dict[str, Any], words: list[str]) -> None:
    stated = {"muscle": "DMSP-20:400mm", **PARTS, **parts}
    with pytest.raises(mk.Problem) as caught:
        mk.Drive(stated.pop("muscle"), **stated)
    assert "\n" not in str(caught.value)
    for word in words:
        assert word in str(caught.value)


def test_a_drive_without_a_command_does_not_run() -> None:
    drive = mk.Drive("DMSP-20:400mm", valve="MPYE-5-1/8-HF")
    with pytest.raises(mk.Problem, match="command is missing"):
        drive.run()


def test_tasks_are_documents_files_and_presets(tmp_path: Path) -> None:
    task = {
        "load": {"mass": "5 kg"},
        "stroke": "40 mm",
        "time": "1 s",
        "catalogue": {"muscles": ["DMSP-10"], "valves": ["MPYE-5-1/8-HF"], "tube_length": 0},
    }
    (tmp_path / "task.json").write_text(json.dumps(task), "utf-8")
    by_document, by_file = mk.size(task), mk.size(tmp_path / "task.json")
    assert [p.details.nominal_length for p in by_document.proposals] == [
        p.details.nominal_length for p in by_file.proposals
    ]
    by_document.report("report.html")
    assert "DMSP-10" in Path("report.html").read_text("utf-8")
    own = "Lift 5 kg by 40 mm in 1 s, with 6 bar"
    assert f"<h1>{own}</h1>" in Path("report.html").read_text("utf-8")
    assert str(by_document).startswith(own)
    assert str(by_file).startswith(f"task: {own}")
    with pytest.raises(mk.Problem, match="proposal"):
        by_document.report("report.html", proposal=99)
    with pytest.raises(mk.Problem, match="lift-20kg"):
        mk.size("lift-20k")
    with pytest.raises(mk.Problem, match="stroke"):
        mk.size({**task, "stroke": "40 kg"})


def test_a_joint_is_run_and_its_both_set_points_are_reached() -> None:
    run = mk.Drive.preset("joint-20").run()
    joint = run.to_dict()["joint"]
    assert joint["stiffness"][-1] == pytest.approx(22.0, rel=0.02)
    assert joint["stiffness_error"] < 1.0
