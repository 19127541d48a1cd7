"""What scatters as a sensor: readings do, no set point of any shape."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.scatter import is_sensed
from tests.measurement.reading.muscle_test import Array

N = 2000
T = 0.01 * np.arange(N)
RANDOM = np.random.default_rng(7)
SHAPES: dict[str, Array] = {
    "constant": np.full(N, 4.0),
    "steps": np.repeat(RANDOM.uniform(1.0, 6.0, 20), 100),
    "ramp": 1.0 + T / 5.0,
    "triangle": 3.0 + 2.0 * np.abs(T % 2.0 - 1.0),
    "sine": 3.0 + 2.0 * np.sin(2.0 * np.pi * T),
    "sweep": 3.0 + 2.0 * np.sin(2.0 * np.pi * (0.1 * T + 1.2 * T**2)),
    "many sines": 3.0 + sum(0.4 * np.sin(2.0 * np.pi * f * T + f) for f in (0.3, 1.1, 2.7, 7.3)),
}


def first_order(values: Array) -> Array:
    """The pressure that follows a set value with a time constant of three rows."""
    out = values.copy()
    for row in range(1, len(out)):
        out[row] = out[row - 1] + 0.3 * (values[row] - out[row - 1])
    return out


@pytest.mark.parametrize("shape", ["constant", "steps", "ramp", "sine", "many sines"])
@pytest.mark.parametrize("step", [1e-6, 1e-4, 10.0 / 4096.0])
def test_readings_scatter(shape: str, step: float) -> None:
    noise = np.random.default_rng(3).normal(0.0, 0.01, N)
    readings = np.round((first_order(SHAPES[shape]) + noise) / step) * step
    assert is_sensed(readings, [np.random.default_rng(4).normal(0.0, 1.0, N)])


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("written", ["exact", "0.0001", "0.01", "12 bit", "4 digits", "3 digits", "4 byte"])
def test_no_set_point_does_however_it_is_written(shape: str, written: str) -> None:
    values = SHAPES[shape]
    if written == "12 bit":
        values = (np.round(values * 409.6) / 409.6).round(4)
    elif "digits" in written:
        values = np.array([float(f"{value:.{written[0]}g}") for value in values])
    elif written == "4 byte":
        values = values.astype(np.float32).astype(np.float64)
    elif written != "exact":
        values = np.round(values / float(written)) * float(written)
    assert not is_sensed(values, [])


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("clock", ["unsteady", "95 Hz", "53 Hz"])
def test_nor_where_it_is_sampled_unevenly(shape: str, clock: str) -> None:
    rate = 100.0 if clock == "unsteady" else float(clock.split()[0])
    times = T + RANDOM.normal(0.0, 0.002, N) if clock == "unsteady" else np.floor(T * rate) / rate
    assert not is_sensed(np.interp(times, T, SHAPES[shape]).round(4), [])


@pytest.mark.parametrize("rows_before", [0, 1, 2])
def test_what_a_controller_computes_from_a_reading_follows_it(rows_before: int) -> None:
    position = np.sin(3.0 * T) + RANDOM.normal(0.0, 0.01, N)
    set_value = 4.0 - np.roll(position, rows_before)
    assert not is_sensed(set_value, [position])
    assert is_sensed(set_value, [])  # its scatter alone would not tell


@pytest.mark.parametrize(
    "values",
    [
        RANDOM.uniform(1.0, 5.0, N),
        RANDOM.integers(10, 60, N) / 10.0,
        4.0 + 0.03 * RANDOM.choice([-1.0, 1.0], N),
        SHAPES["steps"] + RANDOM.normal(0.0, 0.01, N),  # a command that a converter has read
        SHAPES["sine"][:150] + RANDOM.normal(0.0, 0.01, 150),  # too few rows
        np.full(N, np.nan),
    ],
)
def test_neither_what_is_set_at_random_nor_a_command_that_was_recorded(values: Array) -> None:
    assert not is_sensed(values, [])
