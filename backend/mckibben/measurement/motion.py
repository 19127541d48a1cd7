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


def held_directions(
    direction: NDArray[np.int8], length: Array, records: NDArray[np.int_], *, least: float
) -> NDArray[np.int8]:
    """Direction of each row, where rows at rest keep that of the last motion: dry friction stays as it was.

    Rows before the first motion of a record have 0. Runs of one direction that travel less than ``least``
    are noise, or a creeping rest.

    Args:
        direction: of each row, 0 at rest.
        length: of each row [m].
        records: label of the uninterrupted record of each row; rows of a record are in order.
        least: shortest travel of a motion [m].
    """
    kept = np.zeros(len(direction), direction.dtype)
    if not len(direction):
        return kept
    breaks = np.flatnonzero((np.diff(direction) != 0) | (np.diff(records) != 0)) + 1
    last, record = 0, records[0]
    for begin, end in zip([0, *breaks], [*breaks, len(direction)], strict=True):
        if records[begin] != record:
            last, record = 0, records[begin]
        before = length[begin - 1] if begin and records[begin - 1] == record else length[begin]
        if direction[begin] and abs(length[end - 1] - before) >= least:
            last = direction[begin]
        kept[begin:end] = last
    return kept


def _correlation(value: Array, derived: Rate) -> float:
    known = np.isfinite(derived.sigma)
    a, b = value[known], derived.value[known]
    scale = float(np.sqrt(np.sum(a * a) * np.sum(b * b)))
    return float(np.sum(a * b)) / scale if scale > 0.0 else 0.0
