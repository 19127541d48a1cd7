"""Studies on a Dask scheduler with two worker processes; skipped where Dask is not installed."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.application.study import prepare
from mckibben.application.study_cluster import on_cluster
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from tests.application.test_study import question
from tests.cli.conftest import Run, write

pytest.importorskip("distributed", reason="needs the extra cluster: pip install 'mckibben[cluster]'")


class Cluster:
    """A scheduler and two workers, each a process of its own.

    Attributes:
        address: of the scheduler.
        workers: their processes.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._scheduler = self._start("scheduler", "--port", "0", "--dashboard-address", ":0",
                                      "--scheduler-file", str(folder / "scheduler.json"))  # fmt: skip
        self.workers = [
            self._start("worker", "--scheduler-file", str(folder / "scheduler.json"), "--nthreads", "1",
                        "--no-nanny", "--no-dashboard")
            for _ in range(2)
        ]  # fmt: skip
        import json
        import time

        end = time.monotonic() + 60.0
        while not (file := folder / "scheduler.json").exists() or not file.read_text():
            assert time.monotonic() < end, "no scheduler after 60 s"
            time.sleep(0.05)
        self.address = json.loads(file.read_text())["address"]

    def _start(self, *arguments: str) -> subprocess.Popen[bytes]:
        log = (self._folder / f"{arguments[0]}.log").open("ab")
        command = [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        return subprocess.Popen(command, stdout=log, stderr=log, cwd=self._folder, env=environment)

    def stop(self) -> None:
        for process in (*self.workers, self._scheduler):
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    started = Cluster(tmp_path_factory.mktemp("dask"))
    yield started
    started.stop()


@pytest.fixture(scope="module")
def studio() -> Studio:
    return Studio(presets=presets_folder())


def test_two_workers_one_killed_give_the_table_of_one_process(cluster: Cluster, studio: Studio) -> None:
    asked = question(studio, method={"type": "monte_carlo", "runs": 120, "seed": 3})
    alone = prepare(asked)(Watch()).table
    workers = on_cluster(asked, cluster.address)
    both = prepare(asked, workers=workers, chunk=5)(Watch(time_limit=300.0))
    assert both.table == alone
    killed = []

    def kill_one(_: object) -> None:
        if not killed:
            killed.append(cluster.workers[0].pid)
            cluster.workers[0].kill()

    one = prepare(asked, workers=workers, chunk=5)(Watch(found=kill_one, time_limit=300.0))
    assert killed
    assert one.outcome == "completed"
    assert one.table == alone


def test_what_a_cluster_refuses(cluster: Cluster, studio: Studio, tmp_path: Path) -> None:
    asked = question(studio)
    with pytest.raises(InputError, match="no Dask scheduler") as found:
        on_cluster(asked, "tcp://127.0.0.1:1")
    assert found.value.hint
    own = studio.library.folder if hasattr(studio.library, "folder") else None
    assert own is None or own


def test_the_command_line_names_a_scheduler_that_is_not_there(run: Run) -> None:
    from tests.application.test_study import STUDY

    code, out, err = run("study", write("study.json", STUDY), "--scheduler", "tcp://127.0.0.1:1")
    assert (code, out) == (2, "")
    assert "--scheduler tcp://127.0.0.1:1: no Dask scheduler" in err
    assert err.count("\n") == 1
