"""The trace, phases, timing and choked intervals of a run, in coordinates of the load."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, reduce
from math import ceil
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.result import result_class
from mckibben.physics.drive_terms import COUNTER, HIGH_STOP
from mckibben.physics.flow_path import Restriction, with_flow_control
from mckibben.physics.gas import GAS_CONSTANT as _R
from mckibben.physics.model import Model
from mckibben.simulation.command.segments import Interval, Segments, phases
from mckibben.simulation.drive.events import Event
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import Run, constants_of, dead_times
from mckibben.simulation.integrate.engine import SLOWEST_REBOUND
from mckibben.simulation.timing.table import Phase, TimingTable, timing
from mckibben.simulation.timing.trace import REAL, Impact, Trace
from mckibben.simulation.timing.tracking import Followed, Tracking, tracking

Array = np.ndarray

# The timing table is computed on a grid at least this fine.
_FINEST, _FEWEST, _MOST = 1e-3, 2000, 20_000
_TRIMMING = 0.01  # of the largest flow of a run; a regulator trims with less
_FILL, _EXHAUST = 1, 2
_JUMPS = 0.1  # most jumps of a command that get a row each, over the evenly spaced rows
_SAME_TIME = 1e-9  # of the duration; a row so near to a jump is its row
_FEWEST_TRACKED = 4  # least number of rows for tracking figures


@dataclass(frozen=True, slots=True)
class Grid:
    """Times of the integration, which of them are rows of the result, and which those of its figures.

    The figures of a run are those of the same times whatever rows are asked for; None = of all times.
    """

    time: Array
    rows: Array
    figures: Array | None = None


@result_class
class ChokedInterval:
    """Interval in which the flow of the valve does not depend on the downstream pressure [s]."""

    JSON_KEYS: ClassVar = {"begin": "from", "end": "to"}

    begin: float
    """Start [s]."""
    end: float
    """End [s]."""
    side: Literal["fill", "exhaust"]
    """Air flows in (fill) or out (exhaust)."""


def time_step(duration: float) -> float:
    """Step of the grid for the timing table [s]."""
    return max(min(_FINEST, duration / _FEWEST), duration / _MOST)


def grid_of(*, duration: float, begin: float, end: float, points: int, jumps: Sequence[float] = ()) -> Grid:
    """Evenly spaced rows from begin to end, beside the times of the figures of the whole run [s].

    Args:
        duration: of the run.
        begin, end: first and last row.
        points: number of evenly spaced rows.
        jumps: times that get a row as well, where they lie within and are few beside the others, so that a
            command that is held between rows is the command of the run.
    """
    return _grid_of(duration, begin, end, points, tuple(jumps))


@lru_cache(maxsize=32)
def _grid_of(duration: float, begin: float, end: float, points: int, jumps: tuple[float, ...]) -> Grid:
    """`grid_of`: a drive that is run again, or with other values, has the grid that it had."""
    near = _SAME_TIME * duration
    finer = max(1, ceil(duration / _FEWEST / time_step(duration) - 1e-9))
    figures = _with_jumps(np.linspace(0.0, duration, finer * _FEWEST + 1), jumps, _FEWEST, near)
    shown = _with_jumps(np.linspace(begin, end, points), jumps, points, near)
    at = _nearest(figures, shown)
    others = shown[np.abs(figures[at] - shown) > near]
    if not len(others):
        figures.flags.writeable = at.flags.writeable = False
        return Grid(figures, at)
    time = np.sort(np.concatenate([figures, others]))
    grid = Grid(time, _nearest(time, shown), np.searchsorted(time, figures))
    for column in (grid.time, grid.rows, grid.figures):
        if column is not None:
            column.flags.writeable = False
    return grid


def _with_jumps(grid: Array, jumps: tuple[float, ...], points: int, near: float) -> Array:
    """An ascending grid with the jumps within it, where they are few; what is so near to one is left out."""
    times = np.array([t for t in jumps if grid[0] < t < grid[-1]])
    if not 0 < len(times) <= _JUMPS * points:
        return grid
    beside = np.abs(times[_nearest(times, grid)] - grid) <= near
    return np.union1d(grid[~beside], times)


def _nearest(grid: Array, times: Array) -> NDArray[np.intp]:
    """Places in an ascending grid that are next to some times."""
    after = np.minimum(np.searchsorted(grid, times), len(grid) - 1)
    before = np.maximum(after - 1, 0)
    return np.where(np.abs(grid[before] - times) < np.abs(grid[after] - times), before, after)


def of_figures(run: Run, grid: Grid) -> Run:
    """The run at the times of its figures alone."""
    if grid.figures is None:
        return run
    kept = grid.figures[grid.figures < len(run.time)]
    states, outputs = _AtTimes(run.states, kept), _AtTimes(run.outputs, kept)
    return replace(run, time=run.time[kept], states=states, outputs=outputs)


class _AtTimes(Mapping[str, Array]):
    """Columns at some of their rows, each when it is first read: figures need half of them."""

    def __init__(self, columns: Mapping[str, Array], rows: Array) -> None:
        self._columns, self._rows = columns, rows
        self._found: dict[str, Array] = {}

    def __getitem__(self, name: str) -> Array:
        if name not in self._found:
            self._found[name] = self._columns[name][self._rows]
        return self._found[name]

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)


def trace_of(run: Run) -> Trace | None:
    """The run in coordinates of the load; None when fewer than two rows are finite.

    At each impact, and where the muscle becomes slack or taut on the way, there are two more rows: just
    before and just after.
    """
    out, lever, drive = run.outputs, run.drive.load.lever_ratio, run.drive
    suffixes = ("", COUNTER) if drive.pair else ("",)
    from_states = drive.polytropic_exponent is not None and "gas_mass" not in run.states
    exchanged = [_exchanged(run, suffix, from_states=from_states) for suffix in suffixes]

    def total(columns: Iterable[Array]) -> Array:
        return reduce(np.add, columns)

    columns = {
        "time": run.time,
        "position": run.states["stroke"] / lever,
        "velocity": run.states["speed"] / lever,
        "acceleration": out["acceleration"] / lever,
        "pressure": run.pressure,
        "force": out["force"],
        "mass_flow": out["mass_flow"],
        "supply_mass_flow": total(out[f"supply_flow{suffix}"] for suffix in suffixes),
        "exhaust_mass_flow": total(out[f"exhaust_flow{suffix}"] for suffix in suffixes),
        "supplied": total(supplied for supplied, _ in exchanged),
        "vented": total(vented for _, vented in exchanged),
        "tube_charge": total(_tube_charge(run, suffix) for suffix in suffixes),
    }
    table = np.array([columns[name] for name in REAL])
    usable = np.all(np.isfinite(table), axis=0)
    count = len(usable) if usable.all() else int(np.argmin(usable))
    if count < 2:
        return None
    table, contact, choked = table[:, :count], (out["contact"] != 0.0)[:count], _choked_side(run)[:count]
    moving = [event for event in run.events if event.impact or abs(event.speed) > SLOWEST_REBOUND]
    events = [event for event in moving if event.time < table[0, -1]]
    impacts = tuple(
        Impact(event.time, stop_of(drive, event) / lever, event.speed / lever)
        for event in events
        if event.impact
    )
    table, contact, choked = _with_events(table, contact, choked, events, run)
    return Trace.sound(table, contact, choked, impacts=impacts, from_states=from_states)


def stop_of(drive: Drive, event: Event) -> float:
    """Stroke of the stop of an impact [m]."""
    return drive.stops[event.switch == HIGH_STOP]


def _exchanged(run: Run, suffix: str, *, from_states: bool) -> tuple[Array, Array]:
    """Air that a muscle has taken from the supply, and let out, since the start of the run [kg].

    The integrals of the flows; where these do not conserve mass, the larger flow of each step is that which
    the change of p V/(R T) in muscle and tube leaves, T the ambient temperature. What leaks is air let out.
    """
    supplied, vented = run.states[f"supplied{suffix}"], run.states[f"vented{suffix}"]
    if not from_states:
        return supplied, vented
    temperature = run.drive.temperature
    gas = run.states[f"pressure{suffix}"] * run.outputs[f"volume{suffix}"] / (_R * temperature)
    charge = np.diff(gas + _tube_charge(run, suffix))
    taken, left = np.diff(supplied), np.diff(vented)
    filling, venting = np.abs(taken) > np.abs(left), np.abs(left) > np.abs(taken)
    return (
        np.concatenate([[0.0], np.cumsum(np.where(filling, charge + left, taken))]),
        np.concatenate([[0.0], np.cumsum(np.where(venting, taken - charge, left))]),
    )


def _tube_charge(run: Run, suffix: str) -> Array:
    """Air in the tube of a muscle [kg]."""
    tube, pressure = run.drive.tube_in_use, run.states.get(f"tube_pressure{suffix}")
    if tube is None or pressure is None:
        return np.zeros(len(run.time))
    return pressure * tube.volume / (_R * run.drive.temperature)


def _with_events(
    table: Array, contact: Array, choked: Array, events: list[Event], run: Run
) -> tuple[Array, Array, Array]:
    """The columns with rows just before and just after each event."""
    instants = np.array([event.time for event in events])
    new = np.concatenate([[True], np.diff(instants) > 0.0]) if len(events) else np.zeros(0, bool)
    inside = new & (instants > table[0, 0])
    events, instants = [event for event, keep in zip(events, inside, strict=True) if keep], instants[inside]
    if not events:
        return table, contact, choked
    # A row of the instant of an event is that before it: the new rows replace it.
    at = np.searchsorted(table[0], instants)
    if (there := table[0, at] == instants).any():
        kept = np.delete(np.arange(table.shape[1]), at[there])
        table, contact, choked = table[:, kept], contact[kept], choked[kept]
    columns, lever = dict(zip(REAL, table, strict=True)), run.drive.load.lever_ratio
    time = columns["time"]
    after = np.searchsorted(time, instants)
    before = after - 1
    passed = instants - time[before]
    share = passed / (time[after] - time[before])
    speed = np.array([event.speed for event in events]) / lever
    left, here = (
        speed.copy(),
        columns["position"][before] + 0.5 * passed * (columns["velocity"][before] + speed),
    )
    for index, event in enumerate(events):
        if event.impact:
            here[index] = stop_of(run.drive, event) / lever
            left[index] = 0.0 if event.begins else -run.drive.restitution * speed[index]
    pulling = np.array([event.acceleration for event in events]) / lever
    known = {
        "time": (instants, np.nextafter(instants, np.inf)),
        "position": (here, here),
        "velocity": (speed, left),
        "acceleration": (pulling, columns["acceleration"][after]),
    }
    rows = np.insert(np.arange(len(time)), np.repeat(after, 2), np.repeat(after, 2))
    first = after + 2 * np.arange(len(after))  # the new rows among all
    between, choked_before = table[:, before] * (1.0 - share) + table[:, after] * share, choked[before]
    table, contact, choked = table[:, rows], contact[rows], choked[rows]
    table[:, first] = table[:, first + 1] = between
    for name, (row_before, row_after) in known.items():
        number = REAL.index(name)
        table[number, first], table[number, first + 1] = row_before, row_after
    contact[first] = False
    choked[first] = choked[first + 1] = choked_before
    return table, contact, choked


def stops_of(drive: Drive) -> Interval:
    """The end stops as positions of the load [m]."""
    low, high = drive.stops
    return low / drive.load.lever_ratio, high / drive.load.lever_ratio


def moving_mass(drive: Drive) -> float:
    """The mass that hits a stop, including the mass added by effects [kg]."""
    model, values = Model(drive.model.effects), drive.model.values
    factor = float(model.product("load_factor", values, {}))
    added = float(model.sum("inertia", values, {"muscle": drive.muscle}))
    return factor * drive.load.mass + drive.own_mass + added


def phases_of(drive: Drive) -> tuple[Phase | None, Phase | None]:
    """The first fill and the vent after it; of a controlled run the reference's first rise and fall."""
    if drive.reference is None:
        command = drive.command.segments(drive.duration)
        fill, vent = (
            _phase_of(interval, command)
            for interval in _begun(phases(command), command, before=drive.command.before)
        )
        return fill, vent
    reference = drive.reference.segments(drive.duration)
    before = np.r_[drive.reference.before, reference.end_values[:-1]]
    jump = reference.start_values - before
    trend = np.sign(np.where(jump != 0.0, jump, reference.slopes))
    found = phases(Segments(reference.times, _last_trend(trend), np.zeros(len(trend))))
    fill, vent = (_phase_of(interval, reference, reference) for interval in found)
    return fill, vent


