"""The cases with hidden effects with every seed: ``python -m tests.benchmarks.truth_cases``.

What is checked of them is in ``tests/identification/test_truth_cases.py``, where every run makes each once.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from tests.truth.generate import SEEDS

ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    """Run the tests with all seeds; their exit code."""
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", "tests/identification/test_truth_cases.py"]
    environment = {**os.environ, "MCKIBBEN_TRUTH_SEEDS": str(len(SEEDS))}
    return subprocess.call(command, cwd=ROOT, env=environment)


if __name__ == "__main__":
    raise SystemExit(main())
