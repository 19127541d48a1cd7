"""The kernels that numba compiles once per installation: a free run, and a run under a sampled controller.

Both go through the same step (`mckibben.simulation.integrate.rodas.advance`) and hold no physics.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.command import pid
from mckibben.simulation.integrate import coefficients, rodas, switching
from mckibben.simulation.integrate.rodas import advance, buffers_of, packed_for
from mckibben.simulation.integrate.stamp import stamped_with
from mckibben.simulation.integrate.switching import call

_pid_step: Any = pid.compiled_pid_step()


class Status(IntEnum):
    """How a run of the kernel ended."""

    COMPLETED = 0
    STEP_TOO_SMALL = 1
    TOO_MANY_STEPS = 2
    NOT_FINITE = 3


_stamped = stamped_with(pid, coefficients, switching, rodas)
_PLAN = (
    "Tuple((uint64[::1],uint64[::1],uint64[::1],uint64[:,::1],uint64[::1],uint64[:,::1],uint64[:,::1],"
    "uint64[:,::1]))"
)
_SWITCHING = "UniTuple(float64[::1],5)"
_MODEL = (
    f"UniTuple(int64,4),{_PLAN},int64,int64,UniTuple(int64,2),{_SWITCHING},float64[::1],float64[::1],"
    "float64[::1]"
)
_RESULT = "float64[::1],float64,float64[::1],float64[:,::1],float64[:,::1],int64[::1],int64"


@njit(f"int64({_MODEL},float64[::1],float64[:,::1],float64[::1],{_RESULT})", cache=True, nogil=True)
@_stamped
def rodas4(
    functions: tuple[int, int, int, int],
    plan: Any,
    positions: int,
    clock: int,
    moved: tuple[int, int],
    switching: Any,
    constants: np.ndarray,
    state: np.ndarray,
    switches: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    first_step: np.ndarray,
    grid: np.ndarray,
    rtol: float,
    atol: np.ndarray,
    out: np.ndarray,
    events: np.ndarray,
    counts: np.ndarray,
    max_steps: int,
) -> int:
    """Integrate segment by segment and write states and outputs on a grid.

    Args:
        functions: addresses of ``rates``, ``jacobian``, ``outputs`` and ``guards``.
        plan, positions: see `mckibben.simulation.integrate.elimination.Plan`.
        clock: number of the state that is time.
        moved: numbers of the states stroke and speed, which end stops act on; -1 without stops.
        switching: of each switch the least guard and the stroke of its end stop (NaN: none); the coefficient
            of restitution, the speed [m/s] and the height [m] below which the load does not rebound, and the
            stiffness of guards of lengths [N/m]; of each switch the number of the length that follows
            (-1: none); and the numbers of the states that guards depend on.
        constants: arguments of the functions between states and inputs.
        state: start, overwritten with the end.
        switches: start, overwritten with the end.
        times: segment boundaries, one more than segments, ascending; no step crosses one.
        inputs: constants of each segment, shape (segments, inputs).
        first_step: first step to try, shape (1,); overwritten with the next step to try.
        grid: ascending times between the first and the last boundary, at which ``out`` is written.
        rtol, atol: error per step: weighted root mean square below 1; ``atol`` has one entry per state.
        out: shape (grid, states + outputs).
        events: rows (instant, number of the switch, its new value, speed and acceleration just before);
            further events are counted, not written.
        counts: accepted steps, rejected steps, grid rows written and events; incremented in place.
        max_steps: give up after this many accepted and rejected steps.

    Returns:
        a `Status`.
    """
    n, fixed = state.shape[0], constants.shape[0]
    packed = packed_for(n, constants, inputs.shape[1], switches.shape[0])
    buffers = buffers_of(n, out.shape[1], positions, plan, switches.shape[0])
    span = np.zeros(3)
    span[2] = first_step[0]
    state[clock] = times[0]
    status = 0
    for segment in range(inputs.shape[0]):
        span[0], span[1] = times[segment], times[segment + 1]
        for i in range(inputs.shape[1]):
            packed[n + fixed + i] = inputs[segment, i]
        status = advance(
            functions, plan, positions, clock, moved, switching, packed, state, switches, span, grid,
            grid.shape[0], rtol, atol, out, events, counts, max_steps, buffers,
        )  # fmt: skip
        if status != 0:
            break
    first_step[0] = span[2]
    return status


_LOOP = (
    "int64,int64,float64[::1],UniTuple(float64,8),int64[::1],Tuple((float64[::1],float64[::1],float64[::1],"
    "float64[::1])),float64[::1],int64[::1],float64[:,::1],float64[:,::1]"
)


@njit(f"int64({_MODEL},{_LOOP},{_RESULT})", cache=True, nogil=True)
@_stamped
def rodas4_sampled(
    functions: tuple[int, int, int, int],
    plan: Any,
    positions: int,
    clock: int,
    moved: tuple[int, int],
    switching: Any,
    constants: np.ndarray,
    state: np.ndarray,
    switches: np.ndarray,
    first: int,
    stop: int,
    loop: np.ndarray,
    gains: tuple[float, ...],
    places: np.ndarray,
    signals: tuple[np.ndarray, ...],
    memory: np.ndarray,
    marks: np.ndarray,
    queue: np.ndarray,
    commands: np.ndarray,
    grid: np.ndarray,
    rtol: float,
    atol: np.ndarray,
    out: np.ndarray,
    events: np.ndarray,
    counts: np.ndarray,
    max_steps: int,
) -> int:
    """Integrate samples ``first`` to ``stop`` - 1 of a controlled run: measure, step the PID, integrate.

    A command is delayed by the dead time of its direction and never overtakes an earlier one.

    Args:
        loop: duration, dead times of opening and closing, lever ratio, and the second muscle's command at
            command 0 and its change with the command.
        gains: `mckibben.simulation.command.pid.PidController.constants`.
        places: of the measured output, and of the inputs opening, counter_opening, external_force, its slope
            and begin; the last entry is the number of inputs.
        signals: set point of every sample; times, start values and slopes of the external force.
        memory: integral, rate, last measurement, last command, active command, next step to try.
        marks: first and last + 1 of the pending commands, number of ``commands`` so far.
        queue: pending commands, rows (instant, command); one row per sample.
        commands: commands that became active, rows (instant, command); one row more than samples.

    The other arguments are those of `rodas4`; memory, marks, queue, commands and switches persist.
    """
    duration, opening_time, closing_time, lever, counter, counter_slope = loop
    set_points, force_times, forces, force_slopes = signals
    n, fixed, width = state.shape[0], constants.shape[0], out.shape[1]
    period, at = gains[4], n + fixed
    packed = packed_for(n, constants, places[6], switches.shape[0])
    buffers = buffers_of(n, width, positions, plan, switches.shape[0])
    values = buffers[4]
    span = np.zeros(3)
    piece = upper = 0
    for sample in range(first, stop):
        now, end = sample * period, min((sample + 1) * period, duration)
        for i in range(n):
            packed[i] = state[i]
        packed[at:] = 0.0
        call(functions[2], values.ctypes.data, packed.ctypes.data)
        measured = values[places[0]] / lever
        command, memory[0], memory[1] = _pid_step(
            set_points[sample], measured, memory[0], memory[1], memory[2], *gains
        )
        due = now + (opening_time if command > memory[3] else closing_time)
        memory[2], memory[3] = measured, command
        while marks[1] > marks[0] and queue[marks[1] - 1, 0] >= due:
            marks[1] -= 1
        queue[marks[1], 0], queue[marks[1], 1] = due, command
        marks[1] += 1
        while now < end:
            while marks[0] < marks[1] and queue[marks[0], 0] <= now:
                memory[4] = queue[marks[0], 1]
                commands[marks[2], 0], commands[marks[2], 1] = now, memory[4]
                marks[0] += 1
                marks[2] += 1
            while piece < forces.shape[0] - 1 and force_times[piece + 1] <= now:
                piece += 1
            limit = min(end, force_times[piece + 1]) if force_times[piece + 1] > now else end
            if marks[0] < marks[1]:
                limit = min(limit, queue[marks[0], 0])
            while upper < grid.shape[0] and (grid[upper] < limit or limit >= duration):
                upper += 1
            packed[at + places[1]] = memory[4]
            packed[at + places[2]] = counter + counter_slope * memory[4]
            packed[at + places[3]] = forces[piece] + force_slopes[piece] * (now - force_times[piece])
            packed[at + places[4]] = force_slopes[piece]
            packed[at + places[5]] = now
            span[0], span[1], span[2] = now, limit, memory[5]
            status = advance(
                functions, plan, positions, clock, moved, switching, packed, state, switches, span, grid,
                upper, rtol, atol, out, events, counts, max_steps, buffers,
            )  # fmt: skip
            memory[5] = span[2]
            if status != 0:
                return status
            now = limit
    return 0
