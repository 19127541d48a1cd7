"""What a run costs at each door, and how long the first answers after an installation take.

    python -m tests.benchmarks.doors

Times of the processor, the least of many; a quiet machine. The first answers are those of the command line
with empty caches: no code of a structure is kept, the integrators are those compiled with the installation.
"""

from __future__ import annotations

import http.client
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import mckibben as mk
from tests.benchmarks.engine import say
from tests.running_server import AUTHORIZED, RunningServer

ROUNDS = 60


def least(work: Callable[[], object]) -> tuple[float, float]:
    """Least time of the processor, and least time [ms]."""
    found = []
    for _ in range(ROUNDS):
        processor, began = time.process_time(), time.perf_counter()
        work()
        found.append((time.process_time() - processor, time.perf_counter() - began))
    return 1e3 * min(each for each, _ in found), 1e3 * min(each for _, each in found)


def in_python() -> None:
    """Runs of presets, and of a drive that is changed each time."""
    for name in ("propneu-20", "paper-pid-pulse", "joint-20"):
        drive = mk.Drive.preset(name)
        run = drive.run()
        processor, passed = least(drive.run)
        say(f"Python, {name}: {processor:.2f} ms of the processor, {passed:.2f} ms, {run.steps} steps")
    drive, masses = mk.Drive.preset("propneu-20"), iter(np.linspace(8.0, 12.0, ROUNDS + 1).tolist())
    processor, passed = least(lambda: drive.changed(load={"mass": next(masses)}).run())
    say(f"Python, propneu-20 changed: {processor:.2f} ms of the processor, {passed:.2f} ms")


def over_http(folder: Path) -> None:
    """A warm request of 1000 rows."""
    with RunningServer(folder) as server:
        connection = http.client.HTTPConnection(server.url.removeprefix("http://"), timeout=60)
        body = json.dumps({"drive": "propneu-20", "points": 1000})

        def ask() -> None:
            connection.request(
                "POST", "/api/simulations", body, {"content-type": "application/json", **AUTHORIZED}
            )
            assert len(connection.getresponse().read()) > 1000

        ask()
        say(f"HTTP, propneu-20, 1000 rows: {least(ask)[1]:.2f} ms")


def first_answers(folder: Path) -> None:
    """Commands with empty caches, one after the other."""
    rows = [f"{bar},{length},{200.0 * bar * (1.0 - (300.0 - length) / 75.0):.2f}" for bar in (2, 4, 6)
            for length in range(295, 250, -5)]  # fmt: skip
    (folder / "map.csv").write_text("\n".join(["# kind: static", "pressure_bar,length_mm,force_N", *rows]))
    commands = {
        "transient": ["simulate", "propneu-20"],
        "static comparison": ["compare", str(folder / "map.csv"), "--muscle", "DMSP-20:300mm"],
        "curves": ["curves", "--muscle", "DMSP-20:300mm", "--pressure", "3 bar"],
    }
    for name, command in commands.items():
        with tempfile.TemporaryDirectory() as cache:
            environment = {**os.environ, "MCKIBBEN_CACHE": cache, "MCKIBBEN_DATA": str(folder / "data")}
            began = time.perf_counter()
            subprocess.run(
                [sys.executable, "-m", "mckibben", *command], env=environment, check=True, capture_output=True
            )
            say(f"first {name} of an installation: {time.perf_counter() - began:.2f} s")


def main() -> None:
    """All of them."""
    with tempfile.TemporaryDirectory() as place:
        in_python()
        over_http(Path(place))
        first_answers(Path(place))


if __name__ == "__main__":
    main()
