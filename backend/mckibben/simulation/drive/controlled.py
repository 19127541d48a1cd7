"""A drive under a sampled position controller: integrate one sample, measure, set the next command.

The kernel runs the whole loop. The same loop in Python serves other integrators, and checks the kernel.
"""

from __future__ import annotations

import time
from collections import deque
from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.command.pid import PidController, PidState
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.initial_state import Start, start_of
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    Run,
    dead_times,
    external_force,
    parameters_of,
    run_of,
)
from mckibben.simulation.integrate.engine import (
    EVENT_WIDTH,
    FIRST_STEP,
    MAX_STEPS,
    MOST_EVENTS,
    CompiledDrive,
    Outcome,
    Solution,
    compiled_drive,
    integrate,
    kernel,
    outcome_of,
    switching_of,
)
from mckibben.simulation.outcome import Watch

# The kernel returns this often, to check whether the run is to continue.
_SAMPLES_AT_ONCE = 1000
_MEASURED = OUTPUTS.index("stroke_reading")
_PLACES = ("opening", "counter_opening", "external_force", "external_force_slope", "begin")


@dataclass(frozen=True)
class ControlLoop:
    """A controlled run and its inputs.

    Attributes:
        drive, compiled, parameters, tolerance: as for a free run.
        controller: the controller.
        external: external force on the load over time.
        set_points: reference at every sample [m], shape (samples,).
        start: states and switches at rest.
        grid: times of the rows.
        watch: may end it early.
    """

    drive: Drive
    compiled: CompiledDrive
    controller: PidController
    external: Segments
    set_points: np.ndarray
    parameters: np.ndarray
    start: Start
    grid: np.ndarray
    tolerance: float
    watch: Watch


def simulate_controlled(
    drive: Drive,
    *,
    points: int = 2001,
    grid: np.ndarray | None = None,
    tolerance: float = TOLERANCE,
    engine: str = "rodas",
    watch: Watch | None = None,
) -> Run:
    """Run a drive whose controller follows its reference; the command is held between samples.

    The controller uses the sensor reading of the load's stroke. A rising (falling) command acts after the
    dead time of opening (closing). Commands act in the order in which they were issued.

    Args:
        drive: what to run.
        points, grid, tolerance, watch: as in `mckibben.simulation.drive.transient.simulate`.
        engine: "rodas" waits for the kernel, "auto" uses it if it is ready, "lsoda" never uses it.

    Raises:
        InputError: more than a million samples.
    """
    controller, reference = drive.controller, drive.reference
    if controller is None or reference is None:
        raise ValueError("the drive has no controller or no reference")
    period = controller.sample_time
    samples = int(np.ceil(drive.duration / period - 1e-9))
    if samples > 1_000_000:
        raise InputError(
            f"{drive.duration:g} s at {period:g} s make {samples} samples, at most a million",
            field="controller.sample_time",
        )
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    external = external_force(drive)
    begin = _inputs(0.0, drive.counter(0.0), external, 0.0)[0]
    loop = ControlLoop(
        drive=drive,
        compiled=compiled,
        controller=controller,
        external=external,
        set_points=reference.value(np.arange(samples) * period),
        parameters=parameters,
        start=start_of(drive, compiled, parameters, begin),
        grid=np.linspace(0.0, drive.duration, points)
        if grid is None
        else np.ascontiguousarray(grid, dtype=float),
        tolerance=tolerance,
        watch=watch or Watch(),
    )
    if engine == "rodas":
        kernel.warm().join()
    began = time.perf_counter()
    by_kernel = engine != "lsoda" and kernel.ready() is not None
    solution, commands = loop_in_kernel(loop) if by_kernel else loop_in_python(loop, engine)
    command = Segments(np.append(commands[:, 0], drive.duration), commands[:, 1], np.zeros(len(commands)))
    return run_of(drive, compiled, loop.grid, loop.start, solution, command, time.perf_counter() - began)


