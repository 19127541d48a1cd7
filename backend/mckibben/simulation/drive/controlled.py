"""A drive under a sampled position controller: integrate one sample, measure, set the next command.

The kernel runs the whole loop. The same loop in Python serves other integrators, and checks the kernel.
"""

from __future__ import annotations

import time
from collections import deque
from dataclasses import replace

import numpy as np

from mckibben.physics.drive_terms import INPUTS, OUTPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.command.pid import PidState
from mckibben.simulation.command.pwm import Carrier
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.control_loop import ControlLoop, measured_position
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.joint import JointSteps
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    TOLERANCE,
    Run,
    dead_times,
    external_force,
    parameters_of,
    run_of,
)
from mckibben.simulation.integrate.alone import Alone
from mckibben.simulation.integrate.engine import (
    EVENT_WIDTH,
    FIRST_STEP,
    Outcome,
    Solution,
    compiled_drive,
    integrate,
    kernel,
)
from mckibben.simulation.outcome import Watch

# The kernel returns this often, to check whether the run is to continue.
_SAMPLES_AT_ONCE = 1000
_MEASURED = OUTPUTS.index("stroke_reading")
_PLACES = ("opening", "counter_opening", "external_force", "external_force_slope", "begin")


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
    by_kernel = engine != "lsoda" and kernel.ready() is not None and not (drive.stiffness or drive.pwm)
    solution, commands = loop_in_kernel(loop) if by_kernel else loop_in_python(loop, engine)
    return run_of_loop(loop, solution, commands, time.perf_counter() - began)


def run_of_loop(loop: ControlLoop, solution: Solution, commands: np.ndarray, seconds: float) -> Run:
    """The rows of a controlled run, with what the second muscle of a joint was commanded."""
    times = np.append(commands[:, 0], loop.drive.duration)
    held = [Segments(times, column, np.zeros(len(commands))) for column in commands.T[1:]]
    run = run_of(loop.drive, loop.compiled, loop.grid, loop.start, solution, held[0], seconds)
    return run if len(held) == 1 else replace(run, counter_command=held[1])


def loop_in_kernel(loop: ControlLoop) -> tuple[Solution, np.ndarray]:
    """The run by the kernel, and the commands that became active (rows of instant and command)."""
    drive, compiled, external = loop.drive, loop.compiled, loop.external
    samples, period = len(loop.set_points), loop.controller.sample_time
    lever = drive.load.lever_ratio  # the controller measures the load
    mirrored = drive.counter(0.0)
    figures = np.array(
        [drive.duration, *dead_times(drive), lever, mirrored, drive.counter(1.0) - mirrored], dtype=float
    )
    places = np.array([_MEASURED, *(INPUTS.index(name) for name in _PLACES)])
    signals = (
        np.ascontiguousarray(loop.set_points, dtype=float),
        *(np.ascontiguousarray(column, dtype=float) for column in external),
    )
    # See `mckibben.simulation.integrate.lane_controller`.
    memory, marks = np.array([*_first_memory(loop), 0.0, 0.0, -1.0]), np.array([0, 0, 1, -1, 0])
    queue, commands = np.empty((samples, 2)), np.zeros((samples + 1, 2))
    alone = Alone(
        compiled, parameters=loop.parameters, tolerance=loop.tolerance, restitution=drive.restitution
    )
    packed, values = np.zeros(compiled.codes.outputs.size), np.zeros(compiled.codes.outputs.width)
    packed[compiled.size : compiled.size + len(alone.constants)] = alone.constants
    arguments = figures, loop.controller.constants, places, signals, memory, marks, queue, commands
    # A row at the instant of a command is one of the segment that begins there.
    grid = np.minimum(np.nextafter(loop.grid, np.inf), drive.duration)
    rows, events = np.empty((len(grid), compiled.size + compiled.width)), [np.empty((0, EVENT_WIDTH))]
    state, switches, first_step, outcome = (
        loop.start.state,
        loop.start.switches,
        FIRST_STEP,
        Outcome.COMPLETED,
    )
    steps = rejected = written = 0
    for first in range(0, samples, _SAMPLES_AT_ONCE):
        if ended := loop.watch.ended(first / samples):
            outcome = ended
            break
        stop = min(first + _SAMPLES_AT_ONCE, samples)
        upper = len(grid) if stop == samples else int(np.searchsorted(grid, stop * period, side="right"))
        # Each sample has a segment, and begins another at most, as do each command that waits and each force.
        room = 2 * (stop - first) + int(marks[1] - marks[0]) + len(external.slopes) + 1
        times, marks[-1] = np.full(room + 1, np.inf), stop
        times[0] = first * period
        solution = alone.run(
            start=state,
            switches=switches,
            times=times,
            inputs=np.zeros((room, len(INPUTS))),
            grid=grid[written:upper],
            first_step=first_step,
            measured=compiled.codes.outputs.address,
            loop=(*arguments, packed, values),
        )
        state, switches, outcome = solution.end, solution.switches, solution.outcome
        first_step = solution.next_step
        rows[written : written + len(solution.rows)] = solution.rows
        written += len(solution.rows)
        events.append(solution.events)
        steps, rejected = steps + solution.steps, rejected + solution.rejected
        if outcome is not Outcome.COMPLETED:
            break
    rows[:written, compiled.codes.clock] = loop.grid[:written]
    solution = Solution(
        rows[:written], state, switches, np.concatenate(events), outcome, steps, rejected, "rodas"
    )
    return solution, commands[: marks[2]]


