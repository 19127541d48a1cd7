"""The ideal muscle by virtual work on the thread: length b, n turns, no wall."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin, sqrt, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ATMOSPHERE = 101_325.0  # Pa
GRAVITY = 9.80665  # m/s2
ROOM = 293.15  # K
FULL_PRESSURE = 6e5  # Pa


@dataclass(frozen=True)
class Muscle:
    """A muscle at rest, SI; ``nominal`` is its length, ``diameter`` that of the braid."""

    nominal: float
    diameter: float
    angle: float
    wall: float
    inside: float

    @property
    def thread(self) -> float:
        """Thread length b [m]."""
        return self.nominal / cos(self.angle)

    @property
    def turns(self) -> float:
        """Turns n of a thread."""
        return self.nominal * tan(self.angle) / (pi * self.diameter)

    @property
    def rubber(self) -> float:
        """Volume of the elastomer [m^3]."""
        return pi * self.diameter * self.wall * self.nominal

    @property
    def blocked(self) -> float:
        """Ideal blocked force at 6 bar [N], the full scale of the force sensor."""
        return float(FULL_PRESSURE * self.area(np.array(self.nominal)))

    @property
    def shortest(self) -> float:
        """Length without force, b/sqrt(3) [m]."""
        return self.thread / sqrt(3.0)

    def diameter_at(self, length: Array) -> Array:
        """Diameter of the braid [m]."""
        return np.sqrt(self.thread**2 - length**2) / (self.turns * pi)

    def volume(self, length: Array) -> Array:
        """Volume inside the braid [m^3], a cylinder of that diameter."""
        return pi / 4.0 * self.diameter_at(length) ** 2 * length

    def area(self, length: Array) -> Array:
        """-dV/dL [m^2]: force per gauge pressure."""
        return (3.0 * length**2 - self.thread**2) / (4.0 * pi * self.turns**2)

    def lengths(self, points: int = 4001) -> Array:
        """A table of lengths from the shortest sensible to nearly the braid lock."""
        return np.linspace(0.55 * self.nominal, 0.9995 * self.thread, points)

    def document(self, form: str = "diameter") -> dict[str, Any]:
        """The muscle as a user would give it: by ``diameter`` and angle, or by ``thread`` and turns."""
        own: dict[str, Any] = {"nominal_length": f"{self.nominal * 1e3:.6g} mm"}
        if form == "thread":
            own |= {"thread_length": self.thread, "turns": self.turns}
        else:
            own |= {
                "braid_diameter": f"{self.diameter * 1e3:.6g} mm",
                "braid_angle": f"{self.angle * 180.0 / pi:.8g} deg",
            }
        return own | {
            "inside_diameter": f"{self.inside * 1e3:.6g} mm",
            "wall_thickness": f"{self.wall * 1e3:.6g} mm",
        }


def made(size: int, rng: np.random.Generator, *, length: float | None = None) -> Muscle:
    """A muscle like one of the usual sizes 10, 20, 40 (bore in mm), figures rounded as on a drawing."""
    diameter, angle = {10: (11.8e-3, 25.0), 20: (21.8e-3, 26.5), 40: (42e-3, 26.0)}[size]
    nominal = length or round(float(rng.uniform(0.2, 0.5)), 3)
    angle = round(angle + float(rng.uniform(-0.4, 0.4)), 2)
    return Muscle(nominal, diameter, radians(angle), 1.8e-3, size * 1e-3)


def ideal_force(muscle: Muscle, pressure: Array, length: Array) -> Array:
    """P b^2 (3 cos^2 - 1)/(4 pi n^2) [N]."""
    cosine = length / muscle.thread
    return pressure * muscle.thread**2 * (3.0 * cosine**2 - 1.0) / (4.0 * pi * muscle.turns**2)


def stretches(muscle: Muscle, length: Array) -> tuple[Array, Array, Array]:
    """Stretch of the incompressible wall along, around and through."""
    along = length / muscle.nominal
    around = muscle.diameter_at(length) / (muscle.thread * sin(muscle.angle) / (muscle.turns * pi))
    return along, around, 1.0 / (along * around)
