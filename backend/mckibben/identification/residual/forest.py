"""Extremely randomised trees: a regression without a formula, all trees grown level by level at once.

Each node draws one threshold per variable, uniform between its least and largest value, and takes the split
that lowers the sum of squares most (Geurts, Ernst & Wehenkel, Machine Learning 63 (2006) 3).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

_LEAST_ROWS = 4  # of a leaf
_DEEPEST = 40  # levels; a node that still splits is a leaf


class _Level(NamedTuple):
    """The nodes of one depth: split variable (-1: a leaf), threshold, first child, value."""

    variable: np.ndarray
    threshold: np.ndarray
    child: np.ndarray
    value: np.ndarray


class Forest:
    """Trees fitted to a table.

    Args:
        table: shape (rows, variables), finite.
        target: shape (rows,).
        trees: how many; the prediction is their mean.
        random: draws the thresholds.
    """

    def __init__(
        self, table: np.ndarray, target: np.ndarray, *, trees: int, random: np.random.Generator
    ) -> None:
        self._trees = trees
        self._levels: list[_Level] = []
        row = np.tile(np.arange(len(table)), trees)  # the rows of one node after the other
        sizes = np.full(trees, len(table))
        for depth in range(_DEEPEST):
            if not len(sizes):
                break
            level, row, sizes = _grown(table, target, row, sizes, random, last=depth == _DEEPEST - 1)
            self._levels.append(level)

    def predict(self, table: np.ndarray) -> np.ndarray:
        """The mean of the trees, shape (rows,)."""
        rows = np.tile(np.arange(len(table)), self._trees)
        node = np.repeat(np.arange(self._trees), len(table))
        total = np.zeros(len(table))
        for level in self._levels:
            variable = level.variable[node]
            leaf = variable < 0
            total += np.bincount(rows[leaf], level.value[node[leaf]], len(table))
            rows, node, variable = rows[~leaf], node[~leaf], variable[~leaf]
            right = table[rows, variable] > level.threshold[node]
            node = level.child[node] + right
        return total / self._trees


def _grown(
    table: np.ndarray,
    target: np.ndarray,
    row: np.ndarray,
    sizes: np.ndarray,
    random: np.random.Generator,
    *,
    last: bool,
) -> tuple[_Level, np.ndarray, np.ndarray]:
    """One level, and the rows and sizes of the nodes of the next one."""
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    node = np.repeat(np.arange(len(sizes)), sizes)
    y = target[row]
    whole = np.add.reduceat(y, first)
    best, variable = np.full(len(sizes), -np.inf), np.full(len(sizes), -1)
    threshold = np.zeros(len(sizes))
    for column in range(0 if last else table.shape[1]):
        x = table[row, column]
        low, high = np.minimum.reduceat(x, first), np.maximum.reduceat(x, first)
        cut = low + random.random(len(sizes)) * (high - low)
        left = x <= cut[node]
        count, part = np.add.reduceat(left, first, dtype=int), np.add.reduceat(np.where(left, y, 0.0), first)
        others = sizes - count
        allowed = (count >= _LEAST_ROWS) & (others >= _LEAST_ROWS)
        with np.errstate(divide="ignore", invalid="ignore"):
            squares = part**2 / count + (whole - part) ** 2 / others
        taken = allowed & (squares > best)
        best[taken], variable[taken], threshold[taken] = squares[taken], column, cut[taken]
    splits = variable >= 0
    child = np.where(splits, 2 * (np.cumsum(splits) - 1), 0)
    going = splits[node]
    row, node = row[going], node[going]
    side = table[row, variable[node]] > threshold[node]
    place = child[node] + side
    order = np.argsort(place, kind="stable")
    level = _Level(variable, threshold, child, whole / sizes)
    return level, row[order], np.bincount(place, minlength=2 * int(np.count_nonzero(splits)))
