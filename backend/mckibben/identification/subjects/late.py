r"""What a slow or late force channel shows of a signal: the effects' own equations as a linear filter.

A lag obeys :math:`\dot y = (r - y)/\tau`, at rest before the first row of each record. For a signal in lines
between rows the solution is

.. math:: y_{k+1} = a\,y_k + r_{k+1} - a\,r_k - s\tau\,(1 - a), \quad a = e^{-\Delta t/\tau}

with the slope s of the line. A skew shifts the signal in time. Both are linear, so derivatives by a model's
numbers pass through the same filter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.identification.setting import Setting
from mckibben.physics.effect import Effect

_SLOTS = ("skew", "force_reading", "pressure_reading", "stroke_reading")
_LAG = "drive_rates"


def late(effect: Effect) -> bool:
    """Whether an effect delays what is read, so that rows depend on the rows before them."""
    return any(slot in effect.slots for slot in _SLOTS)


def as_read(
    setting: Setting, *, time: np.ndarray, records: Sequence[np.ndarray], values: np.ndarray
) -> np.ndarray:
    """What the force channel shows of values, shape (rows,) or (rows, columns), record by record.

    Args:
        setting: the late effects of this model are applied.
        time: of each row [s], ascending within a record.
        records: rows of each record.
        values: what an ideal channel would show.
    """
    read = values.astype(float).copy()
    for effect in setting.effects:
        if not late(effect):
            continue
        own = setting.values[effect.id]
        rate = _rate(effect, own)
        delay = float(effect.call("skew", {}, own)) if "skew" in effect.slots else 0.0
        for rows in records:
            clock = time[rows]
            if rate > 0.0:
                read[rows] = _lagged(clock, read[rows], 1.0 / rate)
            if delay:
                read[rows] = _shifted(clock, read[rows], delay)
    return read


def _rate(effect: Effect, values: Mapping[str, float]) -> float:
    """1/tau of the force channel [1/s], 0 without a lag: how fast its state follows a signal of one."""
    if _LAG not in effect.slots:
        return 0.0
    signals = {f"instant_{name}_reading": 0.0 for name in ("force", "pressure", "stroke")}
    at_rest = {state.name: 0.0 for state in effect.states}
    rates = effect.call(_LAG, signals | {"instant_force_reading": 1.0} | at_rest, values)
    return float(sum(rates))


def _lagged(time: np.ndarray, signal: np.ndarray, constant: float) -> np.ndarray:
    from scipy.linalg import solve_banded

    if len(time) < 2:
        return signal
    step = np.diff(time).reshape(-1, *([1] * (signal.ndim - 1)))
    kept = np.exp(-step / constant)
    slope = np.diff(signal, axis=0) / step
    right = signal.copy()
    right[1:] = signal[1:] - kept * signal[:-1] - slope * constant * (1.0 - kept)
    bands = np.ones((2, len(time)))
    bands[1, :-1] = -kept.ravel()
    return solve_banded((1, 0), bands, right, check_finite=False)  # a guess may have no value


def _shifted(time: np.ndarray, signal: np.ndarray, delay: float) -> np.ndarray:
    if signal.ndim == 1:
        return np.interp(time - delay, time, signal)
    return np.column_stack([np.interp(time - delay, time, column) for column in signal.T])
