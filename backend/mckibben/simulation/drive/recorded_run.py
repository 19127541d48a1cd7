"""What a run along a record gives: its readings as far as it went, and why it stopped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class RecordedRun:
    """Readings of a run on the rows of a record.

    Attributes:
        readings: name -> values of the rows that the run reached, SI, shape (rows reached,); empty without a
            start.
        steps: accepted and rejected steps.
        stop: why it stopped before the last row, for the user; "" where it did not.
    """

    readings: Mapping[str, np.ndarray]
    steps: int = 0
    stop: str = ""

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a reading."""
        return self.readings[name]
