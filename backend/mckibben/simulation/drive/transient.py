"""Transient simulation of a drive: from its parts to states and outputs on a time grid."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import sin

import numpy as np

from mckibben.physics import gas, ideal
from mckibben.physics.drive_terms import INPUTS
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.units import GRAVITY
from mckibben.simulation.command.segments import Segments, delayed, merged
from mckibben.simulation.command.signals import Signal
from mckibben.simulation.drive.events import Event, events_of
from mckibben.simulation.drive.initial_state import Start, held_between, start_of
from mckibben.simulation.drive.parts import Drive, FlowControl, QuickExhaust, Regulator
from mckibben.simulation.integrate.engine import CompiledDrive, Outcome, Solution, compiled_drive, integrate
from mckibben.simulation.statics.model import StaticModel

# A slack muscle takes its free length within about this time [s].
_SLACK_TIME = 2e-6
_LIGHTEST = 1e-3  # kg; least moving mass: without mass there is no equation of motion
_FREE = 1.0  # m3/(s Pa); conductance of free flow: a million times that of the largest valve
# At 1e-5 a step may jump over the moment at which a load leaves its stop (0.4 mm in paper-ramp).
TOLERANCE = 1e-6


@dataclass(frozen=True)
class Run:
    """A simulated drive: arrays over ``time``, SI, pressures gauge; stroke positive = shorter.

    Attributes:
        states: state name -> values.
        outputs: name of `OUTPUTS` -> values.
        events: impacts on the end stops and changes of contact and slack, in order.
        start: where the run started, and why.
        outcome: how the run ended; a run that ended early has fewer rows.
        command: the command after all dead times.
        wall_seconds: computing time of the integration [s].
    """

    time: np.ndarray
    states: Mapping[str, np.ndarray]
    outputs: Mapping[str, np.ndarray]
    events: tuple[Event, ...]
    start: Start
    outcome: Outcome
    command: Segments
    drive: Drive
    steps: int
    wall_seconds: float
    notes: list[str] = field(default_factory=list)
    counter_command: Segments | None = None

    @property
    def pressure(self) -> np.ndarray:
        """Gauge pressure in the muscle [Pa]."""
        return self.states["pressure"] - self.drive.ambient_pressure


def constants_of(drive: Drive) -> dict[str, float]:
    """The constants of a run by the names of the model's parameters."""
    load, tube, muscle = drive.load, drive.tube_in_use, drive.muscle
    rest, (stop_low, stop_high) = muscle.nominal_length, drive.stops
    blocked = ideal.force(braid=muscle.braid, pressure=drive.supply_pressure, length=rest)
    conductance, ratio, tube_volume = 1.0, 0.5, 1.0
    if tube is not None:
        conductance = float(gas.tube_conductance(diameter=tube.inside_diameter, length=tube.length))
        ratio = float(gas.tube_critical_ratio(diameter=tube.inside_diameter, length=tube.length))
        tube_volume = tube.volume
    regulator = drive.regulator or Regulator(1.0, 1.0)
    control = drive.flow_control or FlowControl(_FREE, _FREE)
    quick = drive.quick_exhaust or QuickExhaust(1e-8)
    table = {
        "supply_pressure": drive.supply_pressure + drive.ambient_pressure,
        "ambient_pressure": drive.ambient_pressure,
        "ambient_temperature": drive.temperature,
        "fill_conductance": drive.valve.fill_conductance,
        "fill_ratio": drive.valve.fill_ratio,
        "exhaust_conductance": drive.valve.exhaust_conductance,
        "exhaust_ratio": drive.valve.exhaust_ratio,
        "regulator_range": regulator.range,
        "regulator_time": regulator.time,
        "regulator_damping": 1.0 if regulator.damping is None else regulator.damping,
        "regulator_band": regulator.band,
        "regulator_dead_band": regulator.dead_band,
        "filling_restriction": min(control.fill_conductance, _FREE),
        "filling_restriction_ratio": control.fill_ratio,
        "venting_restriction": min(control.exhaust_conductance, _FREE),
        "venting_restriction_ratio": control.exhaust_ratio,
        "quick_exhaust_conductance": quick.conductance,
        "quick_exhaust_ratio": quick.critical_ratio,
        "quick_exhaust_band": quick.band,
        "tube_volume": tube_volume,
        "tube_conductance": conductance,
        "tube_ratio": ratio,
        "fitting_volume": drive.fitting_volume,
        "polytropic_exponent": drive.polytropic_exponent or 1.0,
        "wall_heat_transfer": drive.wall_heat_transfer,
        "mass": load.mass,
        "own_mass": max(drive.own_mass, _LIGHTEST - load.mass),
        "gravity": GRAVITY * sin(load.inclination),
        "spring": load.spring,
        "lever_ratio": load.lever_ratio,
        "precontraction": drive.precontraction * rest,
        "stop_low": stop_low,
        "stop_high": stop_high,
        "slack_damping": max(float(blocked) / (0.25 * rest), 1.0) * _SLACK_TIME,
    }
    if drive.path is not None:
        table |= drive.path.constants
    wanted = drive.structure.constants
    assert table.keys() == set(wanted)  # noqa: S101 - a constant without a value is a programming error
    table |= {name: float(getattr(muscle, name)) for name in GEOMETRY}
    for effect, effect_values in drive.model.values.items():
        for name, value in effect_values.items():
            table[f"{effect}.{name}"] = value
    return table


def parameters_of(drive: Drive, compiled: CompiledDrive) -> np.ndarray:
    """The constants of a run in the order of the compiled model's parameters."""
    table = constants_of(drive)
    return np.array([table[name] for name in compiled.model.parameters])