def _begun(
    found: tuple[Interval | None, Interval | None], command: Segments, *, before: float
) -> tuple[Interval | None, Interval | None]:
    """The phases without what goes on since before the run: a muscle held at a level is not filled."""
    if command.start_values[0] != before or command.slopes[0] != 0.0:
        return found
    changed = float(command.times[1])
    fill, vent = (None if each is None or each[1] <= changed else each for each in found)
    way = 0.0  # in which the command goes on
    if len(command.slopes) > 1:
        way = float(command.start_values[1] - command.start_values[0] or command.slopes[1])
    if fill is not None and fill[0] < changed:
        fill = (changed, fill[1]) if way > 0.0 else None
    if vent is not None and vent[0] < changed:
        vent = (changed, vent[1]) if way < 0.0 else None
    return fill, vent


def _phase_of(
    interval: Interval | None, command: Segments, reference: Segments | None = None
) -> Phase | None:
    """A phase, and whether the command is a step there: constant from its begin to its end."""
    if interval is None:
        return None
    begin, end = interval
    inside = (command.times[:-1] < end) & (command.times[1:] > begin)
    levels = command.start_values[inside]
    stepped = not command.slopes[inside].any() and bool(np.all(levels == levels[0]))
    return Phase(interval, None if reference is None else float(levels[-1]), stepped)


