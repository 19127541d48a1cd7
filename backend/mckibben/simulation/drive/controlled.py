"""A drive under a sampled position controller: integrate one sample, measure, set the next command.

The kernel runs the whole loop, see `mckibben.simulation.integrate.lane_controller`.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from mckibben.physics.drive_terms import COUNTER, INPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.control_loop import ControlLoop, measured_position
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.joint import ROOM, JointStiffness
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
from mckibben.simulation.integrate.engine import EVENT_WIDTH, FIRST_STEP, Outcome, Solution, compiled_drive
from mckibben.simulation.outcome import MAX_STEPS, Watch

# The kernel returns this often, to check whether the run is to continue.
_SAMPLES_AT_ONCE = 1000
_STEPS_A_SAMPLE = 4  # steps of a run for each of its samples, besides those of any run
_PLACES = ("opening", "counter_opening", "external_force", "external_force_slope", "begin")


def simulate_controlled(
    drive: Drive,
    *,
    points: int = 2001,
    grid: np.ndarray | None = None,
    tolerance: float = TOLERANCE,
    watch: Watch | None = None,
) -> Run:
    """Run a drive whose controller follows its reference; the command is held between samples.

    The controller uses the sensor reading of the load's stroke. A rising (falling) command acts after the
    dead time of opening (closing). Commands act in the order in which they were issued.

    Args:
        drive: what to run.
        points, grid, tolerance, watch: as in `mckibben.simulation.drive.transient.simulate`.

    Raises:
        InputError: more than a million samples, or too many periods of a carrier.
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
    if drive.pwm is not None:
        drive.pwm.periods(drive.duration)
    compiled = compiled_drive(drive.structure)
    parameters = parameters_of(drive, compiled)
    external = external_force(drive)
    first = {"counter_opening": drive.counter(0.0), "external_force": float(external.value(0.0))}
    begin = np.array([first.get(name, 0.0) for name in INPUTS])
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
    return run_loop(loop)


def run_loop(loop: ControlLoop) -> Run:
    """A controlled run; of a pair with what the second muscle was commanded."""
    drive = loop.drive
    began = time.perf_counter()
    solution, commands = _in_kernel(loop)
    seconds = time.perf_counter() - began
    times = np.append(commands[:, 0], drive.duration)
    own, counter = (Segments(times, column, np.zeros(len(commands))) for column in commands.T[1:])
    run = run_of(drive, loop.compiled, loop.grid, loop.start, solution, own, seconds)
    return replace(run, counter_command=counter) if drive.pair else run


def _in_kernel(loop: ControlLoop) -> tuple[Solution, np.ndarray]:
    """The run by the kernel, and the openings that became active (rows of instant and both muscles)."""
    from mckibben.simulation.integrate import lane_controller as at  # imports numba, as the kernel does

    drive, compiled, external = loop.drive, loop.compiled, loop.external
    samples, period = len(loop.set_points), loop.controller.sample_time
    lever = drive.load.lever_ratio  # the controller measures the load
    mirrored = drive.counter(0.0)
    figures = np.array([
        drive.duration, *dead_times(drive), lever, mirrored, drive.counter(1.0) - mirrored, 1 + drive.pair
    ], float)  # fmt: skip
    states = [state.name for state in compiled.model.states]
    pressures = (states.index("pressure"), states.index(f"pressure{COUNTER}" if drive.pair else "pressure"))
    places = np.array([*(INPUTS.index(name) for name in _PLACES), *pressures])
    signals = (
        np.ascontiguousarray(loop.set_points, dtype=float),
        *(np.ascontiguousarray(column, dtype=float) for column in external),
    )
    carrier = np.zeros(0) if drive.pwm is None else np.array(drive.pwm.constants)
    # Of each muscle in a sample: one command, or the edges of the carrier.
    edges = 1 if drive.pwm is None else 2 * (int(period * drive.pwm.frequency) + 2)
    # See `mckibben.simulation.integrate.lane_controller`.
    memory, marks = np.zeros(at.MEMORY), np.zeros(at.MARKS, np.int64)
    measured = measured_position(loop, loop.start.state)
    memory[[at.INTEGRAL, at.RATE, at.MEASURED]] = loop.controller.start(measurement=measured)
    memory[at.SAMPLE_END], memory[[at.ISSUED + 1, at.ACTIVE + 1]] = -1.0, mirrored
    marks[[at.COMMANDS, at.SAMPLE]] = 1, -1
    queue, commands = np.empty((2, edges * samples, 2)), np.zeros((2 * edges * samples + 1, 3))
    commands[0, 2] = mirrored
    alone = Alone(
        compiled, parameters=loop.parameters, tolerance=loop.tolerance, restitution=drive.restitution
    )
    reading = compiled.codes.reading
    packed, values = np.zeros(reading.size), np.zeros(reading.width)
    packed[compiled.size : compiled.size + len(alone.constants)] = alone.constants
    arguments = figures, loop.controller.constants, places, signals, memory, marks, queue, commands
    others = packed, values, _joint_of(loop), carrier
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
        # Each sample has a segment, and begins another for each edge, as do what waits and each force.
        waiting = int(sum(marks[at.PENDING_END + muscle] - marks[at.PENDING + muscle] for muscle in (0, 1)))
        room = (1 + 2 * edges) * (stop - first) + waiting + len(external.slopes) + 1
        times, marks[at.STOP] = np.full(room + 1, np.inf), stop
        times[0] = first * period
        solution = alone.run(
            start=state,
            switches=switches,
            times=times,
            inputs=np.zeros((room, len(INPUTS))),
            grid=grid[written:upper],
            first_step=first_step,
            measured=reading.address,
            loop=(*arguments, *others),
            max_steps=MAX_STEPS + _STEPS_A_SAMPLE * samples - steps - rejected,
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
    solution = Solution(rows[:written], state, switches, np.concatenate(events), outcome, steps, rejected)
    return solution, commands[: marks[at.COMMANDS]]


def _joint_of(loop: ControlLoop) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What the stiffness controller of a joint is given."""
    from mckibben.simulation.integrate import lane_controller as at

    drive, control = loop.drive, loop.drive.stiffness
    if control is None:
        return at.NO_JOINT
    joint, period = JointStiffness(drive), loop.controller.sample_time
    wanted = control.reference.value(np.arange(len(loop.set_points)) * period)
    law = [
        drive.ambient_pressure, joint.low, joint.step, joint.radius, joint.full, ROOM, control.kp,
        control.ki * period, float(drive.regulator is not None),
    ]  # fmt: skip
    return np.ascontiguousarray(wanted, dtype=float), np.array(law), joint.table
