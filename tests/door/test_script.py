"""The whole story in at most 25 lines, from an empty folder."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import mckibben as mk

SCRIPT = Path(__file__).parent / "script.py"


def test_the_script_runs_where_only_its_data_are(tmp_path: Path) -> None:
    lines = SCRIPT.read_text("utf-8").splitlines()
    assert len(lines) <= 25
    assert [line for line in lines if "import" in line.split()] == ["import mckibben as mk"]
    mk.read("martens-dmsp-20-300").save(tmp_path / "map.csv")
    shutil.copy(SCRIPT, tmp_path / "script.py")
    environment = {
        **os.environ,
        "PYTHONPATH": str(Path(mk.__file__).parents[1]),
        "MCKIBBEN_DATA": str(tmp_path / "data"),
        "PYTHONIOENCODING": "utf-8",
    }
    done = subprocess.run(
        [sys.executable, "-W", "error", "script.py"], cwd=tmp_path, env=environment, capture_output=True,
        encoding="utf-8", timeout=300,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    (line,) = (line for line in done.stdout.splitlines() if "before" in line and "after" in line)
    words = line.split()
    assert float(words[3]) < 0.1 * float(words[0])  # the error falls to that of the readings
    assert done.stdout.rstrip().endswith("True")
    assert {path.name for path in tmp_path.glob("*.*")} >= {"model.json", "curves.csv"}