def dead_times(drive: Drive) -> tuple[float, float]:
    """Dead times of opening and of closing due to the effects [s]."""
    tube = drive.tube or drive.assumed_tube
    tube_length = 0.0 if tube is None else tube.length
    on, off = 0.0, 0.0
    for effect in Model(drive.model.effects).effects:
        if "command_delay" in effect.slots:
            own = effect.call("command_delay", {"tube_length": tube_length}, drive.model.values[effect.id])
            on, off = on + float(own[0]), off + float(own[1])
    return on, off


def external_force(drive: Drive) -> Segments:
    """The external force as linear segments."""
    force = drive.load.force
    if isinstance(force, Signal):
        return force.segments(drive.duration)
    return Segments(np.array([0.0, drive.duration]), np.array([float(force)]), np.zeros(1))


def segments_of(drive: Drive) -> tuple[np.ndarray, np.ndarray, Segments]:
    """Segment boundaries, inputs of each segment, and the command after the dead times of the effects."""
    return segments_after(drive, dead_times(drive))


def segments_after(drive: Drive, delays: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, Segments]:
    """As `segments_of`, with these dead times of opening and of closing [s]."""
    on, off = delays
    unshifted = drive.command.segments(drive.duration)
    command = delayed(_switched(drive, unshifted), on, off, before=drive.command.before)
    command, external = merged(command, external_force(drive))
    counter = command  # unused for a single muscle
    if drive.pair:
        opposite = np.array([drive.counter(value) for value in unshifted.start_values])
        mirrored = Segments(unshifted.times, opposite, -unshifted.slopes)
        mirrored = _switched(drive, mirrored)
        counter, _ = merged(delayed(mirrored, on, off, before=drive.counter(drive.command.before)), command)
        command, external = merged(command, counter)[0], merged(external, counter)[0]
    columns = {
        "opening": command.start_values,
        "opening_slope": command.slopes,
        "counter_opening": counter.start_values,
        "counter_opening_slope": counter.slopes,
        "external_force": external.start_values,
        "external_force_slope": external.slopes,
        "begin": command.times[:-1],
    }
    return command.times, np.column_stack([columns[name] for name in INPUTS]), command


def _switched(drive: Drive, command: Segments) -> Segments:
    """The openings of switching valves, or the command itself."""
    return command if drive.pwm is None else drive.pwm.switched(command)


def before_of(drive: Drive, inputs: np.ndarray) -> np.ndarray:
    """Inputs before t = 0: the valve has the command's value before it, not that of the first segment."""
    before = inputs[0].copy()
    rest_command = drive.command.before
    for name, value in (("opening", rest_command), ("counter_opening", drive.counter(rest_command))):
        before[INPUTS.index(name)], before[INPUTS.index(f"{name}_slope")] = value, 0.0
    return before


def held_interval(drive: Drive) -> tuple[float, float] | None:
    """Strokes [m] between which dry friction holds the load at the start; None where it holds it nowhere."""
    compiled = compiled_drive(drive.structure)
    if not any(switch.slides for switch in compiled.model.switches):
        return None
    inputs = np.zeros(len(INPUTS))
    inputs[INPUTS.index("external_force")] = float(external_force(drive).value(0.0))
    return held_between(drive, compiled, parameters_of(drive, compiled), inputs)


def simulate(
    drive: Drive,
    *,
    points: int = 2001,
    grid: np.ndarray | None = None,
    tolerance: float = TOLERANCE,
    start: Start | None = None,
) -> Run:
    """Run a drive.

    Args:
        drive: what to run.
        points: rows of the evenly spaced time grid.
        grid: ascending times of the rows within the duration; replaces ``points``.
        tolerance: relative error per step.
        start: where it begins; None = where it rests.
    """
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    times, inputs, command = segments_of(drive)
    start = start or start_of(drive, compiled, parameters, before_of(drive, inputs))
    grid = np.linspace(0.0, drive.duration, points) if grid is None else grid
    began = time.perf_counter()
    solution = integrate(
        compiled,
        parameters=parameters,
        start=start.state,
        switches=start.switches,
        restitution=drive.restitution,
        times=times,
        inputs=inputs,
        grid=grid,
        tolerance=tolerance,
    )
    return run_of(drive, compiled, grid, start, solution, command, time.perf_counter() - began)


def run_of(
    drive: Drive,
    compiled: CompiledDrive,
    grid: np.ndarray,
    start: Start,
    solution: Solution,
    command: Segments,
    wall_seconds: float,
) -> Run:
    """The rows of a solution by name."""
    size = compiled.size
    time_axis = grid[: len(solution.rows)]
    names = compiled.model.output_names
    outputs = {name: solution.rows[:, size + index] for index, name in enumerate(names)}
    outputs["force_reading"] = skewed(drive.model, time_axis, outputs["force_reading"])
    return Run(
        time=time_axis,
        states={state.name: solution.rows[:, index] for index, state in enumerate(compiled.model.states)},
        outputs=outputs,
        events=events_of(compiled, solution.events),
        start=start,
        outcome=solution.outcome,
        command=command,
        drive=drive,
        steps=solution.steps,
        wall_seconds=wall_seconds,
    )


def skewed(model: StaticModel, time: np.ndarray, reading: np.ndarray) -> np.ndarray:
    """The force reading delayed by the time skew of the effects."""
    delay = float(Model(model.effects).sum("skew", model.values, {}))
    return np.interp(time - delay, time, reading) if delay and len(time) else reading
