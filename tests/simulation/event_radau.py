"""scipy's Radau at 1e-10 over a drive's compiled equations; own treatment of contact, slack and sticking."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from mckibben.simulation.drive.initial_state import Start
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate.engine import CompiledDrive, compiled_drive

RTOL = 1e-10


class Piece(NamedTuple):
    """A run between two events, with the instants of its rows, and what the event at its end sets."""

    begin: float
    end: float
    inputs: np.ndarray
    switches: np.ndarray
    wanted: np.ndarray
    sets: dict[int, float]


class EventRadau:
    """A run from event to event; ``state`` and ``switches`` are those reached so far."""

    def __init__(self, drive: Drive, start: Start, parameters: np.ndarray | None = None) -> None:
        self.compiled: CompiledDrive = compiled_drive(drive.structure)
        self.parameters = parameters_of(drive, self.compiled) if parameters is None else parameters
        self.state, self.switches = start.state.copy(), start.switches.copy()
        self.pieces: list[Piece] = []
        self.strokes = np.empty(0)
        self.names = [state.name for state in self.compiled.model.states]
        self.scale = np.array([state.scale for state in self.compiled.model.states])
        self.kinds = self.compiled.model.switches
        self.bounce = drive.restitution
        self.low, self.high = drive.stops
        self.drive = drive

    def arguments(self, y: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        return self.compiled.prepared(np.concatenate([y, self.parameters, inputs]), self.switches)

    def outputs(self, inputs: np.ndarray) -> np.ndarray:
        return self.compiled.codes.outputs(self.arguments(self.state, inputs))

    def advance(self, begin: float, end: float, inputs: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """States at the wanted instants between begin and end, at constant inputs."""
        found = [np.empty((0, self.compiled.size))]
        while begin < end:
            self._settle(inputs)
            packed = self.arguments(self.state, inputs)
            size = self.compiled.size

            def rates(_t, y, packed=packed, size=size):
                packed[:size] = y
                return self.compiled.codes.rates(packed)

            def jacobian(_t, y, packed=packed, size=size):
                packed[:size] = y
                return self.compiled.dense(self.compiled.codes.jacobian(packed))

            def guard(k, packed=packed, size=size):
                def value(_t, y):
                    packed[:size] = y
                    return self.compiled.codes.guards(packed)[k] + self.kinds[k].least

                value.terminal, value.direction = True, -1.0
                return value

            solution = solve_ivp(
                rates,
                (begin, end),
                self.state,
                "Radau",
                jac=jacobian,
                rtol=RTOL,
                atol=RTOL * self.scale,
                dense_output=True,
                events=[guard(k) for k in range(len(self.kinds))],
            )
            assert solution.success, solution.message
            reached = solution.t[-1]
            inside = wanted[(wanted >= begin) & ((wanted < reached) | (reached == end))]
            if len(inside):
                found.append(solution.sol(np.clip(inside, begin, reached)).T)
            used = self.switches.copy()
            wanted, started, begin, self.state = wanted[len(inside) :], begin, reached, solution.y[:, -1]
            before = self.state.copy()
            if solution.status == 1:
                self._change(next(k for k, times in enumerate(solution.t_events) if len(times)))
            changed = np.flatnonzero(self.state != before)
            sets = {int(index): float(self.state[index]) for index in changed}
            self.pieces.append(Piece(started, reached, inputs, used, inside, sets))
        return np.concatenate(found)

    def _settle(self, inputs: np.ndarray) -> None:
        for _ in range(20):
            guards = self.compiled.codes.guards(self.arguments(self.state, inputs))
            wrong = [k for k, kind in enumerate(self.kinds) if guards[k] < -kind.least]
            if not wrong:
                return
            self._change(wrong[0])

    def _change(self, k: int) -> None:
        name = self.kinds[k].name
        if name.startswith("slides"):  # at rest it sticks
            if self.switches[k] == 1.0:
                self.state[self.names.index("speed")] = 0.0
            self.switches[k] = 1.0 - self.switches[k]
            return
        if self.switches[k] == 0.0 and name.endswith("stop"):
            stroke, speed = self.names.index("stroke"), self.names.index("speed")
            self.state[stroke] = self.low if name == "low_stop" else self.high
            self.state[speed] *= -self.bounce
            if abs(self.state[speed]) <= 1e-3:
                self.state[speed] = 0.0
            for number, kind in enumerate(self.kinds):
                if kind.name.startswith("slides"):
                    self.switches[number] = float(kind.slides * self.state[speed] > 0.0)
            if self.state[speed] != 0.0:
                return
        self.switches[k] = 1.0 - self.switches[k]
        if name.startswith("slack"):  # the muscle is as long as its fittings are apart
            lengths = self.drive.lengths(float(self.state[self.names.index("stroke")]))
            length = self.names.index(name.replace("slack", "length"))
            self.state[length] = lengths[1 if name.endswith("@counter") else 0]


def strokes(drive: Drive, start: Start, time: np.ndarray) -> np.ndarray:
    """Strokes of a free run at the times."""
    run = EventRadau(drive, start)
    times, inputs, _ = segments_of(drive)
    found = []
    for segment, given in enumerate(inputs):
        begin, end = times[segment], times[segment + 1]
        rows = (time >= begin) & ((time < end) | (segment == len(inputs) - 1))
        found.append(run.advance(begin, end, given, time[rows]))
    return np.concatenate(found)[:, run.names.index("stroke")]
