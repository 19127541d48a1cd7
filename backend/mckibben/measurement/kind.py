"""Kind of a measurement and groups of its rows, detected from the values."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.derivative import noise_of, smoothed
from mckibben.physics.errors import InputError
from mckibben.physics.units import GRAVITY

Array = NDArray[np.float64]

KINDS = ("isobaric", "isometric", "isotonic", "diameter", "transient", "static")
FORCE_KINDS = ("isobaric", "isometric", "static")
#: The channels from which the length of the muscle follows, the most direct first.
STROKES = ("length", "contraction", "displacement")

_GRAIN = 0.01  # share of the range; readings within it are the same level
_MANY = 25  # levels from which the finer axis of a grid is a sweep rather than a map
_JUMP = 0.02  # change of the load to the next level, share of the range
_FEW_READINGS = 0.005  # share of the readings at either end that noise may carry farther
_HELD_SHARE = 0.7  # of the rows, in which a hanging weight pulls with its weight alone
_SECOND = 1.0  # s
_SLOW = 0.2  # of the range of the stroke in a second; a ramp through it takes longer than five
_SWING = 0.25  # s; a weight on a muscle swings in a few tenths of a second
_LITTLE = 0.01 * GRAVITY  # m/s2, 1 % of gravity; less does not show
_SWINGS = 0.025 * GRAVITY  # m/s2; a swing of a few tenths of a second that shows has more
_DENSE = 0.05  # s between rows
_RARELY = 0.05  # share of the way
_PAUSE = 5.0  # usual steps of time; longer ones are pauses
_CLOSE = 0.1  # s between rows, at most, where inertia shows
_FAR_APART = "a stated load, and rows too far apart to show its inertia"
_FEWEST_STEPS = 20  # of time, in which the speed shows
_FEWEST_IN_RUN = 5  # rows with the same load
_MANY_EXTREMES = 200_000  # limit of the loop over extremes; longer signals are reduced to blocks


def common_kind(one: str, other: str) -> str | None:
    """The kind of two measurements taken together; None where different quantities are predicted.

    Those whose force is predicted are together a static one: neither pressure nor length is held in all rows.
    """
    if one == other:
        return one
    return "static" if {one, other} <= set(FORCE_KINDS) else None


def explain_kind(columns: Mapping[str, NDArray], conditions: Mapping[str, float | str]) -> tuple[str, str]:
    """(kind, reason) of a measurement that does not state it.

    At a joint the torque stands for the force and the angle for the stroke where these were not measured.

    The rules in this order; "stroke" is length, contraction or displacement:

    1. time with a valve command: ``transient``; but where pressure, force and stroke were measured beside it
       and the stroke is held, ``isometric``: the pressure says what the valve did, and nothing moves.
    2. force, pressure and stroke: ``transient`` with time and a stated load mass, unless the force is
       constant and the muscle moves slowly or the rows are more than 0.1 s apart, and where stated weights
       are lifted fast; ``isotonic`` when the force is constant, throughout or in each run, and both others
       vary; ``isobaric``/``isometric`` when pressure/stroke is constant throughout. Otherwise the occupied
       1 % steps of both ranges are counted: a filled grid without time and direction is ``static`` (unless
       one axis is fine, >= 25 levels and 4 times the other); an axis with at most half the steps of the
       other is the constant one; without such an axis ``static``, or ``transient`` where over time the force
       leaves one level (2 %) in few rows only.
    3. diameter with pressure or stroke: ``diameter``.
    4. pressure and stroke: ``isotonic`` without time, or where a stated load moves slowly; else
       ``transient``.
    5. time with pressure or stroke: ``transient``.

    "Slowly" is by at most 20 % of the range within any second, on average between rows that are further
    apart: inertia and damping do not show. A stated load also moves slowly where its inertia is below 1 % of
    its weight along 95 % of the way, or below 2.5 % everywhere, and the rows are at least 50 ms apart:
    nothing swings, and without a damping that no file states a simulation would.

    Raises:
        InputError: no rule applies.
    """
    stroke, force = stroke_of(columns), columns.get("force", columns.get("torque"))
    pressure = columns.get("pressure")
    timed = "time" in columns
    if timed and "command" in columns and (pressure is not None or stroke is not None):
        if pressure is not None and stroke is not None and force is not None and not _loaded(conditions):
            found = _force_kind(pressure, stroke, force, swept=True)
            if found[0] == "isometric":
                return "isometric", f"{found[1]}, and the pressure shows what the valve did"
        return "transient", "a valve command over time"
    if "counter_pressure" in columns and force is not None and stroke is not None:
        return "static", "torque over angle of two muscles"
    if force is not None and pressure is not None and stroke is not None:
        slow = timed and _moves_slowly(columns["time"], stroke)
        if timed and "load_mass" in conditions and not (slow and _constant(force)):
            if _constant(force) and _usual_step(columns["time"]) > _CLOSE:
                return "isotonic", _FAR_APART
            return "transient", "force, pressure and stroke over time with a load mass"
        if lifts_fast(columns):
            return "transient", "weights are lifted fast: each run has one exact force, and inertia shows"
        found = _force_kind(pressure, stroke, force, swept=timed or "direction" in columns)
        if found[0] == "static" and slow and _held_load(force):
            return "isotonic", "the force stays at one level while pressure and stroke change slowly"
        if found[0] == "static" and timed and _held_load(force):
            return "transient", "the force leaves one level only briefly while pressure and stroke change"
        return found
    if "diameter" in columns and (pressure is not None or stroke is not None):
        return "diameter", "a diameter beside pressure or stroke"
    if pressure is not None and stroke is not None:
        if timed and _loaded(conditions):
            if _moves_slowly(columns["time"], stroke):
                return "isotonic", "pressure and stroke change slowly under a stated load"
            if _inertia_hidden(columns["time"], stroke):
                return "isotonic", "a stated load moves so evenly that its inertia does not show"
            if _usual_step(columns["time"]) > _CLOSE:
                return "isotonic", _FAR_APART
        return (
            ("transient", "pressure and stroke over time") if timed else ("isotonic", "strokes at pressures")
        )
    if timed and (pressure is not None or stroke is not None):
        return "transient", f"{'pressure' if stroke is None else 'stroke'} over time"
    raise InputError(
        f"no kind of measurement fits the columns {', '.join(columns)}",
        field="columns",
        hint="force measurements need pressure, length and force; strokes need pressure and length, or time",
    )


def stroke_of(columns: Mapping[str, NDArray]) -> NDArray | None:
    """What moves: the most direct of `STROKES`, else the angle at which a torque was measured."""
    stroke = next((columns[c] for c in STROKES if c in columns), None)
    return columns.get("angle") if stroke is None and "torque" in columns else stroke


def _loaded(conditions: Mapping[str, float | str]) -> bool:
    return bool({"load_mass", "load_force"} & set(conditions))


def weights_of_runs(columns: Mapping[str, NDArray]) -> Array | None:
    """The force of each row where it was stated and not measured: exactly one in each run, and no zero.

    A run ends where time steps back or pauses: nobody changes a weight between two rows.
    """
    force, time = columns.get("force"), columns.get("time")
    if force is None or time is None or len(force) < _FEWEST_STEPS or not np.min(force) > 0.0:
        return None
    apart = _run_ends(time)
    if np.any((np.diff(force) != 0.0) & ~apart):
        return None
    return force


def starts_of_lifts(columns: Mapping[str, NDArray]) -> tuple[int, ...]:
    """First row of each run of stated weights (`weights_of_runs`): each has its load and its beginning."""
    return (0, *(np.flatnonzero(_run_ends(columns["time"])) + 1).tolist())


def _run_ends(time: Array) -> NDArray[np.bool_]:
    """Whether a run ends with each row but the last: time steps back or pauses."""
    steps = np.diff(time)
    usual = float(np.median(steps[steps > 0.0])) if np.any(steps > 0.0) else 0.0
    return (steps < 0.0) | (steps > _PAUSE * usual)


def lifts_fast(columns: Mapping[str, NDArray]) -> bool:
    """Whether stated weights are lifted so fast that their inertia shows, and the rows are close enough."""
    weights = weights_of_runs(columns)
    stroke = next((columns[name] for name in STROKES if name in columns), None)
    if weights is None or stroke is None or not np.ptp(stroke) > 0.0:
        return False
    if not 0.0 < _usual_step(columns["time"]) <= _CLOSE:
        return False
    runs = np.split(np.arange(len(stroke)), starts_of_lifts(columns)[1:])
    span = float(np.ptp(stroke))
    return any(_fastest(columns["time"][rows], stroke[rows], span) > _SLOW * span for rows in runs)


def _fastest(time: Array, stroke: Array, span: float) -> float:
    """The most that a stroke changes in a second of a run, or at that speed in a quarter of a shorter one."""
    if len(time) < _FEWEST_STEPS or not time[-1] > time[0]:
        return 0.0
    step = (time[-1] - time[0]) / (len(time) - 1)
    ahead = max(1, min(round(_SECOND / step), len(time) // 4))
    calm, _ = smoothed(stroke, noise=noise_of(stroke), swing=_SLOW * span)
    return float(np.max(np.abs(calm[ahead:] - calm[:-ahead]))) / (ahead * step) * _SECOND


def _force_kind(pressure: Array, stroke: Array, force: Array, *, swept: bool) -> tuple[str, str]:
    if np.any(force) and not _steady(pressure) and not _constant_stroke(stroke):
        if _constant(force):
            return "isotonic", "the force is constant while pressure and stroke vary"
        if runs := _constant_runs(force, pressure, stroke):
            return "isotonic", f"the force is constant in each of {runs} runs while pressure and stroke vary"
    if _steady(pressure) != _constant_stroke(stroke):
        if _steady(pressure):
            return "isobaric", "the pressure is constant throughout"
        return "isometric", "the stroke is constant throughout"
    all_pressures, pressure_levels = _steps(pressure)
    all_strokes, stroke_levels = _steps(stroke)
    seen = f"{pressure_levels} levels of pressure, {stroke_levels} of stroke"
    if not swept and all_pressures * all_strokes <= 1.5 * len(force):
        few, many = sorted((all_pressures, all_strokes))
        if many < max(_MANY, 4 * few):
            return "static", f"a filled grid: {seen}"
    if 2 * pressure_levels <= stroke_levels:
        return "isobaric", f"few levels of pressure: {seen}"
    if 2 * stroke_levels <= pressure_levels:
        return "isometric", f"few levels of stroke: {seen}"
    return "static", f"neither pressure nor stroke is constant: {seen}"


def _constant(values: Array) -> bool:
    """Whether a pressure or force is constant within 2 % of its magnitude."""
    return bool(np.ptp(values) <= 0.02 * np.max(np.abs(values)))


def _steady(pressure: Array) -> bool:
    """Whether nearly all readings of a pressure are within 2 % of its magnitude; noise has no limit."""
    low, high = np.quantile(pressure, [_FEW_READINGS, 1.0 - _FEW_READINGS])
    return bool(high - low <= 0.02 * np.max(np.abs(pressure)))


def _held_load(force: Array) -> bool:
    """Whether most rows show one force: a weight that shakes only while it is moved."""
    level = float(np.median(force))
    return bool(level > 0.0 and np.mean(np.abs(force - level) <= 0.02 * level) >= _HELD_SHARE)


def _usual_step(time: Array) -> float:
    steps = np.diff(time)
    return float(np.median(steps[steps > 0.0])) if np.any(steps > 0.0) else 0.0


def _moves_slowly(time: Array, stroke: Array) -> bool:
    """Whether the stroke changes in any second by a small share of its range, noise apart."""
    steps = np.diff(time)
    steps = steps[steps > 0.0]
    span = float(np.ptp(stroke))
    if len(steps) < _FEWEST_STEPS or span == 0.0:
        return False
    step = float(np.median(steps))
    ahead = max(1, round(_SECOND / step))
    if ahead >= len(stroke):
        return False
    calm, _ = smoothed(stroke, noise=noise_of(stroke), swing=_SLOW * span)
    # A swing of one second is back after it, so parts of a second count as well.
    return all(
        _slow_over(rows, time, calm, step, span) for rows in {max(1, ahead // 4), max(1, ahead // 2), ahead}
    )


def _slow_over(ahead: int, time: Array, calm: Array, step: float, span: float) -> bool:
    """Whether a stroke changes slowly between rows that are some rows apart."""
    apart = np.abs(time[ahead:] - time[:-ahead])
    near = apart <= 2.0 * max(_SECOND, step)
    # Between rows that are further apart only the mean speed is known: no dynamics show in a log.
    moved = (np.abs(calm[ahead:] - calm[:-ahead]) / np.maximum(apart / _SECOND, 1.0))[near]
    return bool(len(moved) and np.max(moved) <= _SLOW * span)


def _inertia_hidden(time: Array, stroke: Array) -> bool:
    """Whether a weight accelerates by less than 1 % of gravity along nearly all its way or swings nowhere."""
    steps = np.diff(time)
    steps = steps[steps > 0.0]
    if len(steps) < _FEWEST_STEPS or not np.ptp(stroke) > 0.0:
        return False
    step = float(np.median(steps))
    if step < _DENSE:  # a dense record shows damping, and its simulation is quick
        return False
    ahead = max(1, round(_SWING / step))
    if len(stroke) <= 2 * ahead + _FEWEST_STEPS:
        return False
    curved, way = _bends(time, stroke, ahead, step)
    quick = curved > _LITTLE
    if len(way) >= _FEWEST_STEPS and np.sum(way[quick]) < _RARELY * np.sum(way):
        return True
    # A second difference is blind to swings that are back after its step: two steps see all of them.
    shorter, _ = _bends(time, stroke, max(1, round(2 * ahead / 3)), step)
    return len(way) >= _FEWEST_STEPS and bool(max(np.max(curved), np.max(shorter)) < _SWINGS)


def _bends(time: Array, stroke: Array, ahead: int, step: float) -> tuple[Array, Array]:
    """Acceleration by rows some rows apart, unsigned, and the way between them, where time is even."""
    even = np.abs(time[2 * ahead :] - time[: -2 * ahead] - 2 * ahead * step) < 0.5 * ahead * step
    curved = np.abs(stroke[2 * ahead :] - 2.0 * stroke[ahead:-ahead] + stroke[: -2 * ahead])[even]
    way = np.abs(stroke[2 * ahead :] - stroke[: -2 * ahead])[even]
    return curved / (ahead * step) ** 2, way


def _constant_runs(force: Array, pressure: Array, stroke: Array) -> int:
    """Number of runs with a constant load and varying pressure and stroke; 0 if one run is not like that."""
    jumps = np.flatnonzero(np.abs(np.diff(force)) > _JUMP * np.ptp(force)) + 1
    runs = np.split(np.arange(len(force)), jumps)
    largest = np.max(np.abs(force))
    for rows in runs:
        if len(rows) < _FEWEST_IN_RUN or np.ptp(force[rows]) > _GRAIN * largest:
            return 0
        if any(np.ptp(values[rows]) < 0.2 * np.ptp(values) for values in (pressure, stroke)):
            return 0
    return len(runs)


def _constant_stroke(values: Array) -> bool:
    """Whether the stroke is constant: within 0.5 % of a length, 0.5 mm, or 0.0005 of contraction."""
    return bool(np.ptp(values) <= max(0.005 * np.median(values), 0.0005))


def _steps(values: Array) -> tuple[int, int]:
    """Number of occupied 1 % steps of the range, and of those that contain 95 % of the rows."""
    span = np.ptp(values)
    if span == 0.0:
        return 1, 1
    counts = np.bincount(np.rint((values - np.min(values)) / span / _GRAIN).astype(np.intp))
    counts = np.sort(counts[counts > 0])[::-1]
    return len(counts), int(np.searchsorted(np.cumsum(counts), 0.95 * len(values)) + 1)


def group_rows(columns: Mapping[str, NDArray], kind: str) -> tuple[NDArray[np.int64], str]:
    """Group label of each row, shape (rows,), and the rule in words.

    A group column of the file takes precedence. Otherwise ``static`` and ``isobaric`` are grouped by
    pressure and ``isometric`` by stroke. Levels are separated by gaps of more than 1 % of the range, and
    labels ascend with the level. In all other cases, and if there is one level or more levels than half the
    rows, every sweep is a group. A sweep ends where the direction channel changes, or where the swept
    quantity turns by more than 10 % of its range (stroke of ``static``/``isobaric``; else the first of
    pressure, stroke and command).
    """
    if "group" in columns:
        return np.array(columns["group"], dtype=np.int64), "by the group column"
    stroke = stroke_of(columns)
    pressure = columns.get("pressure")
    signal = next(v for v in (pressure, stroke, columns.get("command")) if v is not None)
    if kind in FORCE_KINDS and pressure is not None and stroke is not None:
        by_stroke = kind == "isometric"
        constant, signal = (stroke, pressure) if by_stroke else (pressure, stroke)
        labels = _levels(constant)
        one_level = _constant_stroke(stroke) if by_stroke else _constant(pressure)
        if not one_level and 0 < labels.max() < max(1, len(labels) // 2):
            return labels, f"by {'stroke' if by_stroke else 'pressure'}"
    direction = columns.get("direction")
    turns = _turns(signal) if direction is None or np.ptp(direction) == 0.0 else np.diff(direction) != 0.0
    return np.concatenate([[0], np.cumsum(turns)]).astype(np.int64), "by sweep (reversals)"


def _levels(values: Array) -> NDArray[np.int64]:
    order = np.argsort(values, kind="stable")
    labels = np.empty(len(values), np.int64)
    gaps = np.diff(values[order]) > _GRAIN * np.ptp(values)
    labels[order] = np.concatenate([[0], np.cumsum(gaps)])
    return labels


def _turns(values: Array) -> NDArray[np.bool_]:
    """Whether the signal turns after each row but the last, by at least 10 % of its range.

    A signal whose noise could cause such turns is smoothed first.
    """
    calm, threshold = smoothed(values, noise=noise_of(values), swing=0.1 * float(np.ptp(values)))
    return turning_points(calm, threshold=threshold)


def turning_points(values: Array, *, threshold: float) -> NDArray[np.bool_]:
    """Whether the signal turns after each row but the last: at an extreme that it leaves by the threshold.

    A hysteresis filter: swings smaller than the threshold are not turns. Only local extremes are examined; in
    a long signal only the lowest and highest rows of short blocks, so that swings shorter than a block are
    missed.
    """
    turns = np.zeros(len(values) - 1, bool)
    extremes = np.flatnonzero(np.diff(np.sign(np.diff(values)))) + 1
    if len(extremes) > _MANY_EXTREMES:
        extremes = _block_extremes(values, -(-2 * len(values) // _MANY_EXTREMES))
    low = high = (float(values[0]), 0)
    rising: bool | None = None
    for index in (*extremes.tolist(), len(values) - 1):
        point = (float(values[index]), index)
        low, high = min(low, point), max(high, point)
        if rising is not False and high[0] - point[0] > threshold:
            if rising:
                turns[high[1]] = True
            rising, low = False, point
        elif rising is not True and point[0] - low[0] > threshold:
            if rising is False:
                turns[low[1]] = True
            rising, high = True, point
    return turns


def _block_extremes(values: Array, size: int) -> NDArray[np.intp]:
    """Rows of the lowest and the highest value of each block, ascending."""
    whole = len(values) // size * size
    blocks = values[:whole].reshape(-1, size)
    first = np.arange(0, whole, size)
    rest = np.arange(whole, len(values))
    return np.unique(np.concatenate([first + blocks.argmin(1), first + blocks.argmax(1), rest]))
