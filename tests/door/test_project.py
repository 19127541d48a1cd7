"""Projects from Python: the same as on the page and the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import mckibben as mk
from mckibben.cli import run
from mckibben.measurement.store import MeasurementStore

CSV = b"# kind: static\npressure_bar,length_mm,force_N\n" + b"".join(
    b"%d,%d,%d\n" % (p, length, 100 * p + length) for p in (1, 2, 3) for length in (300, 290, 280)
)


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path / "data"))
    monkeypatch.delenv("MCKIBBEN_PROJECTS", raising=False)


def test_a_project_is_kept_opened_and_taken_along(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert mk.Project.list().empty
    made = mk.Project.create("Lift", {"mass": 20}, notes="small bench")
    later = made.save({"mass": 25}, "mass 25 kg")
    assert (made.version, later.version) == (1, 2)
    assert mk.Project.open("Lift").document == {"mass": 25}
    assert mk.Project.open(made.id[:6], version=1).document == {"mass": 20}
    assert list(later.history()["what"]) == ["mass 25 kg", "created"]
    assert list(mk.Project.list()["title"]) == ["Lift"]
    assert "small bench" in str(later)
    assert "Project Lift" in later._repr_html_()
    moved = mk.Project.unpack(later.pack(tmp_path / "lift.zip"))
    assert moved.id != made.id
    assert moved.document == {"mass": 25}
    assert run(["project", "show", moved.id, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["document"], told["project"]["id"]) == ({"mass": 25}, moved.id)


def test_its_measurements_are_read_as_they_were(tmp_path: Path) -> None:
    store = MeasurementStore(tmp_path / "data")
    identity = store.put(CSV, "map.csv").id
    from mckibben.application.project.projects import files_of
    from mckibben.projects.database import Database
    from mckibben.projects.store import ProjectStore

    document = {"case": [identity]}
    projects = ProjectStore(Database(tmp_path / "data"))
    projects.create(document, title="Map", files=files_of(document, store))
    projects.close()
    (read,) = mk.Project.open("Map").measurements()
    assert len(read.to_frame()) == 9
    assert mk.Model.preset("DMSP-20", length="300 mm").compare(read).rmse > 0.0


def test_what_is_wrong_is_said() -> None:
    mk.Project.create("Lift", {})
    mk.Project.create("Lift", {})
    with pytest.raises(mk.Problem, match="2 projects are called 'Lift'"):
        mk.Project.open("Lift")
    with pytest.raises(mk.Problem, match=r"no project 'Lifd'.*Did you mean 'Lift'"):
        mk.Project.open("Lifd")
    with pytest.raises(mk.Problem, match="no-such"):
        mk.Project.unpack("no-such.zip")
    one = mk.Project.create("Arm", {})
    one.save({"a": 1})
    with pytest.raises(mk.Problem, match="saved elsewhere"):
        one.save({"a": 2})
