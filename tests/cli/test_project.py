"""``mckibben project``."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mckibben.cli import run
from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A data folder with one project of two versions."""
    store = ProjectStore(Database(tmp_path))
    made = store.create({"mass": 20}, title="Lift", notes="small bench")
    store.save(made.summary.id, {"mass": 25}, base_version=1, label="mass 25 kg")
    store.close()
    return tmp_path


def test_projects_are_listed_shown_and_moved(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    here = ["--data", str(data)]
    assert run(["project", "list", *here]) == 0
    assert "Lift" in capsys.readouterr().out
    assert run(["project", "show", "Lift", *here]) == 0
    shown = capsys.readouterr()
    assert "mass 25 kg" in shown.out
    assert "small bench" in shown.err
    assert run(["project", "show", "Lift", "--version", "1", "--json", *here]) == 0
    assert json.loads(capsys.readouterr().out)["document"] == {"mass": 20}
    packed = tmp_path / "lift.zip"
    assert run(["project", "export", "Lift", "-o", str(packed), *here]) == 0
    assert run(["project", "import", str(packed), "--data", str(tmp_path / "other")]) == 0
    capsys.readouterr()
    assert run(["project", "list", "--json", "--data", str(tmp_path / "other")]) == 0
    assert [each["title"] for each in json.loads(capsys.readouterr().out)["projects"]] == ["Lift"]


def test_a_deleted_project_comes_back(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    here = ["--data", str(data)]
    assert run(["project", "delete", "Lift", *here]) == 0
    assert "project restore" in capsys.readouterr().err
    assert run(["project", "show", "Lift", *here]) == 2
    assert "there is no project 'Lift'" in capsys.readouterr().err
    assert run(["project", "restore", "Lift", *here]) == 0
    assert run(["project", "show", "Lift", *here]) == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["show", "nothing"], "there is no project 'nothing'"),
        (["import", "no-such.zip"], "no-such.zip"),
        (["import", __file__], "not a packed project"),
        (["list", "--projects", "mysql://x/y"], "not"),
        (["export", "Lift", "-o", "/no/such/folder/x.zip"], "--out"),
    ],
)
def test_bad_input_is_said_in_one_line(
    data: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], words: str
) -> None:
    assert run(["project", *arguments, "--data", str(data)]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert "Traceback" not in error
