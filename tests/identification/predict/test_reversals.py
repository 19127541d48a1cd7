"""Rows beyond a reversal that happened between two rows have come a longer way than the rows show."""

from __future__ import annotations

import numpy as np

from mckibben.identification.predict.comparable_rows import _between_rows

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
