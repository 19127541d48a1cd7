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


def pulse_of(
    command: float, period: float, one: float, min_on: float, min_off: float
) -> tuple[float, float, float]:
    """Opening from the start of a period on, how long [s], and opening for the rest.

    Positional plain numbers on purpose: numba compiles it too.

    Args:
        command: -1 to 1; beyond, the nearest of them.
        period: of the carrier [s].
        one: 1 with one valve that vents when it does not fill, 0 with two.
        min_on, min_off: shortest times a valve is open and closed [s].
    """
    command = min(max(command, -1.0), 1.0)
    opened, closed, share = (1.0 if command > 0.0 else -1.0), 0.0, abs(command)
    if one > 0.0:
        opened, closed, share = 1.0, -1.0, 0.5 * (1.0 + command)
    width = share * period
    if width < min_on or width <= SHORTEST:
        width = 0.0
    elif period - width < min_off or period - width <= SHORTEST:
        width = period
    return opened, width, closed


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

    @property
    def constants(self) -> tuple[float, float, float, float]:
        """The last four arguments of `pulse_of`, in their order."""
        return self.period, float(self.valves == "one"), self.min_on, self.min_off

    def pulse(self, command: float) -> Pulse:
        """The pulse of a period."""
        return Pulse(*pulse_of(command, *self.constants))

    def periods(self, duration: float) -> int:
        """Number of periods in a run [s].

        Raises:
            InputError: more than `MOST_PERIODS`. Field "pwm.frequency".
        """
        count = int(np.ceil(duration / self.period - 1e-9))
        if count > MOST_PERIODS:
            raise InputError(
                f"{duration:g} s at {self.frequency:g} Hz are {count} periods, at most {MOST_PERIODS}",
                field="pwm.frequency",
                hint="shorten the run, or leave the pulse-width modulation out",
            )
        return count

    def switched(self, command: Segments) -> Segments:
        """The openings of the valves for a command.

        Raises:
            InputError: as `periods`.
        """
        duration = float(command.times[-1])
        count = self.periods(duration)
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
