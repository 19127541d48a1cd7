"""Folds of cross-validation: whole pressures, lengths, sweeps, cycles or blocks, never single rows."""

from __future__ import annotations

import numpy as np

FEWEST, MOST = 6, 12  # folds
_RANGES = 6  # of a swept quantity


def folds_of(groups: np.ndarray) -> np.ndarray:
    """Label of the fold of each row, shape (rows,).

    The groups are the folds. More than 12 groups are distributed in turn over 12 folds, so that no fold holds
    only one end of the range. Fewer than 6 groups are split into contiguous blocks, at least 6 in total.
    """
    labels, group = np.unique(groups, return_inverse=True)
    if len(labels) > MOST:
        return group % MOST
    if len(labels) >= FEWEST:
        return group
    blocks = -(-FEWEST // len(labels))
    folds = np.zeros(len(groups), dtype=np.int64)
    for number in range(len(labels)):
        rows = np.flatnonzero(group == number)
        folds[rows] = number * blocks + np.arange(len(rows)) * blocks // max(len(rows), 1)
    return folds


def ranges_of(values: np.ndarray) -> np.ndarray:
    """Label of each row by the level of a quantity, or by one of six ranges of equal width."""
    low, span = float(np.min(values)), float(np.ptp(values))
    if not span > 0.0:
        return np.zeros(len(values), dtype=np.int64)
    levels, level = np.unique(np.round((values - low) / span, 3), return_inverse=True)
    if len(levels) <= MOST:
        return level
    return np.minimum((values - low) / span * _RANGES, _RANGES - 1).astype(np.int64)


def sweeps_of(
    groups: np.ndarray, records: np.ndarray, length: np.ndarray | None, pressure: np.ndarray, *, ordered: bool
) -> list[np.ndarray]:
    """Indices of the rows of each sweep, in order. Along a sweep a residual changes smoothly.

    Where the rows are in the order of the test, a sweep is the rows of a group in a record. A map has lines
    of equal length over pressure or the groups as sweeps, whichever are longer.
    """
    if ordered:
        return _split(np.arange(len(groups)), groups, records)
    by_group = _split(np.arange(len(groups)), groups, records)
    if length is None:
        return by_group
    level = np.round(length, 6)
    lines = [np.flatnonzero(level == value) for value in np.unique(level)]
    if len(lines) >= len(by_group):
        return by_group
    return [rows[np.argsort(pressure[rows], kind="stable")] for rows in lines]


def _split(rows: np.ndarray, groups: np.ndarray, records: np.ndarray) -> list[np.ndarray]:
    new = (np.diff(groups) != 0) | (np.diff(records) != 0)
    return np.split(rows, np.flatnonzero(new) + 1)
