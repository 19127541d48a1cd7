"""Projects in files: tables of studies go along with a project, whole, and only where they hold."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from mckibben.application.project import projects
from mckibben.application.project.projects import give_back, study_from, table_of
from mckibben.application.study.store import StudyStore
from mckibben.application.study.study import prepare, study_question
from mckibben.documents.studio import Studio
from mckibben.documents.study import read_study
from mckibben.physics.errors import InputError
from mckibben.projects.project import StoredStudy
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from tests.application.study.test_study import STUDY
from tests.shipped import shipped_studio

SMALL = STUDY | {"method": {"type": "monte_carlo", "runs": 4, "seed": 3}}


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory, studio: Studio) -> tuple[StudyStore, StoredStudy]:
    """A store in which the study is finished, and its table."""
    store = StudyStore(tmp_path_factory.mktemp("made"))
    question = study_question(read_study(SMALL), studio)
    prepare(question, journal=store.of(question))(Watch(time_limit=float("inf")))
    (found,), remarks = table_of(SMALL, store, studio)
    assert (found.runs, remarks) == (4, [])
    return store, found


def test_the_table_elsewhere_is_the_same_and_nothing_is_run(
    made: tuple[StudyStore, StoredStudy], studio: Studio, tmp_path: Path
) -> None:
    store, found = made
    question = study_question(read_study(SMALL), studio)
    other = StudyStore(tmp_path)
    assert give_back([study_from(found.environment, found.content)], other, studio) == []
    assert other.result(question).table == store.result(question).table
    assert other.result(question).kept == 4


def test_rows_made_here_stand_above_those_brought(
    made: tuple[StudyStore, StoredStudy], studio: Studio
) -> None:
    store, found = made
    question = study_question(read_study(SMALL), studio)
    before = store.result(question).table
    head, rows = found.content.splitlines()
    changed = json.loads(rows)
    for row in changed["rows"]:
        row[2] = [0.0 for _ in row[2]]
    store.bring(replace(found, content=head + b"\n" + json.dumps(changed).encode() + b"\n"))
    assert store.result(question).table == before


def test_a_table_of_another_version_is_not_shown(
    made: tuple[StudyStore, StoredStudy], studio: Studio, tmp_path: Path
) -> None:
    other = StudyStore(tmp_path)
    (words,) = give_back([study_from("0" * 64, made[1].content)], other, studio)
    assert "another version" in words
    assert other.runs(study_question(read_study(SMALL), studio)) == 0


def test_a_large_table_is_not_taken_and_that_is_said(
    made: tuple[StudyStore, StoredStudy], studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(projects, "MOST_BYTES", 100)
    found, (words,) = table_of(SMALL, made[0], studio)
    assert found == []
    assert "4 runs" in words
    assert "CSV" in words
    with pytest.raises(ValueError, match="more than"):
        study_from(made[1].environment, made[1].content)


@pytest.mark.parametrize(
    "study", [None, {}, {"schema": 1, "quantities": 3}, SMALL | {"subject": {"drive": "nothing"}}]
)
def test_a_study_that_cannot_be_used_keeps_no_project_from_being_saved(
    made: tuple[StudyStore, StoredStudy], studio: Studio, study: dict | None
) -> None:
    assert table_of(study, made[0], studio) == ([], [])


def test_the_users_files_count_wherever_they_are(studio: Studio, tmp_path: Path) -> None:
    for name in ("one", "two"):
        folder = tmp_path / name / "own"
        folder.mkdir(parents=True)
        (folder / "muscle.json").write_text("{}")
    marks = [
        Studio(presets=presets_folder(), user_presets=tmp_path / name / "own").own_mark()
        for name in ("one", "two")
    ]
    assert marks[0] == marks[1] != studio.own_mark()


@pytest.mark.parametrize(
    "rows",
    [
        b'{"rows": [["0", "completed", [1.0], ""]]}',
        b'{"rows": [[-1, "completed", [1.0], ""]]}',
        b'{"rows": [[0, "completed", ["x"], ""]]}',
        b'{"rows": [[0, 5, [1.0], ""]]}',
        b'{"rows": [[0, "completed", [1.0]]]}',
        b'{"lines": []}',
        b"no JSON",
    ],
)
def test_damaged_tables_are_refused(made: tuple[StudyStore, StoredStudy], rows: bytes) -> None:
    head = made[1].content.splitlines()[0]
    with pytest.raises((ValueError, KeyError, TypeError, InputError)):
        study_from("0" * 64, head + b"\n" + rows + b"\n")
    with pytest.raises((ValueError, KeyError, TypeError, InputError)):
        study_from("0" * 64, b"")
