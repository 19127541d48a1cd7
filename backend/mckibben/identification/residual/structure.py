"""Structure that no catalogued effect explains: its share of the residual and its variables.

The share comes from a regression without any physics, cross-validated over blocks of rows. Correlated noise
is predicted from rows beside the block, like an effect; from other curves it is not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

_MOST_ROWS = 2000  # for the regression; more are thinned
_BLOCK = 12  # rows that are left out together
_FOLDS = 5
_TREES = 60
_SEED = 0

_LEAST_ROWS = 4  # of a leaf
_DEEPEST = 40  # levels; a node that still splits is a leaf


@dataclass(frozen=True)
class ResidualStructure:
    """The part of a residual that a regression without physics predicts.

    Attributes:
        share: of the mean square, cross-validated.
        variables: the important ones, the most important first, each with the share that is lost when the
            variable is shuffled.
    """

    share: float
    variables: tuple[tuple[str, float], ...]


def structure(
    residual: np.ndarray, variables: Mapping[str, np.ndarray], *, left_out: np.ndarray | None = None
) -> ResidualStructure:
    """The part of a residual that a regression without physics predicts, and from which variables.

    Args:
        residual: shape (rows,).
        variables: that it may depend on, name -> shape (rows,).
        left_out: label of each row, those of a label are predicted from the others; by default short blocks.
    """
    names = [name for name in variables if name != "group"]
    if not names or len(residual) < 40 or not np.any(residual):
        return ResidualStructure(0.0, ())
    rows = np.arange(len(residual))
    if len(rows) > _MOST_ROWS:
        rows = np.unique(np.linspace(0, len(rows) - 1, _MOST_ROWS).astype(int))
    table = np.column_stack([variables[name][rows] for name in names])
    target = residual[rows]
    random = np.random.default_rng(_SEED)
    if left_out is None:
        blocks = np.arange(len(rows)) // min(_BLOCK, max(2, len(rows) // (4 * _FOLDS)))
        fold = random.integers(0, _FOLDS, blocks[-1] + 1)[blocks]
    else:
        fold = left_out[rows]
    left, shuffled = np.zeros(len(rows)), np.zeros((len(names), len(rows)))
    for label in np.unique(fold):
        out = fold == label
        if np.all(out):
            left[out], shuffled[:, out] = target[out], target[out]
            continue
        forest = Forest(table[~out], target[~out], trees=_TREES, random=random)
        inputs = np.tile(
            table[out], (len(names) + 1, 1, 1)
        )  # copy i has variable i shuffled, the last copy none
        for column in range(len(names)):
            inputs[column, :, column] = random.permutation(inputs[column, :, column])
        predicted = forest.predict(inputs.reshape(-1, len(names))).reshape(len(names) + 1, -1)
        shuffled[:, out], left[out] = target[out] - predicted[:-1], target[out] - predicted[-1]
    whole = float(np.mean(target**2))
    share = max(0.0, 1.0 - float(np.mean(left**2)) / whole)
    lost = (np.mean(shuffled**2, axis=1) - np.mean(left**2)) / whole
    order = np.argsort(lost)[::-1]
    return ResidualStructure(share, tuple((names[i], float(lost[i])) for i in order if lost[i] > 0.02))


class _Level(NamedTuple):
    """The nodes of one depth: split variable (-1: a leaf), threshold, first child, value."""

    variable: np.ndarray
    threshold: np.ndarray
    child: np.ndarray
    value: np.ndarray


class Forest:
    """Extremely randomised trees fitted to a table, all grown level by level at once.

    Each node draws one threshold per variable, uniform between its least and largest value, and takes the
    split that lowers the sum of squares most (Geurts, Ernst & Wehenkel, Machine Learning 63 (2006) 3).

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
