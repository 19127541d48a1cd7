"""Dry friction written on its own: stick, slide up and slide down as states, found and left by root finding.

Shares no code with the package, and no rule with its kernel: scipy's Radau at 1e-10 on the rates of
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
