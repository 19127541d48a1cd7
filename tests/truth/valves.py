"""From the command to the opening, on the fine grid of a run: dead time, hysteresis, spool, overlap."""

from __future__ import annotations

import numpy as np
from numba import njit

from tests.truth.muscle import Array


def dead_time(time: Array, command: Array, opening: float, closing: float, slack: float) -> Array:
    """Rising edges late by ``opening``, falling by ``closing``; the coil charges within ``slack`` more."""
    step = time[1] - time[0]
    rising = np.interp(time - opening, time, command)
    falling = np.interp(time - closing, time, command)
    late = np.minimum(rising, falling) if opening > closing else np.maximum(rising, falling)
    width = max(int(slack / step), 1)
    return np.convolve(np.concatenate([np.full(width - 1, late[0]), late]), np.ones(width) / width, "valid")


@njit(cache=True)
def _relays(command: Array, up: Array, down: Array) -> Array:
    on = np.zeros(len(up))
    for k in range(len(up)):
        on[k] = 1.0 if command[0] > 0.5 * (up[k] + down[k]) else 0.0
    out = np.empty(len(command))
    for row in range(len(command)):
        total = 0.0
        for k in range(len(up)):
            if command[row] >= up[k]:
                on[k] = 1.0
            elif command[row] <= down[k]:
                on[k] = 0.0
            total += on[k]
        out[row] = total
    return out


def preisach(command: Array, width: float) -> Array:
    """Relays over the range of the command, switching widths spread between 0.4 and 1.6 ``width``."""
    centres = np.repeat(np.linspace(-1.0, 1.0, 401), 5)
    half = 0.5 * width * np.tile(np.array([0.4, 0.7, 1.0, 1.3, 1.6]), 401)
    # Near the ends of the range the relays have no room: there the loop closes.
    half = np.minimum(half, np.maximum(1.0 - np.abs(centres), 0.0))
    share = _relays(command, centres + half, centres - half) / len(centres)
    return 2.0 * share - 1.0


@njit(cache=True)
def spool(command: Array, step: float, frequency: float, damping: float, fastest: float) -> Array:
    """A second-order spool whose speed is limited [1/s]."""
    w = 2.0 * np.pi * frequency
    x, v = command[0], 0.0
    out = np.empty(len(command))
    for row in range(len(command)):
        out[row] = x
        v += step * (w * w * (command[row] - x) - 2.0 * damping * w * v)
        v = min(max(v, -fastest), fastest)
        x += step * v
    return out


def overlap(opening: Array, half_width: float, blur: float) -> Array:
    """Opening of rounded metering edges: nothing to speak of within the overlap, full command opens fully."""

    def bent(x: Array) -> Array:
        return blur * np.logaddexp(0.0, (x - half_width) / blur)

    rest = bent(np.zeros(1))
    shape = (bent(np.abs(opening)) - rest) / (bent(np.ones(1)) - rest)
    return np.sign(opening) * shape
