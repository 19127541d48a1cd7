"""A Dask scheduler with workers on this machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

# Whoever reaches a scheduler or a worker runs what he likes with it.
_HERE = ("--host", "127.0.0.1")


class LocalCluster:
    """A scheduler and workers, each a process of its own.

    Args:
        folder: for their files.
        workers: how many.

    Attributes:
        address: of the scheduler.
        workers: their processes.
    """

    def __init__(self, folder: Path, *, workers: int = 2) -> None:
        self._folder = folder
        self._scheduler = self._start("scheduler", *_HERE, "--port", "0", "--no-dashboard",
                                      "--scheduler-file", str(folder / "scheduler.json"))  # fmt: skip
        self.workers = [
            self._start("worker", *_HERE, "--scheduler-file", str(folder / "scheduler.json"),
                        "--nthreads", "1", "--no-nanny", "--no-dashboard")
            for _ in range(workers)
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
