"""Rows beyond a reversal that happened between two rows have come a longer way than the rows show."""

from __future__ import annotations

import numpy as np

from mckibben.identification.predict.comparable_rows import _between_rows, _unresolved

NONE = np.zeros(12, int)


def hidden(moved: list[float], records: np.ndarray = NONE) -> list[int]:
    """Numbers of the rows that are not scored."""
    return list(np.flatnonzero(_between_rows(np.array(moved), records[: len(moved)])))


def test_the_row_after_a_short_step_is_beyond_the_reversal() -> None:
    # 2 mm a row down to a tip at -0.9 mm, which no row shows: the next row is 0.2 mm further up.
    assert hidden([8.0, 6.0, 4.0, 2.0, 0.0, 0.2, 2.2, 4.2, 6.2, 8.2]) == [5]


def test_the_extreme_row_after_a_short_step_is_beyond_the_reversal_itself() -> None:
    assert hidden([8.2, 6.2, 4.2, 2.2, 0.2, 0.0, 2.0, 4.0, 6.0, 8.0]) == [5]


def test_a_tip_at_a_row_hides_nothing() -> None:
    assert hidden([8.0, 6.0, 4.0, 2.0, 0.0, 2.0, 4.0, 6.0, 8.0]) == []


def test_noise_at_rest_is_no_reversal() -> None:
    assert hidden([8.0, 6.0, 4.0, 2.0, 0.0, 0.01, -0.01, 0.02, 0.0, 0.01]) == []


def test_a_new_record_is_no_reversal() -> None:
    records = np.array([0, 0, 0, 0, 0, 1, 1, 1, 1, 1])
    assert hidden([8.0, 6.0, 4.0, 2.0, 0.0, 0.2, 2.2, 4.2, 6.2, 8.2], records) == []


def unresolved(moved: np.ndarray) -> list[int]:
    return list(np.flatnonzero(_unresolved(moved, np.zeros(len(moved), int))))


def test_rows_that_have_hardly_left_a_coarse_reversal_are_not_scored() -> None:
    # A smooth path of 40 mm with 2 mm a row at most: two rows within 0.3 mm of the tip at row 20.
    path = 20.0 * np.cos(np.pi * np.arange(41) / 20.0 * 0.97)
    tip = int(np.argmin(path))
    assert unresolved(path) == [tip, tip + 1] or unresolved(path) == [tip]
    assert abs(path[tip + 2] - path[tip]) > 0.15 * float(np.percentile(np.abs(np.diff(path)), 75.0))


def test_rows_that_follow_each_other_closely_show_the_course_of_a_reversal() -> None:
    fine = 20.0 * np.cos(np.linspace(0.0, 2.0 * np.pi, 2001))
    assert unresolved(fine) == []


def test_a_rest_at_the_end_of_a_motion_is_scored() -> None:
    way = np.concatenate([np.arange(0.0, 20.0, 2.0), np.full(8, 20.0), np.arange(18.0, -1.0, -2.0)])
    assert unresolved(way) == []


def test_a_corner_that_a_row_shows_costs_this_row_alone() -> None:
    assert unresolved(np.array([0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 8.0, 6.0, 4.0, 2.0])) == [5]


def test_noise_at_rest_has_no_reversal() -> None:
    still = 10.0 + 0.01 * np.random.default_rng(0).normal(size=60)
    moving = np.concatenate([np.arange(0.0, 10.0, 0.5), still])
    assert unresolved(moving) == []
