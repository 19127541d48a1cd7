"""A controlled run sample by sample in Python, which checks the loop that the kernel runs."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

import numpy as np

from mckibben.physics.drive_terms import COUNTER, INPUTS
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.command.segments import SHORTEST, Segments
from mckibben.simulation.drive.control_loop import ControlLoop, measured_position
from mckibben.simulation.drive.joint import JointStiffness
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import Run, dead_times, run_of
from mckibben.simulation.integrate.engine import (
    EVENT_WIDTH,
    FIRST_STEP,
    Outcome,
    Solution,
    integrate,
)

_ROOM = 0.05  # of the full pressure, that valves leave for turning the joint


class _Position:
    """The commands of a position controller; a second muscle mirrors them."""

    def __init__(self, loop: ControlLoop) -> None:
        self._loop = loop
        self._memory = loop.controller.start(measurement=measured_position(loop, loop.start.state))

    def difference(self, sample: int, position: float) -> float:
        command, self._memory = self._loop.controller.step(
            float(self._loop.set_points[sample]), position, self._memory
        )
        return command

    def __call__(self, sample: int, state: np.ndarray) -> tuple[float, float]:
        command = self.difference(sample, measured_position(self._loop, state))
        return command, self._loop.drive.counter(command)


class _Joint(_Position):
    """Half the difference by the position controller, the mean by that of the stiffness."""

    def __init__(self, loop: ControlLoop) -> None:
        super().__init__(loop)
        control, times = loop.drive.stiffness, np.arange(len(loop.set_points)) * loop.controller.sample_time
        assert control is not None
        self._control, self._joint = control, JointStiffness(loop.drive)
        self._wanted = np.asarray(control.reference.value(times))
        names = [state.name for state in loop.compiled.model.states]
        self._places = [names.index(name) for name in ("pressure", f"pressure{COUNTER}")]
        self._integral = 0.0

    def __call__(self, sample: int, state: np.ndarray) -> tuple[float, float]:
        loop, drive, joint, control = self._loop, self._loop.drive, self._joint, self._control
        position = measured_position(loop, state)
        half = self.difference(sample, position)
        stroke, wanted = position * drive.load.lever_ratio, float(self._wanted[sample])
        first, second = (float(state[place]) - drive.ambient_pressure for place in self._places)
        slopes = joint.at(stroke)
        by_mean = (slopes[0] + slopes[1]) * joint.radius**2
        missing = (wanted - joint.value(stroke, first, second)) / by_mean
        if drive.regulator is None:
            most = (1.0 - _ROOM) * joint.full - 0.5 * abs(first - second)
            missing = min(missing, most - 0.5 * (first + second))
        missing /= joint.full
        step = control.ki * loop.controller.sample_time * missing
        common = control.kp * missing + self._integral + step
        low, high = abs(half) - 1.0, 1.0 - abs(half)
        if drive.regulator is not None:
            # Pressures m + d and m - d that have the stiffness: K(m + d, m - d) = K(d, -d) + by_mean m.
            d = half * joint.full
            common += (wanted - joint.value(stroke, d, -d)) / by_mean / joint.full
            low = abs(half)
        if low <= common <= high:
            self._integral += step
        common = min(max(common, low), high)
        return common + half, common - half


class Edges:
    """When the opening of a muscle changes within a sample, and to what."""

    def __init__(self, pwm: PulseWidth | None) -> None:
        self._pwm, self._number = pwm, 0

    def __call__(self, begin: float, end: float, command: float) -> list[tuple[float, float]]:
        if self._pwm is None:
            return [(begin, command)]
        pulses, found = self._pwm, []
        while (start := self._number * pulses.period) < end - SHORTEST:
            pulse = pulses.pulse(command)
            if pulse.width > 0.0:
                found.append((max(start, begin), pulse.first))
            if pulse.width < pulses.period:
                found.append((max(start + pulse.width, begin), pulse.then))
            self._number += 1
        return found


class _Valve:
    """The opening of a muscle's valve: each command acts after its dead time and overtakes none."""

    def __init__(self, drive: Drive, opening: float) -> None:
        self._delays, self._edges = dead_times(drive), Edges(drive.pwm)
        self._pending: deque[tuple[float, float]] = deque()
        self._last = self.opening = opening

    def command(self, begin: float, end: float, command: float) -> None:
        for instant, opening in self._edges(begin, end, command):
            due = instant + self._delays[0 if opening > self._last else 1]
            self._last = opening
            while self._pending and self._pending[-1][0] >= due:
                self._pending.pop()
            self._pending.append((due, opening))

    def act(self, now: float) -> bool:
        """Whether an opening becomes active now."""
        acts = False
        while self._pending and self._pending[0][0] <= now:
            self.opening, acts = self._pending.popleft()[1], True
        return acts

    @property
    def next(self) -> float:
        return self._pending[0][0] if self._pending else np.inf


