"""Pulse-width modulation: a command becomes the pulses of switching valves.

At the start of each period of the carrier the command is read. Two valves, one for filling and one for
venting, are opened for that share of the period, the first by a positive command, the second by a negative
one; then both are closed: the mean opening is the command. One valve with three ports fills for the share
(1 + u)/2 and vents for the rest.

A pulse shorter than the shortest time a valve stays open is left out, and a pause shorter than the shortest
time it stays closed as well: the valve then stays open for the whole period.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.simulation.command.segments import SHORTEST, Segments, clipped

#: Most periods of a run.
MOST_PERIODS = 100_000


class Pulse(NamedTuple):
    """Opening from the start of a period on, how long [s], and opening for the rest."""

    first: float
    width: float
    then: float


@dataclass(frozen=True, slots=True)
class PulseWidth:
    """A carrier and the switching valves.

    Attributes:
        frequency: of the carrier [Hz].
        valves: "two" valves with two ports each, or "one" with three, which vents when it does not fill.
        min_on, min_off: shortest times a valve is open and closed [s].
    """

    frequency: float
    valves: Literal["one", "two"] = "two"
    min_on: float = 0.0
    min_off: float = 0.0

    @property
    def period(self) -> float:
        """Of the carrier [s]."""
        return 1.0 / self.frequency

    def pulse(self, command: float) -> Pulse:
        """The pulse of a period."""
        command = min(max(command, -1.0), 1.0)
        if self.valves == "one":
            opened, closed, share = 1.0, -1.0, 0.5 * (1.0 + command)
        else:
            opened, closed, share = (1.0 if command > 0.0 else -1.0), 0.0, abs(command)
        width = share * self.period
        if width < self.min_on or width <= SHORTEST:
            width = 0.0
        elif self.period - width < self.min_off or self.period - width <= SHORTEST:
            width = self.period
        return Pulse(opened, width, closed)

    def switched(self, command: Segments) -> Segments:
        """The openings of the valves for a command.

        Raises:
            InputError: more than `MOST_PERIODS` periods. Field "pwm.frequency".
        """
        duration = float(command.times[-1])
        count = int(np.ceil(duration / self.period - 1e-9))
        if count > MOST_PERIODS:
            raise InputError(
                f"{duration:g} s at {self.frequency:g} Hz are {count} periods, at most {MOST_PERIODS}",
                field="pwm.frequency",
                hint="shorten the run, or leave the pulse-width modulation out",
            )
        starts: list[float] = []
        levels: list[float] = []
        for number, value in enumerate(command.value(np.arange(count) * self.period)):
            pulse, begin = self.pulse(float(value)), number * self.period
            if pulse.width > 0.0:
                starts.append(begin)
                levels.append(pulse.first)
            if pulse.width < self.period:
                starts.append(begin + pulse.width)
                levels.append(pulse.then)
        return clipped(starts, levels, np.zeros(len(starts)), duration=duration)


class Carrier:
    """The pulses of a sampled command, which is read at the start of each period."""

    def __init__(self, modulation: PulseWidth) -> None:
        self._modulation, self._number = modulation, 0

    def edges(self, command: tuple[float, float], begin: float, end: float) -> list[tuple[float, int, float]]:
        """Instants in [begin, end), muscle (0 or 1) and opening; of a period also what comes after ``end``.

        Args:
            command: of both muscles, from ``begin`` on.
            begin, end: of the sample [s].
        """
        found: list[tuple[float, int, float]] = []
        while (start := self._number * self._modulation.period) < end - SHORTEST:
            for muscle, each in enumerate(command):
                pulse = self._modulation.pulse(each)
                if pulse.width > 0.0:
                    found.append((start, muscle, pulse.first))
                if pulse.width < self._modulation.period:
                    found.append((start + pulse.width, muscle, pulse.then))
            self._number += 1
        return sorted(found)
