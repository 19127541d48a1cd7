"""A full disk; everything at once is ``python -m tests.benchmarks.chaos``."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from tests.robustness.files import csv
from tests.robustness.load import ask
from tests.running_server import MAIN, RunningServer

SMALL_FILES = ("/bin/sh", "-c", 'ulimit -f 100; exec "$@"', "sh", *MAIN)

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of the shell, processes of /proc")


def test_a_full_disk_is_told_and_what_was_kept_stays(tmp_path: Path) -> None:
    """No file may exceed 50 kB or so, as on a disk without room."""
    with RunningServer(tmp_path, command=SMALL_FILES, arguments=["--workers", "0"]) as server:
        kept = ask(server, "PUT", "/api/measurements?name=small.csv", csv())
        assert kept.status == 200
        large = csv() + b"".join(b"0.1,1,300,%d\n" % number for number in range(20_000))
        refused = ask(server, "PUT", "/api/measurements?name=large.csv", large)
        assert refused.status == 507
        assert "the disk is full" in json.loads(refused.body)["error"]["message"]
        assert ask(server, "GET", f"/api/measurements/{json.loads(kept.body)['id']}").status == 200
        listed = json.loads(ask(server, "GET", "/api/kept").body)["items"]
        assert [item["name"] for item in listed] == ["small.csv"]
        assert ask(server, "GET", "/api/health").status == 200
        assert "Traceback" not in server.output
