"""Measurements without what says nothing."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.settled import record_time, rounded, settled


def read(header: str, rows: list[str], kind: str) -> Measurement:
    return read_measurement("\n".join([f"# kind: {kind}", header, *rows]).encode(), "made.csv")


@pytest.mark.parametrize("origin", [0.0, 6.92, 1e6, 1.7e9])
def test_times_are_the_same_wherever_they_begin(origin):
    """Multiples of a millisecond, whose differences in binary differ in the last digits at each origin."""
    expected = np.cumsum([0.0, *[0.019, 0.018, 0.02] * 30]).round(3)
    np.testing.assert_array_equal(record_time(np.array([origin + each for each in expected])), expected)


def test_each_file_and_each_step_back_begins_at_zero():
    time = np.array([5.0, 6.0, 7.0, 2.0, 3.0, 9.0, 10.0])
    np.testing.assert_array_equal(record_time(time, (0, 5)), [0.0, 1.0, 2.0, 0.0, 1.0, 0.0, 1.0])


def test_times_without_a_step_stay():
    np.testing.assert_array_equal(record_time(np.array([3.0])), [0.0])
    np.testing.assert_array_equal(record_time(np.array([3.0, 3.0])), [0.0, 0.0])


def test_readings_are_the_same_in_every_unit():
    psi = 6894.757293168361
    readings = np.round(np.random.default_rng(1).uniform(0.0, 60.0, 500), 2)
    there = readings * psi
    back = np.array([float(repr(float(value / 1e5))) for value in there]) * 1e5
    assert np.any(there != back)
    np.testing.assert_array_equal(rounded(there), rounded(back))
    np.testing.assert_allclose(rounded(there), there, rtol=0.0, atol=1e-11 * np.max(there))


def test_values_beyond_every_sensor_stay():
    values = np.array([np.nan, np.inf, 1.5])
    np.testing.assert_array_equal(rounded(values), values)
    np.testing.assert_array_equal(rounded(np.zeros(3)), np.zeros(3))
    np.testing.assert_array_equal(rounded(np.array([1e-310, 2e-310])), [1e-310, 2e-310])


ROWS = [f"{n},{3 + 0.01 * n},{0.29 - 1e-4 * n},{500 + n}" for n in range(12)]
TIMED = "time_s,pressure_bar,length_m,force_N"


def test_a_row_that_is_there_twice_is_left_out_and_told():
    once = settled(read(TIMED, ROWS, "isobaric"))
    assert (once.repeated, once.message) == (0, "")
    found = settled(read(TIMED, [*ROWS[:5], ROWS[4], *ROWS[5:]], "isobaric"))
    assert found.repeated == 1
    assert "1 row repeats an earlier row" in found.message
    np.testing.assert_array_equal(found.rows, [0, 1, 2, 3, 4, *range(6, 13)])
    for name in ("time", "pressure", "length", "force"):
        np.testing.assert_array_equal(found.measurement.columns[name], once.measurement.columns[name])


def test_equal_readings_at_other_times_are_no_copies():
    held = [f"{n},3,0.28,500" if n else f"{n},3,0.29,520" for n in range(12)]
    assert settled(read(TIMED, held, "isobaric")).repeated == 0


def test_few_equal_rows_without_time_are_readings():
    rows = [f"{p},{x},{100 * p + x}" for p in (2, 3, 4) for x in range(260, 300, 4)]
    header = "pressure_bar,length_mm,force_N"
    assert settled(read(header, [*rows, rows[3]], "static")).repeated == 0
    assert settled(read(header, [*rows, *rows[:10]], "static")).repeated == 10


def test_the_rows_of_a_map_are_sorted_along_its_lines():
    rows = [f"{p},{x},{100 * p + x}" for p in (2, 3, 4) for x in range(260, 300, 4)]
    header = "pressure_bar,length_mm,force_N"
    order = np.random.default_rng(3).permutation(len(rows))
    plain = settled(read(header, rows, "static"))
    mixed = settled(read(header, [rows[n] for n in order], "static"))
    np.testing.assert_array_equal(plain.rows, np.arange(len(rows)))
    np.testing.assert_array_equal(order[mixed.rows], np.arange(len(rows)))
    np.testing.assert_array_equal(plain.measurement.columns["force"], mixed.measurement.columns["force"])


def test_where_the_order_is_that_of_the_test_only_a_row_after_its_like_is_a_copy():
    """Up and down again, the same pressures on both ways: a reading that comes back is none."""
    way = [*range(10), *range(9, -1, -1)]
    rows = [f"{1 + 0.5 * k},0.28,{300 + 50 * k}" for k in way]
    header = "pressure_bar,length_m,force_N"
    plain = read(header, rows, "isometric")
    assert plain.by_rows
    assert settled(plain).repeated == 0  # one equal pair, at the turn, may be two readings
    twice = settled(read(header, [row for row in rows for _ in range(2)], "isometric"))
    assert twice.repeated == 21
