r"""Corners of a way that lie between two rows: where it turned, or where a ramp met a hold.

Both sides of a corner are straight. Their lines meet between the rows k and k + 1 at

.. math:: t_c = t_k + \frac{y_{k+1} - y_k - v_r\,(t_{k+1} - t_k)}{v_l - v_r}

with the speeds :math:`v_l` before row k and :math:`v_r` behind row k + 1: subcell resolution (A. Harten,
J. Comput. Phys. 83 (1989) 148, doi 10.1016/0021-9991(89)90226-X). A late reading at row k + 1 is one of an
instant between the rows; a straight line from row to row would cut the corner off.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows

_SUDDEN = 4.0  # change of the speed at a corner over those before and behind it: both sides are straight
_CLEAR = 6.0  # distance of a corner from the line between its rows, over the noise of the way
_APPARENT = 0.05  # the same over the longer step beside it: less changes no reading
_EVEN = 1.5  # longest time step over the shortest one around a corner
_NOISE = 0.6745 * np.sqrt(20.0)  # median third difference of white noise of standard deviation 1
_SOON = 1e-6  # time from a corner to the way behind it, share of the time step


def with_corners(task: ComparableRows) -> ComparableRows:
    """The rows with two more at each corner of the way between two of them, which are not to be scored.

    The way is the pressure where the length is held, else the length. The first of the two rows moves as the
    row before the corner, the second one as that behind it. The same rows where the force is not predicted.
    """
    name = "pressure" if task.kind == "isometric" else "length"
    if task.time is None or task.channel != "force" or name not in task.state:
        return task
    row, after = _corners(task.time, task.state[name], task.records)
    if not len(row):
        return task
    step = task.time[row + 1] - task.time[row]
    share = after / step
    tip = _onward(task.time, task.state[name], row, after)

    def inserted(values: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
        return np.insert(values, np.repeat(row + 1, 2), np.stack([first, second], axis=1).ravel())

    def between(values: np.ndarray) -> np.ndarray:
        there = values[row] + share * (values[row + 1] - values[row])
        return inserted(values, there, there)

    def repeated(values: np.ndarray) -> np.ndarray:
        return inserted(values, values[row], values[row])

    state: Mapping[str, np.ndarray] = {
        **{one: between(values) for one, values in task.state.items()},
        **{
            one: inserted(task.state[one], task.state[one][row], task.state[one][row + 1])
            for one in ("velocity", "direction")
        },
        name: inserted(task.state[name], tip, tip),
    }
    at = task.time[row] + after
    unscored = np.ones(len(row), bool)
    by_rest_length = task.by_rest_length
    return replace(
        task,
        measured=between(task.measured),
        state=state,
        time=inserted(task.time, at, at + _SOON * step),
        records=repeated(task.records),
        groups=repeated(task.groups),
        turning=inserted(task.turning, unscored, unscored),
        rows=repeated(task.rows),
        by_rest_length=repeated(by_rest_length) if isinstance(by_rest_length, np.ndarray) else by_rest_length,
        corners=inserted(np.zeros(len(task.rows), bool), unscored, unscored),
        reversing=None,
    )


def _onward(time: np.ndarray, way: np.ndarray, row: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The way a time after a row, if it went on as it did before the row."""
    return way[row] + (way[row] - way[row - 1]) / (time[row] - time[row - 1]) * after


def _corners(time: np.ndarray, way: np.ndarray, records: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The row before each corner, and the time from it to the corner [s]."""
    if len(way) < 6:
        return np.empty(0, int), np.empty(0)
    row = np.arange(2, len(way) - 3)
    row = row[records[row - 2] == records[row + 3]]
    # Between records time may step back or stand still, and the speed need not change.
    with np.errstate(divide="ignore", invalid="ignore"):
        step = np.diff(time)
        speed = np.diff(way) / step
        left, right = speed[row - 1], speed[row + 1]
        after = (way[row + 1] - way[row] - right * step[row]) / (left - right)
    steps = np.stack([step[row + place] for place in range(-2, 3)])
    bent = np.maximum(np.abs(left - speed[row - 2]), np.abs(right - speed[row + 2]))
    found = np.max(steps, axis=0, initial=0.0) < _EVEN * np.min(steps, axis=0, initial=np.inf)
    found &= (np.abs(right - left) > _SUDDEN * bent) & (after > 0.0) & (after < (1.0 - _SOON) * step[row])
    row, after, left, right = row[found], after[found], left[found], right[found]
    off = np.abs(left - speed[row]) * after
    longer = step[row] * np.maximum(np.abs(left), np.abs(right))
    # Corners are few, and do not count in a median.
    noise = float(np.median(np.abs(np.diff(way, 3)))) / _NOISE
    clear = off > np.maximum(_CLEAR * noise, _APPARENT * longer)
    return row[clear], after[clear]
