"""A run of a drive as JSON: columns on the grid asked for, timing from a finer one, limits, remarks."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from mckibben.application.start import Json, flag, flags_json, geometry_json, start_flags
from mckibben.documents.drive_reading import GivenDrive
from mckibben.physics.drive_terms import COUNTER
from mckibben.physics.model import Model
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.outcome import Outcome
from mckibben.simulation.statics.limits import FlagCode, LimitFlag
from mckibben.simulation.timing.table import FIGURES, Interval, Trace, phases, timing, tracking

Array = np.ndarray

# The timing table is read off a grid at least this fine; impacts are found between two of its rows.
_FINEST, _FEWEST, _MOST = 1e-3, 2000, 20_000
# A field of the document for each limit.
_FIELDS = {FlagCode.OVER_PRESSURE: "supply.pressure", FlagCode.OVER_FORCE_LIMIT: "load"}
_FILL, _EXHAUST = 1, 2
_HAIR = 1.001


@dataclass(frozen=True)
class Grid:
    """Times to integrate for, and which of them are rows of the answer."""

    time: Array
    rows: Array


def grid_of(*, duration: float, begin: float, end: float, points: int) -> Grid:
    """Evenly spaced rows from begin to end inside a finer grid of the whole run [s]."""
    step = max(min(_FINEST, duration / _FEWEST), duration / _MOST)
    finer = max(1, ceil((end - begin) / (points - 1) / step - 1e-9))
    inner = np.linspace(begin, end, finer * (points - 1) + 1)
    before = np.linspace(0.0, begin, ceil(begin / step), endpoint=False)
    after = np.linspace(end, duration, ceil((duration - end) / step) + 1)[1:]
    rows = len(before) + finer * np.arange(points)
    return Grid(np.concatenate([before, inner, after]), rows)


def trace_of(run: Run) -> Trace | None:
    """The run in coordinates of the load; None when it has no two rows of numbers."""
    out, lever = run.outputs, run.drive.load.lever_ratio
    columns = {
        "time": run.time,
        "position": run.states["stroke"] / lever,
        "velocity": run.states["speed"] / lever,
        "acceleration": out["acceleration"] / lever,
        "pressure": run.pressure,
        "force": out["force"],
        "mass_flow": out["mass_flow"],
        "contact": out["penetration"] > 0.0,
        "choked": _choked_side(run),
        "supply_mass_flow": out["supply_flow"],
        "exhaust_mass_flow": out["exhaust_flow"],
    }
    usable = np.all([np.isfinite(column) for column in columns.values()], axis=0)
    count = int(np.argmin(usable)) if not usable.all() else len(usable)
    if count < 2:
        return None
    return Trace(**{name: column[:count] for name, column in columns.items()})


def answer_of(given: GivenDrive, grid: Grid, run: Run) -> Json:
    """Everything there is to say about a run."""
    drive, out = run.drive, run.outputs
    rows = grid.rows[grid.rows < len(run.time)]
    lever, rest = drive.load.lever_ratio, drive.muscle.nominal_length
    stroke = run.states["stroke"]
    contraction = stroke / rest + drive.precontraction
    trace = trace_of(run)
    reference = None if drive.reference is None else drive.reference.value(run.time)
    table = _timing(drive, trace)
    follows = None
    if reference is not None and trace is not None and len(trace.time) >= 4:
        follows = tracking(trace.time, reference[: len(trace.time)], trace.position)
    gauge = -drive.ambient_pressure
    columns: dict[str, Array | None] = {
        "time": run.time,
        "position": stroke / lever,
        "velocity": run.states["speed"] / lever,
        "acceleration": out["acceleration"] / lever,
        "pressure": run.pressure,
        "force": out["force"],
        "mass_flow": out["mass_flow"],
        "command": run.command.value(run.time) if reference is not None else drive.command.value(run.time),
        "opening": out["opening"],
        "reference": reference,
        "supply_flow": out["supply_flow"],
        "exhaust_flow": out["exhaust_flow"],
        "tube_pressure": _plus(run.states.get("tube_pressure"), gauge),
        "regulator_pressure": _plus(run.states.get("regulator_pressure"), gauge),
        "volume": out["volume"],
        "diameter": out["diameter"],
        "length": rest * (1.0 - contraction),
        "contraction": contraction,
        "load_force": out["external_force"],
        "temperature": out["gas_temperature"],
        "contact": out["penetration"] > 0.0,
    }
    notes = {
        **given.notes,
        **{f"timing.{name}": why for name, why in table["notes"].items()},
        **({} if follows is None else {f"tracking.{name}": why for name, why in follows["notes"].items()}),
    }
    limits, (low, high) = drive.model.limits, drive.stops
    return {
        **{name: None if column is None else column[rows] for name, column in columns.items()},
        "readings": _readings(run, rows),
        "joint": _joint(run, rows),
        "choked": choked_intervals(run.time, _choked_side(run)),
        "timing": table,
        "tracking": follows,
        "outcome": run.outcome.label,
        "message": None if run.outcome is Outcome.COMPLETED else run.outcome.value,
        "wall_ms": run.wall_seconds * 1e3,
        "engine": run.engine,
        "steps": run.steps,
        "flags": [*start_flags(given.start), *_part_flags(given), *flags_json(_crossed(run))],
        "notes": notes,
        "limits": {
            "max_pressure": limits.max_pressure,
            "max_force": limits.max_force,
            "max_contraction": limits.max_contraction,
            "max_pretension": limits.max_pretension,
            "position_min": low / lever,
            "position_max": high / lever,
        },
        "geometry": geometry_json(given.start),
        "model": {"effects": drive.model.values},
        "duration": drive.duration,
    }


def moving_mass(drive: Drive) -> float:
    """The mass that meets a stop, with what effects add [kg]."""
    model, values = Model(drive.model.effects), drive.model.values
    factor = float(model.product("load_factor", values, {}))
    return (
        factor * drive.load.mass
        + drive.own_mass
        + float(model.sum("inertia", values, {"muscle": drive.muscle}))
    )


def phases_of(drive: Drive) -> tuple[Interval | None, Interval | None]:
    """The first fill and what follows it; under a controller the reference's first rise and fall."""
    if drive.reference is None:
        return phases(drive.command.segments(drive.duration))
    reference = drive.reference.segments(drive.duration)
    before = np.r_[drive.reference.before, reference.end_values[:-1]]
    jump = reference.start_values - before
    trend = np.sign(np.where(jump != 0.0, jump, reference.slopes))
    return phases(Segments(reference.times, _last_trend(trend), np.zeros(len(trend))))


