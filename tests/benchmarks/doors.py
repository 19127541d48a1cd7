"""What a run costs at each door, and how long the first answers after an installation take.

    python -m tests.benchmarks.doors

Times of the processor in milliseconds, which other work on the machine changes little. Of runs the least of
many; of the server the mean of many requests, with everything it does besides. The first answers are those
of the command line with empty caches: no code of a structure is kept, the integrators are those compiled with
the installation (in a checkout: `backend/compile_kernels.py`).
"""

from __future__ import annotations

import http.client
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from itertools import count
from pathlib import Path

import mckibben as mk
from mckibben.documents.studio import Studio
from mckibben.resources import presets_folder
from mckibben.simulation.drive.transient import TOLERANCE
from tests.benchmarks.engine import kernel_positions, say
from tests.benchmarks.lift import Lift
from tests.running_server import AUTHORIZED, RunningServer

ROUNDS, REQUESTS = 60, 300


def least(work: Callable[[], object]) -> float:
    """Least time of the processor [ms]."""
    found = []
    for _ in range(ROUNDS):
        began = time.process_time()
        work()
        found.append(time.process_time() - began)
    return 1e3 * min(found)


def in_python() -> None:
    """Runs of presets, of a drive that is changed each time, and what is read of them."""
    for name in ("propneu-20", "paper-pid-pulse", "joint-20"):
        drive = mk.Drive.preset(name)
        run = drive.run()
        say(f"Python, {name}: {least(drive.run):.2f}, {run.steps} steps")
    drive, masses = mk.Drive.preset("propneu-20"), count(8.0, 1e-3)

    def changed() -> mk.door.run.Run:
        return drive.changed(load={"mass": next(masses)}).run()

    say(f"Python, propneu-20 changed: {least(changed):.2f}")
    say(f"  and its positions read: {least(lambda: changed().position):.2f}")
    say(f"  and a time of the fill read: {least(lambda: changed().timing.extend.rise_time):.2f}")
    say(f"  and everything read: {least(lambda: changed().to_dict()):.2f}")


def of_kernel() -> None:
    """The integration of the reference lift, at the tolerance of runs."""
    positions = kernel_positions(Lift(Studio(presets=presets_folder())))
    say(f"the reference lift in the kernel: {least(lambda: positions(0, TOLERANCE)):.2f}")


def over_http(folder: Path) -> None:
    """Warm requests of 1000 rows."""
    with RunningServer(folder) as server:
        connection = http.client.HTTPConnection(server.url.removeprefix("http://"), timeout=60)
        body = json.dumps({"drive": "propneu-20", "points": 1000})

        def ask() -> None:
            connection.request(
                "POST", "/api/simulations", body, {"content-type": "application/json", **AUTHORIZED}
            )
            assert len(connection.getresponse().read()) > 1000

        for _ in range(REQUESTS):  # also what the server warms beside them
            ask()
        began, waits = processor_of(server.pid), []
        for _ in range(REQUESTS):
            at = time.perf_counter()
            ask()
            waits.append(time.perf_counter() - at)
        mean = 1e3 * (processor_of(server.pid) - began) / REQUESTS
        say(f"HTTP, propneu-20, 1000 rows: {mean:.2f} of the server; {1e3 * min(waits):.2f} ms waited")


def processor_of(pid: int) -> float:
    """Time of the processor that a process has taken [s]; Linux."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def first_answers(folder: Path) -> None:
    """Commands with empty caches, one after the other."""
    rows = [f"{bar},{length},{200.0 * bar * (1.0 - (300.0 - length) / 75.0):.2f}" for bar in (2, 4, 6)
            for length in range(295, 250, -5)]  # fmt: skip
    (folder / "map.csv").write_text("\n".join(["# kind: static", "pressure_bar,length_mm,force_N", *rows]))
    commands = {
        "transient": ["simulate", "propneu-20"],
        "transient of a joint": ["simulate", "joint-20"],
        "static comparison": ["compare", str(folder / "map.csv"), "--muscle", "DMSP-20:300mm"],
        "curves": ["curves", "--muscle", "DMSP-20:300mm", "--pressure", "3 bar"],
    }
    for name, command in commands.items():
        with tempfile.TemporaryDirectory() as cache:
            environment = {**os.environ, "MCKIBBEN_CACHE": cache, "MCKIBBEN_DATA": str(folder / "data")}
            before = children()
            subprocess.run(
                [sys.executable, "-m", "mckibben", *command], env=environment, check=True, capture_output=True
            )
            say(f"first {name} of an installation: {1e3 * (children() - before):.0f}")


def children() -> float:
    """Time of the processor of the processes that have ended [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    """All of them."""
    with tempfile.TemporaryDirectory() as place:
        in_python()
        of_kernel()
        first_answers(Path(place))
        over_http(Path(place))


if __name__ == "__main__":
    main()
