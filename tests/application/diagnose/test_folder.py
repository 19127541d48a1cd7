"""Diagnoses of a folder, on a Dask scheduler with two workers too; what needs it is skipped without Dask."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.folder import (
    FileVerdict,
    diagnose_each,
    diagnose_kept,
    files_of,
    finish,
    here,
    on_cluster,
    packed,
    unpacked,
    verdicts_text,
)
from mckibben.application.measurement.files import measurements_of
from mckibben.cli.model import model_question
from mckibben.cli.options import ModelOptions
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from tests.application.local_cluster import LocalCluster
from tests.cli.conftest import write
from tests.cli.test_diagnose import BRAID, rubbing
from tests.shipped import shipped_studio

FILES = 3


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Files of one muscle with other loads, and one that is none."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lab").mkdir()
    write("m.json", BRAID)
    text = Path(rubbing()).read_text("utf-8")
    for number in range(FILES):
        lines = [line for place, line in enumerate(text.splitlines()) if place < 4 or place % 7 != number]
        Path(f"lab/{number}.csv").write_text("\n".join(lines) + "\n", "utf-8")
    Path("lab/notes.txt").write_text("nothing to read\n", "utf-8")
    return tmp_path / "lab"


def ask(name: str) -> ModelQuestion:
    studio = shipped_studio()
    return model_question(studio, measurements_of([name], studio), ModelOptions("m.json"), free=())


def table(verdicts: list[FileVerdict]) -> str:
    return verdicts_text(sorted(verdicts, key=lambda item: item.file))


def test_a_question_survives_the_way_with_the_effects_of_the_program(folder: Path) -> None:
    question = ask("lab/0.csv")
    content = packed(question)
    assert len(content) < 30_000  # the data and no code
    again = unpacked(content)
    assert again.predictor.measured.tolist() == question.predictor.measured.tolist()
    assert again.start.muscle == question.start.muscle
    assert pickle.loads(pickle.dumps(FileVerdict("a", effects=["b"]))).effects == ["b"]
    assert again.start.effects == question.start.effects


def test_effects_of_the_user_are_refused(tmp_path: Path) -> None:
    own = Studio(presets=presets_folder(), effects=[tmp_path])
    with pytest.raises(InputError, match="effects of your own"):
        on_cluster(own, "tcp://127.0.0.1:1", again="")


def test_what_is_done_is_kept_until_all_is(folder: Path, studio: Studio) -> None:
    out, files = Path("verdicts.csv"), files_of(folder)
    asked: list[str] = []

    def slow(name: str) -> ModelQuestion:
        asked.append(Path(name).name)
        if len(asked) == 3:
            raise KeyboardInterrupt
        raise InputError("cannot be used")

    first = []
    with pytest.raises(KeyboardInterrupt):
        first.extend(diagnose_kept(files, slow, here(studio), Watch(), out=out, asked="a", resume=False))
    with pytest.raises(InputError, match="unfinished diagnosis"):
        list(diagnose_kept(files, slow, here(studio), Watch(), out=out, asked="a", resume=False))
    with pytest.raises(InputError, match="another diagnosis"):
        list(diagnose_kept(files, slow, here(studio), Watch(), out=out, asked="b", resume=True))


@pytest.fixture
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    pytest.importorskip("distributed", reason="needs the extra cluster: pip install 'mckibben[cluster]'")
    started = LocalCluster(tmp_path_factory.mktemp("dask"))
    yield started
    started.stop()


@pytest.mark.examination("tests/application/study/test_cluster.py::test_a_lost_scheduler_pauses_the_study")
def test_two_workers_one_killed_give_the_verdicts_of_one_process(
    cluster: LocalCluster, folder: Path, studio: Studio
) -> None:
    """Then the scheduler is lost: what is done is kept, and the rest is done without it."""
    files = files_of(folder)
    alone = table(list(diagnose_each(files, ask, here(studio), Watch())))
    both = on_cluster(studio, cluster.address, again="again")
    found = []
    for verdict in diagnose_each(files, ask, both, Watch()):
        if not found:
            cluster.workers[0].kill()
        found.append(verdict)
    assert table(found) == alone

    out, kept = Path("verdicts.csv"), []
    each = diagnose_kept(files, ask, both, Watch(), out=out, asked="a", resume=False)
    kept.append(next(each))
    cluster.end()
    with pytest.raises(InputError, match="scheduler is lost") as lost:
        kept.extend(each)
    assert lost.value.hint == "again"
    assert 0 < len(kept) < len(files)
    rest = list(diagnose_kept(files, ask, here(studio), Watch(), out=out, asked="a", resume=True))
    finish(sorted(rest, key=lambda item: item.file), out, complete=True)
    assert out.read_text("utf-8") == alone
    assert not Path("verdicts.csv.journal").exists()
