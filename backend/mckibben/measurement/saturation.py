"""Rows in which a sensor does not show what it should: clipped at an end of its range, or stuck.

A run of identical values is no proof: a held pressure, a set point, rest and coarse rounding give them too.
Two things are. Noise elsewhere: where a sensor flickers from row to row, a long run without any flicker is
no reading. And an abrupt stop: the signal runs on undiminished until it stands still, at a corner, while the
other channels keep their pace.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import noise_of, rounding_step
from mckibben.measurement.kind import FORCE_KINDS, STROKES

Array = NDArray[np.float64]

_SENSORS = ("pressure", "force", *STROKES, "diameter", "velocity")
_SHORTEST = 5  # rows
_STUCK = 20  # rows: away from the ends of the range a sensor must stand still for longer
_CHANCE = 1e-4  # that noise alone gives such a run somewhere in the file
_FLICKER = 1.0  # rounding steps: with less noise a held signal may well not flicker
_MOVES = 0.02  # of the range: less, and another channel rests
_REPEATS = 0.2  # share of equal neighbours elsewhere from which a signal is often at rest
_APPROACH = 0.05  # of the range: how near the corner is looked at
_CORNER = 0.3  # a fifth of the way in less than this share of the rows: the signal did not slow down
_PACE = 0.25  # of the pace before: slower, and the other channels have stopped as well
_SET_POINTS = 50  # a signal that stands at more levels than these is made to
_MANY_RUNS = 2000
_PUSH = 0.01  # of the largest force: a force that far below zero is no zero error of a good load cell
_MOSTLY = 0.2  # share of rows below zero from which it is the zero that is wrong
_EXAMINED = 200  # runs of one value; more are judged by these

#: What may stand still because the muscle does, or because the test holds it.
_MAY_REST: Mapping[str, tuple[str, ...]] = {
    "isobaric": ("pressure", *STROKES, "diameter", "velocity"),
    "isometric": (*STROKES, "diameter", "velocity"),
    "isotonic": ("force", *STROKES, "diameter", "velocity"),
}


class _Runs(NamedTuple):
    """Runs of equal neighbours: first row and row after the last."""

    begin: NDArray[np.intp]
    end: NDArray[np.intp]

    @property
    def rows(self) -> NDArray[np.intp]:
        return self.end - self.begin

    def only(self, keep: NDArray[np.bool_]) -> _Runs:
        return _Runs(self.begin[keep], self.end[keep])


def unusable_rows(
    columns: Mapping[str, NDArray], kind: str, *, slack: NDArray[np.bool_]
) -> dict[str, NDArray[np.bool_]]:
    """Reason -> bool array, shape (rows,), of the rows of saturated or stuck sensors; empty when all is well.

    Args:
        columns: channels in SI.
        kind: of the measurement; a map without time and direction is in no order and is not judged.
        slack: rows without pulling force, whose force may well be the same.
    """
    rows = len(slack)
    if kind == "static" and "time" not in columns and "direction" not in columns:
        return {}
    found: dict[str, NDArray[np.bool_]] = {}
    sensors = {name: columns[name] for name in _SENSORS if name in columns and np.ptp(columns[name]) > 0.0}
    for name, values in sensors.items():
        others = [other for key, other in sensors.items() if key != name]
        may_rest = name in _MAY_REST.get(kind, (*STROKES, "diameter", "velocity"))
        if name == "force" and kind in FORCE_KINDS:
            level = _noisy_ceiling(values, others)
            if level.any():
                found["force saturated"] = level
                continue
        runs = _runs(values)
        runs = runs.only(runs.rows >= _SHORTEST)
        if name == "force" and len(runs.begin):
            runs = runs.only(~slack[runs.begin])
        if not len(runs.begin):
            continue
        bad = _judged(values, runs, others, may_rest=may_rest)
        at_end = _at_end(values, bad)
        for reason, chosen in (("saturated", at_end), ("stuck", ~at_end)):
            if chosen.any():
                found[f"{name} {reason}"] = _mask(bad.only(chosen), rows)
    return found


def pushing_rows(force: Array) -> NDArray[np.bool_]:
    """Rows in which the muscle pushes, shape (rows,); a model of its pull has nothing to say about them.

    A force that falls further and further below zero is no noise, and no wrong zero either: behind that a
    slack muscle shows one and the same force. Where more than a fifth of the rows are below zero it is the
    zero that is wrong, and no row is marked.

    Args:
        force: [N], rows that follow each other, so that their scatter is noise.
    """
    noise, largest = noise_of(force), float(np.max(np.abs(force)))
    clear = max(5.0 * noise, _PUSH * largest)
    below = force < -clear
    none = np.zeros(len(force), bool)
    if not np.any(below) or np.mean(force < 0.0) > _MOSTLY:
        return none
    if np.subtract(*np.quantile(force[below], (0.75, 0.25))) < clear:  # all of them alike: slack
        return none
    return force < -max(3.0 * noise, 0.1 * _PUSH * largest)


def _noisy_ceiling(force: Array, others: list[Array]) -> NDArray[np.bool_]:
    """Rows at the upper end of a load cell's range whose noise was added behind it, shape (rows,).

    There the force keeps one level but for its noise, although another channel goes on so far that it would
    have risen clearly. The lower end of a force is a slack muscle.
    """
    noise = noise_of(force)
    if noise == 0.0 or np.count_nonzero(force == np.max(force)) >= _SHORTEST:  # cut off behind the noise
        return np.zeros(len(force), bool)
    top = float(np.median(force[force >= np.max(force) - 8.0 * noise]))
    above = np.where(force >= top - 5.0 * noise, top, force)
    runs = _runs(above)
    runs = runs.only((above[runs.begin] == top) & (runs.rows >= 3 * _SHORTEST))
    clear = 10.0 * noise / float(np.ptp(force))
    kept = (
        _level(force[begin:end], noise) and any(_way(other, begin, end) > clear for other in others)
        for begin, end in zip(*runs, strict=True)
    )
    if not any(kept):
        return np.zeros(len(force), bool)
    return force >= top - 3.0 * noise  # in short visits too


def _level(values: Array, noise: float) -> bool:
    """Whether nothing but noise moves these values: neither a slope nor a tip."""
    thirds = [float(np.mean(part)) for part in np.array_split(values, 3)]
    return max(thirds) - min(thirds) < 5.0 * noise / np.sqrt(len(values) / 3.0)


def _way(values: Array, begin: int, end: int) -> float:
    """How far a channel goes in these rows without its noise, as a share of its range."""
    fifths = [float(np.mean(part)) for part in np.array_split(values[begin:end], 5)]
    return (max(fifths) - min(fifths)) / float(np.ptp(values))


def _runs(values: Array) -> _Runs:
    edges = np.flatnonzero(np.diff(values) != 0.0) + 1
    return _Runs(np.concatenate([[0], edges]), np.concatenate([edges, [len(values)]]))


def _at_end(values: Array, runs: _Runs) -> NDArray[np.bool_]:
    """Whether a run stands at the largest or smallest value there is."""
    level = values[runs.begin]
    return (level == np.max(values)) | (level == np.min(values))


def _mask(runs: _Runs, rows: int) -> NDArray[np.bool_]:
    marks = np.zeros(rows + 1, np.int64)
    np.add.at(marks, runs.begin, 1)
    np.add.at(marks, runs.end, -1)
    return np.cumsum(marks[:-1]) > 0


def _judged(values: Array, runs: _Runs, others: list[Array], *, may_rest: bool) -> _Runs:
    """Those of the runs that are no readings."""
    long_ago = _mask(runs, len(values))
    equal = (np.diff(values) == 0.0) & ~(long_ago[1:] & long_ago[:-1])
    elsewhere = max(1, len(values) - 1 - int(np.count_nonzero(long_ago)))
    repeats = np.count_nonzero(equal) / elsewhere
    # A reading that only moves slowly leaves a run by one step; a stuck sensor has to catch up.
    away = 3.0 * max(rounding_step(values[~long_ago]), noise_of(values[~long_ago]))
    arriving = np.abs(values[runs.begin] - values[np.maximum(runs.begin - 1, 0)])
    leaving = np.abs(values[np.minimum(runs.end, len(values) - 1)] - values[runs.begin])
    stuck = (runs.rows >= _STUCK) & (np.maximum(arriving, leaving) > away)
    runs = runs.only(stuck | _at_end(values, runs))
    if not len(runs.begin):
        return runs
    flickers = _flickers(values, long_ago)
    if flickers and repeats < 0.9:
        longest = np.log(_CHANCE / len(values)) / np.log(max(repeats, 1e-3))
        runs = runs.only(runs.rows > np.maximum(longest, _SHORTEST))
        if len(runs.begin) > _MANY_RUNS:
            return runs  # too many to be chance, whatever the others do
        return runs.only(
            np.array([_moving(begin, end, others) for begin, end in zip(*runs, strict=True)], bool)
        )
    keep = np.zeros(len(runs.begin), bool)
    levels = np.unique(values[runs.begin])
    if may_rest or repeats > _REPEATS or len(levels) > _SET_POINTS:
        return runs.only(keep)
    for value in levels:
        same = np.flatnonzero(values[runs.begin] == value)
        looked = same[np.linspace(0, len(same) - 1, min(len(same), _EXAMINED)).astype(int)]
        verdicts = [_cornered(values, int(runs.begin[i]), int(runs.end[i]), others) for i in looked]
        keep[same] = np.mean(verdicts) > 0.5
    return runs.only(keep)


def _moving(begin: int, end: int, others: list[Array]) -> bool:
    """Whether another channel moves in these rows: its first and last rows differ by more than its noise."""
    tail = max(1, (end - begin) // 5)
    for other in others:
        inside = other[begin:end]
        means = [float(np.mean(part)) for part in np.array_split(inside, max(2, len(inside) // tail))]
        scatter = 6.0 * float(np.std(np.diff(inside))) / np.sqrt(tail)
        if np.ptp(means) > max(_MOVES * float(np.ptp(other)), scatter):
            return True
    return False


def _flickers(values: Array, long_ago: NDArray[np.bool_]) -> bool:
    """Whether the sensor's noise moves it from row to row, so that it never stands still by itself."""
    rest = values[~long_ago]
    noise, step = noise_of(rest), rounding_step(rest)
    # Without a visible step: noise that is far above what smooth numbers leave.
    return noise > _FLICKER * step if step > 0.0 else noise > 1e-5 * float(np.ptp(values)) and _rough(rest)


