"""What is left out together."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict.folds import FEWEST, MOST, folds_of, ranges_of, sweeps_of


def test_groups_are_the_folds():
    groups = np.repeat([5, 7, 1, 9, 30, 2, 4], 10)
    folds = folds_of(groups)
    assert len(np.unique(folds)) == 7
    for label in np.unique(groups):
        assert len(np.unique(folds[groups == label])) == 1


def test_many_groups_are_dealt_out_in_turn():
    """Forty levels to twelve folds: none holds one end of the range only."""
    groups = np.repeat(np.arange(40), 5)
    folds = folds_of(groups)
    assert len(np.unique(folds)) == MOST
    for label in np.unique(folds):
        inside = np.unique(groups[folds == label])
        assert np.max(inside) - np.min(inside) >= 24
    for label in range(40):
        assert len(np.unique(folds[groups == label])) == 1


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_few_groups_are_cut_into_contiguous_blocks(count):
    groups = np.repeat(np.arange(count), 60)
    folds = folds_of(groups)
    assert len(np.unique(folds)) >= FEWEST
    for label in np.unique(folds):
        rows = np.flatnonzero(folds == label)
        assert len(np.unique(groups[rows])) == 1
        assert np.all(np.diff(rows) == 1)
    sizes = np.unique(folds, return_counts=True)[1]
    assert np.ptp(sizes) <= 1


def test_fewer_rows_than_folds():
    assert len(np.unique(folds_of(np.zeros(3, int)))) == 3
    assert folds_of(np.zeros(1, int)).tolist() == [0]


def test_ranges_are_levels_or_six_of_equal_width():
    levels = np.tile([0.25, 0.27, 0.3], 20)
    assert ranges_of(levels).tolist() == np.tile([0, 1, 2], 20).tolist()
    even = np.linspace(10.0, 22.0, 601)
    found = ranges_of(even)
    assert np.unique(found).tolist() == [0, 1, 2, 3, 4, 5]
    assert found[[0, 99, 101, 499, 501, 600]].tolist() == [0, 0, 1, 4, 5, 5]
    assert ranges_of(np.full(5, 3.0)).tolist() == [0] * 5


def test_sweeps_over_time_are_runs_of_a_group_in_a_record():
    groups = np.array([0, 0, 0, 1, 1, 0, 0, 0])
    records = np.array([0, 0, 0, 0, 0, 0, 1, 1])
    found = sweeps_of(groups, records, None, np.arange(8.0), ordered=True)
    assert [rows.tolist() for rows in found] == [[0, 1, 2], [3, 4], [5], [6, 7]]


def test_sweeps_of_a_map_are_its_longest_lines():
    """Two lengths at five pressures: the lines of equal length, in the order of the pressure."""
    pressure = np.repeat([5e5, 1e5, 3e5, 2e5, 4e5], 2)
    length = np.tile([0.28, 0.3], 5)
    found = sweeps_of(np.repeat(np.arange(5), 2), np.zeros(10, int), length, pressure, ordered=False)
    assert [rows.tolist() for rows in found] == [[2, 6, 4, 8, 0], [3, 7, 5, 9, 1]]
    # Five lengths at two pressures: the groups of equal pressure are longer.
    found = sweeps_of(
        np.repeat([0, 1], 5), np.zeros(10, int), np.tile(np.linspace(0.26, 0.3, 5), 2),
        np.repeat([1e5, 2e5], 5), ordered=False,
    )  # fmt: skip
    assert [rows.tolist() for rows in found] == [[0, 1, 2, 3, 4], [5, 6, 7, 8, 9]]
