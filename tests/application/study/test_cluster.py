"""Studies on a Dask scheduler with two worker processes; skipped where Dask is not installed."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from mckibben.application import cluster as dask_cluster
from mckibben.application.model.saved import keep
from mckibben.application.study import cluster as study_cluster
from mckibben.application.study.cluster import on_cluster
from mckibben.application.study.study import prepare
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from mckibben.studies.journal import Journal
from tests.application.local_cluster import LocalCluster
from tests.application.model.test_saved import MODEL
from tests.application.study.test_study import SHORT, patient, question
from tests.shipped import shipped_studio

# Not by importing it: that takes a second, which each process of the suite would spend.
pytestmark = pytest.mark.skipif(
    find_spec("distributed") is None, reason="needs the extra cluster: pip install 'mckibben[cluster]'"
)


@pytest.fixture
def cluster(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[LocalCluster]:
    started = LocalCluster(tmp_path, workers=request.param)
    yield started
    started.stop()


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


@pytest.mark.examination("test_a_lost_scheduler_pauses_the_study")
@pytest.mark.parametrize("cluster", [2], indirect=True)
def test_two_workers_one_killed_give_the_table_of_one_process(cluster: LocalCluster, studio: Studio) -> None:
    asked = question(studio, method={"type": "monte_carlo", "runs": 120, "seed": 3})
    alone = prepare(asked)(patient()).table
    workers = on_cluster(asked, cluster.address)
    both = prepare(asked, workers=workers, chunk=5)(patient())
    assert both.table == alone
    killed = []

    def kill_one(_: object) -> None:
        if not killed:
            killed.append(cluster.workers[0].pid)
            cluster.workers[0].kill()

    one = prepare(asked, workers=workers, chunk=5)(patient(found=kill_one))
    assert killed
    assert one.outcome == "completed"
    assert one.table == alone


@pytest.mark.parametrize("cluster", [1], indirect=True)
def test_a_lost_scheduler_pauses_the_study(cluster: LocalCluster, studio: Studio, tmp_path: Path) -> None:
    asked, journal = question(studio, method={"type": "monte_carlo", "runs": 40, "seed": 3}), tmp_path / "j"

    def kept(resume: bool) -> Journal:
        return Journal(journal, asked.fingerprint, resume=resume)

    workers = on_cluster(asked, cluster.address)
    with pytest.raises(InputError, match="scheduler is lost") as found:
        prepare(asked, workers=workers, chunk=2, journal=lambda: kept(False))(
            patient(found=lambda _: cluster.end())
        )
    assert "--resume" in (found.value.hint or "")
    again = prepare(asked, journal=lambda: kept(True))(patient())
    assert again.table == prepare(asked)(patient()).table


def test_what_a_cluster_refuses(studio: Studio, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_cluster, "_CONNECT", 0.2)
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
