"""The same run by scipy's LSODA, which checks the kernel."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mckibben.physics.drive_terms import GUARD_STIFFNESS
from mckibben.simulation.drive import transient
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import TOLERANCE, Run
from mckibben.simulation.integrate.problem import (
    EVENT_WIDTH,
    LOWEST_REBOUND,
    SLOWEST_REBOUND,
    Solution,
)
from mckibben.simulation.integrate.system import CompiledDrive
from mckibben.simulation.outcome import Outcome

_MOST_CHANGES = 10_000  # switches that change more often in one run make it chatter


@dataclass(frozen=True, kw_only=True, eq=False)
class Problem:
    """A run for an integrator.

    Attributes:
        drive: the compiled structure.
        constants: of the run, as the codes take them.
        stops: stroke of the end stop of each switch [m], NaN for others.
        restitution: share of the speed that an impact on an end stop leaves, in the opposite direction.
        state, switches: at the start; integrators overwrite them.
        times: segment boundaries.
        inputs: of each segment.
        grid: times of the rows.
        tolerance: relative error per step.
    """

    drive: CompiledDrive
    constants: np.ndarray
    stops: np.ndarray
    restitution: float
    state: np.ndarray
    switches: np.ndarray
    times: np.ndarray
    inputs: np.ndarray
    grid: np.ndarray
    tolerance: float

    @property
    def absolute(self) -> np.ndarray:
        """Absolute error per step of each state."""
        return self.tolerance * self.drive.scales


class _Run:
    """One run: state, switches, rows and events so far."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.codes, self.size = problem.drive.codes, problem.drive.size
        kinds, inputs = len(problem.switches), problem.inputs.shape[1]
        self.packed = np.concatenate([problem.state, problem.constants, np.zeros(inputs + kinds)])
        self.first_input, self.first_switch = self.size + len(problem.constants), len(self.packed) - kinds
        self.rows = np.full((len(problem.grid), self.size + problem.drive.width), np.nan)
        self.events: list[tuple[float, int, float, float, float]] = []
        self.steps = self.written = 0

    def solution(self, outcome: Outcome) -> Solution:
        """What is known so far."""
        events = np.array(self.events).reshape(-1, EVENT_WIDTH)
        problem, rows = self.problem, self.rows[: self.written]
        return Solution(rows, problem.state, problem.switches, events, outcome, self.steps, 0)

    def at(self, y: np.ndarray) -> np.ndarray:
        """Arguments of the codes."""
        self.packed[: self.size] = y
        self.packed[self.first_switch :] = self.problem.switches
        return self.packed

    def rates(self, _time: float, y: np.ndarray) -> np.ndarray:
        return self.codes.rates(self.at(y))

    def jacobian(self, _time: float, y: np.ndarray) -> np.ndarray:
        return self.problem.drive.dense(self.codes.jacobian(self.at(y)))

    def guard(self, number: int) -> Callable[[float, np.ndarray], float]:
        """Guard of a switch as an event of solve_ivp."""
        least = self.problem.drive.least[number]

        def value(_time: float, y: np.ndarray) -> float:
            return float(self.codes.guards(self.at(y))[number] + least)

        value.terminal, value.direction = True, -1.0  # type: ignore
        return value

    def turning(self, _time: float, y: np.ndarray) -> float:
        """Acceleration of a load that slides: where it is zero the load may have come to rest.

        solve_ivp looks at the guards at the ends of its steps only.
        """
        slides = self.problem.drive.slides @ self.problem.switches
        return float(slides * self.codes.rates(self.at(y))[self.problem.drive.moved[1]]) if slides else 1.0

    def rested(self, found: Any) -> tuple[float, np.ndarray] | None:
        """Where a load that slides has first been at rest within a step, and the state there."""
        if not self.problem.drive.slides.any():
            return None
        for at, y in zip(found.t_events[-1], found.y_events[-1], strict=True):
            if np.any(self.codes.guards(self.at(y)) < -self.problem.drive.least):
                return float(at), y
        return None

    def change(self, number: int, now: float) -> None:
        """Change a switch, as `mckibben.simulation.integrate.switching.change_switch`."""
        problem = self.problem
        to, speed, acceleration = 1.0 - problem.switches[number], 0.0, 0.0
        stop = problem.stops[number]
        stroke_place, speed_place = problem.drive.moved
        if speed_place >= 0:
            speed = float(problem.state[speed_place])
            acceleration = float(self.codes.rates(self.at(problem.state))[speed_place])
        if to == 1.0 and not np.isnan(stop):
            problem.state[stroke_place], problem.state[speed_place] = stop, 0.0
            left, pressing = problem.restitution * abs(speed), np.sign(speed) * acceleration
            if left > SLOWEST_REBOUND and left * left > 2.0 * LOWEST_REBOUND * pressing:
                problem.state[speed_place] = -problem.restitution * speed
                to = 0.0
            slides = problem.drive.slides != 0.0
            problem.switches[slides] = problem.drive.slides[slides] * problem.state[speed_place] > 0.0
        sense = problem.drive.slides[number]
        if sense != 0.0 and to == 0.0:
            if abs(speed) > SLOWEST_REBOUND:
                problem.switches[problem.drive.slides == -sense] = 1.0
            else:
                problem.state[speed_place] = 0.0
        place = int(problem.drive.follows[number])
        if place >= 0:
            # The guard of a switch that is 1 is the distance to be closed, times a stiffness.
            arguments = self.at(problem.state)
            arguments[self.first_switch + number] = 1.0
            problem.state[place] -= self.codes.guards(arguments)[number] / GUARD_STIFFNESS
        problem.switches[number] = to
        self.events.append((now, number, to, speed, acceleration))

    def settle(self, now: float) -> None:
        """Change the switches whose guards are violated."""
        least = self.problem.drive.least
        for _ in range(2 * len(least) + 1):
            wrong = np.flatnonzero(self.codes.guards(self.at(self.problem.state)) < -least)
            if not len(wrong):
                return
            self.change(int(wrong[0]), now)


