"""The rows of a measurement that a model can predict, with the inputs of the model.

| kind | given | predicted |
|---|---|---|
| isobaric, isometric, static | pressure, length (and time, where rates or memory matter) | force |
| isotonic | pressure, load | length |
| diameter | length, or pressure of a free muscle | diameter |
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mckibben.measurement.measurement import FORCE_KINDS, STROKES, Measurement, lengths
from mckibben.measurement.motion import RecordedMotion, held_directions, motion_of
from mckibben.measurement.settled import settled
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.physics.muscle import Muscle
from mckibben.physics.units import GRAVITY

_LONGEST_SHARE = 0.9999  # longest length over the thread length, at which the braid locks
_NEW_LEVEL = 0.05  # change of the constant quantity from row to row, share of its range
_FORGOTTEN = 0.15  # travel after which friction no longer depends on the history, share of the swept range
_PAUSE = 3.0  # time step over the median one, above which the recording paused
_MOTION = 0.01  # shortest travel of a motion, share of the range of lengths; less is noise
_MANY_ROWS = 20  # rows of a record from which its first one can be spared
_SHORT = 0.3  # share of the next step; a shorter one next to a reversal hides a part of the way
_REAL_STEP = 0.3  # share of a usual step; smaller ones are noise at rest
_UNRESOLVED = 0.15  # share of a usual step; a row nearer to a reversal shows neither of its sides
_SWING = 2.0  # usual steps of a reversal; less is noise
_FEW_NEAR = 3  # rows near a reversal; more resolve it
_READ = 0.5  # share of the rows at which a load that is read changes
_PRESSED = ("isometric", "isotonic")  # kinds in which the pressure moves
_PRESCRIBED = ("isobaric", "static")  # kinds in which the length is prescribed and moves

# The velocity of a row counts as a jump if its uncertainty exceeds both
_UNSURE = 5.0  # times the median uncertainty and
_JUMP = 0.05  # times the speed of the neighbouring rows.
_STILL = 0.25  # speed over that of both neighbours, below which the motion turns
_SUDDEN = 4.0  # change of velocity over the changes before and after, above which it is a jump
_FEW = 0.1  # largest share of rows with jumps; above, the velocity is simply noisy
_CORNER = 0.2  # change of the speed at a row, as a share of the usual speed, from which it may be a corner
_BEYOND = 6.0  # the same over its median at all rows
_MOST_CORNERS = 0.3  # largest share of rows beside corners; above, no way is straight enough to tell


@dataclass(frozen=True)
class ComparableRows:
    """The comparable rows of a measurement, with the inputs of the model.

    Attributes:
        kind: kind of the measurement.
        channel: name of the predicted channel.
        unit: its SI unit.
        measured: its values, shape (rows used,).
        state: inputs of the model (`mckibben.simulation.statics.compiled.INPUTS`), of the same shape, and
            "load" where the length is predicted.
        time: of each row since its record began [s]; None where the rows have no order in time.
        records: label of the uninterrupted record that each row belongs to; rows of a record are in order.
        groups: group label of each row.
        turning: mask of the rows whose friction is unknown, because the motion turns, its speed jumps or the
            history is unknown. They are not scored, but they belong to the path of effects with memory.
        rows: index of each row in the measurement.
        excluded: reason -> number of excluded rows.
        unknown_load: whether the load is not stated and has to be fitted.
        load_read: whether a sensor read the load, so that it has the errors of a force sensor.
        reversing: mask of those of ``turning`` at which the motion turns: dry friction may have any value of
            its range there; None without any.
        messages: the assumptions.
        rest_length: the nominal length that the lengths are calculated with [m].
        by_rest_length: derivative of each length by it: 0 where the length itself is measured, 1 for a
            displacement, 1 - contraction for a contraction.
        corners: mask of the rows that were put between those of the file, see
            `mckibben.identification.predict.quasistatic`; None without any.
        ordered: the rows follow each other as in the test, with or without time.
    """

    kind: str
    channel: str
    unit: str
    measured: np.ndarray
    state: Mapping[str, np.ndarray]
    time: np.ndarray | None
    records: np.ndarray
    groups: np.ndarray
    turning: np.ndarray
    rows: np.ndarray
    excluded: Mapping[str, int]
    unknown_load: bool
    messages: tuple[str, ...]
    rest_length: float = 0.0
    by_rest_length: np.ndarray | float = 0.0
    corners: np.ndarray | None = None
    ordered: bool = False
    load_read: bool = False
    reversing: np.ndarray | None = None

    def chosen(self, keep: np.ndarray) -> ComparableRows:
        """Only some of the rows (a mask or indices)."""
        return replace(
            self,
            measured=self.measured[keep],
            state={name: values[keep] for name, values in self.state.items()},
            time=None if self.time is None else self.time[keep],
            records=self.records[keep],
            groups=self.groups[keep],
            turning=self.turning[keep],
            rows=self.rows[keep],
            by_rest_length=self.by_rest_length[keep]
            if isinstance(self.by_rest_length, np.ndarray)
            else self.by_rest_length,
            corners=None if self.corners is None else self.corners[keep],
            reversing=None if self.reversing is None else self.reversing[keep],
        )


def comparable_rows(measurement: Measurement, muscle: Muscle) -> ComparableRows:
    """The comparable rows of a measurement of any kind but transient.

    Unusable rows (slack or a faulty sensor) and rows longer than the braid allows are excluded, with a count.

    Raises:
        InputError: the predicted channel is missing, or no row can be compared.
    """
    data = settled(measurement)
    measurement = data.measurement
    columns, kind, count = measurement.columns, measurement.kind, measurement.rows
    messages = [*measurement.messages, *([data.message] if data.message else [])]
    stroked = any(name in columns for name in STROKES)
    length = lengths(measurement, muscle.nominal_length) if stroked else None
    records = records_of(measurement)
    velocity, direction, unsure = _motion(measurement, muscle.nominal_length, messages)
    state: dict[str, np.ndarray] = {
        "temperature": columns.get("temperature", np.full(count, ROOM_TEMPERATURE)),
        "pressure": columns.get("pressure", np.zeros(count)),
        "velocity": velocity,
        "direction": direction,
    }
    unknown_load = False
    if kind in FORCE_KINDS:
        channel, unit, measured = "force", "N", columns["force"]
    elif kind == "isotonic":
        channel, unit, measured = "length", "m", length
        state["load"], unknown_load = load_of(measurement)
        if unknown_load:
            messages.append("the load is not stated: it is fitted as an unknown constant")
    else:
        channel, unit, measured = "diameter", "m", columns["diameter"]
    if measured is None:
        raise InputError(f"{measurement.name}: no {channel} was measured", field=channel)
    keep, excluded = measurement.usable.copy(), dict(measurement.exclusions)
    for name in ("angle", "lever", "torque", "counter_pressure"):
        if name in columns:
            state[name] = columns[name]
    if length is not None:
        too_long = length >= _LONGEST_SHARE * float(muscle.braid.thread_length)
        excluded["beyond the braid lock"] = int(np.count_nonzero(too_long & keep))
        keep &= ~too_long
        state["length"] = length
    elif kind == "diameter":
        state["load"] = np.zeros(count)
    if not np.any(keep):
        reasons = ", ".join(f"{number} {reason}" for reason, number in excluded.items() if number)
        hint = None
        if length is not None and excluded["beyond the braid lock"]:
            shown = f"{float(np.min(length)) * 1e3:.4g} to {float(np.max(length)) * 1e3:.4g} mm"
            reasons += f"; lengths of {shown} at a rest length of {muscle.nominal_length * 1e3:.4g} mm"
            hint = 'is the rest length another? --rest-length "300 mm"'
        raise InputError(
            f"{measurement.name}: no row can be compared ({count} rows, {reasons})",
            field="measurement",
            hint=hint,
        )
    ordered = "time" in columns
    turning = _turning(state["direction"], records) | unsure
    moved = state["pressure"] if kind in _PRESSED else length
    if measurement.in_order and moved is not None:
        turning |= _between_rows(moved, records) | _unresolved(moved, records)
    excluded["turning points"] = int(np.count_nonzero(turning & keep))
    reversing = turning[keep]
    unseen = _unknown_history(measurement, length)
    excluded["history unknown at the start or after a break"] = int(
        np.count_nonzero(unseen & keep & ~turning)
    )
    excluded["repeated rows"] = data.repeated
    turning |= unseen
    read = "load" in state and np.count_nonzero(np.diff(state["load"])) > _READ * count
    return ComparableRows(
        kind=kind,
        channel=channel,
        unit=unit,
        measured=np.asarray(measured, dtype=float)[keep],
        state={name: np.asarray(values, dtype=float)[keep] for name, values in state.items()},
        time=columns["time"][keep] if ordered else None,
        records=records[keep],
        groups=columns["group"][keep],
        turning=turning[keep],
        rows=data.rows[keep],
        excluded={reason: number for reason, number in excluded.items() if number},
        unknown_load=unknown_load,
        messages=tuple(messages),
        rest_length=muscle.nominal_length,
        by_rest_length=_by_rest_length(columns)[keep] if length is not None else 0.0,
        ordered=measurement.in_order,
        load_read=bool(read),
        reversing=reversing if np.any(reversing) else None,
    )


def _by_rest_length(columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """Derivative of each row's length by the nominal length, as `lengths` calculates it."""
    if "length" in columns:
        return np.zeros(len(columns["length"]))
    if "contraction" in columns:
        return 1.0 - columns["contraction"]
    return np.ones(len(columns["displacement"]))


