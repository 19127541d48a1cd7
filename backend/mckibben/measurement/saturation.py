"""Detection of rows with a faulty sensor: saturated at an end of its range, or stuck.

A run of identical values alone is no evidence: a constant pressure, a set point, rest and coarse rounding
cause it too. There are two criteria. Missing noise: if a sensor is noisy elsewhere, a long run without noise
is a fault. An abrupt stop: the signal changes at a constant rate, then suddenly not at all, while other
channels continue to change.
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
_SHORTEST = 5  # rows of a run
_STUCK = 20  # rows of a run away from the ends of the range
_CHANCE = 1e-4  # probability that noise alone causes such a run in the file
_FLICKER = 1.0  # rounding steps; a resting signal with less noise may be constant
_MOVES = 0.02  # share of the range; a channel with a smaller change is at rest
_REPEATS = 0.2  # share of equal neighbours elsewhere, above which a signal is often at rest
_APPROACH = 0.05  # share of the range that is examined next to a corner
_CORNER = 0.3  # largest share of these rows for the first fifth of the change; more means a smooth stop
_PACE = 0.25  # rate over the rate before, below which another channel has stopped as well
_SET_POINTS = 50  # levels; a signal constant at more levels is controlled
_MANY_RUNS = 2000  # more runs cannot be chance
_PUSH = 0.01  # of the largest force: more than the zero error of a good load cell
_MOSTLY = 0.2  # share of rows below zero, above which the zero of the load cell is wrong
_GOES_ON = 0.05  # share of the range of another channel, in a run at the largest force
_HARDLY = 0.2  # range over the largest value, below which a channel hardly varies
_COARSE = 0.01  # rounding step over the range, from which it may hide a change of the force
_EXAMINED = 200  # runs examined per level; the others get the same verdict

#: Channels that may be constant because the muscle rests or the test holds them.
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
    """Reason -> bool array, shape (rows,), of the rows with a saturated or stuck sensor; empty without
    faults.

    Args:
        columns: channels in SI.
        kind: of the measurement; a map without time and direction has no order and is not checked.
        slack: rows in which the muscle is slack, whose force may be constant.
    """
    rows = len(slack)
    if kind == "static" and "time" not in columns and "direction" not in columns:
        return {}
    faults: dict[str, NDArray[np.bool_]] = {}
    sensors = {name: columns[name] for name in _SENSORS if name in columns and np.ptp(columns[name]) > 0.0}
    for name, values in sensors.items():
        others = [other for key, other in sensors.items() if key != name]
        may_rest = name in _MAY_REST.get(kind, (*STROKES, "diameter", "velocity"))
        if name == "force" and kind in FORCE_KINDS:
            ceiling = _noisy_ceiling(values, others)
            if ceiling.any():
                faults["force saturated"] = ceiling
                continue
        runs = _runs(values)
        runs = runs.only(runs.rows >= _SHORTEST)
        if name == "force" and len(runs.begin):
            runs = runs.only(~slack[runs.begin] & (values[runs.begin] != 0.0))  # exactly 0: it is slack
        if not len(runs.begin):
            continue
        bad = _judged(values, runs, others, may_rest=may_rest)
        if name == "force" and kind in FORCE_KINDS and not len(bad.begin):
            bad = _at_ceiling(values, runs, others)
            if len(bad.begin):  # a single row there is one as well
                faults["force saturated"] = values == np.max(values)
                continue
        at_end = _at_end(values, bad)
        for reason, chosen in (("saturated", at_end), ("stuck", ~at_end)):
            if chosen.any():
                faults[f"{name} {reason}"] = _mask(bad.only(chosen), rows)
    return faults


def pushing_rows(force: Array) -> NDArray[np.bool_]:
    """Mask of the rows in which the muscle pushes, shape (rows,); a model of its tension cannot predict them.

    A force that varies clearly below zero is neither noise nor a zero error: with a zero error, a slack
    muscle shows a constant force. If more than a fifth of the rows are below zero, the zero is wrong and no
    row is marked.

    Args:
        force: [N], in the order of measurement, so that its scatter is noise.
    """
    noise, largest = noise_of(force), float(np.max(np.abs(force)))
    clear = max(5.0 * noise, _PUSH * largest)
    below = force < -clear
    none = np.zeros(len(force), bool)
    if not np.any(below) or np.mean(force < 0.0) > _MOSTLY:
        return none
    if np.subtract(*np.quantile(force[below], (0.75, 0.25))) < clear:  # all nearly equal: slack
        return none
    return force < -max(3.0 * noise, 0.1 * _PUSH * largest)


def _noisy_ceiling(force: Array, others: list[Array]) -> NDArray[np.bool_]:
    """Mask of the rows with a saturated load cell whose noise arises after the saturation, shape (rows,).

    The force is constant except for noise, although another channel changes so much that the force should
    rise. A constant force at the lower end is a slack muscle.
    """
    noise = noise_of(force)
    if (
        noise == 0.0 or np.count_nonzero(force == np.max(force)) >= _SHORTEST
    ):  # clipped after the noise was added
        return np.zeros(len(force), bool)
    top = float(np.median(force[force >= np.max(force) - 8.0 * noise]))
    above = np.where(force >= top - 5.0 * noise, top, force)
    runs = _runs(above)
    runs = runs.only((above[runs.begin] == top) & (runs.rows >= 3 * _SHORTEST))
    clear = 10.0 * noise / float(np.ptp(force))
    level = [
        end - begin if _level(force[begin:end], noise) else begin - end
        for begin, end in zip(*runs, strict=True)
        if any(_change(other, begin, end) > clear for other in others)
    ]
    if not sum(level) > 0:  # the top of a slow swing is level by chance here and there, but not in most rows
        return np.zeros(len(force), bool)
    return force >= top - 3.0 * noise  # short saturated intervals too


def _at_ceiling(force: Array, runs: _Runs, others: list[Array]) -> _Runs:
    """The runs at the largest force, to the last digit, while another channel goes on.

    Where a muscle pulls most its force changes most with length and pressure, so it cannot stay equal there,
    however smooth or noisy the signal is; only a coarse rounding hides a change.
    """
    runs = runs.only(force[runs.begin] == np.max(force))
    if rounding_step(force) > _COARSE * float(np.ptp(force)):
        return runs.only(np.zeros(len(runs.begin), bool))
    moves = [
        any(_change(other, begin, end) > _GOES_ON for other in others)
        for begin, end in zip(*runs, strict=True)
    ]
    return runs.only(np.array(moves, bool))


def _level(values: Array, noise: float) -> bool:
    """Whether these values are constant except for noise: without slope or peak."""
    thirds = [float(np.mean(part)) for part in np.array_split(values, 3)]
    return max(thirds) - min(thirds) < 5.0 * noise / np.sqrt(len(values) / 3.0)


def _change(values: Array, begin: int, end: int) -> float:
    """Change of a channel in these rows, as a share of its range; 0 where its noise explains it.

    What varies little at all, as a pressure that is controlled, is related to its size.
    """
    parts = np.array_split(values[begin:end], 5)
    fifths = [float(np.mean(part)) for part in parts]
    change = max(fifths) - min(fifths)
    by_chance = 5.0 * noise_of(values) / np.sqrt(len(parts[-1]) or 1.0)
    whole = max(float(np.ptp(values)), _HARDLY * float(np.max(np.abs(values))))
    return change / whole if change > by_chance else 0.0


def _runs(values: Array) -> _Runs:
    edges = np.flatnonzero(np.diff(values) != 0.0) + 1
    return _Runs(np.concatenate([[0], edges]), np.concatenate([edges, [len(values)]]))


def _at_end(values: Array, runs: _Runs) -> NDArray[np.bool_]:
    """Whether a run is at the largest or smallest value of the signal."""
    level = values[runs.begin]
    return (level == np.max(values)) | (level == np.min(values))


def _mask(runs: _Runs, rows: int) -> NDArray[np.bool_]:
    marks = np.zeros(rows + 1, np.int64)
    np.add.at(marks, runs.begin, 1)
    np.add.at(marks, runs.end, -1)
    return np.cumsum(marks[:-1]) > 0


def _judged(values: Array, runs: _Runs, others: list[Array], *, may_rest: bool) -> _Runs:
    """The runs that are faults of the sensor."""
    in_run = _mask(runs, len(values))
    equal = (np.diff(values) == 0.0) & ~(in_run[1:] & in_run[:-1])
    elsewhere = max(1, len(values) - 1 - int(np.count_nonzero(in_run)))
    repeats = np.count_nonzero(equal) / elsewhere
    # A slow signal leaves a run by one rounding step; a stuck sensor jumps to the true value.
    away = 3.0 * max(rounding_step(values[~in_run]), noise_of(values[~in_run]))
    arriving = np.abs(values[runs.begin] - values[np.maximum(runs.begin - 1, 0)])
    leaving = np.abs(values[np.minimum(runs.end, len(values) - 1)] - values[runs.begin])
    stuck = (runs.rows >= _STUCK) & (np.maximum(arriving, leaving) > away)
    runs = runs.only(stuck | _at_end(values, runs))
    if not len(runs.begin):
        return runs
    flickers = _flickers(values, in_run)
    if flickers and repeats < 0.9:
        longest = np.log(_CHANCE / len(values)) / np.log(max(repeats, 1e-3))
        runs = runs.only(runs.rows > np.maximum(longest, _SHORTEST))
        if len(runs.begin) > _MANY_RUNS:
            return runs  # too many to be chance, whatever the other channels show
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
    """Whether another channel changes in these rows by more than its noise."""
    tail = max(1, (end - begin) // 5)
    for other in others:
        inside = other[begin:end]
        means = [float(np.mean(part)) for part in np.array_split(inside, max(2, len(inside) // tail))]
        scatter = 6.0 * float(np.std(np.diff(inside))) / np.sqrt(tail)
        if np.ptp(means) > max(_MOVES * float(np.ptp(other)), scatter):
            return True
    return False


def _flickers(values: Array, in_run: NDArray[np.bool_]) -> bool:
    """Whether the noise of the sensor is so large that successive readings differ."""
    rest = values[~in_run]
    noise, step = noise_of(rest), rounding_step(rest)
    # Without visible rounding: noise far above the third differences of a smooth signal.
    return noise > _FLICKER * step if step > 0.0 else noise > 1e-5 * float(np.ptp(values)) and _rough(rest)


def _rough(values: Array) -> bool:
    """Whether successive steps change sign often, as those of noise do (two in three)."""
    steps = np.diff(values)
    return len(steps) > _STUCK and float(np.mean(steps[1:] * steps[:-1] < 0.0)) > 0.2


def _cornered(values: Array, begin: int, end: int, others: list[Array]) -> bool:
    """Whether the signal enters or leaves this run at a corner while another channel keeps its rate."""
    before = _abrupt(values[max(0, begin - 20 * (end - begin) - 100) : begin + 1][::-1], np.ptp(values))
    after = _abrupt(values[end - 1 : end + 20 * (end - begin) + 100], np.ptp(values))
    for reach, back in ((before, True), (after, False)):
        if not reach:
            continue
        beside = slice(max(0, begin - reach), begin + 1) if back else slice(end - 1, end + reach)
        for other in others:
            change, change_in_run = np.ptp(other[beside]), np.ptp(other[begin:end])
            expected = change / max(1, reach) * min(end - begin, 4 * reach)
            if change > 0.0 and change_in_run > _PACE * expected and change_in_run > 0.01 * np.ptp(other):
                return True
    return False


def _abrupt(leaving: Array, span: float) -> int:
    """Number of rows in which a signal leaves its first value, if it does so at a corner; else 0."""
    distance = np.abs(leaving - leaving[0])
    far = np.flatnonzero(distance >= _APPROACH * span)
    if not len(far):
        return 0
    near = np.flatnonzero(distance >= _APPROACH * span / 5.0)
    return int(far[0]) if far[0] >= 3 and near[0] <= max(1.0, _CORNER * far[0]) else 0