def _rough(values: Array) -> bool:
    """Whether neighbouring steps change sign as noise does (two in three), not as a smooth signal."""
    steps = np.diff(values)
    return len(steps) > _STUCK and float(np.mean(steps[1:] * steps[:-1] < 0.0)) > 0.2


def _cornered(values: Array, begin: int, end: int, others: list[Array]) -> bool:
    """Whether the signal comes to this run, or leaves it, at a corner while another keeps its pace."""
    before = _abrupt(values[max(0, begin - 20 * (end - begin) - 100) : begin + 1][::-1], np.ptp(values))
    after = _abrupt(values[end - 1 : end + 20 * (end - begin) + 100], np.ptp(values))
    for reach, back in ((before, True), (after, False)):
        if not reach:
            continue
        beside = slice(max(0, begin - reach), begin + 1) if back else slice(end - 1, end + reach)
        for other in others:
            moved, kept = np.ptp(other[beside]), np.ptp(other[begin:end])
            expected = moved / max(1, reach) * min(end - begin, 4 * reach)
            if moved > 0.0 and kept > _PACE * expected and kept > 0.01 * np.ptp(other):
                return True
    return False


def _abrupt(leaving: Array, span: float) -> int:
    """Rows a signal takes to leave its first value for good, if it does so at a corner; else 0."""
    distance = np.abs(leaving - leaving[0])
    far = np.flatnonzero(distance >= _APPROACH * span)
    if not len(far):
        return 0
    near = np.flatnonzero(distance >= _APPROACH * span / 5.0)
    return int(far[0]) if far[0] >= 3 and near[0] <= max(1.0, _CORNER * far[0]) else 0