def _motion(
    measurement: Measurement, nominal_length: float, messages: list[str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Velocity and direction of each row, and where the velocity jumps.

    A direction channel takes precedence over the sign of the velocity.
    """
    columns = measurement.columns
    velocity, direction = np.zeros(measurement.rows), columns.get("direction")
    unsure = np.zeros(measurement.rows, bool)
    known = direction is not None and bool(np.any(direction))
    stroked = any(name in columns for name in STROKES)
    if "time" in columns and (stroked or "velocity" in columns):
        moved = motion_of(measurement, nominal_length)
        velocity = moved.velocity
        if stroked and not moved.measured:
            length = lengths(measurement, nominal_length)
            unsure = jumps(columns["time"], length, moved, records_of(measurement))
            # The file does not show whether the muscle already moves at the start or after a pause.
            unsure[1:] |= _pauses(columns["time"], columns["group"])
            unsure |= _first_of_long(records_of(measurement))
        messages += moved.messages
        if not known:
            direction, known = moved.direction, True
            if stroked and measurement.kind in _PRESCRIBED:
                direction = _held(measurement, nominal_length, moved.direction)
    elif "velocity" in columns:
        velocity = columns["velocity"]
        if not known:
            direction, known = velocity, True
    if measurement.by_rows and known and direction is not None:
        unsure |= direction == 0.0  # which way the muscle came there is before the first row
    if direction is None or not known:
        messages.append("the direction of motion is unknown: friction cannot be determined from these rows")
        return velocity, np.zeros(measurement.rows), unsure
    return velocity, np.sign(direction).astype(float), unsure


def _held(measurement: Measurement, nominal_length: float, direction: np.ndarray) -> np.ndarray:
    """Direction with rows at rest in that of the last motion."""
    length = lengths(measurement, nominal_length)
    least = _MOTION * float(np.ptp(length[measurement.usable])) if np.any(measurement.usable) else 0.0
    return held_directions(direction, length, records_of(measurement), least=least)


def _first_of_long(records: np.ndarray) -> np.ndarray:
    """Mask of the first row of each record, if the record has rows enough."""
    _, first, count = np.unique(records, return_index=True, return_counts=True)
    rows = np.zeros(len(records), bool)
    rows[first[count >= _MANY_ROWS]] = True
    return rows


def _pauses(time: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Whether the recording paused before each row but the first and continued with another group."""
    steps = np.diff(time)
    if not len(steps):
        return np.zeros(0, bool)
    return (steps > _PAUSE * np.median(np.abs(steps))) & (np.diff(group) != 0)


def _unknown_history(measurement: Measurement, length: np.ndarray | None) -> np.ndarray:
    """Mask of the rows after a break whose friction still depends on the unrecorded motion in the break.

    A break is a pause between groups, or a jump of the constant quantity. The state of friction after it is
    known only after some travel. A record is assumed to begin at rest, except in isotonic measurements: there
    the muscle was filled before the record to carry its load.
    """
    columns, rows = measurement.columns, np.zeros(measurement.rows, bool)
    quantities = {  # the constant and the swept quantity
        "isobaric": (columns.get("pressure"), length),
        "isometric": (length, columns.get("pressure")),
        "isotonic": (columns.get("force"), columns.get("pressure")),
    }
    constant, swept = quantities.get(measurement.kind, (None, None))
    if swept is None or "time" not in columns or measurement.rows < 3:
        return rows
    breaks = _pauses(columns["time"], columns["group"])
    if constant is not None:
        jumps = np.abs(np.diff(constant)) > _NEW_LEVEL * max(np.ptp(constant), 0.2 * np.max(np.abs(constant)))
        breaks |= jumps & (np.diff(columns["group"]) != 0)
    begins = np.concatenate([[True], np.diff(records_of(measurement)) != 0])
    unknown = np.concatenate([[False], breaks]) & ~begins
    if measurement.kind == "isotonic":
        unknown |= begins
    edges = [*np.flatnonzero(unknown | begins), measurement.rows]
    for first, last in itertools.pairwise(edges):
        if not unknown[first]:
            continue
        moved = np.abs(swept[first:last] - swept[first]) > _FORGOTTEN * np.ptp(swept[first:last])
        until = int(np.argmax(moved)) if np.any(moved) else 0
        rows[first : first + min(until, (last - first) // 4)] = True
    return rows


def _turning(direction: np.ndarray, records: np.ndarray) -> np.ndarray:
    """Mask of single rows without motion between two opposite directions."""
    turns = np.zeros(len(direction), bool)
    same = (records[2:] == records[:-2]) if len(records) > 2 else np.zeros(0, bool)
    turns[1:-1] = same & (direction[1:-1] == 0.0) & (direction[2:] * direction[:-2] < 0.0)
    return turns


def _between_rows(moved: np.ndarray, records: np.ndarray) -> np.ndarray:
    """Mask of rows next to a reversal that happened between two rows.

    Where the way turns between two rows, the shorter of the two steps at the extreme row hides a part of it,
    and the row beyond that step has come a longer way since the reversal than the rows show.
    """
    hidden = np.zeros(len(moved), bool)
    if len(moved) < 5:
        return hidden
    step = np.diff(moved)
    real = _REAL_STEP * float(np.percentile(np.abs(step), 75.0))
    extreme = np.arange(2, len(moved) - 2)
    into, out = step[extreme - 1], step[extreme]
    turns = (
        (into * out < 0.0)
        & (step[extreme - 2] * into > 0.0)
        & (step[extreme + 1] * out > 0.0)
        & (np.minimum(np.abs(step[extreme - 2]), np.abs(step[extreme + 1])) > real)
        & (records[extreme - 2] == records[extreme + 2])
    )
    short_out = turns & (np.abs(out) < _SHORT * np.abs(step[extreme + 1]))
    short_into = turns & (np.abs(into) < _SHORT * np.abs(step[extreme - 2]))
    # Two equal rows: the way turned between them, or the motion paused there.
    even = (
        (out == 0.0)
        & (into * step[extreme + 1] < 0.0)
        & (np.minimum(np.abs(into), np.abs(step[extreme + 1])) > real)
        & (records[extreme - 2] == records[extreme + 2])
    )
    hidden[extreme[short_out | even] + 1] = True
    hidden[extreme[short_into]] = True
    return hidden


def _unresolved(moved: np.ndarray, records: np.ndarray) -> np.ndarray:
    """Mask of single rows that have hardly left a reversal, where the sampling does not resolve it.

    Every friction needs some travel to turn round, often a thousandth of the length. A row nearer to the
    extreme than a small share of a usual step tells nothing of it. Where more rows follow each other there,
    they show the course, or a rest.
    """
    rows = np.zeros(len(moved), bool)
    if len(moved) < 5:
        return rows
    usual = float(np.percentile(np.abs(np.diff(moved)), 75.0))
    if not usual > 0.0:
        return rows
    edges = [0, *(np.flatnonzero(np.diff(records)) + 1).tolist(), len(moved)]
    for first, last in itertools.pairwise(edges):
        for turn in _turns(moved[first:last], _SWING * usual):
            extreme = first + turn
            away = np.abs(moved[extreme:last] - moved[extreme]) > _UNRESOLVED * usual
            count = int(np.argmax(away)) if np.any(away) else last - extreme
            if count <= _FEW_NEAR:
                rows[extreme : extreme + count] = True
    return rows


def _turns(moved: np.ndarray, swing: float) -> list[int]:
    """Numbers of the rows farthest out before each reversal by more than a swing."""
    turns, extreme, way = [], 0, 0.0
    for row in range(1, len(moved)):
        back = moved[row] - moved[extreme]
        if way == 0.0:
            if abs(back) > swing:
                way, extreme = float(np.sign(back)), row
        elif way * back > 0.0:
            extreme = row
        elif abs(back) > swing:
            turns.append(extreme)
            way, extreme = -way, row
    return turns


def records_of(measurement: Measurement) -> np.ndarray:
    """Label of the uninterrupted record of each row: a new one begins where time does not increase."""
    columns = measurement.columns
    if not measurement.in_order:
        return np.zeros(measurement.rows, dtype=np.int64)
    new = np.zeros(measurement.rows - 1, bool)
    if "time" in columns:
        new |= ~(np.diff(columns["time"]) > 0.0)
    new[np.array(measurement.starts[1:], dtype=int) - 1] = True
    return np.concatenate([[0], np.cumsum(new)]).astype(np.int64)


def load_of(measurement: Measurement) -> tuple[np.ndarray, bool]:
    """The load of each row [N], and whether it is unknown."""
    if "force" in measurement.columns:
        return measurement.columns["force"], False
    conditions = measurement.conditions
    force, mass = conditions.get("load_force"), conditions.get("load_mass")
    total = float(force or 0.0) + float(mass or 0.0) * GRAVITY
    return np.full(measurement.rows, total), force is None and mass is None


def jumps(time: np.ndarray, length: np.ndarray, moved: RecordedMotion, records: np.ndarray) -> np.ndarray:
    """Mask of the rows at which the velocity jumps within a record; empty if there are many.

    These are rows whose velocity is far less certain than that of the others. Where the velocity changes
    suddenly between two rows, it is the row nearer to the intersection of both straight lines.
    """
    unsure = _UNSURE * float(np.median(moved.velocity_sigma))
    edges = [0, *(np.flatnonzero(np.diff(records)) + 1).tolist(), len(time)]
    parts = [slice(first, last) for first, last in itertools.pairwise(edges)]
    sudden = np.concatenate([
        _jumps_within(time[part], length[part], moved.velocity[part], moved.velocity_sigma[part], unsure)
        for part in parts
    ])  # fmt: skip
    corners = np.concatenate([_corners(time[part], length[part]) for part in parts])
    if np.mean(corners) > _MOST_CORNERS:
        corners[:] = False
    return sudden | corners if np.mean(sudden & ~corners) < _FEW else corners


def _corners(time: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Mask of the rows of one record at which a way that was straight is so no more.

    The rows on both sides of a corner that lies between them: a velocity fitted over neighbours mixes the
    speeds of both sides there. A way that bends all along changes as much before and behind such a row.
    """
    corners = np.zeros(len(time), bool)
    if len(time) < 5:
        return corners
    speed = np.diff(length) / np.diff(time)
    change = np.abs(np.diff(speed))  # at the rows 1 to n - 2
    beside = np.minimum(change[:-2], change[2:])
    usual, scatter = float(np.percentile(np.abs(speed), 75.0)), float(np.median(change))
    corners[2:-2] = change[1:-1] > np.maximum(_SUDDEN * beside, max(_CORNER * usual, _BEYOND * scatter))
    return corners


def _jumps_within(
    time: np.ndarray, length: np.ndarray, velocity: np.ndarray, sigma: np.ndarray, unsure: float
) -> np.ndarray:
    """Mask of the rows of one record at which the velocity jumps, or is less certain than ``unsure``."""
    speed = np.pad(np.abs(velocity), 1)
    size = np.maximum(np.maximum(speed[:-2], speed[2:]), speed[1:-1])
    jumps = np.isfinite(sigma) & (sigma > np.maximum(unsure, _JUMP * size))
    jumps |= speed[1:-1] < _STILL * np.minimum(speed[:-2], speed[2:])
    change = np.pad(np.abs(np.diff(velocity)), 1)
    around = np.maximum(np.maximum(change[:-2], change[2:]), np.hypot(sigma[1:], sigma[:-1]))
    sudden = np.flatnonzero(change[1:-1] > np.maximum(_SUDDEN * around, _JUMP * size[1:]))
    step, lengthened = time[sudden + 1] - time[sudden], length[sudden + 1] - length[sudden]
    before, after = velocity[sudden], velocity[sudden + 1]
    intersection = (lengthened - after * step) / (
        before - after
    )  # time of the intersection after the first row [s]
    jumps[sudden + (intersection > 0.5 * step)] = True
    return jumps
