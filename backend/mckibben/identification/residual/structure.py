"""Structure that no catalogued effect explains: its share of the residual and its variables.

The share comes from a regression without any physics, cross-validated over blocks of rows. Correlated noise
is predicted from rows beside the block, like an effect; from other curves it is not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mckibben.identification.residual.forest import Forest

_MOST_ROWS = 2000  # for the regression; more are thinned
_BLOCK = 12  # rows that are left out together
_FOLDS = 5
_TREES = 60
_SEED = 0


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
