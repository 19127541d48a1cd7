"""A measurement without what says nothing: last digits, origin of time, repeated rows, order of a map.

The same reading in bar and in psi, or at a time of the day and at a time of the test, differs in its last
binary digits. A decision at a threshold, and a fit with many decisions on its way, must not depend on them,
nor on how often or in which order the rows of a map stand in a file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES, Measurement

_DIGITS = 12  # decimal digits kept of the largest magnitude; no sensor has more than eight
_OF_STEP = 1e-6  # times are kept to this share of the usual time step
_EXACT = {"group", "direction"}  # labels and signs
_COPIED = 0.1  # share of repeated rows above which rows without time are copies, not equal readings


class Settled(NamedTuple):
    """A settled measurement, the row of the source of each of its rows, and the number of repeated rows."""

    measurement: Measurement
    rows: NDArray[np.intp]
    repeated: int

    @property
    def message(self) -> str:
        """A note on the repeated rows; empty without any."""
        if not self.repeated:
            return ""
        rows, count = ("row repeats", "it counts") if self.repeated == 1 else ("rows repeat", "they count")
        return (
            f"{self.measurement.name}: {self.repeated} {rows} an earlier row in every reading: {count} once, "
            "because a copy says nothing about the noise"
        )


def settled(measurement: Measurement) -> Settled:
    """The measurement with values of twelve digits and times that begin at 0 in each file.

    A row that repeats another one of its file in every column is left out: with time always, without time
    only where a tenth of the rows does, as coarse readings may be equal by chance. Where the order of the
    rows is that of the test, a way comes back to its readings: only a row after its like is a copy. The rows
    of another static map without time are sorted within each group, along the quantity that changes there.

    Args:
        measurement: of any kind; a time that steps back begins at 0 again.
    """
    columns = {
        name: values if name in _EXACT else rounded(values)
        for name, values in measurement.columns.items()
        if name != "time"
    }
    timed = measurement.in_order
    if "time" in measurement.columns:
        columns["time"] = record_time(measurement.columns["time"], measurement.starts)
    file = np.zeros(measurement.rows, dtype=np.int64)
    file[list(measurement.starts)] = 1
    file = np.cumsum(file)
    copies = _copies(columns, file, only_next=measurement.by_rows)
    if "time" not in measurement.columns and np.count_nonzero(copies) <= _COPIED * measurement.rows:
        copies[:] = False
    rows = np.flatnonzero(~copies)
    if measurement.kind == "static" and not timed:
        rows = rows[_along_lines({name: values[rows] for name, values in columns.items()}, file[rows])]
    columns = {name: columns[name][rows] for name in measurement.columns}
    for values in columns.values():
        values.flags.writeable = False
    left = replace(measurement, columns=MappingProxyType(columns))
    if len(rows) < measurement.rows or np.any(np.diff(rows) < 0):
        left = replace(
            left,
            slack=measurement.slack[rows],
            excluded_rows=MappingProxyType(
                {why: bad[rows] for why, bad in measurement.excluded_rows.items()}
            ),
            starts=tuple(np.flatnonzero(np.diff(file[rows], prepend=0)).tolist()),
            segmented=None if measurement.segmented is None else measurement.segmented.only(rows),
            source_rows=None if measurement.source_rows is None else measurement.source_rows[rows],
        )
    return Settled(left, rows, int(np.count_nonzero(copies)))


def rounded(values: NDArray) -> NDArray[np.float64]:
    """Values rounded to twelve digits of the largest magnitude; infinite and NaN values stay."""
    values = np.asarray(values, dtype=np.float64)
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    if not 1e-200 < largest < 1e200:
        return values.copy()
    return np.round(values, _DIGITS - 1 - int(np.floor(np.log10(largest)))).astype(np.float64)


def record_time(time: NDArray, starts: Sequence[int] = (0,)) -> NDArray[np.float64]:
    """Time since the first row of each record, to a millionth of the usual step [s], shape (rows,).

    Coarser where the times are so far from zero that their own rounding is larger.

    Args:
        time: of each row [s].
        starts: first row of each file; a step back in time begins a record as well.
    """
    time = np.asarray(time, dtype=float)
    steps = np.diff(time)
    first = np.zeros(len(time), dtype=np.intp)
    begins = np.unique([0, *starts, *(np.flatnonzero(steps < 0.0) + 1).tolist()])
    first[begins] = begins
    elapsed = time - time[np.maximum.accumulate(first)]
    forward = steps[steps > 0.0]
    if not len(forward):
        return elapsed
    grid = max(_OF_STEP * float(np.median(forward)), 4.0 * float(np.spacing(np.max(np.abs(time)))))
    return np.round(elapsed, -int(np.ceil(np.log10(grid)))).astype(np.float64)


def _copies(columns: Mapping[str, NDArray], file: NDArray, *, only_next: bool) -> NDArray[np.bool_]:
    """Mask of the rows that equal an earlier row of their file, or the one before, in every column."""
    table = np.column_stack([file, *columns.values()]) + 0.0  # -0 and 0 are equal
    if only_next:
        return np.concatenate([[False], np.all(table[1:] == table[:-1], axis=1)])
    first = np.unique(table, axis=0, return_index=True)[1]
    copies = np.ones(len(table), bool)
    copies[first] = False
    return copies


def _along_lines(columns: Mapping[str, NDArray], file: NDArray) -> NDArray[np.intp]:
    """Order of the rows of a map: by file, group and direction, then along the line of the group."""
    quantities = [columns[name] for name in (*STROKES, "pressure") if name in columns]
    groups = columns["group"]
    line = sorted(quantities, key=lambda values: -_change_within(values, groups))
    others = [values for name, values in columns.items() if name not in ("group", "direction")]
    direction = [columns["direction"]] if "direction" in columns else []
    return np.lexsort((*others[::-1], *line[::-1], *direction, groups, file))


def _change_within(values: NDArray, groups: NDArray) -> float:
    """Mean range of a quantity within the groups, relative to its whole range."""
    whole = float(np.ptp(values))
    if not whole > 0.0:
        return 0.0
    return float(np.mean([np.ptp(values[groups == label]) for label in np.unique(groups)])) / whole
