"""A drive written on its own: ideal braid, linear spring, viscous drag; rigid stops, slack solved by Newton.

Shares no code with the package. scipy's Radau at 1e-10, from event to event.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, radians, sin, sqrt, tan

import numpy as np
from scipy.integrate import solve_ivp

R, T0, AMBIENT, RHO0, G = 287.05, 293.15, 101_325.0, 1.185, 9.80665
CP, CV = 3.5 * R, 2.5 * R


@dataclass
class Rig:
    """The drive; SI, pressures gauge. ``exponent`` None: energy balance with ``heat``."""

    diameter: float = 0.02
    angle: float = radians(25.0)
    rest: float = 0.4
    drag: float = 100.0
    spring: float = 0.0
    mass: float = 30.0
    inclination: float = 90.0
    supply: float = 6e5
    fill: float = 1.2e-8
    exhaust: float = 1.5e-8
    ratio: float = 0.3
    exponent: float | None = None
    heat: float = 100.0
    off: float = 1.5
    end: float = 4.0
    highest: float = 0.25
    restitution: float = 0.0
    hits: list[tuple[float, int, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.thread = self.rest / cos(self.angle)
        self.turns = self.rest * tan(self.angle) / (pi * self.diameter)

    def volume(self, length: float) -> float:
        return length * (self.thread**2 - length**2) / (4 * pi * self.turns**2)

    def area(self, length: float) -> float:
        return (3 * length**2 - self.thread**2) / (4 * pi * self.turns**2)

    def tension(self, length: float, gauge: float) -> float:
        return gauge * self.area(length) + self.spring * (length - self.rest)

    def stiffness(self, length: float, gauge: float) -> float:
        return gauge * 6 * length / (4 * pi * self.turns**2) + self.spring

    def free_length(self, gauge: float, guess: float) -> float:
        length = guess
        for _ in range(60):
            step = self.tension(length, gauge) / self.stiffness(length, gauge)
            length -= step
            if abs(step) < 1e-15:
                break
        return length

    def flow(self, upstream: float, downstream: float, temperature: float, conductance: float) -> float:
        if downstream > upstream:
            return -self.flow(downstream, upstream, T0, conductance)
        r = downstream / upstream
        psi = 1.0
        if min(r, 0.999) > self.ratio:
            psi = sqrt(1 - ((min(r, 0.999) - self.ratio) / (1 - self.ratio)) ** 2)
        if r > 0.999:
            psi *= (1 - r) / 0.001
        return conductance * RHO0 * upstream * sqrt(T0 / temperature) * psi

    def rates(self, y: np.ndarray, opening: int, contact: int) -> tuple[list[float], float]:
        """Rates of (stroke, speed, pressure, mass, in, out), and the net force on the load."""
        x, v, p, m, _, _ = y
        gauge, distance = p - AMBIENT, self.rest - x
        slack = self.spring > 0.0 and self.tension(distance, gauge) < 0.0
        length = self.free_length(gauge, distance) if slack else distance
        temperature = T0 if self.exponent is not None else p * self.volume(length) / (m * R)
        into = self.flow(self.supply + AMBIENT, p, T0, self.fill) if opening > 0 else 0.0
        out = self.flow(p, AMBIENT, temperature, self.exhaust) if opening < 0 else 0.0
        volume, area = self.volume(length), self.area(length)
        if self.exponent is not None:
            n, power = self.exponent, self.exponent * R * T0 * (into - out)
        else:
            n, d = 1.4, sqrt(self.thread**2 - length**2) / (self.turns * pi)
            wall = self.heat * (pi * d * length + pi * d**2 / 2) * (T0 - temperature)
            enthalpy = CP * (max(into, 0) * T0 + max(-out, 0) * T0 + min(into, 0) * temperature)
            power = 0.4 * (wall + enthalpy - CP * max(out, 0) * temperature)
        if slack:  # dl/dt = -(F_p/F_l) dp/dt
            by_pressure = -area / self.stiffness(length, gauge)
            dp = power / (volume - n * p * area * by_pressure)
            force = 0.0
        else:
            dp = (power - n * p * area * v) / volume
            force = max(0.0, self.tension(distance, gauge) - self.drag * v)
        net = force - self.mass * G * sin(radians(self.inclination))
        acceleration = 0.0 if contact else net / self.mass
        return [0.0 if contact else v, acceleration, dp, into - out, into, out], net

    def run(self, time: np.ndarray) -> np.ndarray:
        """Rows (stroke, speed, pressure, mass, in, out) at the times; ``hits``: instant, side, speed."""
        y = np.array([0, 0, AMBIENT, AMBIENT * self.volume(self.rest) / (R * T0), 0, 0.0])
        contact, rows, high = -1, [], self.highest * self.rest
        for begin, end, opening in ((0.0, self.off, 1), (self.off, self.end, -1)):
            now = begin
            while now < end:

                def motion(_t, y, opening=opening, contact=contact):
                    return self.rates(y, opening, contact)[0]

                def below(_t, y):
                    return y[0] + 1e-12

                def above(_t, y):
                    return high - y[0] + 1e-12

                def pressed(_t, y, opening=opening, contact=contact):
                    return contact * self.rates(y, opening, contact)[1] + 1e-9

                events = [pressed] if contact else [below, above]
                for event in events:
                    event.terminal, event.direction = True, -1.0
                sizes = np.array([1e-12, 1e-12, 1e-4, 1e-13, 1e-13, 1e-13])
                found = solve_ivp(
                    motion, (now, end), y, "Radau", rtol=1e-10, atol=sizes, events=events, dense_output=True
                )
                assert found.success, found.message
                inside = time[(time >= now) & ((time < found.t[-1]) | (found.t[-1] == self.end))]
                rows.append(found.sol(inside).T if len(inside) else np.empty((0, 6)))
                now, y = found.t[-1], found.y[:, -1].copy()
                if found.status != 1:
                    continue
                if contact:
                    contact = 0
                    continue
                side = -1 if len(found.t_events[0]) else 1
                self.hits.append((now, side, y[1]))
                y[0] = 0.0 if side < 0 else high
                y[1] *= -self.restitution
                if abs(y[1]) < 1e-3:
                    y[1] = 0.0
                    contact = side if side * self.rates(y, opening, 0)[1] > 0 else 0
        return np.concatenate(rows)

    @property
    def document(self) -> dict:
        """The same drive for the package."""
        effects = {"viscous_damping": {"coefficient": f"{self.drag} N*s/m"}}
        if self.spring:
            effects["linear_elasticity"] = {"stiffness": f"{self.spring} N/m"}
        gas = {"wall_heat_transfer": self.heat}
        if self.exponent is not None:
            gas = {"polytropic_exponent": self.exponent}
        return {
            "muscle": {
                "inside_diameter": self.diameter,
                "braid_angle": self.angle,
                "nominal_length": self.rest,
            },
            "effects": effects,
            "supply": {"pressure": self.supply},
            "valve": {
                "sonic_conductance": self.fill,
                "exhaust_conductance": self.exhaust,
                "critical_pressure_ratio": self.ratio,
            },
            "tube": None,
            "load": {"mass": self.mass, "inclination": radians(self.inclination)},
            "stops": {"max_contraction": self.highest, "restitution": self.restitution},
            "gas": gas,
            "command": {"shape": "pulse", "on": 0.0, "off": self.off},
            "duration": self.end,
        }
