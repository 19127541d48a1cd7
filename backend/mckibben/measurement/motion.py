"""Velocity of a muscle with its uncertainty, and its direction of motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import Array, Rate, noise_of, rates
from mckibben.measurement.measurement import STROKES, Measurement, lengths
from mckibben.physics.errors import InputError

_MOVES = 2.0  # standard uncertainties; faster is motion
_STAYS = 1.0  # the same for rows next to a motion
_OPPOSED = -0.5  # correlation below which a measured velocity has the opposite sign convention


@dataclass(frozen=True, eq=False)
class RecordedMotion:
    """Rates of each row; arrays have shape (rows,).

    Attributes:
        velocity: dL/dt, negative = shortening [m/s].
        velocity_sigma: its standard uncertainty [m/s].
        direction: -1 shortening, +1 lengthening, 0 not distinguishable from rest.
        measured: the velocity was measured, not derived.
        messages: the assumptions.
    """

    velocity: Array
    velocity_sigma: Array
    direction: NDArray[np.int8]
    measured: bool
    messages: tuple[str, ...]


def motion_of(measurement: Measurement, nominal_length: float) -> RecordedMotion:
    """Velocity of a measurement in time.

    A measured velocity is used as it is, with the sign of dL/dt unless the measured stroke shows that
    shortening is positive. Otherwise the length is differentiated by local fits, see
    :func:`mckibben.measurement.derivative.rates`. The direction is the sign of the velocity where it exceeds
    twice its uncertainty, and next to such rows where it exceeds its uncertainty.

    Args:
        measurement: with time and a stroke or a velocity.
        nominal_length: of the muscle, for a stroke given as contraction [m].

    Raises:
        InputError: no time, or neither stroke nor velocity.
    """
    columns, starts = measurement.columns, measurement.starts
    if "time" not in columns:
        raise InputError(f"{measurement.name}: rates need a time column", field="time", hint="e.g. 'time_s'")
    time = columns["time"]
    messages = []
    stroked = any(name in columns for name in STROKES)
    derived = rates(time, lengths(measurement, nominal_length), starts=starts) if stroked else None
    if "velocity" in columns:
        value = columns["velocity"].astype(float)
        if derived is not None and _correlation(value, derived) < _OPPOSED:
            value = -value
            messages.append(
                "the velocity counts shortening as positive: its sign is reversed to that of dL/dt"
            )
        sigma = np.full(len(value), noise_of(value))
    elif derived is not None:
        value, sigma = derived.value, derived.sigma
        width = 2 * int(np.median(derived.half_width)) + 1
        messages.append(f"velocity from local quadratic fits, usually over {width} rows")
    else:
        raise InputError(
            f"{measurement.name}: rates need a stroke or a velocity", field="length", hint="e.g. 'length_mm'"
        )
    return RecordedMotion(
        value, sigma, directions(value, sigma, starts=starts),
        "velocity" in columns, tuple(messages),
    )  # fmt: skip


def directions(velocity: Array, sigma: Array, *, starts: tuple[int, ...] = (0,)) -> NDArray[np.int8]:
    """Sign of a velocity where it is significant: runs above one ``sigma`` that exceed two somewhere."""
    sign = np.where(np.abs(velocity) > _STAYS * sigma, np.sign(velocity), 0.0).astype(np.int8)
    sure = np.abs(velocity) > _MOVES * sigma
    begins = np.concatenate([[True], np.diff(sign) != 0])
    begins[list(starts)] = True
    run = np.cumsum(begins) - 1
    passes = np.zeros(run[-1] + 1, bool)
    passes[run[sure]] = True
    return np.where(passes[run], sign, 0).astype(np.int8)


def _correlation(value: Array, derived: Rate) -> float:
    known = np.isfinite(derived.sigma)
    a, b = value[known], derived.value[known]
    scale = float(np.sqrt(np.sum(a * a) * np.sum(b * b)))
    return float(np.sum(a * b)) / scale if scale > 0.0 else 0.0
