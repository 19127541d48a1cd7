"""Responses of linear models to steps, which the tests compare with runs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from mckibben.simulation.command.pid import PidController
from mckibben.simulation.linear.loop import _closed
from mckibben.simulation.linear.model import LinearModel

Array = NDArray[np.float64]


def step_response(model: LinearModel, input_name: str, output_name: str, time: Array, size: float) -> Array:
    """Deviation of an output after a step of an input at t = 0.

    Args:
        model: the model; its dead time delays a command.
        input_name, output_name: the channel.
        time: [s], ascending and evenly spaced from 0.
        size: of the step, in the unit of the input.
    """
    a, b, c, d = model.channel(input_name, output_name)
    scales = model.scales[0]
    a, b, c = a * scales / scales[:, None], b / scales, c * scales
    delay = model.dead_time if input_name.endswith("command") else 0.0
    late = np.asarray(time, float) - delay
    block = np.zeros((len(a) + 1, len(a) + 1))
    block[:-1, :-1], block[:-1, -1] = a, b * size
    result = np.zeros(len(late))
    first = int(np.searchsorted(late, 0.0))
    if first == len(late):
        return result
    state = expm(block * late[first]) @ np.append(np.zeros(len(a)), 1.0)
    advance = expm(block * (late[1] - late[0])) if len(late) > 1 else np.eye(len(block))
    for index in range(first, len(late)):
        result[index] = c @ state[:-1] + d * size
        state = advance @ state
    return result


def closed_loop_step(model: LinearModel, controller: PidController, size: float, samples: int) -> Array:
    """Deviation of the position reading at each sample after a step of the reference [m]."""
    matrix, drive, reading = _closed(model, controller)
    state, result = np.zeros(len(matrix)), np.empty(samples)
    for index in range(samples):
        result[index] = reading @ state
        state = matrix @ state + drive * size
    return result
