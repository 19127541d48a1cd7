r"""Reading of a slow or delayed force channel: the equations of its effects as a linear filter.

A lag obeys :math:`\dot y = (r - y)/\tau`, at rest before the first row of each record. For a signal that is
linear between rows the solution is

.. math:: y_{k+1} = a\,y_k + r_{k+1} - a\,r_k - s\tau\,(1 - a), \quad a = e^{-\Delta t/\tau}

with the slope s of the line. Stages in series are a sum of such lags, by partial fractions:

.. math:: \prod_i \frac{1}{1+\tau_i p} = \sum_i \frac{1}{1+\tau_i p}\prod_{j\ne i}\frac{\tau_i}{\tau_i-\tau_j}

What a prediction has from the noise of its inputs passes neither
(`mckibben.identification.predict.input_noise`). A skew shifts the signal in time. Lag and skew are linear, so
derivatives by a model's parameters pass through the same filter. A corner between two rows of the file is one
of the rows here (`mckibben.identification.predict.quasistatic`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.input_noise import without_input_noise
from mckibben.physics.effect import Effect

_SLOTS = ("skew", "force_reading", "pressure_reading", "stroke_reading")
_LAG = "drive_rates"
_APART = 1e-6  # relative distance of equal time constants: partial fractions need different ones


def late(effect: Effect) -> bool:
    """Whether an effect delays a reading, so that rows depend on the rows before them."""
    return any(slot in effect.slots for slot in _SLOTS)


def as_read(
    fit_model: FitModel, *, time: np.ndarray, records: Sequence[np.ndarray], values: np.ndarray
) -> np.ndarray:
    """Readings of the force channel, shape (rows,) or (rows, columns), record by record.

    Args:
        fit_model: the model whose delaying effects are applied.
        time: of each row [s], ascending within a record.
        records: rows of each record.
        values: readings of an ideal channel, of the same shape.
    """
    values = values.astype(float)
    read = values.copy()
    for rows in records:
        read[rows] = without_input_noise(time[rows], values[rows])
    noise = values - read
    for effect in fit_model.effects:
        if not late(effect):
            continue
        values_of_effect = fit_model.values[effect.id]
        constants = _constants(effect, values_of_effect)
        delay = float(effect.call("skew", {}, values_of_effect)) if "skew" in effect.slots else 0.0
        for rows in records:
            clock = time[rows]
            if constants:
                read[rows] = _filtered(clock, read[rows], constants)
            if delay:
                read[rows] = _shifted(clock, read[rows], delay)
    return read + noise


def _constants(effect: Effect, values: Mapping[str, float]) -> list[float]:
    """Time constants of the stages that the force passes through [s], from the rates of their states."""
    if _LAG not in effect.slots:
        return []
    signals = {f"instant_{name}_reading": 0.0 for name in ("force", "pressure", "stroke")}
    names = [state.name for state in effect.states]

    def rates(**raised: float) -> np.ndarray:
        inputs = signals | dict.fromkeys(names, 0.0) | raised
        return np.array(effect.call(_LAG, inputs, values), dtype=float)

    reached = rates(instant_force_reading=1.0) > 0.0
    constants = {}
    while np.any(reached):
        stage = int(np.argmax(reached))
        response = rates(**{names[stage]: 1.0})
        constants[stage] = -1.0 / float(response[stage])
        reached = response > 0.0
    return list(constants.values())


def _filtered(time: np.ndarray, signal: np.ndarray, constants: Sequence[float]) -> np.ndarray:
    """The signal after all stages; equal time constants are shifted by a negligible amount."""
    apart = [constant * (1.0 + _APART * number) for number, constant in enumerate(constants)]
    weights = [np.prod([tau / (tau - other) for other in apart if other != tau]) for tau in apart]
    reading = np.zeros_like(signal)
    for weight, tau in zip(weights, apart, strict=True):
        reading += weight * _lagged(time, signal, tau)
    return reading


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
    return solve_banded((1, 0), bands, right, check_finite=False)  # a trial model may give NaN


def _shifted(time: np.ndarray, signal: np.ndarray, delay: float) -> np.ndarray:
    if signal.ndim == 1:
        return np.interp(time - delay, time, signal)
    return np.column_stack([np.interp(time - delay, time, column) for column in signal.T])