def _last_trend(trend: Array) -> Array:
    """The trend with constant pieces counted to the phase before them."""
    moving = np.where(trend != 0.0, np.arange(len(trend)), -1)
    last = np.maximum.accumulate(moving)
    return np.where(last >= 0, trend[np.maximum(last, 0)], 0.0)


def timing_of(drive: Drive, trace: Trace | None) -> TimingTable:
    """The timing table of a run, with phases by its command."""
    if trace is None:
        return TimingTable.missing("the run ended before this phase")
    fill, vent = phases_of(drive)
    return timing(trace, fill=fill, vent=vent, mass=moving_mass(drive), delays=dead_times(drive))


def tracking_of(run: Run, trace: Trace | None) -> Tracking | None:
    """Tracking figures of a controlled run; None without a reference, or with too few rows."""
    reference, controller = run.drive.reference, run.drive.controller
    if reference is None or controller is None or trace is None or len(trace.time) < _FEWEST_TRACKED:
        return None
    return tracking(
        Followed(
            time=trace.time,
            reference=np.asarray(reference.value(trace.time)),
            position=trace.position,
            command=np.asarray(run.command.value(trace.time)),
            limits=(controller.output_min, controller.output_max),
            contact=trace.contact,
            stops=stops_of(run.drive),
            pressure=trace.pressure,
            full_pressure=full_pressure_of(run.drive),
            pulled_back=run.drive.pair,
            integrates=controller.ki > 0.0,
            rubs=bool(np.any(run.outputs["friction"])),
        )
    )


