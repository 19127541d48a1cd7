"""``mckibben size``: JSON, tables, one line for whatever is wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from mckibben.application.model.saved import keep
from mckibben.application.size.size import SizingResult
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.studio import Studio
from mckibben.resources import presets_folder
from tests.application.model.test_saved import MODEL
from tests.cli.conftest import Run, result_of, write
from tests.server.answers import valid
from tests.server.test_sizings import IMPOSSIBLE, TASK


def test_a_task_gives_one_json_object_and_its_drive_runs(run: Run) -> None:
    code, out, _ = run("size", write("task.json", TASK), "--json")
    assert code == 0
    assert out.count("\n") == 1
    answer = result_of(out)
    valid(SizingResult, answer)
    best = answer["proposals"][0]
    code, out, _ = run("simulate", write("drive.json", best["drive"]), "--json")
    assert code == 0
    timing: dict[str, Any] = json.loads(out)["timing"]
    # One process per run integrates by LSODA, the search by the kernel.
    assert timing["extend"]["positioning_time"] == pytest.approx(best["time"], rel=0.01)


def test_a_fitted_muscle_is_told_where_it_was_not_measured(run: Run) -> None:
    """The sizing takes the muscle that a diagnosis kept; it was measured to 5 bar, slowly, at 250 mm."""
    studio = Studio(presets=presets_folder(), user_presets=Path("data") / "presets")
    keep(read_saved_model(MODEL, "the model"), studio, id="mine")
    task = {
        "load": {"mass": "20 kg"}, "stroke": "40 mm", "time": "1 s", "supply_pressure": "6 bar",
        "catalogue": {"muscles": ["mine"], "valves": ["MPYE-5-1/8-HF"], "tube_length": "1 m"},
    }  # fmt: skip
    code, out, _ = run("size", write("task.json", task), "--json", "--data", "data")
    assert code == 0
    best = result_of(out)["proposals"][0]
    (note,) = (note for note in best["notes"] if "was not measured" in note)
    assert note.startswith("mine is used where it was not measured: ")
    assert ("pressures up to" in note) == (best["pressure"] > 5e5)
    assert "the model was measured without time" in note


def test_tables_name_the_drives_and_the_reasons(run: Run) -> None:
    code, out, err = run("size", write("task.json", TASK))
    assert code == 0
    assert "DMSP-20" in out
    assert "combinations of" in err
    assert "it would work with" in err


def test_nothing_found_is_an_answer(run: Run) -> None:
    task = write("task.json", IMPOSSIBLE)
    code, out, err = run("size", task)
    assert code == 3
    assert "task.json: Lift 5000 kg by 60 mm in 0.5 s, with 6 bar: no drive in the catalogue" in out
    assert "times the load" in err
    assert json.loads(run("size", task, "--json")[1])["proposals"] == []


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("{", ["task.json"]),
        ("[]", ["task.json"]),
        ({"load": {"mass": "20 kg"}}, ["task.json", "stroke"]),
        ({**TASK, "stroek": 1}, ["stroek", "stroke"]),
        ({**TASK, "load": {"mass": "20 kgg"}}, ["load.mass"]),
        ({**TASK, "catalogue": {"muscles": ["DMSP-21"]}}, ["catalogue.muscles.0", "DMSP-20"]),
    ],
)
def test_what_is_wrong_is_said_in_one_line(run: Run, content: object, words: list[str]) -> None:
    code, out, err = run("size", write("task.json", content), "--json")
    assert code == 2
    assert out == ""
    assert len(err.strip().splitlines()) == 1
    assert "Traceback" not in err
    for word in words:
        assert word in err


def test_a_missing_file_is_named(run: Run) -> None:
    code, _, err = run("size", "nowhere.json")
    assert code == 2
    assert "nowhere.json" in err


def test_a_report_is_written_beside_the_tables(run: Run) -> None:
    task = write("task.json", {**TASK, "uncertainty": {"specimens": 0}})
    code, out, err = run("size", task, "--report", "r.html", "--proposal", "2", "--title", "<b>Mine</b>")
    assert code == 0
    assert "DMSP-20" in out
    assert "report: r.html" in err
    text = Path("r.html").read_text("utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "<h1>&lt;b&gt;Mine&lt;/b&gt;: Lift 20 kg by 60 mm in 0.5 s, with 6 bar</h1>" in text
    assert "Proposal 2 of " in text
    assert "mckibben size task.json --report report.html --proposal 2" in text


def test_nothing_found_is_written_down_too(run: Run) -> None:
    code, out, _ = run("size", write("task.json", IMPOSSIBLE), "--report", "r.html", "--json")
    assert code == 3
    assert json.loads(out)["proposals"] == []
    assert "No drive in the catalogue fulfils this task" in Path("r.html").read_text("utf-8")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--report", "no/r.html"], ["--report no/r.html: there is no folder no"]),
        (["--report", "r.html", "--proposal", "30"], ["--proposal 30: there ", " proposals", "1 to "]),
        (["--report", "r.html", "--proposal", "0"], ["--proposal"]),
        (["--proposal", "2"], ["--proposal belongs to a report", "--report FILE"]),
        (["--title", "x"], ["--title belongs to a report"]),
    ],
)
def test_what_is_wrong_with_a_report_is_said_in_one_line(
    run: Run, options: list[str], words: list[str]
) -> None:
    task = write("task.json", {**TASK, "uncertainty": {"specimens": 0}})
    code, out, err = run("size", task, *options)
    assert code == 2
    assert out == ""
    assert len(err.strip().splitlines()) == 1
    assert not Path("r.html").exists()
    for word in words:
        assert word in err
