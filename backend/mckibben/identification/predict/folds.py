"""What is left out together: whole pressures, lengths, sweeps or cycles, or contiguous blocks; never rows."""

from __future__ import annotations

import numpy as np

FEWEST, MOST = 6, 12
_RANGES = 6


def folds_of(groups: np.ndarray) -> np.ndarray:
    """Label of the fold of each row, shape (rows,).

    Groups are the folds. More than 12 are dealt out to 12 folds in turn, so that a fold never holds one end
    of the range only; of fewer than 6 each is cut into as many contiguous blocks as it takes to have 6.
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
    """Label of the range of a quantity that each row falls into: its levels, or six ranges of equal width."""
    low, span = float(np.min(values)), float(np.ptp(values))
    if not span > 0.0:
        return np.zeros(len(values), dtype=np.int64)
    levels, level = np.unique(np.round((values - low) / span, 3), return_inverse=True)
    if len(levels) <= MOST:
        return level
    return np.minimum((values - low) / span * _RANGES, _RANGES - 1).astype(np.int64)


def sweeps_of(
    groups: np.ndarray, records: np.ndarray, length: np.ndarray | None, pressure: np.ndarray, *, timed: bool
) -> list[np.ndarray]:
    """Indices of the rows of each sweep, in order: along which a residual changes smoothly.

    With time the rows of a group in a record, in order. A map without time has none; there the lines of equal
    length over pressure are taken, or the groups, whichever are longer.
    """
    if timed:
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