def _last_trend(trend: Array) -> Array:
    """A constant piece belongs to the phase that leads to it."""
    moving = np.where(trend != 0.0, np.arange(len(trend)), -1)
    last = np.maximum.accumulate(moving)
    return np.where(last >= 0, trend[np.maximum(last, 0)], 0.0)


def _timing(drive: Drive, trace: Trace | None) -> Json:
    if trace is None:
        why = "the run ended before this phase"
        empty = dict.fromkeys(FIGURES)
        notes = {f"{phase}.{name}": why for phase in ("extend", "retract") for name in FIGURES}
        return {"extend": empty, "retract": empty, "notes": notes}
    fill, exhaust = phases_of(drive)
    low, high = (stop / drive.load.lever_ratio for stop in drive.stops)
    stops = (low, high)
    return timing(trace, fill=fill, exhaust=exhaust, mass=moving_mass(drive), stops=stops)


def _plus(column: Array | None, offset: float) -> Array | None:
    return None if column is None else column + offset


def _choked_side(run: Run) -> Array:
    """1 while filling is choked, 2 while venting is, else 0."""
    out, valve = run.outputs, run.drive.valve
    fill = (out["supply_flow"] > 0.0) & (out["fill_pressure_ratio"] < valve.fill_ratio)
    exhaust = (out["exhaust_flow"] > 0.0) & (out["exhaust_pressure_ratio"] < valve.exhaust_ratio)
    return np.where(fill, _FILL, np.where(exhaust, _EXHAUST, 0))


