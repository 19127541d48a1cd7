"""Studies on a Dask scheduler with two worker processes; skipped where Dask is not installed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from mckibben.application import study_cluster
from mckibben.application.keep import keep
from mckibben.application.study import prepare
from mckibben.application.study_cluster import on_cluster
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from tests.application.test_keep import MODEL
from tests.application.test_study import SHORT, question

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
        end = time.monotonic() + 60.0
        while not (file := folder / "scheduler.json").exists() or not file.read_text():
            assert time.monotonic() < end, "no scheduler after 60 s"
            time.sleep(0.05)
        self.address = json.loads(file.read_text())["address"]

    def _start(self, *arguments: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        with (self._folder / f"{arguments[0]}.log").open("ab") as log:
            return subprocess.Popen(command, stdout=log, stderr=log, cwd=self._folder, env=environment)

    def end(self) -> None:
        """End the scheduler."""
        self._scheduler.kill()
        self._scheduler.wait()

    def stop(self) -> None:
        """End what still runs."""
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


def test_a_lost_scheduler_pauses_the_study(cluster: Cluster, studio: Studio, tmp_path: Path) -> None:
    """Last of the tests with the cluster: it ends the scheduler."""
    asked, journal = question(studio, method={"type": "monte_carlo", "runs": 40, "seed": 3}), tmp_path / "j"
    workers = on_cluster(asked, cluster.address)
    with pytest.raises(InputError, match="scheduler is lost") as found:
        prepare(asked, workers=workers, chunk=2, journal=journal)(Watch(found=lambda _: cluster.end()))
    assert "--resume" in (found.value.hint or "")
    again = prepare(asked, journal=journal, resume=True)(Watch())
    assert again.table == prepare(asked)(Watch()).table


def test_what_a_cluster_refuses(studio: Studio, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study_cluster, "_CONNECT", 0.2)
    with pytest.raises(InputError, match="no Dask scheduler") as found:
        on_cluster(question(studio), "tcp://127.0.0.1:1")
    assert "dask scheduler" in (found.value.hint or "")
    with pytest.raises(InputError, match="no Dask scheduler"):
        on_cluster(question(studio), "nonsense://")
    own = Studio(presets=presets_folder(), user_presets=tmp_path)
    keep(read_saved_model(MODEL, "the model"), own, id="mine")
    drive = SHORT | {"muscle": {"preset": "mine", "nominal_length": "300 mm"}}
    with pytest.raises(InputError, match="mine is a preset of yours"):
        on_cluster(question(own, subject={"drive": drive}), "tcp://127.0.0.1:1")


def test_a_worker_of_another_version_is_refused() -> None:
    with pytest.raises(InputError, match="a worker has mckibben"):
        study_cluster.make_rows(b"{}", "0.0.0", np.zeros((1, 1)))
