"""Corners of a way between two rows: late readings there are those of the true course."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.predict.comparable_rows import ComparableRows, comparable_rows
from mckibben.identification.predict.corners import _corners, with_corners
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.identification.predict.memory import Memory
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.identification.predict.sensor_dynamics import as_read
from mckibben.measurement.read import read_measurement
from mckibben.physics import ideal
from tests.identification.synthetic import CATALOGUE, MUSCLE

STEP = 0.07  # time between two rows [s]
DELAY = 0.03
ROWS = np.arange(90) * STEP
LAG = FitModel(MUSCLE).adding(CATALOGUE["time_skew"], {"delay": DELAY})


def pressure(time: np.ndarray) -> np.ndarray:
    """Ramps and holds between 1 and 4 bar; their corners lie anywhere between rows [Pa]."""
    return 1e5 * np.interp(time, [0.0, 0.5, 1.53, 2.61, 3.31, 4.44, 5.0, 6.3], [1, 1, 4, 4, 2, 4, 1, 1])


def isometric(readings: np.ndarray, force: np.ndarray | float = 100.0) -> ComparableRows:
    """Rows of a test at a constant length."""
    rows = np.broadcast_arrays(ROWS, readings, 0.95 * MUSCLE.nominal_length, force)
    text = "# kind: isometric\ntime_s,pressure_Pa,length_m,force_N\n"
    text += "\n".join(",".join(f"{value:.9g}" for value in row) for row in zip(*rows, strict=True))
    return comparable_rows(read_measurement(text.encode(), "test.csv"), MUSCLE)


def corners(way: np.ndarray) -> np.ndarray:
    """Times of the corners of a way [s]."""
    row, after = _corners(ROWS[: len(way)], way, np.zeros(len(way), int))
    return ROWS[row] + after


def test_corners_are_where_the_straight_lines_meet() -> None:
    assert corners(pressure(ROWS)) == pytest.approx([0.5, 1.53, 2.61, 3.31, 4.44, 5.0], abs=1e-9)


def test_a_corner_at_a_row_is_that_row() -> None:
    tip = ROWS[40]
    assert not len(corners(-np.abs(ROWS - tip)))


def test_a_smooth_way_has_no_corners() -> None:
    assert not len(corners(np.sin(2.0 * np.pi * ROWS / 1.3)))


def test_noise_has_no_corners() -> None:
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(size=len(ROWS))
        assert not len(corners(noise))
        assert not len(corners(ROWS + noise))


def test_no_corner_is_looked_for_across_records() -> None:
    row, _ = _corners(ROWS, pressure(ROWS), np.arange(len(ROWS)) // 5)
    assert not len(row)


def test_a_late_reading_beside_a_corner_is_that_of_the_true_course() -> None:
    task = isometric(pressure(ROWS))
    late = replace(task, state={**task.state, "pressure": pressure(ROWS - DELAY)})
    true = QuasistaticPredictor(late).predict(FitModel(MUSCLE))
    assert QuasistaticPredictor(task).predict(LAG) == pytest.approx(true, abs=0.02)


def test_a_slow_reading_is_that_of_the_true_course() -> None:
    slow = FitModel(MUSCLE).adding(CATALOGUE["sensor_lag"], {"force_time": 0.05})
    task = isometric(pressure(ROWS))
    fine = np.arange(100 * len(ROWS)) * STEP / 100.0
    force = ideal.force(braid=MUSCLE.braid, pressure=pressure(fine), length=0.95 * MUSCLE.nominal_length)
    true = as_read(slow, time=fine, records=[np.arange(len(fine))], values=force)[::100]
    assert QuasistaticPredictor(task).predict(slow) == pytest.approx(true[~task.turning], abs=0.1)


def test_a_row_is_predicted_alike_with_a_delay_of_nothing() -> None:
    predictor = QuasistaticPredictor(isometric(pressure(ROWS)))
    none = FitModel(MUSCLE).adding(CATALOGUE["time_skew"], {"delay": 0.0})
    assert predictor.predict(none) == pytest.approx(predictor.predict(FitModel(MUSCLE)), rel=1e-12)


def test_memory_does_not_depend_on_the_rows_at_corners() -> None:
    task = isometric(pressure(ROWS))
    model = FitModel(MUSCLE).adding(CATALOGUE["pressure_hysteresis"])
    more = with_corners(task)
    assert more.corners is not None
    assert len(more.rows) == len(task.rows) + 2 * 6
    plain, between = Memory(task).states(model), Memory(more).states(model)
    for name, values in plain.items():
        assert between[name][~more.corners] == pytest.approx(values, abs=1e-12)


def test_derivatives_are_those_of_the_prediction() -> None:
    predictor = QuasistaticPredictor(isometric(pressure(ROWS)))
    model = LAG.adding(CATALOGUE["linear_elasticity"], {"stiffness": 300.0})
    free = free_numbers(model)
    _, slopes = predictor.linearised(model, free)
    apart = np.abs(slopes - predictor.differences(model, free))
    assert np.all(apart < 1e-3 * np.max(np.abs(slopes), axis=0))