def full_pressure_of(drive: Drive) -> float:
    """Highest gauge pressure that a muscle can be given [Pa]."""
    highest = drive.supply_pressure
    return highest if drive.regulator is None else min(highest, drive.regulator.range)


def choked_intervals(time: Array, side: Array) -> list[ChokedInterval]:
    """Intervals of choked flow; ``side`` at each time: 1 filling, 2 venting, 0 not choked."""
    if not len(time):
        return []
    edges = np.flatnonzero(np.diff(side)) + 1
    starts, ends = np.r_[0, edges], np.r_[edges, len(time) - 1]
    return [
        ChokedInterval(float(time[a]), float(time[b]), "fill" if side[a] == _FILL else "exhaust")
        for a, b in zip(starts, ends, strict=True)
        if side[a] and b > a
    ]


def choked_of(run: Run) -> list[ChokedInterval]:
    """Intervals of choked flow of a run."""
    return choked_intervals(run.time, _choked_side(run))


def _choked_side(run: Run) -> Array:
    """1 where filling is choked, 2 where venting is, else 0."""
    out = run.outputs
    # A regulator at rest trims its pressure with hardly any air, always choked on its way out.
    share = 0.0 if run.drive.regulator is None else _TRIMMING
    flows = {name: out[f"{name}_flow"] for name in ("supply", "exhaust")}
    least = {name: share * float(np.max(flow, initial=0.0)) for name, flow in flows.items()}
    fill_ratio, exhaust_ratio = _critical_ratios(run.drive)
    after_exhaust, quick = out["exhaust_pressure_ratio"], run.drive.quick_exhaust
    if quick is not None:
        exhaust_ratio, after_exhaust = (
            quick.critical_ratio,
            run.drive.ambient_pressure / run.states["pressure"],
        )
    fill = (flows["supply"] > least["supply"]) & (out["fill_pressure_ratio"] < fill_ratio)
    exhaust = (flows["exhaust"] > least["exhaust"]) & (after_exhaust < exhaust_ratio)
    return np.where(fill, _FILL, np.where(exhaust, _EXHAUST, 0))


def _critical_ratios(drive: Drive) -> tuple[float, float]:
    """Of filling and venting through the open valve, with a flow control that is directly behind it."""
    valve = drive.valve
    filling = Restriction(valve.fill_conductance, valve.fill_ratio)
    venting = Restriction(valve.exhaust_conductance, valve.exhaust_ratio)
    if drive.flow_control is not None and drive.tube_in_use is None:
        filling, venting = with_flow_control(before=filling, behind=venting, c=constants_of(drive))
    return float(filling.critical_ratio), float(venting.critical_ratio)
