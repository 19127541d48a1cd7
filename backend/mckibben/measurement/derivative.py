"""Derivatives of noisy samples with their standard uncertainty: local quadratic fits of adaptive width.

On uniform samples a local quadratic fit is the Savitzky-Golay filter (A. Savitzky, M. J. E. Golay, Analytical
Chemistry 36 (1964) 1627, doi 10.1021/ac60214a047); the fit itself allows any sampling. Its width is chosen
per row by the intersection of confidence intervals (A. Goldenshluger, A. Nemirovski, Mathematical Methods of
Statistics 6 (1997) 135): the widest window whose estimate still agrees with those of all narrower ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Half widths tried [rows]; each about 1.5 times the one before.
LADDER = (1, 2, 3, 4, 6, 9, 13, 19, 28, 42, 63, 94)
_AGREES = 4.0  # half width of the confidence intervals, standard uncertainties: noise rarely exceeds it
_DOUBTFUL = 3.0  # times the median uncertainty: above, one-sided windows are tried
_SURER = 0.5  # uncertainty of a one-sided window over that of both sides, below which it is used
_BACK = 2  # windows below the widest consistent one: there the bias is small compared with the noise
_CHUNK = 32_768  # rows whose sums fit into the cache of the processor
_TRIMMED = 0.9  # share of the squared residuals that counts; the largest ones are at edges of the signal
_TRIMMED_MEAN = 0.6229962  # mean of z^2 over the smallest 90 % of a standard normal z
_SURE = 8.0  # standard deviations of the noise; smaller swings may be noise
_THIRD = 20.0  # variance of the third difference of white noise of variance 1


class Rate(NamedTuple):
    """Rates of each row, their standard uncertainty, and the half width used [rows]; shape (rows,) each."""

    value: Array
    sigma: Array
    half_width: NDArray[np.intp]


class _Fit(NamedTuple):
    """A local quadratic fit of one half width: level and slope at the row, variances for unit noise."""

    level: Array
    slope: Array
    level_variance: Array
    slope_variance: Array


def noise_of(values: Array) -> float:
    r"""Standard deviation of white noise on a smooth signal of evenly spaced rows.

    It comes from third differences, whose variance is :math:`20\sigma^2`, without the largest tenth, where
    the signal jumps. It is at least the rounding noise q/√12 of a signal with the resolution q.
    """
    if len(values) < 8:
        return 0.0
    return max(_spread(np.diff(values, 3) ** 2 / _THIRD), rounding_step(values) / np.sqrt(12.0))


def rounding_step(values: Array) -> float:
    """The resolution of a rounded signal, in which many neighbours are equal; 0 without visible steps."""
    steps = np.abs(np.diff(values))
    moving = steps[steps > 1e-12 * np.max(np.abs(values), initial=0.0)]
    if not len(moving) or len(moving) > 0.7 * len(steps):
        return 0.0
    step = float(np.quantile(moving, 0.05))
    ratio = moving / step
    return step if np.median(np.abs(ratio - np.rint(ratio))) < 0.05 else 0.0


def smoothed(values: Array, *, noise: float, swing: float) -> tuple[Array, float]:
    """The signal, smoothed so that swings of this size exceed the noise, and the smallest significant swing.

    The running mean is only as wide as needed. It is not used if it would remove the signal: the apparent
    noise is then a signal with few rows per swing.
    """
    ratio = _SURE * noise / swing if swing > 0.0 else 0.0
    width = min(int(ratio**2) // 2 * 2 + 1, len(values) // 20) if ratio < 1e6 else 0
    if ratio <= 1.0:
        return values, swing
    if width >= 3:
        mean = running_mean(values, width)
        if np.ptp(mean) > 0.5 * np.ptp(values):
            return mean, max(swing, _SURE * noise / np.sqrt(width))
        return values, swing
    return values, min(max(swing, _SURE * noise), 0.5 * float(np.ptp(values)))


def running_mean(values: Array, width: int) -> Array:
    """Mean over a window around each row; beyond the ends the first and the last value continue."""
    if width <= 1:
        return values
    before = width // 2
    padded = np.pad(values - values[0], (before + 1, width - 1 - before), mode="edge")
    padded[0] = 0.0
    total = np.cumsum(padded)
    return values[0] + (total[width:] - total[:-width]) / width


def rates(time: Array, values: Array, *, starts: tuple[int, ...] = (0,), noise: float | None = None) -> Rate:
    r"""Time derivative of sampled values with its standard uncertainty.

    At each row a quadratic is fitted to the rows around it; its slope at the row is the rate, with

    .. math:: u^2 = \sigma^2 \left[(X^T X)^{-1}\right]_{11}

    for white noise :math:`\sigma` (a low-pass filter of the sensor makes it appear smaller). The bias is
    estimated from the next wider windows and added. Where the uncertainty is large, windows that end or begin
    at the row are tried: next to a corner the rate is that of the row's own side. At a corner it is the mean
    of both sides, with half their difference as uncertainty.

    Args:
        time: shape (rows,), ascending within a part; uneven spacing is allowed [s].
        values: shape (rows,).
        starts: first row of each part; no window crosses it, nor a step back in time.
        noise: standard deviation of the values; None = from the residuals of the narrowest windows.

    Returns:
        zero with infinite uncertainty where a window has fewer than three different times.
    """
    back = np.flatnonzero(np.diff(time) < 0.0) + 1
    edges = np.unique([0, *starts, *back.tolist(), len(time)])
    parts = [_part(time[a:b], values[a:b], noise) for a, b in pairwise(edges.tolist())]
    return Rate(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _part(time: Array, values: Array, noise: float | None) -> Rate:
    rows = len(time)
    step = float(np.median(np.diff(time))) if rows > 1 else 0.0
    if rows < 3 or step <= 0.0:
        spans = float(np.ptp(time)) if rows else 0.0
        step = spans / (rows - 1) if rows > 2 and spans > 0.0 else 0.0
        if step <= 0.0:
            return Rate(np.zeros(rows), np.full(rows, np.inf), np.zeros(rows, np.intp))
    ladder = [half for half in LADDER if half <= max(2, rows // 4)]
    # Scaled values: squares of very large or tiny values would overflow or underflow.
    scale = float(np.max(np.abs(values - values[0]))) or 1.0
    scaled, clock = (values - values[0]) / scale, (time - time[0]) / step
    sigma = _residual_noise(clock, scaled) if noise is None else noise / scale
    value, spread, width = np.zeros(rows), np.full(rows, np.inf), np.zeros(rows, np.intp)
    for begin in range(0, rows, _CHUNK):
        chunk = slice(begin, min(begin + _CHUNK, rows))
        value[chunk], spread[chunk], width[chunk] = _adapted(clock, scaled, chunk, ladder, sigma)
    known = np.isfinite(spread)
    typical = float(np.median(spread[known])) if np.any(known) else np.inf
    doubtful = np.flatnonzero(known & (spread > _DOUBTFUL * typical))
    if len(doubtful):
        value[doubtful], spread[doubtful] = _beside(
            clock, scaled, doubtful, ladder, sigma, value[doubtful], spread[doubtful]
        )
    return Rate(value * scale / step, spread * scale / step, width)


def _residual_noise(clock: Array, values: Array) -> float:
    """Noise from the residuals of the narrowest fits, and from rounding."""
    rows = len(clock)
    squares = []
    for begin in range(0, rows, _CHUNK):
        fit = next(_fits(clock, values, slice(begin, min(begin + _CHUNK, rows)), [3]))
        remaining_variance = 1.0 - fit.level_variance
        good = remaining_variance > 0.1
        squares.append(fit.level[good] ** 2 / remaining_variance[good])
    return max(_spread(np.concatenate(squares)), rounding_step(values) / np.sqrt(12.0))


def _spread(squares: Array) -> float:
    """Standard deviation from squares, without the largest tenth."""
    if not len(squares):
        return 0.0
    count = max(1, int(_TRIMMED * len(squares)))
    smallest = np.partition(squares, count - 1)[:count]
    return float(np.sqrt(np.mean(smallest) / _TRIMMED_MEAN))


def _beside(
    clock: Array,
    values: Array,
    rows: NDArray[np.intp],
    ladder: list[int],
    sigma: float,
    value: Array,
    spread: Array,
) -> tuple[Array, Array]:
    """Rate and uncertainty of some rows from one-sided windows, where these are more certain."""
    (left, left_spread, _), (right, right_spread, _) = (
        _adapted(clock, values, rows, ladder, sigma, sides=(side,)) for side in (-1, 1)
    )
    sure_left, sure_right = left_spread < _SURER * spread, right_spread < _SURER * spread
    nearer = np.where(left_spread < right_spread, left, right)
    one_sided = np.where(sure_left | sure_right, nearer, value)
    one_sided_spread = np.where(sure_left | sure_right, np.minimum(left_spread, right_spread), spread)
    difference = np.abs(left - right)
    corner = sure_left & sure_right & (difference > _AGREES * np.hypot(left_spread, right_spread))
    return np.where(corner, 0.5 * (left + right), one_sided), np.where(
        corner, 0.5 * difference, one_sided_spread
    )


def _adapted(
    clock: Array,
    values: Array,
    chunk: slice | NDArray[np.intp],
    ladder: list[int],
    sigma: float,
    sides: tuple[int, ...] = (1, -1),
) -> tuple[Array, Array, NDArray[np.intp]]:
    """Rate, uncertainty and half width of the rows of a chunk."""
    fits = [
        (fit.slope, np.where(np.isfinite(fit.slope_variance), sigma, 1.0) * np.sqrt(fit.slope_variance))
        for fit in _fits(clock, values, chunk, ladder, sides)
    ]
    rows = len(fits[0][0])
    low, high = np.full(rows, -np.inf), np.full(rows, np.inf)
    agreeing, unknown = np.ones(rows, bool), np.zeros(rows, np.intp)
    widest = np.zeros(rows, np.intp)
    for number, (slope, uncertainty) in enumerate(fits):
        known = np.isfinite(uncertainty)
        unknown += ~known  # too few different times in the narrowest windows
        low = np.where(known, np.maximum(low, slope - _AGREES * uncertainty), low)
        high = np.where(known, np.minimum(high, slope + _AGREES * uncertainty), high)
        agreeing &= low <= high
        widest[agreeing] = number
    chosen = np.minimum(np.maximum(widest - _BACK, unknown), len(ladder) - 1)
    row, halves = np.arange(rows), np.array(ladder)
    slopes, spreads = (np.array(each) for each in zip(*fits, strict=True))
    value, spread = slopes[chosen, row], spreads[chosen, row]
    # The bias of a quadratic fit grows with the square of the width, so wider windows give its size.
    wider = np.minimum(chosen + _BACK, len(ladder) - 1)
    growth = np.maximum((halves[wider] / halves[chosen]) ** 2 - 1.0, 1.0)
    spread = np.hypot(spread, (slopes[wider, row] - value) / growth)
    return np.where(np.isfinite(spread), value, 0.0), spread, halves[chosen]


def _neighbours(
    chunk: slice | NDArray[np.intp], offset: int, rows: int
) -> tuple[slice | NDArray[np.intp], slice | NDArray[np.intp], slice | NDArray[np.intp]]:
    """The rows that have a neighbour at an offset: their places in the chunk, the rows, the neighbours."""
    if isinstance(chunk, slice):
        begin = max(chunk.start, -offset)
        end = max(begin, min(chunk.stop, rows - offset))
        here = slice(begin - chunk.start, end - chunk.start)
        return here, slice(begin, end), slice(begin + offset, end + offset)
    here = np.flatnonzero((chunk + offset >= 0) & (chunk + offset < rows))
    return here, chunk[here], chunk[here] + offset


def _fits(
    clock: Array,
    values: Array,
    chunk: slice | NDArray[np.intp],
    ladder: list[int],
    sides: tuple[int, ...] = (1, -1),
) -> Iterator[_Fit]:
    """The quadratic fits of some rows for ascending half widths; their sums are accumulated."""
    count = chunk.stop - chunk.start if isinstance(chunk, slice) else len(chunk)
    s0, s1, s2, s3, s4, y0, y1, y2 = (np.zeros(count) for _ in range(8))
    s0 += 1.0  # the row itself; others are relative to it
    reached = 0
    for half in ladder:
        for offset in (side * n for n in range(reached + 1, half + 1) for side in sides):
            here, at, other = _neighbours(chunk, offset, len(clock))
            t = clock[other] - clock[at]
            y = values[other] - values[at]
            t2 = t * t
            s0[here] += 1.0
            s1[here] += t
            s2[here] += t2
            s3[here] += t2 * t
            s4[here] += t2 * t2
            y0[here] += y
            y1[here] += y * t
            y2[here] += y * t2
        reached = half
        c00, c01, c02 = s2 * s4 - s3 * s3, s2 * s3 - s1 * s4, s1 * s3 - s2 * s2
        c11, c12 = s0 * s4 - s2 * s2, s1 * s2 - s0 * s3
        det = s0 * c00 + s1 * c01 + s2 * c02
        det = np.where(det > 1e-9 * s0 * s2 * s4, det, np.nan)
        yield _Fit(
            np.nan_to_num((c00 * y0 + c01 * y1 + c02 * y2) / det),
            np.nan_to_num((c01 * y0 + c11 * y1 + c12 * y2) / det),
            np.nan_to_num(c00 / det, nan=1.0),
            np.where(np.isnan(det), np.inf, c11 / det),
        )
