"""Sweeps, cycles, directions and speeds of a measurement, from time, stroke and pressure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import noise_of, running_mean, smoothed
from mckibben.measurement.kind import STROKES, Array, turning_points

_TURN = 0.03  # smallest swing of a sweep, share of the range
_SLOW = 0.1  # share of the mean speed of a sweep below which a row is at rest
_HOLD_AT_TURN = 0.08  # shortest hold at a turn, share of the rows of a sweep; less is the turn itself
_HOLD = 0.015  # the same within a sweep
_HOLD_ROWS = 5  # shortest hold
_SAME_SPEED = 1.3  # ratio of neighbouring mean speeds above which they are two levels
_MANY_PARTS = 5000  # more breaks mean that the rows have no order


@dataclass(frozen=True, eq=False)
class Sweeps:
    """Segments of a measurement; arrays have shape (rows,).

    Attributes:
        sweep: number of the sweep, ascending from 0 with the rows; a sweep ends where the signal turns.
        cycle: number of the cycle, ascending from 0; a cycle begins with each sweep of the first direction.
        direction: -1 shortening, +1 lengthening, 0 at rest or creeping. If the signal is the pressure, rising
            counts as shortening.
        speed_level: 0 at rest, else 1 for the slowest level of ``speeds`` and so on.
        speeds: mean |rate| of the sweeps of each level [unit of the signal per s], empty without time.
        signal: the evaluated channel.
        noise: standard deviation of its noise [unit of the signal].
    """

    sweep: NDArray[np.int64]
    cycle: NDArray[np.int64]
    direction: NDArray[np.int8]
    speed_level: NDArray[np.int64]
    speeds: tuple[float, ...]
    signal: str
    noise: float

    def only(self, rows: NDArray[np.intp]) -> Sweeps:
        """The segments of some of the rows, with unchanged numbers."""
        return Sweeps(
            self.sweep[rows], self.cycle[rows], self.direction[rows], self.speed_level[rows],
            self.speeds, self.signal, self.noise,
        )  # fmt: skip

    @property
    def sweeps(self) -> int:
        """Number of sweeps."""
        return int(self.sweep[-1]) + 1 if len(self.sweep) else 0

    @property
    def cycles(self) -> int:
        """Number of cycles."""
        return int(self.cycle[-1]) + 1 if len(self.cycle) else 0

    @property
    def held_rows(self) -> int:
        """Number of rows without motion."""
        return int(np.count_nonzero(self.direction == 0))


def sweeps_of(columns: Mapping[str, NDArray], kind: str, *, starts: tuple[int, ...] = (0,)) -> Sweeps:
    """The segments of a measurement.

    The signal is the stroke (the pressure of an isometric test, or if no stroke was measured). It turns where
    it leaves an extreme by 3 % of its range and by 8 times its noise; a noisier signal is smoothed first. A
    row is at rest where the signal moves at less than a tenth of the mean speed of its sweep, for at least
    five rows and longer than a turn takes. A direction column of the file takes precedence.

    Args:
        columns: channels in SI, with ``group``.
        kind: kind of the measurement.
        starts: first row of each file of a joined measurement.
    """
    name, signal = _signal(columns, kind)
    time = columns.get("time")
    noise = noise_of(signal)
    span = float(np.ptp(signal))
    bounds = _parts(columns, signal, noise, starts)
    stated = columns.get("direction")
    if stated is not None and np.any(stated):
        turns = np.diff(np.sign(stated)) != 0.0
        direction = np.sign(stated).astype(np.int8)
        begins = np.concatenate([[True], turns])
        begins[bounds[:-1]] = True
    else:
        begins, direction = _detected(signal, time, bounds, noise, span)
    sweep = np.cumsum(begins) - 1
    return Sweeps(
        sweep, _cycles(begins, sweep, direction, bounds), direction,
        *_speed_levels(signal, time, sweep, direction), name, noise,
    )  # fmt: skip


def _signal(columns: Mapping[str, NDArray], kind: str) -> tuple[str, Array]:
    """(channel, its values with the sign that ascends with lengthening)."""
    signs = {"length": 1.0, "contraction": -1.0, "displacement": -1.0, "pressure": -1.0}
    order = ("pressure", *STROKES) if kind == "isometric" else (*STROKES, "pressure")
    present = [name for name in order if name in columns]
    moving = [name for name in present if np.ptp(columns[name]) > 0.0]
    name = (moving or present)[0]
    return name, signs[name] * columns[name]


def _parts(columns: Mapping[str, NDArray], signal: Array, noise: float, starts: tuple[int, ...]) -> list[int]:
    """First row of each continuous part, and the number of rows as the last item.

    A part ends at the end of a file, where time decreases, and where the group changes together with a jump
    of stroke or pressure.
    """
    rows = len(signal)
    breaks = [np.array(starts, dtype=np.intp)]
    if "time" in columns:
        breaks.append(np.flatnonzero(np.diff(columns["time"]) < 0.0) + 1)
    other = np.flatnonzero(np.diff(columns["group"])) + 1
    if len(other) < rows // _HOLD_ROWS:  # else the rows of a map, whose order has no meaning
        jumps = _jumps(signal, noise)
        for name in ("pressure", *STROKES):
            if name in columns:
                jumps |= _jumps(columns[name], noise_of(columns[name]))
        breaks.append(other[jumps[other - 1]])
    bounds = np.unique(np.concatenate([[0, rows], *breaks]))
    return bounds.tolist() if len(bounds) <= _MANY_PARTS else [0, rows]


def _jumps(values: Array, noise: float) -> NDArray[np.bool_]:
    """Whether a signal jumps from each row to the next."""
    return np.abs(np.diff(values)) > max(2.0 * _TURN * float(np.ptp(values)), 6.0 * noise)


def _detected(
    signal: Array, time: Array | None, bounds: list[int], noise: float, span: float
) -> tuple[NDArray[np.bool_], NDArray[np.int8]]:
    """(mask of the rows at which a sweep begins, direction of each row)."""
    begins = np.zeros(len(signal), bool)
    direction = np.zeros(len(signal), np.int8)
    for begin, end in pairwise(bounds):
        begins[begin] = True
        part = signal[begin:end]
        if span <= 0.0 or len(part) < 2:
            continue
        smooth, threshold = smoothed(part, noise=noise, swing=_TURN * span)
        begins[begin + 1 : end] |= turning_points(smooth, threshold=threshold)
        edges = [*np.flatnonzero(begins[begin:end]).tolist(), end - begin]
        clock = np.arange(len(part), dtype=float) if time is None else time[begin:end]
        direction[begin:end] = _directions(smooth, clock, edges, noise, threshold)
    return begins, direction


def _directions(
    smooth: Array, clock: Array, edges: list[int], noise: float, threshold: float
) -> NDArray[np.int8]:
    """Direction of each row of a part: that of its sweep, 0 where the signal rests."""
    rows = len(smooth)
    begin, end = np.array(edges[:-1]), np.array(edges[1:])
    lengths = end - begin
    # A sweep begins one row after the extreme, which belongs to the sweep before.
    change = smooth[end - 1] - smooth[np.maximum(begin - 1, 0)]
    lasted = clock[end - 1] - clock[np.maximum(begin - 1, 0)]
    moving = np.abs(change) > 0.5 * threshold
    result = np.repeat(np.where(moving, np.sign(change), 0.0), lengths).astype(np.int8)
    if not moving.any():
        return result
    usual = float(np.median(lengths[moving]))
    per_row = float(np.median(np.abs(change[moving]) / lengths[moving]))
    # The narrowest window that the noise of the slope allows.
    needed = (np.sqrt(2.0) * noise / (0.5 * _SLOW * per_row)) ** (2.0 / 3.0) if per_row > 0.0 else 1.0
    width = int(min(max(1.0, 0.005 * usual, needed), max(1.0, 0.1 * usual)))
    mean = running_mean(smooth, width)
    ahead, behind = np.minimum(np.arange(rows) + width, rows - 1), np.maximum(np.arange(rows) - width, 0)
    elapsed = clock[ahead] - clock[behind]
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = np.abs(mean[ahead] - mean[behind]) / elapsed
        sweep_speed = np.repeat(np.abs(change) / lasted, lengths)
    resting = (speed < _SLOW * sweep_speed) | ~moving.repeat(lengths)
    at_turn = np.zeros(rows, bool)
    at_turn[begin[1:]] = True
    result[_rests(resting, at_turn, usual)] = 0
    return result


def _rests(flags: NDArray[np.bool_], at_turn: NDArray[np.bool_], usual: float) -> NDArray[np.bool_]:
    """The flags without runs that are too short to be a hold; ``usual``: rows of a typical sweep."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    begin, end = edges[::2], edges[1::2]
    turns = np.concatenate([[0], np.cumsum(at_turn)])
    share = np.where(turns[end] > turns[begin], _HOLD_AT_TURN, _HOLD)
    kept = end - begin >= np.maximum(_HOLD_ROWS, share * usual)
    marks = np.zeros(len(flags) + 1, np.int64)
    np.add.at(marks, begin[kept], 1)
    np.add.at(marks, end[kept], -1)
    return np.cumsum(marks[:-1]) > 0


