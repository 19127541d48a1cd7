"""What the fork server loads before it makes a worker: the program, and the units, a third of its start."""

from __future__ import annotations

from mckibben.measurement.reading import load_readers
from mckibben.server import worker  # noqa: F401 - loaded for the workers

load_readers()
