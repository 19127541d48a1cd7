"""Noise of a smooth signal, from its differences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

SHORTEST_SWEEP = 8  # rows; fewer leave too few differences

CHI2_MEDIAN = 0.4549364231195724  # median of chi squared with one degree of freedom

_TRIMMED = 0.9  # share of the smallest squares that is averaged where the median is an exact zero


def noise_floor(values: np.ndarray, sweeps: Sequence[np.ndarray]) -> float | None:
    r"""Standard deviation of the noise, from third differences inside each sweep.

    The third difference of white noise has the variance :math:`20\sigma^2`; that of a smooth signal is small.
    The median of its square is robust against a few steps of the signal. If more than half of the differences
    are exactly zero (coarse resolution), the mean of the smaller nine tenths is used.

    Args:
        values: a residual or a smooth signal.
        sweeps: indices of the rows of each sweep, in order.

    Returns:
        None when no sweep has eight rows.
    """
    third = [np.diff(values[rows], 3) for rows in sweeps if len(rows) >= SHORTEST_SWEEP]
    if not third:
        return None
    squares = np.concatenate(third) ** 2
    middle = float(np.median(squares)) / CHI2_MEDIAN
    if middle == 0.0:
        kept = np.sort(squares)[: max(1, int(_TRIMMED * len(squares)))]
        middle = float(np.mean(kept))
    return float(np.sqrt(middle / 20.0))
