"""Many generated requests: ``python -m tests.benchmarks.requests [NUMBER]``, 500 for each operation.

What is checked of each answer is in ``tests/server/test_schemathesis.py``, which sends a few in every run.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main(arguments: list[str]) -> int:
    """Run the tests with this many requests; their exit code."""
    number = int(arguments[0]) if arguments else 500
    command = [sys.executable, "-m", "pytest", "-q", "tests/server/test_schemathesis.py"]
    return subprocess.call(command, cwd=ROOT, env={**os.environ, "MCKIBBEN_REQUESTS": str(number)})


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
