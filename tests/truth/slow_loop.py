"""A slow loop of stroke over pressure under a constant load, integrated in a few lines; no code of physics/.

The muscle of a preset file is read as written: ideal braid, Mooney-Rivlin wall under the kinematics of
the braid, prestress, and friction that builds up over a short travel after each reversal (Dahl). The pressure
is a triangle; at each small step the length follows from the balance of forces.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import cos, exp, pi, sin, tan
from pathlib import Path

import numpy as np

SI = {"mm": 1e-3, "m": 1.0, "deg": pi / 180.0, "N": 1.0, "MPa": 1e6, "%": 0.01, "1": 1.0, "N*s/m": 1.0}


@dataclass(frozen=True)
class SlowMuscle:
    """Lengths [m], angle [rad], modulus [Pa], forces [N]; from the JSON of a preset."""

    length: float
    diameter: float
    angle: float
    wall: float
    modulus: float
    second: float
    prestress: float
    friction: float
    travel: float

    @classmethod
    def read(cls, path: Path) -> SlowMuscle:
        """The muscle of a preset file at its own nominal length."""
        document = json.loads(path.read_text(encoding="utf-8"))

        def value(*keys: str) -> float:
            part = document
            for key in keys:
                part = part[key]
            return part["value"] * SI[part["unit"]]

        geometry = [
            value("geometry", name)
            for name in ("nominal_length", "braid_diameter", "braid_angle", "wall_thickness")
        ]
        wall = [value("effects", "bladder_elasticity", n) for n in ("shear_modulus", "mooney_constant")]
        return cls(
            *geometry,
            *wall,
            value("effects", "prestress", "force"),
            value("effects", "dahl", "force"),
            value("effects", "dahl", "break_strain") * geometry[0],
        )

    def mean_force(self, pressure: float, length: float) -> float:
        """Force without friction: P A0 (3 (L/L0)^2/tan^2 - 1/sin^2) + dW/dL - F0."""
        shrink, step = length / self.length, 1e-6
        area = pi / 4.0 * self.diameter**2
        gas = pressure * area * (3.0 * shrink**2 / tan(self.angle) ** 2 - 1.0 / sin(self.angle) ** 2)
        slope = (self._energy(shrink + step) - self._energy(shrink - step)) / (2.0 * step * self.length)
        return gas + slope - self.prestress

    def _energy(self, axial: float) -> float:
        hoop2 = (1.0 - (axial * cos(self.angle)) ** 2) / sin(self.angle) ** 2
        radial2 = 1.0 / (axial**2 * hoop2)
        first = axial**2 + hoop2 + radial2 - 3.0
        second = axial**-2 + 1.0 / hoop2 + 1.0 / radial2 - 3.0
        volume = pi * self.diameter * self.wall * self.length
        return volume * (self.modulus * first + self.second * second)

    def loop(self, load: float, top: float, at: list[float], steps: int = 6000) -> list[float]:
        """Distance of the venting from the filling branch in length [m] at the pressures ``at`` [Pa].

        The second cycle of a triangle from 0 to ``top`` [Pa]; ``steps`` per ramp.
        """
        ramp = np.linspace(0.0, top, steps)
        branches: list[np.ndarray] = []
        length, built = self.length, 0.0
        for pressures in (ramp, ramp[::-1], ramp, ramp[::-1]):
            path = []
            for pressure in pressures:
                length, built = self._balance(float(pressure), load, length, built)
                path.append(length)
            branches.append(np.array(path))
        filling, venting = branches[2], branches[3][::-1]
        return [float(np.interp(p, ramp, filling) - np.interp(p, ramp, venting)) for p in at]

    def _balance(self, pressure: float, load: float, length: float, built: float) -> tuple[float, float]:
        """The next length and share of friction: bisection for force + friction = load.

        Dahl, exact over a step of one direction: after a travel s the share is 1 - (1 - z) exp(-s/x_b) on
        lengthening, and its mirror image on shortening.
        """

        def share(new: float) -> float:
            way = 1.0 if new >= length else -1.0
            return way * (1.0 - (1.0 - way * built) * exp(-abs(new - length) / self.travel))

        def excess(new: float) -> float:
            return self.mean_force(pressure, new) + self.friction * share(new) - load

        low, high = 0.6 * self.length, 0.999 * self.length / cos(self.angle)
        width = 1e-4 * self.length
        while not (excess(length - width) < 0.0 < excess(length + width)) and width < high - low:
            width *= 4.0
        low, high = max(low, length - width), min(high, length + width)
        for _ in range(44):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if excess(middle) > 0.0 else (middle, high)
        return 0.5 * (low + high), share(0.5 * (low + high))
