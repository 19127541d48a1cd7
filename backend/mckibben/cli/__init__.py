"""The command line: ``mckibben`` alone starts the studio; the other commands work without a browser.

Exit 0: done. Exit 2: the input cannot be used; one line on stderr says where, what is wrong and what would
be right. Exit 3: no drive fulfils the task of a sizing; the answer says why. A command imports what it
works with when it runs, so that others and --help need not wait for that.
"""

from __future__ import annotations

import gc
import sys

# In the order of the help.
from mckibben.cli import (  # isort: skip
    studio_commands, data_commands, drive_commands, listing_commands, effect_commands,
    project_commands,
)  # fmt: skip
from mckibben.cli.app import app, run

__all__ = [
    "app",
    "data_commands",
    "drive_commands",
    "effect_commands",
    "listing_commands",
    "main",
    "project_commands",
    "run",
    "studio_commands",
]


def main() -> None:
    """Entry point of the console script."""
    # What is loaded and built at the start is not garbage: looking for it so often takes a tenth of the time.
    gc.set_threshold(50_000, 20, 50)
    sys.exit(run(sys.argv[1:]))
