"""The segments of a run under a sampled controller, found as it goes: measure, step the PID, hold.

A command is delayed by the dead time of its direction and never overtakes an earlier one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.command import pid
from mckibben.simulation.integrate.switching import call

_pid_step: Any = pid.compiled_pid_step()

# Entries of ``memory``: integral, rate, last measurement, last command, active command, end of the sample.
INTEGRAL, RATE, MEASURED, ISSUED, COMMAND, SAMPLE_END = range(6)
MEMORY = 6
# Entries of ``marks``: first and last + 1 of the pending commands, number of ``commands`` so far, current
# sample, the sample that is not run any more.
PENDING, PENDING_END, COMMANDS, SAMPLE, STOP = range(5)

#: Numba's type of a loop.
LOOP = (
    "Tuple((float64[::1],UniTuple(float64,8),int64[::1],UniTuple(float64[::1],4),float64[::1],int64[::1],"
    "float64[:,::1],float64[:,::1],float64[::1],float64[::1]))"
)
_NONE, _WIDE = np.zeros(0), np.zeros((0, 2))
#: The loop of a run without a controller.
NO_LOOP = (
    _NONE, (0.0,) * 8, np.zeros(0, np.int64), (_NONE,) * 4, _NONE, np.zeros(0, np.int64), _WIDE, _WIDE, _NONE,
    _NONE,
)  # fmt: skip


@njit(error_model="numpy")
def next_segment(
    outputs: int, t: float, segment: int, first: int, times: np.ndarray, inputs: np.ndarray, loop: Any
) -> bool:
    """Write the segment that begins at t; False if the last sample is over.

    Args:
        outputs: address of the outputs of one set.
        segment: its number.
        first: number of states and constants.
        times, inputs: of the segments, shapes (1, segments + 1) and (1, segments, inputs).
        loop: duration, dead times of opening and closing, lever ratio, and the second muscle's command at
            command 0 and its change with the command; the constants of
            `mckibben.simulation.command.pid.PidController`; places of the measured output and of the inputs
            opening, counter_opening, external_force, its slope and begin; set point of every sample, and
            times, start values and slopes of the external force; ``memory``; ``marks``; pending commands and
            those that became active, rows (instant, command), one more of these than samples; arguments of
            one set (states and constants are given); room for the outputs.
    """
    figures, gains, places, signals, memory, marks, queue, commands, packed, values = loop
    duration, opening_time, closing_time, lever, counter, counter_slope = figures
    set_points, force_times, forces, force_slopes = signals
    now, period = t, gains[4]
    if t >= memory[SAMPLE_END]:
        sample = marks[SAMPLE] + 1
        if sample >= marks[STOP]:
            return False
        marks[SAMPLE] = sample
        now = sample * period
        memory[SAMPLE_END] = min((sample + 1) * period, duration)
        packed[first:] = 0.0
        call(outputs, values.ctypes.data, packed.ctypes.data)
        measured = values[places[0]] / lever
        command, memory[INTEGRAL], memory[RATE] = _pid_step(
            set_points[sample], measured, memory[INTEGRAL], memory[RATE], memory[MEASURED], *gains
        )
        due = now + (opening_time if command > memory[ISSUED] else closing_time)
        memory[MEASURED], memory[ISSUED] = measured, command
        while marks[PENDING_END] > marks[PENDING] and queue[marks[PENDING_END] - 1, 0] >= due:
            marks[PENDING_END] -= 1
        queue[marks[PENDING_END], 0], queue[marks[PENDING_END], 1] = due, command
        marks[PENDING_END] += 1
    while marks[PENDING] < marks[PENDING_END] and queue[marks[PENDING], 0] <= now:
        memory[COMMAND] = queue[marks[PENDING], 1]
        commands[marks[COMMANDS], 0], commands[marks[COMMANDS], 1] = now, memory[COMMAND]
        marks[PENDING] += 1
        marks[COMMANDS] += 1
    piece = np.searchsorted(force_times, now, side="right") - 1
    piece = min(max(piece, 0), forces.shape[0] - 1)
    limit = memory[SAMPLE_END]
    if force_times[piece + 1] > now:
        limit = min(limit, force_times[piece + 1])
    if marks[PENDING] < marks[PENDING_END]:
        limit = min(limit, queue[marks[PENDING], 0])
    times[0, segment], times[0, segment + 1] = now, limit
    for i in range(inputs.shape[2]):
        inputs[0, segment, i] = 0.0
    inputs[0, segment, places[1]] = memory[COMMAND]
    inputs[0, segment, places[2]] = counter + counter_slope * memory[COMMAND]
    inputs[0, segment, places[3]] = forces[piece] + force_slopes[piece] * (now - force_times[piece])
    inputs[0, segment, places[4]] = force_slopes[piece]
    inputs[0, segment, places[5]] = now
    return True
