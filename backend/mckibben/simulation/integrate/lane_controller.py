"""The segments of a run under a sampled controller, found as it goes: measure, step the controllers, hold.

A command is delayed by the dead time of its direction and never overtakes an earlier one. With a carrier it
becomes pulses, see `mckibben.simulation.command.pwm`; the second muscle of a pair mirrors the first, or the
stiffness of the joint decides what both have in common, see `mckibben.simulation.command.joint`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from mckibben.simulation.command import joint, pid, pwm
from mckibben.simulation.command.segments import SHORTEST
from mckibben.simulation.integrate.switching import call

_pid_step: Any = njit(pid.pid_step, error_model="numpy")
_interpolated: Any = njit(joint.interpolated, error_model="numpy")
_common_command: Any = njit(joint.common_command, error_model="numpy")
_pulse_of: Any = njit(pwm.pulse_of, error_model="numpy")

# Entries of ``memory``: integral, rate and last measurement of the position controller, integral of the
# stiffness controller, end of the sample, and of both muscles the last opening issued and the active one.
INTEGRAL, RATE, MEASURED, STIFFNESS, SAMPLE_END, ISSUED, ACTIVE = (*range(6), 7)
MEMORY = 9
# Entries of ``marks``: number of ``commands`` so far, current sample, the sample that is run no more, and
# of both muscles first and last + 1 of the pending openings, and the next period of the carrier.
COMMANDS, SAMPLE, STOP, PENDING, PENDING_END, PERIOD = 0, 1, 2, 3, 5, 7
MARKS = 9

#: Numba's type of a loop.
LOOP = (
    "Tuple((float64[::1],UniTuple(float64,8),int64[::1],UniTuple(float64[::1],4),float64[::1],int64[::1],"
    "float64[:,:,::1],float64[:,::1],float64[::1],float64[::1],"
    "Tuple((float64[::1],float64[::1],float64[:,::1])),float64[::1]))"
)
_NONE = np.zeros(0)
#: What the stiffness controller of a joint is given, where there is none.
NO_JOINT = (_NONE, _NONE, np.zeros((3, 0)))
#: The loop of a run without a controller.
NO_LOOP = (
    _NONE, (0.0,) * 8, np.zeros(0, np.int64), (_NONE,) * 4, _NONE, np.zeros(0, np.int64),
    np.zeros((2, 0, 2)), np.zeros((0, 3)), _NONE, _NONE, NO_JOINT, _NONE,
)  # fmt: skip


@njit(error_model="numpy")
def _issue(
    muscle: int, instant: float, opening: float, figures: np.ndarray, memory: np.ndarray, marks: np.ndarray,
    queue: np.ndarray,
) -> None:  # fmt: skip
    """Let an opening wait for its dead time."""
    due = instant + (figures[1] if opening > memory[ISSUED + muscle] else figures[2])
    memory[ISSUED + muscle] = opening
    first, end = marks[PENDING + muscle], marks[PENDING_END + muscle]
    while end > first and queue[muscle, end - 1, 0] >= due:
        end -= 1
    queue[muscle, end, 0], queue[muscle, end, 1] = due, opening
    marks[PENDING_END + muscle] = end + 1


@njit(error_model="numpy")
def _issue_pulses(
    muscle: int, now: float, command: float, figures: np.ndarray, memory: np.ndarray, marks: np.ndarray,
    queue: np.ndarray, carrier: np.ndarray,
) -> None:  # fmt: skip
    """Issue the pulses of the periods of the carrier that begin within the sample."""
    period, one, min_on, min_off = carrier
    while marks[PERIOD + muscle] * period < memory[SAMPLE_END] - SHORTEST:
        start = marks[PERIOD + muscle] * period
        marks[PERIOD + muscle] += 1
        opening, width, then = _pulse_of(command, period, one, min_on, min_off)
        if width > 0.0:
            _issue(muscle, max(start, now), opening, figures, memory, marks, queue)
        if width < period:
            _issue(muscle, max(start + width, now), then, figures, memory, marks, queue)


@njit(error_model="numpy")
def next_segment(
    reading: int, t: float, segment: int, first: int, times: np.ndarray, inputs: np.ndarray, loop: Any
) -> bool:
    """Write the segment that begins at t; False if the last sample is over.

    Args:
        reading: address of what the position sensor reads of one set.
        segment: its number.
        first: number of states and constants.
        times, inputs: of the segments, shapes (1, segments + 1) and (1, segments, inputs).
        loop: duration, dead times of opening and closing, lever ratio, the second muscle's command at command
            0 and its change with the command, and the number of muscles; the constants of
            `mckibben.simulation.command.pid.PidController`; places of the inputs
            opening, counter_opening, external_force, its slope and begin, and of the pressures of both
            muscles among the states; set point of every sample, and times, start values and slopes of the
            external force; ``memory``; ``marks``; pending openings of each muscle, rows (instant, opening);
            openings that became active, rows (instant, first, second); arguments of one set (states and
            constants are given); room for the reading; of the stiffness controller of a joint (`NO_JOINT`
            without one) the set point of every sample, ambient pressure, first and step of the strokes of the
            table and the arguments of `mckibben.simulation.command.joint.common_command` from ``radius`` on,
            and the table; constants of the carrier, none without one.
    """
    figures, gains, places, signals, memory, marks, queue, commands, packed, values, stiff, carrier = loop
    duration, _, _, lever, counter, counter_slope, muscles = figures
    set_points, force_times, forces, force_slopes = signals
    wanted, law, table = stiff
    now, period = t, gains[4]
    if t >= memory[SAMPLE_END]:
        sample = marks[SAMPLE] + 1
        if sample >= marks[STOP]:
            return False
        marks[SAMPLE] = sample
        now = sample * period
        memory[SAMPLE_END] = min((sample + 1) * period, duration)
        packed[first:] = 0.0
        call(reading, values.ctypes.data, packed.ctypes.data)
        measured = values[0] / lever
        command, memory[INTEGRAL], memory[RATE] = _pid_step(
            set_points[sample], measured, memory[INTEGRAL], memory[RATE], memory[MEASURED], *gains
        )
        memory[MEASURED] = measured
        other = counter + counter_slope * command
        if wanted.shape[0] > 0:
            ambient, low, step, radius, full, room, kp, grown, regulated = law
            stroke = measured * lever
            common, memory[STIFFNESS] = _common_command(
                command, wanted[sample], packed[places[5]] - ambient, packed[places[6]] - ambient,
                _interpolated(stroke, low, step, table[0]), _interpolated(stroke, low, step, table[1]),
                _interpolated(stroke, low, step, table[2]), memory[STIFFNESS], radius, full, room, kp, grown,
                regulated,
            )  # fmt: skip
            command, other = common + command, common - command
        for muscle in range(int(muscles)):
            wished = command if muscle == 0 else other
            if carrier.shape[0] > 0:
                _issue_pulses(muscle, now, wished, figures, memory, marks, queue, carrier)
            else:
                _issue(muscle, now, wished, figures, memory, marks, queue)
    changed, due = False, np.inf
    for muscle in range(int(muscles)):
        first_due, end = marks[PENDING + muscle], marks[PENDING_END + muscle]
        while first_due < end and queue[muscle, first_due, 0] <= now:
            memory[ACTIVE + muscle] = queue[muscle, first_due, 1]
            first_due, changed = first_due + 1, True
        marks[PENDING + muscle] = first_due
        if first_due < end:
            due = min(due, queue[muscle, first_due, 0])
    if changed:
        row = commands[marks[COMMANDS]]
        row[0], row[1], row[2] = now, memory[ACTIVE], memory[ACTIVE + 1]
        marks[COMMANDS] += 1
    piece = np.searchsorted(force_times, now, side="right") - 1
    piece = min(max(piece, 0), forces.shape[0] - 1)
    limit = min(memory[SAMPLE_END], due)
    if force_times[piece + 1] > now:
        limit = min(limit, force_times[piece + 1])
    times[0, segment], times[0, segment + 1] = now, limit
    for i in range(inputs.shape[2]):
        inputs[0, segment, i] = 0.0
    inputs[0, segment, places[0]] = memory[ACTIVE]
    inputs[0, segment, places[1]] = memory[ACTIVE + 1]
    inputs[0, segment, places[2]] = forces[piece] + force_slopes[piece] * (now - force_times[piece])
    inputs[0, segment, places[3]] = force_slopes[piece]
    inputs[0, segment, places[4]] = now
    return True
