"""Sweeps, cycles, directions and speeds of signals that were made from them."""

import numpy as np
import pytest
from scipy.signal import lfilter

from mckibben.measurement.measurement import Measurement, build
from mckibben.measurement.sweeps import Sweeps

ROWS = 4000
TIME = np.arange(ROWS) * 0.01
RANDOM = np.random.default_rng(11)


def triangle(rows: int, cycles: float) -> np.ndarray:
    phase = (np.arange(rows) / rows * cycles) % 1.0
    return np.where(phase < 0.5, 2.0 * phase, 2.0 - 2.0 * phase)


def isobaric(stroke: np.ndarray, noise: float = 0.0, **more) -> Sweeps:
    """Segments of a loop at one pressure; the stroke goes from 0 to 1 for 50 mm."""
    rows = len(stroke)
    columns = {
        "time": np.arange(rows) * 0.01,
        "pressure": np.full(rows, 3e5),
        "length": 0.3 - 0.05 * (stroke + noise * RANDOM.standard_normal(rows)),
        "force": 100.0 + stroke,
        **more,
    }
    return build(columns, name="a.csv", id="0" * 64, kind="isobaric").segments


def borders(segments: Sweeps) -> np.ndarray:
    return np.flatnonzero(np.diff(segments.sweep))


@pytest.mark.parametrize("noise", [0.0, 0.002, 0.02, 0.1])
def test_a_triangle_has_its_sweeps_whatever_the_noise(noise: float) -> None:
    segments = isobaric(triangle(ROWS, 4), noise)
    assert (segments.sweeps, segments.cycles, segments.signal) == (8, 4, "length")
    np.testing.assert_allclose(borders(segments), np.arange(500, 4000, 500), atol=5 + 300 * noise)
    expected = np.tile(np.repeat([-1, 1], 500), 4)
    assert np.mean(segments.direction == expected) > 0.97 - noise / 2
    assert segments.noise == pytest.approx(0.05 * noise, rel=0.1, abs=1e-12)


@pytest.mark.parametrize("noise", [0.0, 0.002, 0.02])
def test_a_sine_has_no_rests(noise: float) -> None:
    segments = isobaric(0.5 - 0.5 * np.cos(8.0 * np.pi * np.arange(ROWS) / ROWS), noise)
    assert (segments.sweeps, segments.cycles) == (8, 4)
    assert segments.held_rows < 0.03 * ROWS


@pytest.mark.parametrize("noise", [0.0, 0.002])
def test_speeds_are_told_apart(noise: float) -> None:
    stroke = np.concatenate([triangle(2000, 1), triangle(1000, 2), triangle(1000, 8)])
    segments = isobaric(stroke, noise)
    assert (segments.sweeps, segments.cycles) == (22, 11)
    # 50 mm in 10 s, 2.5 s, 0.625 s
    np.testing.assert_allclose(segments.speeds, [0.005, 0.02, 0.08], rtol=0.03)
    assert [segments.speed_level[row] for row in (500, 2100, 3990)] == [1, 2, 3]


def test_rests_of_a_trapezoid_are_held() -> None:
    stroke = np.clip(1.6 * triangle(ROWS, 4) - 0.3, 0.0, 1.0)
    segments = isobaric(stroke)
    resting = (stroke == 0.0) | (stroke == 1.0)
    assert np.mean((segments.direction == 0) == resting) > 0.95


def test_creep_after_a_step_is_held() -> None:
    square = ((np.arange(ROWS) // 500) % 2).astype(float)
    stroke = lfilter([0.1], [1.0, -0.9], square) + 0.01 * lfilter([0.004], [1.0, -0.996], square)
    segments = isobaric(stroke)
    for edge in range(500, ROWS, 500):
        side = -1 if (edge // 500) % 2 else 1
        assert (segments.direction[edge + 2 : edge + 15] == side).all()
        assert (segments.direction[edge + 100 : edge + 480] == 0).all()
    assert (segments.speed_level[segments.direction == 0] == 0).all()


def test_a_staircase_is_held_on_its_steps() -> None:
    stairs = np.repeat(np.concatenate([np.arange(11), np.arange(9, -1, -1)]), 100) / 10.0
    segments = isobaric(stairs, 0.0005)
    assert segments.sweeps == 2
    assert 0.7 < segments.held_rows / len(stairs) < 1.0


def test_isometric_sweeps_are_those_of_pressure() -> None:
    pressure = 6e5 * triangle(ROWS, 2)
    columns = {"time": TIME, "pressure": pressure, "length": np.full(ROWS, 0.3), "force": 1.0 + pressure}
    segments = build(columns, name="a.csv", id="0" * 64).segments
    assert (segments.signal, segments.sweeps, segments.cycles) == ("pressure", 4, 2)
    assert segments.direction[500] == -1, "rising pressure would shorten"


def test_each_level_begins_anew() -> None:
    pressure = np.repeat([1e5, 2e5, 4e5], 800)
    stroke = np.tile(triangle(800, 1), 3)
    segments = isobaric(stroke, pressure=pressure)
    assert (segments.sweeps, segments.cycles) == (6, 3)
    np.testing.assert_allclose(borders(segments), [400, 799, 1200, 1599, 2000], atol=2)


def test_files_are_never_joined_in_one_sweep() -> None:
    measurement = build(
        {"pressure": np.full(100, 1e5), "length": 0.3 - 0.001 * np.arange(100), "force": np.ones(100)},
        name="a.csv", id="0" * 64, kind="isobaric", starts=(0, 40),
    )  # fmt: skip
    assert borders(measurement.segments).tolist() == [39]


def test_a_direction_column_decides() -> None:
    direction = np.repeat([-1.0, 1.0, -1.0, 1.0], 25)
    columns = {"pressure": np.arange(100.0), "length": np.linspace(0.3, 0.2, 100), "direction": direction}
    segments = build(columns, name="a.csv", id="0" * 64).segments
    np.testing.assert_array_equal(segments.direction, direction)
    assert (segments.sweeps, segments.cycles, segments.speeds) == (4, 2, ())


def test_one_row_and_no_motion() -> None:
    for rows in (1, 2, 30):
        columns = {"pressure": np.full(rows, 1e5), "length": np.full(rows, 0.3), "force": np.ones(rows)}
        segments: Sweeps = build(columns, name="a", id="0" * 64, kind="static").segments
        assert (segments.sweeps, segments.cycles, segments.held_rows) == (1, 1, rows)


def test_a_long_noisy_signal_keeps_its_turns() -> None:
    rows = 500_000
    stroke = triangle(rows, 20) + 0.01 * RANDOM.standard_normal(rows)
    measurement: Measurement = build(
        {"time": np.arange(rows) * 1e-3, "pressure": np.full(rows, 1e5), "displacement": 0.05 * stroke},
        name="a.csv", id="0" * 64, kind="transient",
    )  # fmt: skip
    assert measurement.segments.sweeps == 40
    np.testing.assert_allclose(borders(measurement.segments), np.arange(12_500, rows, 12_500), atol=300)
