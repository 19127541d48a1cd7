"""The tests that take too long for every run: ``python -m tests.benchmarks.examinations [ARGUMENTS]``.

They stand among the others, marked ``@pytest.mark.examination(beside)``, where ``beside`` names the short
test of the suite that makes the same claim. Whoever changes what they examine runs them, and all of them run
before a release. The arguments are pytest's:

    python -m tests.benchmarks.examinations tests/frontend/test_sizing.py
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main(arguments: list[str]) -> int:
    """Run them; pytest's exit code."""
    return subprocess.call([sys.executable, "-m", "pytest", "-m", "examination", *arguments], cwd=ROOT)


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
