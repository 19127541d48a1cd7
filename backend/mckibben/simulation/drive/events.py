"""Events of a run: impacts on the end stops, loads that leave them, muscles that hang slack."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import HIGH_STOP, LOW_STOP
from mckibben.simulation.integrate.engine import SLOWEST_REBOUND, CompiledDrive


@dataclass(frozen=True, slots=True)
class Event:
    """A change of a switch.

    Attributes:
        time: instant [s].
        switch: `mckibben.physics.drive_terms.LOW_STOP`, `HIGH_STOP`, `SLIDES_UP`, `SLIDES_DOWN` or `SLACK`,
            of the second muscle of a pair with `COUNTER`.
        begins: whether the contact, the slack or the sliding begins; of an impact with rebound False.
        speed: of the stroke just before [m/s], positive = shortening.
        acceleration: of the stroke just before [m/s^2].
    """

    time: float
    switch: str
    begins: bool
    speed: float = 0.0
    acceleration: float = 0.0

    @property
    def impact(self) -> bool:
        """Whether the load hits an end stop.

        A contact that ends does so after a rebound, which has a least speed, or because the load leaves its
        stop from rest; an integrator may then report a speed of the size of its rounding errors.
        """
        least = 0.0 if self.begins else SLOWEST_REBOUND
        return self.switch in (LOW_STOP, HIGH_STOP) and abs(self.speed) > least


def events_of(compiled: CompiledDrive, rows: np.ndarray) -> tuple[Event, ...]:
    """The events of a solution."""
    return tuple(each_event(compiled, rows))


def each_event(compiled: CompiledDrive, rows: np.ndarray) -> Iterator[Event]:
    """The events of a solution, one after the other: for whom needs only the first ones."""
    switches = compiled.model.switches
    for time, number, value, speed, acceleration in rows.tolist():
        yield Event(time, switches[int(number)].name, bool(value), speed, acceleration)