class _PidSteps:
    """The commands of a position controller, sample by sample; a second muscle mirrors them."""

    def __init__(self, loop: ControlLoop) -> None:
        self._loop, self._memory = loop, _first_memory(loop)

    def __call__(self, sample: int, state: np.ndarray) -> tuple[float, float]:
        loop = self._loop
        measured = measured_position(loop, state)
        set_point = float(loop.set_points[sample])
        command, self._memory = loop.controller.step(set_point, measured, self._memory)
        return command, loop.drive.counter(command)


class _Edges:
    """When the openings of both muscles change within a sample, and to what; with a carrier, its pulses."""

    def __init__(self, drive: Drive) -> None:
        self._carrier = None if drive.pwm is None else Carrier(drive.pwm)
        self._openings = [0.0, drive.counter(0.0)]

    def __call__(
        self, begin: float, end: float, command: tuple[float, float]
    ) -> list[tuple[float, float, float]]:
        if self._carrier is None:
            return [(begin, *command)]
        found = []
        for instant, muscle, opening in self._carrier.edges(command, begin, end):
            self._openings[muscle] = opening
            found.append((max(instant, begin), self._openings[0], self._openings[1]))
        return found


def loop_in_python(loop: ControlLoop, engine: str) -> tuple[Solution, np.ndarray]:
    """The run sample by sample by `integrate`; as `loop_in_kernel`, with the second muscle's command."""
    drive, compiled, external, grid = loop.drive, loop.compiled, loop.external, loop.grid
    period, delays, samples = loop.controller.sample_time, dead_times(drive), len(loop.set_points)
    edges_of = _Edges(drive)
    steps_of = _PidSteps(loop) if drive.stiffness is None else JointSteps(loop)
    pending: deque[tuple[float, float, float]] = deque()
    active, counter = 0.0, drive.counter(0.0)
    last_command = 0.0
    state, switches, first_step = loop.start.state, loop.start.switches, FIRST_STEP
    events = [np.empty((0, EVENT_WIDTH))]
    rows = [np.empty((0, compiled.size + compiled.width))]
    commands, steps, rejected = [(0.0, active, counter)], 0, 0
    outcome = Outcome.COMPLETED
    for sample in range(samples):
        if ended := loop.watch.ended(sample / samples):
            outcome = ended
            break
        now, end = sample * period, min((sample + 1) * period, drive.duration)
        command, other = steps_of(sample, state)
        for instant, opening, opposite in edges_of(now, end, (command, other)):
            due = instant + (delays[0] if opening > last_command else delays[1])
            last_command = opening
            while pending and pending[-1][0] >= due:  # never overtake an earlier command
                pending.pop()
            pending.append((due, opening, opposite))
        while now < end and outcome is Outcome.COMPLETED:
            while pending and pending[0][0] <= now:
                _, active, counter = pending.popleft()
                commands.append((now, active, counter))
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
                inputs=_inputs(active, counter, external, now),
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
    return loop.controller.start(measurement=measured_position(loop, loop.start.state))


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