def by_lsoda(problem: Problem) -> Solution:
    """Integrate a problem segment by segment, and within it from event to event."""
    run = _Run(problem)
    for segment, inputs in enumerate(problem.inputs):
        begin, finish = float(problem.times[segment]), float(problem.times[segment + 1])
        last = segment == len(problem.inputs) - 1
        run.packed[run.first_input : run.first_switch] = inputs
        while begin < finish:
            if len(run.events) > _MOST_CHANGES:
                return run.solution(Outcome.STUCK)
            begin, ended = _piece(run, begin, finish, last=last)
            if ended is not None:
                return run.solution(ended)
    return run.solution(Outcome.COMPLETED)


def _piece(run: _Run, begin: float, finish: float, *, last: bool) -> tuple[float, Outcome | None]:
    """Integrate to the next event or to ``finish``; returns the instant reached, and why the run must end."""
    problem = run.problem
    run.settle(begin)
    stop = np.searchsorted(problem.grid, finish, side="right" if last else "left")
    wanted = problem.grid[run.written : stop]
    events: list[Any] = [run.guard(number) for number in range(len(problem.switches))]
    if problem.drive.slides.any():
        events.append(run.turning)
    # LSODA warns of failures that its result reports as well.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = solve_ivp(
            run.rates,
            (begin, finish),
            problem.state,
            method="LSODA",
            jac=run.jacobian,
            t_eval=np.union1d(wanted, finish),
            rtol=problem.tolerance,
            atol=problem.absolute,
            events=events or None,
        )
    run.steps += len(found.t)
    # Without a row before the first event, ``y`` is an empty list.
    states = np.reshape(found.y, (run.size, len(found.t))).T
    if not found.success or not np.all(np.isfinite(states)):
        return begin, Outcome.DIVERGED
    rested = run.rested(found)
    reached = found.t if rested is None else found.t[found.t <= rested[0]]
    count = int(np.searchsorted(wanted, reached[-1], side="right")) if len(reached) else 0
    for y in states[:count]:
        run.rows[run.written, : run.size] = y
        run.rows[run.written, run.size :] = run.codes.outputs(run.at(y))
        run.written += 1
    if rested is not None:
        problem.state[:] = rested[1]
        return rested[0], None
    if found.status != 1:
        problem.state[:] = states[-1]
        return finish, None
    number = next(n for n in range(len(problem.switches)) if len(found.t_events[n]))
    at = float(found.t_events[number][0])
    problem.state[:] = found.y_events[number][0]
    run.change(number, at)
    return at, None


def integrated(
    drive: CompiledDrive,
    *,
    parameters: np.ndarray,
    start: np.ndarray,
    times: np.ndarray,
    inputs: np.ndarray,
    grid: np.ndarray,
    tolerance: float,
    switches: np.ndarray | None = None,
    restitution: float = 0.0,
) -> Solution:
    """As `mckibben.simulation.integrate.engine.integrate`."""
    began = np.zeros(len(drive.model.switches)) if switches is None else np.array(switches, dtype=float)
    problem = Problem(
        drive=drive,
        constants=drive.codes.constants(parameters),
        stops=drive.stops(parameters),
        restitution=restitution,
        state=start.copy(),
        switches=began,
        times=times,
        inputs=inputs,
        grid=grid,
        tolerance=tolerance,
    )
    return by_lsoda(problem)


def simulated(
    drive: Drive, *, points: int = 2001, grid: np.ndarray | None = None, tolerance: float = TOLERANCE
) -> Run:
    """As `mckibben.simulation.drive.transient.simulate`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(transient, "integrate", lambda compiled, **given: integrated(compiled, **given))
        return transient.simulate(drive, points=points, grid=grid, tolerance=tolerance)