def choked_intervals(time: Array, side: Array) -> list[Json]:
    """Where the valve is choked, as intervals."""
    if not len(time):
        return []
    edges = np.flatnonzero(np.diff(side)) + 1
    starts, ends = np.r_[0, edges], np.r_[edges, len(time) - 1]
    return [
        {"from": time[a], "to": time[b], "side": "fill" if side[a] == _FILL else "exhaust"}
        for a, b in zip(starts, ends, strict=True)
        if side[a] and b > a
    ]


def _readings(run: Run, rows: Array) -> dict[str, Any] | None:
    model = Model(run.drive.model.effects)
    channels = {"pressure": "pressure", "force": "force", "position": "stroke"}
    slots = (
        "pressure_sensor",
        "force_sensor",
        "length_sensor",
        *(f"{name}_reading" for name in channels.values()),
    )
    if not any(model.has(slot) for slot in slots):
        return None
    lever = run.drive.load.lever_ratio
    return {
        name: run.outputs[f"{channel}_reading"][rows] / (lever if name == "position" else 1.0)
        for name, channel in channels.items()
    }


def _joint(run: Run, rows: Array) -> Json | None:
    """Angle, torque and stiffness of a pair's pulley; the stiffness at constant pressures."""
    drive = run.drive
    if drive.pulley_radius is None:
        return None
    radius, rest = drive.pulley_radius, drive.muscle.nominal_length
    stroke = run.states["stroke"][rows]
    pressures = [
        run.states[name][rows] - drive.ambient_pressure for name in ("pressure", f"pressure{COUNTER}")
    ]
    middle = rest * (1.0 - drive.precontraction)
    stiffness = np.zeros(len(rows))
    for sense, pressure in zip((1.0, -1.0), pressures, strict=True):
        seen = drive.model.outputs(
            length=middle - sense * stroke, pressure=pressure, temperature=drive.temperature
        )
        stiffness += np.where(seen["tension"] > 0.0, seen["tension_by_length"], 0.0)
    counter = run.outputs[f"force{COUNTER}"][rows]
    return {
        "angle": stroke / radius,
        "torque": radius * (run.outputs["force"][rows] - counter),
        "stiffness": radius**2 * stiffness,
        "counter_force": counter,
        "counter_pressure": pressures[1],
    }


def _part_flags(given: GivenDrive) -> list[Json]:
    why = "from general knowledge or estimated, not read in a source"
    found = [
        flag("unverified", f"{part}: {', '.join(names)} {why}", "valve")
        for part, names in given.unverified.items()
    ]
    if (text := given.drive.tube_assumption) is not None:
        found.append(flag("assumed", text, "tube"))
    return found


def _crossed(run: Run) -> Iterable[LimitFlag]:
    """The limits that the run crosses anywhere; a stop that gives way by a hair is no contraction."""
    if not len(run.time):
        return
    drive = run.drive
    contraction = np.clip(
        run.states["stroke"] / drive.muscle.nominal_length + drive.precontraction,
        drive.min_contraction,
        drive.max_contraction,
    )
    limits = drive.model.limits
    # A stretch is told by the longest muscle, everything else by the shortest.
    for pick, stretch in ((np.nanmax, False), (np.nanmin, True)):
        crossed = limits.flags(
            pressure=_at_most(float(np.nanmax(run.pressure)), limits.max_pressure),
            force=_at_most(float(np.nanmax(run.outputs["force"])), limits.max_force),
            contraction=float(pick(contraction)),
        )
        for item in crossed:
            if (item.code is FlagCode.OVER_PRETENSION_LIMIT) is stretch:
                yield LimitFlag(item.code, item.message, _FIELDS.get(item.code, "stops"))


def _at_most(value: float, limit: float | None) -> float:
    """A muscle that settles at a limit is not above it: the last digits are the integrator's."""
    return value if limit is None or value > limit * _HAIR else min(value, limit)
