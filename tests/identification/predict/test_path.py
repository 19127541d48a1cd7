"""Rows between which a muscle that carries a load is followed."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.path import path_of


def rows_of(time: np.ndarray, pressure: np.ndarray, length: np.ndarray, records: np.ndarray | None = None):
    count = len(time)
    return ComparableRows(
        kind="isotonic", channel="length", unit="m", measured=length,
        state={"pressure": pressure, "length": length, "load": np.full(count, 100.0)},
        time=time, records=np.zeros(count, int) if records is None else records,
        groups=np.zeros(count), turning=np.zeros(count, bool), rows=np.arange(count), excluded={},
        unknown_load=False, messages=(),
    )  # fmt: skip


def cycles(count: int = 1200, noise: float = 0.0):
    time = np.linspace(0.0, 60.0, count)
    pressure = 3e5 - 2e5 * np.cos(0.5 * time)
    length = 0.28 - 0.03 * (pressure / 5e5) ** 0.8 + noise * np.random.default_rng(3).normal(size=count)
    return time, pressure, length


def test_far_fewer_rows_than_a_logger_writes_tell_the_way():
    time, pressure, length = cycles()
    path = path_of(rows_of(time, pressure, length))
    assert len(path.rows) < 0.4 * len(time)
    for values in (pressure, length):
        assert path.everywhere(values[path.rows]) == pytest.approx(values, abs=3e-3 * np.ptp(values))
    np.testing.assert_array_equal(path.everywhere(length[path.rows])[path.rows], length[path.rows])


def test_noise_of_the_readings_does_not_ask_for_more_rows():
    quiet = path_of(rows_of(*cycles()))
    noisy = path_of(rows_of(*cycles(noise=2e-5)))
    assert len(noisy.rows) < 1.5 * len(quiet.rows)


def test_turns_ends_of_records_and_beginnings_are_kept():
    time, pressure, length = cycles(600)
    twice = [np.concatenate([values, values]) for values in (time, pressure, length)]
    records = np.repeat([0, 1], 600)
    path = path_of(rows_of(*twice, records), begins=[777])
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(pressure))))
    assert {0, 599, 600, 777, 1199, *turns, *(600 + turns)} <= set(path.rows.tolist())
    # Nothing is drawn across the end of a record.
    lengths = np.where(records == 0, 1.0, 2.0)
    np.testing.assert_array_equal(path.everywhere(lengths[path.rows]), lengths)


def test_steps_of_the_pressure_stay_steps():
    time = np.linspace(0.0, 50.0, 500)
    pressure = np.repeat([1e5, 3e5, 5e5, 3e5, 1e5], 100)
    length = 0.3 - 1e-7 * pressure
    path = path_of(rows_of(time, pressure, length))
    np.testing.assert_allclose(path.everywhere(pressure[path.rows]), pressure, atol=1e-6)
    assert len(path.rows) < 100


def test_short_and_timeless_records_are_followed_row_by_row():
    time, pressure, length = cycles(150)
    assert len(path_of(rows_of(time, pressure, length)).rows) == 150


def test_a_load_that_changes_is_followed_and_a_constant_length_is_no_matter():
    time = np.linspace(0.0, 50.0, 500)
    task = rows_of(time, np.full(500, 3e5), np.full(500, 0.28))
    task.state["load"][:] = np.repeat([50.0, 80.0, 60.0, 90.0, 70.0], 100)
    path = path_of(task)
    np.testing.assert_allclose(path.everywhere(task.state["load"][path.rows]), task.state["load"], atol=1e-9)
    assert len(path.rows) < 100
