"""Memory for the largest measurement files that are read: ``python -m tests.benchmarks.large_files``."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.robustness.test_hostile_files import LARGEST, large_files, read_elsewhere


def main() -> int:
    """Print the table; 1 when a file is refused or takes more than is allowed."""
    wrong = 0
    for name, content in large_files(1.0).items():
        with tempfile.TemporaryDirectory() as folder:
            read = read_elsewhere(Path(folder), {name: content})[name]
        fine = read.refusal is None and 100e6 < read.peak < LARGEST
        wrong += not fine
        said = read.refusal or "read"
        sys.stdout.write(f"{name}: {read.peak / 1e6:.0f} of at most {LARGEST / 1e6:.0f} MB, {said}\n")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
