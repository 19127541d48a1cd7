"""Whether a series scatters as the readings of a sensor do, and as no set point does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_FEWEST = 200  # rows
_ROOT_70 = float(np.sqrt(70.0))  # of the fourth differences of independent readings, over their own scatter
_MEDIAN = 0.6745  # median magnitude of normal scatter over its standard deviation
_SWINGS = 0.6  # share of sign changes of fourth differences; 0.8 of independent readings, 0 of a smooth line
_LEAST, _MOST = 2e-4, 0.01  # of the largest value; less may be rounding, more may be set at random
_STEPS = 3.0  # steps of the numbers; scatter below it may be their rounding
_REPEATED = 0.1  # share of rows that repeat the one before, as a set point does between two settings
_EVEN = 0.7  # scatter of the flattest quarter over that of the steepest; an unsteady clock scatters slopes
_CURVED = 0.5  # slope of the flattest quarter over that of the steepest; of one slope nothing is told
_FOLLOWS = 0.25  # share of swings in step with another column above that by chance
_LAGS = 3  # rows
_JUMP, _SETTLED = 20.0, 4.0  # scatters; what jumps so far in one row and rests before and after was set


def is_sensed(values: Floats, others: Sequence[Floats]) -> bool:
    """Whether readings scatter, from row to row and everywhere alike, as a sensor does.

    A set point may be a step, a ramp or a sine, coarse, rounded, held for some rows, or sampled by an
    unsteady clock; computed from another reading, it scatters with that. Fourth differences leave of all slow
    motions only what changes from row to row: it has to be there in flat parts as in steep ones, has to
    exceed the step of the numbers, and must not follow another column. A series that jumps from rest to rest
    in one row is a command, also where a converter has read it.

    Args:
        values: the series, row by row.
        others: other columns of the same rows, from which it could be computed.
    """
    largest = float(np.max(np.abs(values), initial=0.0))
    if len(values) < _FEWEST or not np.isfinite(values).all() or largest == 0.0:
        return False
    rough = _rough(values)
    scatter = _scatter(rough)
    if not _LEAST * largest <= scatter <= _MOST * largest or scatter < _STEPS * _step(values):
        return False
    if float(np.mean(np.diff(values) == 0.0)) > _REPEATED:
        return False
    swings = np.sign(rough)
    if float(np.mean(swings[1:] * swings[:-1] < 0.0)) < _SWINGS:
        return False
    return (
        _is_even(values, rough)
        and not _jumps(values, scatter)
        and not any(_follows(swings, other) for other in others)
    )


def _rough(values: Floats) -> Floats:
    """What changes from row to row, of independent readings with their own scatter."""
    return np.diff(values, 4) / _ROOT_70


def _scatter(rough: Floats) -> float:
    return float(np.median(np.abs(rough))) / _MEDIAN


def _step(values: Floats) -> float:
    """The step of the numbers, in the half of their range where it is the coarser one."""
    middle = 0.5 * (float(np.min(values)) + float(np.max(values)))
    halves = (np.unique(values[values <= middle]), np.unique(values[values > middle]))
    return max((float(np.min(np.diff(half))) for half in halves if len(half) > 1), default=0.0)


def _is_even(values: Floats, rough: Floats) -> bool:
    """Whether the flattest rows scatter as the steepest do."""
    slope = np.abs(values[4:] - values[:-4])
    low, high = np.quantile(slope, (0.25, 0.75))
    flat, steep = slope <= low, slope >= high
    if float(np.median(slope[flat])) > _CURVED * float(np.median(slope[steep])):
        return False
    return _scatter(rough[flat]) >= _EVEN * _scatter(rough[steep])


def _jumps(values: Floats, scatter: float) -> bool:
    """Whether the series goes from rest to rest within one row."""
    far = np.flatnonzero(np.abs(np.diff(values)) > _JUMP * scatter)
    for row in far.tolist():
        before, after = values[max(0, row - 3) : row + 1], values[row + 1 : row + 5]
        if min(len(before), len(after)) > 1 and max(np.ptp(before), np.ptp(after)) < _SETTLED * scatter:
            return True
    return False


def _follows(swings: Floats, other: Floats) -> bool:
    """Whether the swings are those of another column, then or some rows before."""
    if len(other) < len(swings) or not np.isfinite(other).all() or np.ptp(other) == 0.0:
        return False
    theirs = np.sign(_rough(other))
    return any(
        abs(float(np.mean(swings[lag:] * theirs[: len(theirs) - lag]))) > _FOLLOWS for lag in range(_LAGS)
    )
