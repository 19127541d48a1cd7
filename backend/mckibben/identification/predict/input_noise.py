r"""A predicted reading without the noise that it has from its inputs.

The noise of a pressure or a length that was read is none of the muscle's force, so no filter of the force
channel averages it. What passes through such a filter is the part of the prediction that is smooth in time:
each row is averaged with the points at its time of the lines between the rows beside it, m before and m after
it, from the nearest outwards until a point is farther away than noise explains. Lines and steps stay as they
are; a prediction without noise stays as it is everywhere.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.measurement.noise import CHI2_MEDIAN

_REACH = 8  # rows to either side
_FARTHEST = 4.0  # deviations of a point that noise explains
_TOLD = 2e-4  # of the range of the pressure; noise that is worth a word
_ANSWERS = 0.3  # correlation from which a length answers to a pressure
_FEWEST = 12  # rows of a record; fewer are left as they are
# Of white noise, what an average over the whole reach leaves: its row, and 8 middles with half the variance.
_LEFT = np.sqrt(1.0 + 0.5 * _REACH) / (1.0 + _REACH)
# Of white noise, the variance of d_k - (d_(k-1) + d_(k+1))/2 with d_k = r_k - (r_(k-1) + r_(k+1))/2.
_OF_DIFFERENCES = 4.375


def without_input_noise(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The smooth part of predicted values, shape (rows,) or (rows, columns).

    Args:
        time: of each row [s], ascending.
        values: the prediction; further columns are derivatives, which are averaged over the same rows.
    """
    signal = values if values.ndim == 1 else values[:, 0]
    if len(signal) < _FEWEST or not np.all(np.isfinite(signal)):
        return values
    limit = _FARTHEST * _noise(time, signal)
    total, count = values.astype(float).copy(), np.ones(len(signal))
    going = np.ones(len(signal), bool)
    for reach in range(1, min(_REACH, (len(signal) - 1) // 2) + 1):
        inner = slice(reach, len(signal) - reach)
        going[:reach] = going[len(signal) - reach :] = False
        # The deviation of the row and of the point: 1 + w^2 + (1 - w)^2 = 3/2 in the middle.
        near = np.abs(_between(time, signal, reach) - signal[inner]) <= limit * np.sqrt(1.5)
        going[inner] &= near
        taken = going[inner]
        total[inner] += np.where(_like(taken, values), _between(time, values, reach), 0.0)
        count[inner] += taken
    return total / _like(count, values)


def with_smooth_pressure(task: ComparableRows) -> tuple[ComparableRows, float]:
    """The rows with the smooth part of their pressure: the muscle has not felt the noise of its sensor.

    Where the length answers to what would be taken away it was pressure, as steps by hand are, and stays.

    Returns:
        the rows, and the noise of their lengths [m] by what is left of that of the pressure, which neighbours
        share.
    """
    if task.time is None:
        return task, 0.0
    pressure, left = np.array(task.state["pressure"]), []
    for label in np.unique(task.records):
        rows = np.flatnonzero(task.records == label)
        smooth = without_input_noise(task.time[rows], pressure[rows])
        if _felt(
            pressure[rows] - smooth,
            task.measured[rows] - without_input_noise(task.time[rows], task.measured[rows]),
        ):
            continue
        if len(rows) >= _FEWEST:
            change = float(np.std(task.measured[rows])) / max(float(np.std(smooth)), 1e-300)
            left.append(_LEFT * change * _noise(task.time[rows], pressure[rows]))
        pressure[rows] = smooth
    taken = float(np.sqrt(np.mean((pressure - task.state["pressure"]) ** 2)))
    messages = task.messages
    if taken > _TOLD * float(np.ptp(pressure)):
        averaged = (
            f"noise of the pressure readings, {taken / 100.0:.2g} mbar, was averaged to predict lengths"
        )
        messages = (*messages, averaged)
    smooth_rows = replace(task, state={**task.state, "pressure": pressure}, messages=messages)
    return smooth_rows, max(left, default=0.0)


def _felt(pressure: np.ndarray, length: np.ndarray) -> bool:
    """Whether what is rough in the length follows what is rough in the pressure."""
    size = float(np.linalg.norm(pressure) * np.linalg.norm(length))
    return abs(float(pressure @ length)) > max(_ANSWERS, 3.0 / np.sqrt(len(pressure))) * size > 0.0


def _between(time: np.ndarray, values: np.ndarray, reach: int) -> np.ndarray:
    """At each row, the line between those that many rows before and after it."""
    before, here, after = time[: -2 * reach], time[reach:-reach], time[2 * reach :]
    share = _like((here - before) / np.maximum(after - before, 1e-300), values)
    return (1.0 - share) * values[: -2 * reach] + share * values[2 * reach :]


def _noise(time: np.ndarray, signal: np.ndarray) -> float:
    beside = signal[1:-1] - _between(time, signal, 1)
    differences = beside[1:-1] - 0.5 * (beside[:-2] + beside[2:])
    return float(np.sqrt(np.median(differences**2) / CHI2_MEDIAN / _OF_DIFFERENCES))


def _like(rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    return rows.reshape(-1, *([1] * (values.ndim - 1)))
