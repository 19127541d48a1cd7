"""Digits that say something: values and times without the rounding errors of their conversion.

The same reading in bar and in psi, or at a time of the day and at a time of the test, differs in its last
binary digits. A decision at a threshold, and a fit with many decisions on its way, must not depend on them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import Measurement

_DIGITS = 12  # decimal digits kept of the largest magnitude; no sensor has more than eight
_OF_STEP = 1e-6  # times are kept to this share of the usual time step
_EXACT = {"group", "direction"}  # labels and signs


def settled(measurement: Measurement) -> Measurement:
    """The measurement with values of twelve digits and times that begin at 0 in each file.

    Args:
        measurement: of any kind.

    Returns:
        the same rows; a time that steps back begins at 0 again.
    """
    columns = {
        name: values if name in _EXACT else rounded(values)
        for name, values in measurement.columns.items()
        if name != "time"
    }
    if "time" in measurement.columns:
        columns["time"] = record_time(measurement.columns["time"], measurement.starts)
    ordered = {name: columns[name] for name in measurement.columns}
    for values in ordered.values():
        values.flags.writeable = False
    return replace(measurement, columns=MappingProxyType(ordered))


def rounded(values: NDArray) -> NDArray[np.float64]:
    """Values rounded to twelve digits of the largest magnitude; infinite and NaN values stay."""
    values = np.asarray(values, dtype=float)
    known = np.abs(values[np.isfinite(values)])
    largest = float(np.max(known, initial=0.0))
    if not 1e-200 < largest < 1e200:
        return values
    return np.round(values, _DIGITS - 1 - int(np.floor(np.log10(largest))))


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
    return np.round(elapsed, -int(np.ceil(np.log10(grid))))
