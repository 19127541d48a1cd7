r"""Reduction of long measurements to block means, for fits.

Consecutive samples of a sweep differ mainly by noise. Their mean keeps the signal and has the noise
:math:`\sigma/\sqrt{n}`. A fit to the means, weighted by their number of rows :math:`n`, gives the parameters
and standard errors of a fit to all rows, provided that the model is nearly linear within a block. A diagnosis
gives every mean the same weight, so quickly changing parts of a measurement count more than in a fit to all
rows.
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

ROWS = 4000  # default number of block means
_SIGNALS = ("pressure", *STROKES, "force", "diameter", "command", "velocity")
_JUMP = 0.05  # change of the command from row to row that no block crosses, share of its range
_GROWTH = 0.1  # longest block of a transient, share of the rows since the last edge
_BY_TIME = 0.5  # share of the blocks spread evenly over the rows; the others follow the signals


class Reduced(NamedTuple):
    """A measurement of block means, the number of rows of each mean, and a note for the user."""

    measurement: Measurement
    counts: Array
    message: str


def reduced(measurement: Measurement, rows: int = ROWS) -> Reduced:
    """A measurement of about this many rows with the information of all usable rows.

    Blocks of consecutive rows are averaged in the order of time. No block crosses a file, group, sweep,
    direction, jump of the command or unusable row. Half of the blocks are spread evenly over the rows, half
    over the change of the signals relative to their range: where a signal changes quickly, blocks are short
    (at an edge of a transient down to single rows). In a transient no block is longer than a tenth of the
    rows since the last edge, because the response settles in this time. There may be more rows than requested
    if there are many such limits.

    Args:
        measurement: any kind; one that is not larger than ``rows`` is returned as it is, with counts of 1.
        rows: approximate number of rows of the result.
    """
    usable = measurement.usable
    count = int(np.count_nonzero(usable))
    if measurement.rows <= rows or count == 0:
        return Reduced(measurement, np.ones(measurement.rows), "")
    kept = np.flatnonzero(usable)
    block = _blocks(measurement, kept, rows)
    counts = np.bincount(block).astype(float)
    first = kept[np.concatenate([[True], np.diff(block) != 0])]
    columns: dict[str, NDArray] = {}
    for name, values in measurement.columns.items():
        if name == "group":
            columns[name] = values[first]
        else:
            columns[name] = np.bincount(block, values[kept]) / counts
    for values in columns.values():
        values.flags.writeable = False
    starts = np.unique(np.searchsorted(first, measurement.starts)).tolist()
    message = (
        f"fitted to {len(first)} means of up to {int(counts.max())} consecutive rows each, all with the same "
        f"weight, instead of {count} rows; no mean crosses a sweep, a direction or an edge"
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
        source_rows=None if measurement.source_rows is None else measurement.source_rows[first],
        messages=(*measurement.messages, message),
    )
    return Reduced(few, counts, message)


def _blocks(measurement: Measurement, kept: NDArray[np.intp], rows: int) -> NDArray[np.intp]:
    """Index of the block of each usable row, ascending."""
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
    # The response settles after an edge: blocks grow with the rows since the edge.
    settling = np.zeros(len(kept))
    if measurement.kind == "transient":
        settling = np.minimum(1.0, 1.0 / (_GROWTH * (after + 1.0)))
    others = max(rows - settling.sum(), 0.5 * rows)
    change_share = step / step.sum() if step.sum() > 0.0 else np.full(len(kept), 1.0 / len(kept))
    share = others * (_BY_TIME / len(kept) + (1.0 - _BY_TIME) * change_share) + settling
    # A block ends where the cumulated share passes an integer; the sum restarts with each run.
    cumulated = np.cumsum(share)
    in_run = cumulated - (cumulated[begin] - 1e-9)[run]
    number = np.floor(in_run).astype(np.int64)
    new = np.concatenate([[True], breaks | (np.diff(number) != 0)])
    return np.cumsum(new) - 1


def _change(measurement: Measurement, kept: NDArray[np.intp]) -> Array:
    """Largest change of a signal from each usable row to the next, relative to its range."""
    largest = np.zeros(len(kept) - 1)
    for name in _SIGNALS:
        values = measurement.columns.get(name)
        if values is None or not np.ptp(values) > 0.0:
            continue
        # Noise must not count as change: a running mean over about one block removes it.
        width = max(1, len(kept) // ROWS)
        smooth = running_mean(values[kept].astype(float), width)
        np.maximum(largest, np.abs(np.diff(smooth)) / np.ptp(values), out=largest)
    return largest


def _ranged(channel: MeasuredChannel, columns: dict[str, NDArray]) -> MeasuredChannel:
    values = columns[channel.name]
    return channel._replace(minimum=float(np.min(values)), maximum=float(np.max(values)))
