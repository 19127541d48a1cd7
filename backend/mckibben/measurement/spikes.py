"""Detection of spikes: a bad contact, a lost bit, a knock against the rig.

They would distort a least-squares fit: a row with an error of a hundred times the noise weighs as much as ten
thousand others.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import noise_of
from mckibben.measurement.kind import STROKES

_SENSORS = ("pressure", "force", *STROKES, "diameter")
_LONGEST = 2  # rows of a spike
_NOISE = 12.0  # least height over the noise
_STEPS = 6.0  # least height over the usual step from row to row
_USUAL = 0.95  # quantile of the steps that counts as the usual step
_BACK = 0.3  # largest difference of both neighbours over the height
#: Height over the least one, and the largest share of rows with such spikes; more frequent jumps belong to
#: the signal, unless they are so high that nothing in a signal is.
_RATES = ((1.0, 0.01), (3.0, 0.03))
_BOTH_SIDES, _AMONG = 0.04, 0.2  # share of rows allowed where at least this share leaps to either side
_FEWEST = 20  # rows of a signal that is checked
_AT_ONCE = 1_000_000  # rows processed together, which bounds the memory


def spiked_rows(columns: Mapping[str, NDArray]) -> dict[str, NDArray[np.bool_]]:
    """Reason -> bool array, shape (rows,), of the rows with spikes; rows must be in the order of measurement.

    A spike is one row or two that differ from both neighbours to the same side by far more than the noise and
    the usual step between rows, while both neighbours have nearly the same value.
    """
    spikes = {}
    for name in _SENSORS:
        if name in columns and len(columns[name]) >= _FEWEST:
            values = np.asarray(columns[name], dtype=float)
            for clear, most in _RATES:
                spiked = _spikes(values, clear)
                allowed = max(most, _BOTH_SIDES) if _to_both_sides(values, spiked) else most
                if 0 < np.count_nonzero(spiked) <= max(3, allowed * len(spiked)):
                    spikes[f"spikes of the {name}"] = spiked
                    break
    return spikes


def _to_both_sides(values: NDArray[np.float64], spiked: NDArray[np.bool_]) -> bool:
    """Whether spikes leap up and down, as a bad contact does; features of a signal leap to one side."""
    rows = np.flatnonzero(spiked)
    rows = rows[(rows > 0) & (rows < len(values) - 1)]
    up = np.count_nonzero(values[rows] > 0.5 * (values[rows - 1] + values[rows + 1]))
    return bool(min(up, len(rows) - up) >= max(1.0, _AMONG * len(rows)))


def _spikes(values: NDArray[np.float64], clear: float) -> NDArray[np.bool_]:
    """Mask of the rows with spikes that are higher than the least height by a factor."""
    # The steps of spikes themselves are not usual ones.
    noise = _NOISE * noise_of(values)
    steps = np.abs(np.diff(values))
    leaping = _leaping(values, noise)
    usual = steps[~(leaping[1:] | leaping[:-1])]
    least = clear * max(noise, _STEPS * float(np.quantile(usual if len(usual) else steps, _USUAL)))
    return _leaping(values, least)


def _leaping(values: NDArray[np.float64], least: float) -> NDArray[np.bool_]:
    """Mask of one row or two that leap away and come back."""
    leaping = np.zeros(len(values), bool)
    for rows in range(1, _LONGEST + 1):
        for begin in range(0, len(values), _AT_ONCE):
            at = begin + _leaps(values[begin : begin + _AT_ONCE + rows + 1], rows, least)
            for k in range(1, rows + 1):
                leaping[at + k] = True
    return leaping


def _leaps(values: NDArray[np.float64], rows: int, least: float) -> NDArray[np.intp]:
    """Rows behind which so many rows leap away and come back."""
    before, after = values[: -rows - 1], values[rows + 1 :]
    inside = np.stack([values[k : len(values) - rows - 1 + k] for k in range(1, rows + 1)])
    away = np.minimum(inside - before, inside - after).min(axis=0)
    below = np.minimum(before - inside, after - inside).min(axis=0)
    leap = np.maximum(away, below)
    return np.flatnonzero((leap > least) & (leap > 0.0) & (np.abs(after - before) < _BACK * leap))