def loop_in_kernel(loop: ControlLoop) -> tuple[Solution, np.ndarray]:
    """The run by the kernel, and the commands that became active (rows of instant and command)."""
    drive, compiled, external = loop.drive, loop.compiled, loop.external
    kernels = kernel.ready()
    if kernels is None:
        raise RuntimeError("the kernel is not ready")
    samples = len(loop.set_points)
    lever = drive.load.lever_ratio  # the controller measures the load
    mirrored = drive.counter(0.0)
    figures = np.array(
        [drive.duration, *dead_times(drive), lever, mirrored, drive.counter(1.0) - mirrored], dtype=float
    )
    places = np.array([_MEASURED, *(INPUTS.index(name) for name in _PLACES), len(INPUTS)])
    signals = (
        np.ascontiguousarray(loop.set_points, dtype=float),
        *(np.ascontiguousarray(column, dtype=float) for column in external),
    )
    memory = np.array([*_first_memory(loop), 0.0, 0.0, FIRST_STEP])
    marks = np.array([0, 0, 1])
    queue, commands = np.empty((samples, 2)), np.zeros((samples + 1, 2))
    rows = np.empty((len(loop.grid), compiled.size + compiled.width))
    counts, state, switches = np.zeros(4, np.int64), loop.start.state.copy(), loop.start.switches.copy()
    events = np.zeros((MOST_EVENTS, EVENT_WIDTH))
    switching = switching_of(compiled, compiled.stops(loop.parameters), drive.restitution)
    constants = compiled.codes.constants(loop.parameters)
    outcome = Outcome.COMPLETED
    for first in range(0, samples, _SAMPLES_AT_ONCE):
        if ended := loop.watch.ended(first / samples):
            outcome = ended
            break
        status = kernels.sampled(
            *compiled.codes.given,
            compiled.moved,
            switching,
            constants,
            state,
            switches,
            first,
            min(first + _SAMPLES_AT_ONCE, samples),
            figures,
            loop.controller.constants,
            places,
            signals,
            memory,
            marks,
            queue,
            commands,
            loop.grid,
            loop.tolerance,
            loop.tolerance * compiled.scales,
            rows,
            events,
            counts,
            int(counts[0] + counts[1]) + MAX_STEPS,
        )
        outcome = outcome_of(status)
        if outcome is not Outcome.COMPLETED:
            break
    steps, rejected, written, happened = (int(count) for count in counts)
    solution = Solution(rows[:written], state, switches, events[:happened], outcome, steps, rejected, "rodas")
    return solution, commands[: marks[2]]


def loop_in_python(loop: ControlLoop, engine: str) -> tuple[Solution, np.ndarray]:
    """The run sample by sample by `integrate`; result as `loop_in_kernel`."""
    drive, compiled, external, grid = loop.drive, loop.compiled, loop.external, loop.grid
    period, delays, samples = loop.controller.sample_time, dead_times(drive), len(loop.set_points)
    memory = _first_memory(loop)
    pending: deque[tuple[float, float]] = deque()
    active = last_command = 0.0
    state, switches, first_step = loop.start.state, loop.start.switches, FIRST_STEP
    events = [np.empty((0, EVENT_WIDTH))]
    rows = [np.empty((0, compiled.size + compiled.width))]
    commands, steps, rejected = [(0.0, active)], 0, 0
    outcome = Outcome.COMPLETED
    for sample in range(samples):
        if ended := loop.watch.ended(sample / samples):
            outcome = ended
            break
        now, end = sample * period, min((sample + 1) * period, drive.duration)
        measured = _measured(loop, state)
        command, memory = loop.controller.step(float(loop.set_points[sample]), measured, memory)
        due = now + (delays[0] if command > last_command else delays[1])
        last_command = command
        while pending and pending[-1][0] >= due:  # never overtake an earlier command
            pending.pop()
        pending.append((due, command))
        while now < end and outcome is Outcome.COMPLETED:
            while pending and pending[0][0] <= now:
                active = pending.popleft()[1]
                commands.append((now, active))
            limits = [end, *external.times[external.times > now][:1]]
            stop = float(min([*limits, pending[0][0]] if pending else limits))
            upper = np.searchsorted(grid, stop, side="right" if stop >= drive.duration else "left")
            lower = np.searchsorted(grid, now, side="left")
            solution = integrate(
                compiled,
                parameters=loop.parameters,
                start=state,
                switches=switches,
                restitution=drive.restitution,
                times=np.array([now, stop]),
                inputs=_inputs(active, drive.counter(active), external, now),
                grid=grid[lower:upper],
                tolerance=loop.tolerance,
                engine=engine,
                first_step=first_step,
            )
            rows.append(solution.rows)
            events.append(solution.events)
            switches = solution.switches
            steps, rejected = steps + solution.steps, rejected + solution.rejected
            state, now, outcome, first_step = solution.end, stop, solution.outcome, solution.next_step
        if outcome is not Outcome.COMPLETED:
            break
    name = "lsoda" if engine == "lsoda" else "rodas"
    solution = Solution(
        np.concatenate(rows), state, switches, np.concatenate(events), outcome, steps, rejected, name
    )
    return solution, np.array(commands)


def _first_memory(loop: ControlLoop) -> PidState:
    return loop.controller.start(measurement=_measured(loop, loop.start.state))


def _inputs(opening: float, counter: float, external: Segments, now: float) -> np.ndarray:
    piece = int(np.clip(np.searchsorted(external.times, now, side="right") - 1, 0, len(external.slopes) - 1))
    values = {
        "opening": opening,
        "opening_slope": 0.0,
        "counter_opening": counter,
        "counter_opening_slope": 0.0,
        "external_force": float(external.value(now)),
        "external_force_slope": float(external.slopes[piece]),
        "begin": now,
    }
    return np.array([[values[name] for name in INPUTS]])


def _measured(loop: ControlLoop, state: np.ndarray) -> float:
    """Sensor reading of the load's stroke [m]; it does not depend on the inputs of the run."""
    packed = np.concatenate([state, loop.parameters, np.zeros(len(INPUTS))])
    reading = float(loop.compiled.outputs(packed)[_MEASURED])
    return reading / loop.drive.load.lever_ratio