def run_in_python(loop: ControlLoop) -> Run:
    """As `mckibben.simulation.drive.controlled.run_loop`."""
    drive, compiled, external, grid = loop.drive, loop.compiled, loop.external, loop.grid
    period, samples = loop.controller.sample_time, len(loop.set_points)
    commands_of = _Position(loop) if drive.stiffness is None else _Joint(loop)
    valves = [_Valve(drive, 0.0), _Valve(drive, drive.counter(0.0))][: 1 + drive.pair]
    state, switches, first_step = loop.start.state, loop.start.switches, FIRST_STEP
    events = [np.empty((0, EVENT_WIDTH))]
    rows = [np.empty((0, compiled.size + compiled.width))]
    commands, steps = [(0.0, 0.0, drive.counter(0.0))], 0
    for sample in range(samples):
        now, end = sample * period, min((sample + 1) * period, drive.duration)
        for valve, command in zip(valves, commands_of(sample, state), strict=False):
            valve.command(now, end, command)
        while now < end:
            acts = [valve.act(now) for valve in valves]
            active, counter = valves[0].opening, valves[-1].opening
            if any(acts):
                commands.append((now, active, counter))
            stop = float(min([end, *external.times[external.times > now][:1], *(v.next for v in valves)]))
            upper = np.searchsorted(grid, stop, side="right" if stop >= drive.duration else "left")
            solution = integrate(
                compiled, parameters=loop.parameters, start=state, switches=switches,
                restitution=drive.restitution, times=np.array([now, stop]),
                inputs=_inputs(active, counter, external, now),
                grid=grid[np.searchsorted(grid, now, side="left") : upper], tolerance=loop.tolerance,
                first_step=first_step,
            )  # fmt: skip
            assert solution.outcome is Outcome.COMPLETED
            rows.append(solution.rows)
            events.append(solution.events)
            switches, steps = solution.switches, steps + solution.steps
            state, now, first_step = solution.end, stop, solution.next_step
    solution = Solution(
        np.concatenate(rows), state, switches, np.concatenate(events), Outcome.COMPLETED, steps, 0
    )
    table = np.array(commands)
    times = np.append(table[:, 0], drive.duration)
    own, other = (Segments(times, column, np.zeros(len(table))) for column in table.T[1:])
    run = run_of(drive, compiled, grid, loop.start, solution, own, 0.0)
    return replace(run, counter_command=other) if drive.pair else run


def _inputs(opening: float, counter: float, external: Segments, now: float) -> np.ndarray:
    piece = int(np.clip(np.searchsorted(external.times, now, side="right") - 1, 0, len(external.slopes) - 1))
    values = {
        "opening": opening, "counter_opening": counter, "begin": now,
        "external_force": float(external.value(now)),
        "external_force_slope": float(external.slopes[piece]),
    }  # fmt: skip
    return np.array([[values.get(name, 0.0) for name in INPUTS]])
