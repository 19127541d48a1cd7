"""Logs over hours whose time is in seconds, as their head says."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError

ROWS = np.arange(240)


def log(pressure: np.ndarray) -> Measurement:
    """A reading each minute for four hours, under a weight."""
    lines = [f"{60 * n};{p:.3f};{12.0 * p + 0.02 * (n % 5):.3f}" for n, p in zip(ROWS, pressure, strict=True)]
    text = "\n".join(["# rest length 300 mm, load 12 kg", "time (s);pressure (bar);stroke (mm)", *lines])
    return read_measurement(text.encode(), "log.csv")


def test_a_warming_up_of_hours_on_and_off_is_read_as_it_says() -> None:
    """The pressure is another one from row to row, which no muscle follows in the 60 ms of a wrong unit."""
    found = log(1.0 + 3.0 * ((ROWS // 10) % 2))
    assert found.columns["time"][-1] == 60.0 * 239


def test_ramps_that_would_suit_milliseconds_are_asked_about() -> None:
    with pytest.raises(InputError, match="60 s between readings"):
        log(2.5 - 1.5 * np.cos(ROWS / 20.0))


@pytest.mark.parametrize("rows", [39_999, 40_000, 40_001])
def test_a_log_of_any_length_is_read(rows: int) -> None:
    """Questions are asked of a choice of its rows."""
    time = 1e-3 * np.arange(rows)
    stroke = 30.0 * (1.0 - np.cos(0.3 * time))
    lines = [f"{t:.3f},4.0,{x:.4f},{900.0 - 9.0 * x:.2f}" for t, x in zip(time, stroke, strict=True)]
    text = "\n".join(["time (s),pressure (bar),displacement (mm),force (N)", *lines])
    assert read_measurement(text.encode(), "log.csv").rows == rows
