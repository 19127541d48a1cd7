"""Piecewise-linear signals of time for the integrator: a list of segments, with jumps between them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Pieces shorter than this are left out [s]: they come from rounding of ``k * period``, not from a valve.
SHORTEST = 1e-12

Array = NDArray[np.float64]
Interval = tuple[float, float]


class Segments(NamedTuple):
    """y(t) = start_values[i] + slopes[i] (t - times[i]) for times[i] <= t < times[i + 1].

    Attributes:
        times: boundaries [s], ascending, one more than segments; the first is 0, the last the duration.
        start_values: value at the beginning of each segment [unit of the signal].
        slopes: rate within each segment [unit/s].
    """

    times: Array
    start_values: Array
    slopes: Array

    @property
    def end_values(self) -> Array:
        """Value at the end of each segment, before a jump."""
        return self.start_values + self.slopes * np.diff(self.times)

    def value(self, time: ArrayLike) -> Array:
        """Value at any times; right-continuous at jumps, start and end value outside."""
        clipped = np.clip(np.asarray(time, dtype=np.float64), self.times[0], self.times[-1])
        return self._from_piece(self._piece(clipped), clipped)

    def _piece(self, time: Array) -> NDArray[np.intp]:
        last = len(self.start_values) - 1
        return np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, last)

    def _from_piece(self, piece: NDArray[np.intp], time: Array) -> Array:
        return self.start_values[piece] + self.slopes[piece] * (time - self.times[piece])


def clipped(starts: ArrayLike, values: ArrayLike, slopes: ArrayLike, *, duration: float) -> Segments:
    """Segments on [0, duration] from pieces; each lasts until the next one starts.

    Adjacent pieces with the same constant level are joined.

    Args:
        starts: ascending instants [s]; its value holds before the first. Of equal ones the last counts.
        values, slopes: value at, and rate from, each start.
        duration: end [s], positive.
    """
    begin, level, rate = (np.array(column, dtype=np.float64) for column in (starts, values, slopes))
    if begin[0] > 0.0:
        begin, level, rate = _joined(0.0, begin), _joined(level[0], level), _joined(0.0, rate)
    early = begin < 0.0
    level[early] -= rate[early] * begin[early]
    begin[early] = 0.0
    begin[begin <= SHORTEST] = 0.0
    ends = np.minimum(_joined(begin[1:], np.inf), duration)
    kept = ends - begin > SHORTEST
    begin, level, rate = begin[kept], level[kept], rate[kept]
    same = (level[1:] == level[:-1]) & (rate[1:] == 0.0) & (rate[:-1] == 0.0)
    new = np.concatenate(([True], ~same))
    return Segments(_joined(begin[new], duration), level[new], rate[new])


def delayed(
    segments: Segments, on_delay: float, off_delay: float, *, before: float | None = None
) -> Segments:
    """The signal after a dead time that differs for rising and falling edges.

    A jump upwards happens ``on_delay`` later, a jump downwards ``off_delay`` later; the signal after the jump
    is shifted with it. A kink without a jump keeps the delay of the last edge (at the start: by the sign of
    the first slope), so a continuous signal stays continuous. Where the next edge comes later than the piece
    lasts, its end value is held; where it comes earlier, the piece is cut. An edge that would overtake the
    one before it cancels it: a pulse shorter than ``on_delay - off_delay`` never opens the valve, a pause
    shorter than ``off_delay - on_delay`` never closes it.

    Args:
        segments: the signal [any unit].
        on_delay, off_delay: dead times [s], not negative.
        before: value before t = 0; if it differs from the first value there is an edge at t = 0. None: no
            edge at t = 0.

    Raises:
        ValueError: a negative or infinite delay.
    """
    if not (0.0 <= on_delay < np.inf and 0.0 <= off_delay < np.inf):
        raise ValueError("delays are finite and not negative")
    duration = float(segments.times[-1])
    starts, values, slopes = segments.times[:-1], segments.start_values, segments.slopes
    ends = segments.end_values
    previous = _joined(values[0] if before is None else before, ends[:-1])
    jumps = values - previous
    # At a kink the end of one piece and the start of the next differ by rounding only: no edge.
    scale = max(np.abs(values).max(), np.abs(previous).max())
    edges = np.where(np.abs(jumps) > 1e-9 * scale, np.sign(jumps), 0.0)
    if edges[0] == 0.0:
        edges[0] = -1.0 if slopes[0] < 0.0 else 1.0
    last_edge = np.maximum.accumulate(np.where(edges != 0.0, np.arange(len(edges)), 0))
    delay = np.where(edges[last_edge] > 0.0, on_delay, off_delay)
    begin = starts + delay
    # Backwards running minimum: a piece survives when no later one starts before or with it.
    later = _joined(np.minimum.accumulate(begin[::-1])[::-1][1:], np.inf)
    alive = begin < later
    shifted_end = segments.times[1:] + delay
    extended = alive & (later > shifted_end + SHORTEST)
    at = _joined(begin[alive], shifted_end[extended])
    level = _joined(values[alive], ends[extended])
    rate = _joined(slopes[alive], np.zeros(int(extended.sum())))
    order = np.argsort(at, kind="stable")
    first = float(previous[0])
    return clipped(
        _joined(-1.0, at[order]), _joined(first, level[order]), _joined(0.0, rate[order]), duration=duration
    )


def merged(a: Segments, b: Segments) -> tuple[Segments, Segments]:
    """Both signals on the union of their breakpoints (one ``times`` array), values unchanged.

    Raises:
        ValueError: they do not cover the same time.
    """
    if a.times[0] != b.times[0] or a.times[-1] != b.times[-1]:
        raise ValueError("the signals cover different times")
    union = np.union1d(a.times, b.times)
    inner = union[(union - union[0] > SHORTEST) & (union[-1] - union > SHORTEST)]
    inner = inner[np.diff(inner, prepend=-np.inf) > SHORTEST]
    times = _joined(union[0], inner, union[-1])
    middle = 0.5 * (times[1:] + times[:-1])  # away from the jumps of either signal

    def on_common(signal: Segments) -> Segments:
        piece = signal._piece(middle)
        return Segments(times, signal._from_piece(piece, times[:-1]), signal.slopes[piece])

    return on_common(a), on_common(b)


def _joined(*parts: ArrayLike) -> Array:
    """Concatenates numbers and arrays; numpy's `r_` takes six times as long, which counts in short runs."""
    return np.concatenate([np.atleast_1d(np.asarray(part, dtype=np.float64)) for part in parts])


def phases(command: Segments) -> tuple[Interval | None, Interval | None]:
    """The first fill (command above 0) and the exhaust after it, as (start, end) instants of the command [s].

    The exhaust begins when the command of the fill ends, by closing or by venting, and lasts until the next
    fill or the end. Without a fill it begins with the first negative command.
    """
    middle = 0.5 * (command.start_values + command.end_values)
    duration = float(command.times[-1])

    def first(holds: NDArray[np.bool_], after: float) -> float | None:
        positions = np.flatnonzero(holds & (command.times[:-1] >= after))
        return float(command.times[positions[0]]) if len(positions) else None

    on = first(middle > 0.0, 0.0)
    off = first(middle < 0.0, 0.0) if on is None else first(middle <= 0.0, on)
    fill = None if on is None else (on, duration if off is None else off)
    if off is None:
        return fill, None
    again = first(middle > 0.0, off)
    return fill, (off, duration if again is None else again)