def _cycles(
    begins: NDArray[np.bool_], sweep: NDArray[np.int64], direction: NDArray[np.int8], bounds: list[int]
) -> NDArray[np.int64]:
    """Number of the cycle of each row."""
    first = np.flatnonzero(begins)
    total = np.add.reduceat(direction.astype(np.int64), first)
    side = np.sign(total)
    starts = np.zeros(len(first), bool)
    part = np.searchsorted(np.array(bounds), first, side="right")
    leading = 0
    for number in range(len(first)):
        if number == 0 or part[number] != part[number - 1]:
            leading, starts[number] = 0, True
        elif side[number] and side[number] == leading:
            starts[number] = True
        if not leading:
            leading = int(side[number])
    return (np.cumsum(starts) - 1)[sweep]


def _speed_levels(
    signal: Array, time: Array | None, sweep: NDArray[np.int64], direction: NDArray[np.int8]
) -> tuple[NDArray[np.int64], tuple[float, ...]]:
    """(level of each row, mean speed of each level) by gaps between the mean speeds of the sweeps."""
    moving = direction != 0
    if time is None:
        return moving.astype(np.int64), ()
    step = np.diff(time, prepend=time[0])
    inside = moving & np.concatenate([[False], (sweep[1:] == sweep[:-1]) & moving[:-1]])
    count = int(sweep[-1]) + 1
    # Sum of signed steps, so that noise does not add to the travel.
    signed = np.where(inside, np.diff(signal, prepend=signal[0]) * direction, 0.0)
    elapsed = np.bincount(sweep, np.where(inside, step, 0.0), count)
    travelled = np.bincount(sweep, signed, count)
    known = (elapsed > 0.0) & (travelled > 0.0)
    if not known.any():
        return moving.astype(np.int64), ()
    speeds = travelled[known] / elapsed[known]
    order = np.argsort(speeds)
    level_of_sorted = np.concatenate([[0], np.cumsum(np.diff(np.log(speeds[order])) > np.log(_SAME_SPEED))])
    level = np.zeros(count, np.int64)
    level[np.flatnonzero(known)[order]] = level_of_sorted + 1
    means = np.bincount(level_of_sorted, speeds[order]) / np.bincount(level_of_sorted)
    level[~known] = 1
    return np.where(moving, level[sweep], 0), tuple(means.tolist())
