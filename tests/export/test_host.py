"""An importer in C: the binary of the FMU in an environment without Python, its sources under sanitizers.

Both give the motion of the engine, and all calls with all variables are clean.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import numpy as np
import pytest

from mckibben.export.fmu import package
from mckibben.export.fmu.dialects import FMI2, FMI3
from tests.export.fmus import fmu_of, our_run
from tests.export.test_c import FLAGS, SANITIZERS
from tests.export.test_fmu import subject_named

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")
HOST = Path(__file__).with_name("host.c")
STEPS = 1200


def positions(program: Path, token: str, *, environment: dict[str, str] | None = None) -> np.ndarray:
    done = subprocess.run(
        [program, token, str(STEPS)], cwd=program.parent, capture_output=True, env=environment
    )
    assert (done.returncode, done.stderr.decode()[:2000]) == (0, "")
    return np.frombuffer(done.stdout)


def built(folder: Path, files: list[str], *flags: str) -> Path:
    """The importer with some other files."""
    shutil.copy(HOST, folder)
    command = ["gcc", *FLAGS, *flags, "-o", "host", "host.c", *files, "-lm", "-Wl,-rpath,$ORIGIN"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:3000]
    return folder / "host"


@pytest.mark.parametrize(
    ("name", "dialect"),
    [
        ("propneu-20", FMI2),
        ("pair", FMI3),
        pytest.param(
            "pair",
            FMI2,
            marks=pytest.mark.examination(
                "test_the_binary_runs_without_python_and_the_sources_under_sanitizers"
            ),
        ),
    ],
)
def test_the_binary_runs_without_python_and_the_sources_under_sanitizers(name, dialect, tmp_path):
    model = subject_named(name)
    texts = package.sources(model, "drive", dialect)
    for file, text in texts.items():
        (tmp_path / file).write_text(text, "utf-8")
    token = re.search(r'MODEL_GUID "(.*)"', texts["model.h"])[1]
    with zipfile.ZipFile(fmu_of(model, tmp_path, "drive", dialect)) as archive:
        (member,) = (each for each in archive.namelist() if each.endswith(".so"))
        (tmp_path / "drive.so").write_bytes(archive.read(member))
    alone = positions(built(tmp_path, ["drive.so"]), token, environment={})
    checked = positions(built(tmp_path, package.compiled(texts), *SANITIZERS), token)
    run = our_run(model, 1e-3 * np.arange(1, STEPS + 1))
    ours = run.states["stroke"] / run.drive.load.lever_ratio
    assert np.ptp(ours) > 1e-3
    assert np.max(np.abs(alone - ours)) < 1e-4
    # Another optimisation rounds differently.
    assert np.max(np.abs(checked - alone)) < 1e-6
