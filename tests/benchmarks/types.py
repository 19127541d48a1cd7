"""Types of all files by pyright: ``python -m tests.benchmarks.types``, a minute of processor time.

The suite checks all files with ty in a tenth of that, and with pyright the public names and who uses them.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.pyright_environment import pyright_environment

ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    """Run pyright as pyproject.toml says; its exit code."""
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable]
    return subprocess.call(command, cwd=ROOT, env=pyright_environment())


if __name__ == "__main__":
    raise SystemExit(main())
