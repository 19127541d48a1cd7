"""Studies of drives and tasks: the same figures as a single run, nothing dropped, resumed, deterministic."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.application.study.file import journal_of, prepare_file, table_text
from mckibben.application.study.study import StudyQuestion, prepare, study_question
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.documents.study import read_study
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch
from mckibben.studies.journal import Journal
from tests.shipped import shipped_studio

SHORT = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "supply": {"pressure": "6 bar"}, "valve": {"preset": "MPYE-5-1/8-HF"}, "load": {"mass": "10 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "0.3 s"}, "duration": "0.6 s",
}  # fmt: skip
STUDY: dict[str, Any] = {
    "subject": {"drive": SHORT},
    "quantities": [
        {"path": "load.mass", "distribution": {"type": "normal", "mean": "10 kg", "deviation": "1 kg"}},
        {"path": "supply.pressure", "from": "4 bar", "to": "6 bar"},
    ],
    "figures": ["timing.extend.rise_time", "largest.force", "timing.extend.impact_energy"],
    "method": {"type": "monte_carlo", "runs": 20, "seed": 3},
}


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def patient(**told: Any) -> Watch:
    """A watch without a limit of time: a busy machine must not change what is tested."""
    return Watch(**told, time_limit=float("inf"))


def question(studio: Studio, **changes: Any) -> StudyQuestion:
    return study_question(read_study({**STUDY, **changes}), studio)


def test_a_run_has_the_figures_of_a_simulation_of_its_document(studio):
    asked = question(studio)
    result = prepare(asked)(patient())
    assert result.outcomes == {"completed": 20}
    for run in (0, 7, 19):
        point = [result.table[name][run] for name in ("load.mass", "supply.pressure")]
        drive = drive_of(read_document(asked.document_of(point), "the drive"), studio)
        alone = simulate(SimulationQuestion(drive))
        assert result.table["timing.extend.rise_time"][run] == pytest.approx(
            alone.timing.extend.rise_time, rel=1e-6
        )
        assert result.table["largest.force"][run] == pytest.approx(np.max(alone.force), rel=1e-6)


def test_the_table_is_the_same_to_the_last_digit_whatever_the_chunk(studio):
    asked = question(studio)
    tables = [prepare(asked, chunk=chunk)(patient()).table for chunk in (1, 7, 64)]
    assert tables[0] == tables[1] == tables[2]
    other = question(studio, method={"type": "monte_carlo", "runs": 20, "seed": 4})
    assert prepare(other)(patient()).table["load.mass"] != tables[0]["load.mass"]


_NEW_PROCESS = """
import json, sys
from mckibben.application.study.study import prepare, study_question
from mckibben.documents.studio import Studio
from mckibben.documents.study import read_study
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
studio = Studio(presets=presets_folder())
asked = study_question(read_study(json.loads(sys.argv[1])), studio)
tables = [prepare(asked, chunk=chunk)(Watch(time_limit=1e9)).table for chunk in (32, 5)]
print(json.dumps([table["largest.force"] for table in tables]))
"""


@pytest.mark.examination("test_the_table_is_the_same_to_the_last_digit_whatever_the_chunk")
def test_threads_that_compile_the_equations_give_the_same_digits(studio):
    """In a new process both threads want the equations at once; a process that has compiled others agrees."""
    study = STUDY | {"method": {"type": "monte_carlo", "runs": 64, "seed": 3}}
    shown = subprocess.run(
        [sys.executable, "-c", _NEW_PROCESS, json.dumps(study)], capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ).stdout  # fmt: skip
    first, second = json.loads(shown)
    assert first == second
    # This process has compiled other equations before, which must not show.
    here = prepare(study_question(read_study(study), studio))(patient()).table["largest.force"]
    assert first == here


def test_a_study_resumes_from_its_journal(studio, tmp_path: Path):
    asked, out = question(studio), tmp_path / "table.csv"
    whole = prepare(asked)(patient())
    made: list[object] = []
    first = patient(found=made.append, cancelled=lambda: len(made) >= 2)
    stopped = prepare(
        asked, journal=lambda: Journal(journal_of(out), asked.fingerprint, resume=False), chunk=3
    )(first)
    assert stopped.outcome == "cancelled"
    assert 0 < stopped.runs < 20
    with pytest.raises(InputError, match="unfinished study"):
        prepare_file(asked, out, resume=False)(patient())
    with pytest.raises(InputError, match="another study"):
        prepare_file(question(studio, figures=["largest.force"]), out, resume=True)(patient())
    resumed = prepare_file(asked, out, resume=True)(patient())
    assert resumed.table == whole.table
    assert out.read_text() == table_text(whole)
    assert not journal_of(out).exists()


def test_the_csv_reads_back_exactly(studio, tmp_path: Path):
    import pandas as pd

    result = prepare_file(question(studio), tmp_path / "t.csv", resume=False)(patient())
    frame = pd.read_csv(tmp_path / "t.csv")
    assert len(frame) == 20
    text = (tmp_path / "t.csv").read_text().splitlines()
    assert [float(line.split(",")[4]) for line in text[1:]] == result.table["largest.force"]
    assert list(frame.columns)[:2] == ["run", "load.mass [kg]"]


def test_runs_that_cannot_be_are_rows_with_reasons(studio):
    result = prepare(
        question(
            studio,
            quantities=[
                {"path": "load.mass", "values": ["10 kg", "-1 kg", "5000 kg"]},
                {"path": "valve.preset", "values": ["MPYE-5-1/8-HF", "MPYE-5-1/8-LF", "none"]},
            ],
            figures=["timing.extend.rise_time", "timing.retract.impact_energy"],
            method={"type": "grid"},
        )
    )(patient())
    assert result.runs == 9
    assert result.outcomes["refused"] >= 5
    assert result.table["outcome"][0] == "completed"
    assert "load.mass" in str(result.table["message"][3])
    assert "among the valves" in str(result.table["message"][2])
    assert result.table["timing.extend.rise_time"][2] is None
    assert any("refused" in remark for remark in result.remarks)


def test_a_controlled_drive_runs_too(studio):
    drive: dict[str, Any] = {name: value for name, value in SHORT.items() if name != "command"} | {
        "controller": {"kp": 2.0, "reference": {"shape": "step", "at": "0.1 s", "level": "20 mm"}},
        "duration": "0.3 s",
    }
    result = prepare(
        question(
            studio, subject={"drive": drive}, figures=["tracking.rms"], method={"type": "list"},
            quantities=[{"path": "controller.kp", "values": ["0.5 %/mm", "8 %/mm"]}],
        )
    )(patient())  # fmt: skip
    for run, gain in enumerate(("0.5 %/mm", "8 %/mm")):
        alone = drive | {"controller": drive["controller"] | {"kp": gain}}
        annotated = drive_of(read_document(alone, "the drive"), studio)
        follows = simulate(SimulationQuestion(annotated)).tracking
        assert follows is not None
        assert result.table["tracking.rms"][run] == pytest.approx(follows.rms, rel=1e-9)


def test_a_sizing_task(studio):
    result = prepare(
        question(
            studio, subject={"task": "lift-20kg"}, figures=["best.pressure", "proposals"],
            quantities=[{"path": "load.mass", "values": ["20 kg", "9000 kg"]}], method={"type": "list"},
        )
    )(patient())  # fmt: skip
    assert result.table["outcome"] == ["completed", "no_proposal"]
    assert result.table["proposals"][1] == 0.0
    assert result.table["best.pressure"][1] is None
    assert "no drive fulfils" in str(result.table["message"][1])


def test_a_robust_study_puts_the_design_that_keeps_the_limit_first(studio):
    limit = {"figure": "timing.extend.positioning_time", "at_most": "1 s"}
    result = prepare(
        question(
            studio,
            quantities=[
                {"path": "supply.pressure", "values": ["0.5 bar", "6 bar"]},
                {"path": "load.mass", "relative": True,
                 "distribution": {"type": "normal", "mean": 1, "deviation": 0.05}},
            ],
            limits=[limit], method={"type": "robust", "runs": 10},
        )
    )(patient())  # fmt: skip
    assert [design.design for design in result.designs] == [1, 0]
    weak, strong = (result.designs[place].probabilities[-1].kept for place in (1, 0))
    assert weak < strong == 10
