"""Whether a signal swings: frequency, amplitude, and whether it dies away."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_BESIDE = 0.25  # of the amplitude that a passage of the middle must go beyond it
_FEWEST = 3  # passages upwards: two periods
_EVEN = 0.3  # largest standard deviation of the periods over their mean


@dataclass(frozen=True, slots=True)
class Swing:
    """A swing.

    Attributes:
        frequency: passages upwards in unit time [Hz].
        amplitude: half of the range within the last period [the signal's unit].
        growth: of the amplitude from period to period [-]; below 1 it dies away.
    """

    frequency: float
    amplitude: float
    growth: float


def swing_of(time: Array, values: Array) -> Swing | None:
    """The swing of a signal about the middle of its range; None where it has no two even periods.

    A passage counts once the signal is a quarter of the amplitude beyond the middle on either side, so noise
    and pauses near it do not. The middle follows a swing that dies away: it is that of the last half.

    Args:
        time: ascending [s], shape (rows,).
        values: same shape.
    """
    if len(time) < 2 * _FEWEST or not np.ptp(values) > 0.0:
        return None
    late = values[len(values) // 2 :]
    middle, amplitude = 0.5 * (late.max() + late.min()), 0.5 * np.ptp(late)
    side = np.where(values > middle + _BESIDE * amplitude, 1, 0)
    side = np.where(values < middle - _BESIDE * amplitude, -1, side)
    decided = np.flatnonzero(side)
    turned = np.flatnonzero((side[decided][:-1] < 0) & (side[decided][1:] > 0))
    if len(turned) < _FEWEST:
        return None
    passages = []
    for before, after in zip(decided[turned], decided[turned + 1], strict=True):
        row = before + int(np.argmax(values[before : after + 1] >= middle))
        share = (middle - values[row - 1]) / (values[row] - values[row - 1])
        passages.append(time[row - 1] + share * (time[row] - time[row - 1]))
    periods = np.diff(passages)
    if np.std(periods) > _EVEN * np.mean(periods):
        return None
    edges = np.searchsorted(time, passages)
    sizes = [0.5 * float(np.ptp(values[begin : end + 1])) for begin, end in pairwise(edges)]
    growth = (sizes[-1] / sizes[0]) ** (1.0 / (len(sizes) - 1)) if len(sizes) > 1 else 1.0
    return Swing(1.0 / float(np.mean(periods)), sizes[-1], growth)
