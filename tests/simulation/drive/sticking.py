"""Dry friction written on its own: stick, slide up and slide down as states, found and left by root finding.

Shares no code with the package, and no rule with its kernel: scipy's Radau on the rates of
`independent.Rig`, the friction a number in each of the states, the state changed where the speed is zero or
the force on the stuck load leaves the range.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import exp, radians, sin

import numpy as np
from scipy.integrate import solve_ivp

from tests.simulation.drive.independent import AMBIENT, CP, T0, G, R, Rig

Course = tuple[tuple[float, ...], tuple[float, ...]]
#: Error of the integration of stroke, speed, pressure and gas mass, and what counts as no force [N].
SIZES, NO_FORCE = np.array([1e-12, 1e-12, 1e-4, 1e-13]), 1e-8


@dataclass
class DryRig(Rig):
    """A lift with Coulomb friction in its muscle, filled through a valve and loaded along a course.

    Attributes:
        kinetic, excess, stribeck: F_c (1 + excess exp(-|v|/stribeck)) [N], [-], [m/s].
        per_pressure: friction per gauge pressure beside it [m^2].
        course: times [s] and external force [N], linear between.
        commands: times [s] and openings of the valve from then on.
        changes: instant and new state of the load, "up", "down", "stuck", "low" or "high".
        work: of muscle, friction, weight and external force [J].
    """

    kinetic: float = 0.0
    excess: float = 0.0
    stribeck: float = 5e-3
    per_pressure: float = 0.0
    course: Course = ((0.0,), (0.0,))
    commands: tuple[tuple[float, float], ...] = ((0.0, 1.0),)
    changes: list[tuple[float, str]] = field(default_factory=list)

    def friction(self, v: float, gauge: float) -> float:
        return self.kinetic * (1.0 + self.excess * exp(-abs(v) / self.stribeck)) + self.per_pressure * max(
            gauge, 0.0
        )

    def outside(self, time: float) -> float:
        return float(np.interp(time, *self.course))

    def net(self, time: float, y: np.ndarray, direction: float) -> float:
        """Force on the load if its friction acts against a motion in this direction."""
        x, v, p = y[:3]
        gauge = p - AMBIENT
        tension = self.tension(self.rest - x, gauge) - self.drag * v - direction * self.friction(v, gauge)
        weight = self.mass * G * sin(radians(self.inclination))
        return max(tension, 0.0) - weight - self.outside(time)

    def motion(self, time: float, y: np.ndarray, opening: float, state: str) -> list[float]:
        x, v, p, m = y
        direction = {"up": 1.0, "down": -1.0}.get(state, 0.0)
        length = self.rest - x
        temperature = p * self.volume(length) / (m * R)
        into = self.flow(self.supply + AMBIENT, p, T0, self.fill * opening) if opening > 0 else 0.0
        out = self.flow(p, AMBIENT, temperature, -self.exhaust * opening) if opening < 0 else 0.0
        diameter = np.sqrt(self.thread**2 - length**2) / (self.turns * np.pi)
        wall = self.heat * (np.pi * diameter * length + np.pi * diameter**2 / 2) * (T0 - temperature)
        enthalpy = CP * (max(into, 0) * T0 + max(-out, 0) * T0 + (min(into, 0) - max(out, 0)) * temperature)
        moves = direction != 0.0
        dp = (0.4 * (wall + enthalpy) - 1.4 * p * self.area(length) * v * moves) / self.volume(length)
        acceleration = self.net(time, y, direction) / self.mass if moves else 0.0
        return [v if moves else 0.0, acceleration, dp, into - out]

    def changed(self, now: float, y: np.ndarray, state: str, number: int, low: float, high: float) -> str:
        """The state after an event of `leaves`; sets position and speed."""
        if state == "stuck":
            return ("up", "down")[number]
        if state in ("low", "high"):
            sense = 1.0 if state == "low" else -1.0
            return ("up" if sense > 0.0 else "down") if sense * self.net(now, y, sense) > 0.0 else "stuck"
        if number == 0:
            y[1] = 0.0
            other = -1.0 if state == "up" else 1.0
            turns = other * self.net(now, y, other) > 0.0
            return {"up": "down", "down": "up"}[state] if turns else "stuck"
        self.hits.append((now, -1 if number == 1 else 1, y[1]))
        back = -self.restitution * y[1]
        y[0], stop = (low, "low") if number == 1 else (high, "high")
        y[1] = back if abs(back) > 1e-3 else 0.0
        return stop if y[1] == 0.0 else ("up" if y[1] > 0.0 else "down")

    def leaves(self, state: str, low: float, high: float) -> list:
        """What ends a state: functions that fall through zero."""
        if state == "stuck":
            return [lambda t, y: NO_FORCE - self.net(t, y, 1.0), lambda t, y: NO_FORCE + self.net(t, y, -1.0)]
        if state in ("low", "high"):
            sense = -1.0 if state == "low" else 1.0
            return [lambda t, y: sense * self.net(t, y, 0.0) + NO_FORCE]
        sense = 1.0 if state == "up" else -1.0
        return [
            lambda t, y: sense * y[1] + 1e-12,
            lambda t, y: y[0] - low + 1e-12,
            lambda t, y: high - y[0] + 1e-12,
        ]

    def followed(self, time: np.ndarray, start: np.ndarray, rtol: float = 1e-10) -> np.ndarray:
        """Rows (stroke, speed, pressure, gas mass) at the times, from rest on the lower stop."""
        low, high, y = 0.0, self.highest * self.rest, np.array(start, float)
        marks = [*self.course[0], *(at for at, _ in self.commands), time[0], time[-1]]
        marks = sorted({mark for mark in marks if time[0] <= mark <= time[-1]})
        rows, state = [], "low"
        for begin, end in pairwise(marks):
            now, opening = begin, [value for at, value in self.commands if at <= begin][-1]
            while now < end:
                events = self.leaves(state, low, high)
                for event in events:
                    event.terminal, event.direction = True, -1.0
                found = solve_ivp(
                    lambda t, y, opening=opening, state=state: self.motion(t, y, opening, state),
                    (now, end), y, "Radau", rtol=rtol, atol=SIZES, events=events, dense_output=True,
                )  # fmt: skip
                assert found.success, found.message
                inside = time[(time >= now) & ((time < found.t[-1]) | (found.t[-1] == time[-1]))]
                rows.append(found.sol(inside).T if len(inside) else np.empty((0, 4)))
                now, y = found.t[-1], found.y[:, -1].copy()
                if found.status == 1:
                    number = next(n for n, times in enumerate(found.t_events) if len(times))
                    state = self.changed(now, y, state, number, low, high)
                    self.changes.append((now, state))
        return np.concatenate(rows)

    @property
    def document(self) -> dict:
        document = super().document
        effects = document["effects"]
        effects["coulomb_friction"] = {
            "force": f"{self.kinetic} N", "static_share": self.excess, "stribeck_speed": self.stribeck,
        }  # fmt: skip
        if self.per_pressure:
            effects["pressure_friction"] = {"area": self.per_pressure}
        times, values = self.course
        if len(times) > 1:
            document["load"]["force"] = {
                "shape": "table", "times": list(times), "values": list(values), "interpolation": "linear",
            }  # fmt: skip
        instants, openings = zip(*self.commands, strict=True)
        document["command"] = {
            "shape": "table", "times": list(instants), "values": list(openings), "interpolation": "hold",
        }  # fmt: skip
        return document


@dataclass
class HuntingRig(DryRig):
    """The lift with a pressure regulator and a sampled PI controller of the position, by Runge-Kutta steps.

    Attributes:
        range, lag, band: of the regulator: highest set point [Pa], time constant [s], error at which an
            orifice is fully open [Pa].
        kp, ki: gains of the controller [1/m], [1/(m s)].
        sample: its sample time [s].
        target: its set point [m] from ``at`` [s] on; 0 before.
    """

    range: float = 6e5
    lag: float = 0.03
    band: float = 0.3e5
    kp: float = 10.0
    ki: float = 50.0
    sample: float = 2e-3
    target: float = 0.02
    at: float = 0.5

    def rates_of(self, y: np.ndarray, command: float, state: str) -> np.ndarray:
        """Rates of (stroke, speed, pressure, gas mass, set point after its lag)."""
        error = y[4] - y[2]
        opening = min(max(error / self.band, -1.0), 1.0)
        lagging = (AMBIENT + max(command, 0.0) * self.range - y[4]) / self.lag
        return np.array([*self.motion(0.0, y[:4], opening, state), lagging])

    def stepped(self, y: np.ndarray, command: float, state: str, h: float) -> np.ndarray:
        """One step of the classical method of fourth order."""
        a = self.rates_of(y, command, state)
        b = self.rates_of(y + 0.5 * h * a, command, state)
        c = self.rates_of(y + 0.5 * h * b, command, state)
        d = self.rates_of(y + h * c, command, state)
        return y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)

    def ends(self, y: np.ndarray, state: str) -> str | None:
        """The state that follows where this one has ended; a direction ends where the load is at rest."""
        if state == "stuck":
            up, down = (self.net(0.0, y, sense) for sense in (1.0, -1.0))
            return "up" if up > 0.0 else "down" if down < 0.0 else None
        return "stuck" if y[1] * (1.0 if state == "up" else -1.0) < 0.0 else None

    def hunts(self, duration: float, parts: int = 8) -> tuple[np.ndarray, np.ndarray]:
        """Strokes at the samples; instants at which the load breaks away upwards."""
        y = np.array([0.0, 0.0, AMBIENT, AMBIENT * self.volume(self.rest) / (R * T0), AMBIENT])
        state, integral, h, strokes, breaks = "stuck", 0.0, self.sample / parts, [], []
        for number in range(round(duration / self.sample)):
            strokes.append(y[0])
            error = (self.target if number * self.sample >= self.at - 1e-12 else 0.0) - y[0]
            grown = integral + self.ki * self.sample * error
            wanted = self.kp * error + grown
            command = min(max(wanted, 0.0), 1.0)
            if wanted == command or (grown > integral) != (wanted > command):
                integral = grown
            command = min(max(self.kp * error + integral, 0.0), 1.0)
            for part in range(parts):
                left, now = h, number * self.sample + part * h
                while left > 1e-15:
                    if (following := self.ends(y, state)) is not None and y[1] == 0.0:
                        state = following
                        if state == "up":
                            breaks.append(now + h - left)
                    new = self.stepped(y, command, state, left)
                    if self.ends(new, state) is None:
                        y, left = new, 0.0
                        continue
                    low, high = 0.0, left
                    for _ in range(50):
                        middle = 0.5 * (low + high)
                        ended = self.ends(self.stepped(y, command, state, middle), state) is not None
                        low, high = (low, middle) if ended else (middle, high)
                    y, left = self.stepped(y, command, state, high), left - high
                    if state != "stuck":
                        y[1], state = 0.0, "stuck"
                if y[0] < 0.0:  # on the lower stop
                    y[0], y[1], state = 0.0, 0.0, "stuck"
        return np.array(strokes), np.array(breaks)

    @property
    def document(self) -> dict:
        document = super().document
        del document["command"]
        document["regulator"] = {"range": self.range, "time": self.lag, "band": self.band}
        document["controller"] = {
            "type": "pid", "kp": f"{self.kp} 1/m", "ki": f"{self.ki} 1/(m*s)", "sample_time": self.sample,
            "reference": {"shape": "step", "at": self.at, "level": self.target},
        }  # fmt: skip
        return document
