"""Driven runs: from measured pressure and length to force, or from measured pressure to motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.physics.muscle import GEOMETRY
from mckibben.simulation.drive.initial_state import settle, without_friction
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.recorded_run import RecordedRun
from mckibben.simulation.drive.transient import constants_of, external_force, skewed
from mckibben.simulation.integrate.engine import (
    CompiledDrive,
    Outcome,
    compiled_driven,
    integrate,
)
from mckibben.simulation.integrate.many import integrate_many
from mckibben.simulation.outcome import MAX_STEPS
from mckibben.simulation.statics.model import StaticModel

TOLERANCE = 1e-6
_MOTION = ("stroke_reading", "force_reading", "stroke", "speed")  # what a run under a measured pressure gives


def force_of_record(
    model: StaticModel,
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    length: np.ndarray,
    temperature: float = ROOM_TEMPERATURE,
    tolerance: float = TOLERANCE,
) -> np.ndarray:
    """The force reading [N] at each time of a record of gauge pressure [Pa] and length [m].

    Rates and states of the effects are integrated along the record, linear between samples. Before the record
    everything is at rest at the first sample.

    Args:
        model: the muscle with its effects.
        time: ascending [s], shape (rows,), at least two rows.
        pressure, length: as measured, same shape.

    Raises:
        InputError: times that do not ascend, or an effect whose states diverge on this record.
    """
    outputs = states_of_record(
        model, time=time, pressure=pressure, length=length, temperature=temperature, tolerance=tolerance
    )
    return skewed(model, time, outputs["force_reading"])


def states_of_record(
    model: StaticModel,
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    length: np.ndarray,
    temperature: float = ROOM_TEMPERATURE,
    tolerance: float = TOLERANCE,
    begin: Mapping[str, float] | None = None,
) -> dict[str, np.ndarray]:
    """The states ("effect.state") and readings that `force_of_record` integrates, at each time of the record.

    Args:
        begin: states that do not begin at rest.

    Raises:
        InputError: as for `force_of_record`.
    """
    compiled = compiled_driven(model.effects, motion=False)
    table = {"temperature": temperature, **_geometry(model), **_named(model)}
    inputs, start = _held_inputs(time, pressure, length), _start(compiled, time, begin or {})
    return _run(compiled, table, inputs, start, time, tolerance)


def states_of_records(
    models: Sequence[StaticModel],
    names: Sequence[str],
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    length: np.ndarray,
    begins: Sequence[Mapping[str, float]],
    temperature: float = ROOM_TEMPERATURE,
    tolerance: float = TOLERANCE,
) -> list[dict[str, np.ndarray]]:
    """Some states along one record of models with the same effects: as `states_of_record`, at once.

    Args:
        models: with the same effects.
        names: of the states wanted ("effect.state").
        time, pressure, length: the record.
        begins: of each model, states that do not begin at rest.
        temperature: [K].
        tolerance: relative error per step.

    Raises:
        InputError: as for `force_of_record`.
    """
    compiled = compiled_driven(models[0].effects, motion=False)
    tables = [{"temperature": temperature, **_geometry(model), **_named(model)} for model in models]
    parameters = np.array([[table[name] for name in compiled.model.parameters] for table in tables])
    inputs = _held_inputs(time, pressure, length)
    packed_inputs, at_rest = _packed(compiled, inputs)
    starts = np.array([_start(compiled, time, begin) for begin in begins])
    for start, constants in zip(starts, parameters, strict=True):
        settle(compiled, start, constants, at_rest)
    solutions = integrate_many(
        compiled,
        parameters=parameters,
        starts=starts,
        times=time,
        inputs=packed_inputs,
        grid=time,
        tolerance=tolerance,
        columns=names,
    )
    for outcome, written in zip(solutions.outcomes, solutions.written, strict=True):
        if outcome is not Outcome.COMPLETED:
            raise _unfollowed(time, int(written), outcome.advice())
    return [dict(zip(names, rows.T.copy(), strict=True)) for rows in solutions.rows]


def _held_inputs(time: np.ndarray, pressure: np.ndarray, length: np.ndarray) -> dict[str, np.ndarray]:
    steps = _steps(time)
    return {
        "pressure": pressure[:-1],
        "pressure_slope": np.diff(pressure) / steps,
        "length": length[:-1],
        "length_slope": np.diff(length) / steps,
        "direction": _directions(length),
        "begin": time[:-1],
    }


def _directions(length: np.ndarray) -> np.ndarray:
    """Direction of the dry friction between two rows: that of the length, at rest that of its last motion."""
    step = np.sign(np.diff(length))
    last = np.maximum.accumulate(np.where(step != 0.0, np.arange(len(step)), 0))
    return step[last]


def _start(compiled: CompiledDrive, time: np.ndarray, begin: Mapping[str, float]) -> np.ndarray:
    names = [state.name for state in compiled.model.states]
    start = np.array([state.initial or 0.0 for state in compiled.model.states])
    start[0] = time[0]
    for name, value in begin.items():
        start[names.index(name)] = value
    return start


def _packed(compiled: CompiledDrive, inputs: Mapping[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """The inputs of each segment, and those of the first one without slopes."""
    names = compiled.model.inputs
    packed = np.column_stack([inputs[name] for name in names])
    return packed, packed[0] * ~np.array([name.endswith("_slope") for name in names])


def _unfollowed(time: np.ndarray, written: int, why: str) -> InputError:
    return InputError(
        f"the model does not follow this record beyond {time[max(written - 1, 0)]:.4g} s",
        field="effects",
        hint=why,
    )


def motion_of_record(
    drive: Drive, *, time: np.ndarray, pressure: np.ndarray, stroke: float, tolerance: float = TOLERANCE
) -> dict[str, np.ndarray]:
    """Stroke and force readings of a load under a measured gauge pressure [Pa].

    Args:
        drive: muscle, load and stops; its valve, tube and command are not used.
        time, pressure: the record, see `force_of_record`.
        stroke: stroke of the muscle at the first row [m], where it is at rest.

    Returns:
        ``stroke_reading`` [m], ``force_reading`` [N] and ``stroke``, ``speed`` at each time.

    Raises:
        InputError: times that do not ascend, or a drive that does not follow the record to its end.
    """
    (found,) = motions_of_records([drive], time=time, pressure=pressure, stroke=stroke, tolerance=tolerance)
    if found.stop:
        raise _unfollowed(time, len(found["stroke"]), found.stop)
    return dict(found.readings)


class BegunMotion(NamedTuple):
    """What a run under a measured pressure begins with: states, switches, constants, inputs of segments."""

    start: np.ndarray
    switches: np.ndarray
    parameters: np.ndarray
    inputs: np.ndarray


def begun_motion(
    drive: Drive,
    compiled: CompiledDrive,
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    stroke: float,
    speed: float = 0.0,
) -> BegunMotion:
    """The start of `motion_of_record`, where the load is at rest unless a speed is given.

    Args:
        drive, time, pressure, stroke: as there.
        compiled: the equations of its motion.
        speed: of the load there, along the stroke [m/s].

    Raises:
        InputError: times that do not ascend.
    """
    steps, names = _steps(time), [state.name for state in compiled.model.states]
    table = constants_of(drive) | {"temperature": drive.temperature}
    external = external_force(drive).value(time - time[0])
    inputs = {
        "pressure": pressure[:-1],
        "pressure_slope": np.diff(pressure) / steps,
        "external_force": external[:-1],
        "external_force_slope": np.diff(external) / steps,
        "begin": time[:-1],
    }
    start = np.array([state.initial or 0.0 for state in compiled.model.states])
    low, high = drive.stops
    start[names.index("clock")], start[names.index("stroke")] = time[0], min(max(stroke, low), high)
    constants = np.array([table[name] for name in compiled.model.parameters])
    columns, at_rest = _packed(compiled, inputs)
    settle(compiled, start, constants, at_rest)
    held = np.zeros(len(compiled.model.switches))
    packed = np.concatenate([start, constants, at_rest])
    without_friction(compiled, held, lambda given: compiled.guards(packed, given))
    if speed != 0.0:
        start[names.index("speed")] = speed
        rubs = [index for index, switch in enumerate(compiled.model.switches) if switch.slides]
        for index in rubs if not any(held[index] for index in rubs) else ():
            held[index] = float(compiled.model.switches[index].slides * speed > 0.0)
    return BegunMotion(start, held, constants, columns)


def motions_of_records(
    drives: Sequence[Drive],
    *,
    time: np.ndarray,
    pressure: np.ndarray,
    stroke: float,
    starts: Sequence[tuple[float, float]] | None = None,
    tolerance: float = TOLERANCE,
    grid: np.ndarray | None = None,
    max_steps: int = MAX_STEPS,
) -> list[RecordedRun]:
    """`motion_of_record` of drives that differ in numbers only, side by side; each as it would be alone.

    Args:
        drives: of the same effects.
        time, pressure, stroke: see `motion_of_record`; every row of the record drives the motion.
        starts: of each drive how far beyond the stroke it begins [m], and how fast [m/s]; None: at rest.
        tolerance: relative error per step.
        grid: ascending times within the record at which readings are wanted [s]; default: those of its rows.
        max_steps: most accepted and rejected steps of a run, which stops there.

    Raises:
        InputError: times that do not ascend.
    """
    grid = time if grid is None else grid
    first = drives[0]
    compiled = compiled_driven(first.model.effects, motion=True)
    parameters, states, switches, packed = [], [], [], []
    alike = all(drive.load is first.load for drive in drives)  # then one table of inputs serves them all
    for drive, (beyond, speed) in zip(drives, starts or [(0.0, 0.0)] * len(drives), strict=True):
        begun = begun_motion(
            drive, compiled, time=time, pressure=pressure, stroke=stroke + beyond, speed=speed
        )
        switches.append(begun.switches)
        parameters.append(begun.parameters)
        states.append(begun.start)
        if not (alike and packed):
            packed.append(begun.inputs)
    solutions = integrate_many(
        compiled,
        parameters=np.array(parameters),
        starts=np.array(states),
        switches=np.array(switches),
        times=time,
        inputs=packed[0] if alike else np.array(packed),
        grid=grid,
        tolerance=tolerance,
        columns=_MOTION,
        restitution=first.restitution,
        max_steps=max_steps,
    )
    found = []
    for number, drive in enumerate(drives):
        rows = solutions.rows[number, : solutions.written[number]]
        outputs = dict(zip(_MOTION, rows.T.copy(), strict=True))
        outputs["force_reading"] = skewed(drive.model, grid[: len(rows)], outputs["force_reading"])
        found.append(RecordedRun(outputs, *solutions.ending(number, max_steps)))
    return found


def _run(
    compiled: CompiledDrive,
    table: dict[str, float],
    inputs: dict[str, np.ndarray],
    start: np.ndarray,
    time: np.ndarray,
    tolerance: float,
) -> dict[str, np.ndarray]:
    model = compiled.model
    parameters = np.array([table[name] for name in model.parameters])
    packed_inputs, at_rest = _packed(compiled, inputs)
    settle(compiled, start, parameters, at_rest)
    solution = integrate(
        compiled,
        parameters=parameters,
        start=start,
        times=np.ascontiguousarray(time, dtype=float),
        inputs=packed_inputs,
        grid=np.ascontiguousarray(time, dtype=float),
        tolerance=tolerance,
    )
    if solution.outcome is not Outcome.COMPLETED:
        raise _unfollowed(time, len(solution.rows), solution.outcome.advice())
    columns = (*(state.name for state in model.states), *model.output_names)
    return dict(zip(columns, solution.rows.T, strict=True))


def _steps(time: np.ndarray) -> np.ndarray:
    steps = np.diff(time)
    if len(time) < 2 or not np.all(steps > 0.0):
        raise InputError("the times of a record must ascend", field="time")
    return steps


def _geometry(model: StaticModel) -> dict[str, float]:
    return {name: float(getattr(model.muscle, name)) for name in GEOMETRY}


def _named(model: StaticModel) -> dict[str, float]:
    return {
        f"{effect}.{name}": value
        for effect, parameters in model.values.items()
        for name, value in parameters.items()
    }
