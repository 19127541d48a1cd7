r"""Fewer rows with the same information: block means with weights, for fits of long measurements.

Consecutive samples of one sweep hardly differ but for noise. Their mean keeps the signal and has the noise
:math:`\sigma/\sqrt{n}`, so a fit to the means, each weighted by its :math:`n`, gives the parameters and
standard errors of the fit to all rows, as long as the model is nearly straight within a block.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import Array, running_mean
from mckibben.measurement.measurement import STROKES, MeasuredChannel, Measurement

ROWS = 4000
_SIGNALS = ("pressure", *STROKES, "force", "diameter", "command", "velocity")
_JUMP = 0.05  # of the range from one row to the next: an edge of the command, which no block crosses
_GROWTH = 0.1  # of the rows since the last edge: the longest block of a transient
_BY_TIME = 0.5  # share of the blocks that follow the rows, the others follow the change of the signals


class Reduced(NamedTuple):
    """A measurement of block means, rows averaged per row as weights of its squares, and what was done."""

    measurement: Measurement
    weights: Array
    message: str


def reduced(measurement: Measurement, rows: int = ROWS) -> Reduced:
    """A measurement of about so many rows that holds the information of all usable ones.

    Blocks of consecutive rows are averaged, never across files, groups, sweeps, directions, a jump of the
    command or an unusable row; in the order of time. Half of the blocks are spread evenly over the rows, half
    over the change of the signals, each relative to its range: where a signal moves quickly blocks are short
    (in an edge of a transient down to single rows), where it rests they are long. In a transient no block is
    longer than a tenth of the time since the last edge, in which everything settles. What no block may cross
    can leave more rows than asked for.

    Args:
        measurement: any kind; one that is not larger than ``rows`` is returned as it is, with weights 1.
        rows: about how many to leave.
    """
    usable = measurement.usable
    count = int(np.count_nonzero(usable))
    if measurement.rows <= rows or count == 0:
        return Reduced(measurement, np.ones(measurement.rows), "")
    kept = np.flatnonzero(usable)
    block = _blocks(measurement, kept, rows)
    weights = np.bincount(block).astype(float)
    first = kept[np.concatenate([[True], np.diff(block) != 0])]
    columns: dict[str, NDArray] = {}
    for name, values in measurement.columns.items():
        if name == "group":
            columns[name] = values[first]
        else:
            columns[name] = np.bincount(block, values[kept]) / weights
    for values in columns.values():
        values.flags.writeable = False
    starts = np.unique(np.searchsorted(first, measurement.starts)).tolist()
    message = (
        f"fitted to {len(first)} means of up to {int(weights.max())} consecutive rows each, weighted by "
        f"their number, in place of {count} rows; no mean crosses a sweep, a direction or an edge"
    )
    slack = np.zeros(len(first), bool)
    slack.flags.writeable = False
    few = replace(
        measurement,
        id=hashlib.sha256(f"{measurement.id}:{rows}".encode()).hexdigest(),
        columns=MappingProxyType(columns),
        channels=tuple(_ranged(channel, columns) for channel in measurement.channels),
        slack=slack,
        excluded_rows=MappingProxyType({}),
        starts=tuple(start for start in starts if start < len(first)) or (0,),
        segmented=measurement.segments.only(first),
        messages=(*measurement.messages, message),
    )
    return Reduced(few, weights, message)


def _blocks(measurement: Measurement, kept: NDArray[np.intp], rows: int) -> NDArray[np.intp]:
    """Number of the block of each usable row, ascending."""
    columns, segments = measurement.columns, measurement.segments
    part = np.zeros(measurement.rows, np.int64)
    part[list(measurement.starts)] = 1
    keys = [np.cumsum(part), columns["group"], segments.sweep, segments.direction]
    keys += [np.sign(columns["direction"])] if "direction" in columns else []
    breaks = np.diff(kept) > 1
    for key in keys:
        breaks |= np.diff(key[kept]) != 0
    if "command" in columns:
        command = columns["command"][kept]
        breaks |= np.abs(np.diff(command)) > _JUMP * max(float(np.ptp(command)), 1e-12)
    run = np.concatenate([[0], np.cumsum(breaks)])
    step = np.concatenate([[0.0], np.where(breaks, 0.0, _change(measurement, kept))])
    begin = np.concatenate([[0], np.flatnonzero(breaks) + 1])
    after = np.arange(len(kept)) - begin[run]
    # After an edge everything settles: blocks grow with the time since, so that none is longer than it takes.
    settling = np.zeros(len(kept))
    if measurement.kind == "transient":
        settling = np.minimum(1.0, 1.0 / (_GROWTH * (after + 1.0)))
    left = max(rows - settling.sum(), 0.5 * rows)
    moved = step / step.sum() if step.sum() > 0.0 else np.full(len(kept), 1.0 / len(kept))
    share = left * (_BY_TIME / len(kept) + (1.0 - _BY_TIME) * moved) + settling
    # Where the sum of the shares passes a whole number a block ends; each run starts afresh.
    passed = np.cumsum(share)
    own = passed - (passed[begin] - 1e-9)[run]
    number = np.floor(own).astype(np.int64)
    new = np.concatenate([[True], breaks | (np.diff(number) != 0)])
    return np.cumsum(new) - 1


def _change(measurement: Measurement, kept: NDArray[np.intp]) -> Array:
    """How far the signals go from each usable row to the next, the largest relative to its range."""
    largest = np.zeros(len(kept) - 1)
    for name in _SIGNALS:
        values = measurement.columns.get(name)
        if values is None or not np.ptp(values) > 0.0:
            continue
        # Noise is no change: differences of a running mean over as many rows as are averaged anyway.
        width = max(1, len(kept) // ROWS)
        calm = running_mean(values[kept].astype(float), width)
        np.maximum(largest, np.abs(np.diff(calm)) / np.ptp(values), out=largest)
    return largest


def _ranged(channel: MeasuredChannel, columns: dict[str, NDArray]) -> MeasuredChannel:
    values = columns[channel.name]
    return channel._replace(minimum=float(np.min(values)), maximum=float(np.max(values)))
