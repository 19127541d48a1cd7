"""Projects while their process is killed fifty times: what was acknowledged and what is there afterwards.

    python -m tests.benchmarks.projects [--postgresql postgresql://tester@/postgres?host=/tmp/pg] [--kills 50]

A process saves a project of 20 kB again and again and says each version; it gets SIGKILL at a random moment.
SQLite in a temporary folder, and a PostgreSQL whose address is given. Also saves per second.
"""

from __future__ import annotations

import argparse
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore
from tests.benchmarks.diagnosis import say

WRITER = Path(__file__).parents[1] / "projects" / "writer.py"


def killed(address: str, after: float) -> list[tuple[str, int]]:
    """Versions that a process acknowledged before it was killed, some time after its first save."""
    with subprocess.Popen(
        [sys.executable, str(WRITER), address], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        lines = [process.stdout.readline()]
        time.sleep(after)
        process.send_signal(signal.SIGKILL)
        lines += [line for line in process.stdout if line.endswith("\n")]
    return [(line.split()[0], int(line.split()[1])) for line in lines]


def examined(name: str, address: str, kills: int) -> None:
    """Kill a writer some times and compare what it acknowledged with what is there."""
    store = ProjectStore(Database(address if "://" in address else Path(address)))
    choose, saves, lost, torn, spent = random.Random(1), 0, 0, 0, 0.0
    for _ in range(kills):
        after = choose.uniform(0.0, 0.3)
        said = killed(address, after)
        identity, version = said[-1]
        found = store.open(identity)
        saves, spent = saves + len(said), spent + after
        lost += found.summary.version < version
        torn += found.document.get("version") != found.summary.version
        torn += len(store.history(identity)) != min(found.summary.version, 200)
    rate = saves / spent
    say(f"{name:12}{kills:6} kills{saves:8} acknowledged{lost:6} lost{torn:6} torn{rate:8.0f} saves/s")
    store.close()


def main() -> None:
    """Print a line for each database."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--postgresql", default="", help="address of a PostgreSQL database")
    parser.add_argument("--kills", type=int, default=50)
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        examined("SQLite", folder, chosen.kills)
    if chosen.postgresql:
        examined("PostgreSQL", chosen.postgresql, chosen.kills)


if __name__ == "__main__":
    sys.exit(main())
