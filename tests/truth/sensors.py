"""Sensors that err, and the noise, quantisation and drift of those that do not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from scipy.signal import cont2discrete, lfilter

from tests.truth.composition import Hidden, Record, accept
from tests.truth.muscle import Array, Muscle, ideal_force


def zero_error(channel: str, offset: float, *ids: str) -> Hidden:
    """A zero that is off."""

    def reading(channels: dict[str, Array]) -> dict[str, Array]:
        channels[channel] = channels[channel] + offset
        return channels

    return Hidden(f"{channel} zero", accept(*ids), reading=reading)


def bent_scale(channel: str, scale: float, bend: float, full: float, *ids: str) -> Hidden:
    """A scale error with a slight bend: y = scale x [1 + bend (1 - x/full)]."""

    def reading(channels: dict[str, Array]) -> dict[str, Array]:
        x = channels[channel]
        channels[channel] = scale * x * (1.0 + bend * (1.0 - x / full))
        return channels

    return Hidden(f"{channel} scale", accept(*ids), reading=reading)


def second_order(time: Array, signal: Array, frequency: float, damping: float) -> Array:
    """A signal behind a second-order filter, at rest before the first row."""
    step = float(np.min(np.diff(time)))
    grid = np.arange(time[0], time[-1] + step, step)
    w = 2.0 * np.pi * frequency
    system = ([w * w], [1.0, 2.0 * damping * w, w * w])
    b, a, _ = cast(tuple[Array, Array, float], cont2discrete(system, step, method="foh"))
    even = np.interp(grid, time, signal)
    return np.interp(time, grid, even[0] + lfilter(b.ravel(), a, even - even[0]))


def slow_amplifier(channel: str, frequency: float, damping: float, *ids: str) -> Hidden:
    """A channel behind a second-order low pass."""

    def reading(channels: dict[str, Array]) -> dict[str, Array]:
        channels[channel] = second_order(channels["time"], channels[channel], frequency, damping)
        return channels

    return Hidden(f"slow {channel} amplifier", accept(*ids), reading=reading)


def tube_behind_the_sensor(muscle: Muscle, seconds: float, *ids: str) -> Hidden:
    """The sensor sits before a rough tube: Weymouth's flow, the root of a difference of squared pressures.

    Args:
        seconds: to fill the muscle of full length from 3 to 4 bar, were that flow constant.
    """
    atmosphere = 101.3e3

    def memory(record: Record) -> Array:
        before = np.maximum(record.pressure, 0.0) + atmosphere
        flow = 1e5 / seconds / np.sqrt(5.013e5**2 - 4.013e5**2)
        slower = muscle.volume(record.length) / float(muscle.volume(np.array(muscle.nominal)))
        rounded = (2e4) ** 2  # Pa^2, laminar below

        def rate(sensor: float, inside: float) -> float:
            head = sensor**2 - inside**2
            return flow * head / (head**2 + rounded**2) ** 0.25

        inside = np.empty_like(before)
        inside[0] = before[0]
        for row in range(1, len(before)):
            span = float(record.time[row] - record.time[row - 1])
            parts = min(50, max(1, int(np.ceil(span / (0.02 * seconds)))))
            x, step = float(inside[row - 1]), span / parts / float(slower[row])
            for part in range(parts):
                here, there = (
                    float(before[row - 1] + (before[row] - before[row - 1]) * (part + k) / parts)
                    for k in (0, 1)
                )
                first = rate(here, x)
                second = rate(0.5 * (here + there), x + 0.5 * step * first)
                x += step * rate(0.5 * (here + there), x + 0.5 * step * second)
            inside[row] = x
        return ideal_force(muscle, inside - atmosphere, record.length) - ideal_force(
            muscle, record.pressure, record.length
        )

    return Hidden("tube behind the sensor", accept(*ids), memory=memory)


def warm_cell(slope: float, *ids: str) -> Hidden:
    """A load cell whose zero follows its temperature, with a slight bend [N/K]."""

    def memory(record: Record) -> Array:
        warmer = record.temperature - 293.15
        return slope * warmer * (1.0 + 0.002 * warmer)

    return Hidden("warm load cell", accept(*ids), memory=memory)


def warming_amplifier(drift: float, half: float, *ids: str) -> Hidden:
    """A zero that drifts from the start of the record: half of it within a time, the rest hyperbolically."""

    def memory(record: Record) -> Array:
        since = record.time - record.time[0]
        return drift * since / (since + half)

    return Hidden("amplifier that warms up", accept(*ids), memory=memory)


def late_recorder(delay: float, *ids: str) -> Hidden:
    """The force comes from another recorder, whose clock is off: resampled by cubic lines."""

    def reading(channels: dict[str, Array]) -> dict[str, Array]:
        time = channels["time"]
        channels["force"] = np.interp(time - delay, time, channels["force"])
        return channels

    return Hidden("late recorder", accept(*ids), reading=reading)


@dataclass(frozen=True)
class Noise:
    """What every channel adds: white noise, steps of the converter, a slow drift of the force.

    Attributes:
        levels: standard deviation by channel, SI.
        bits: of the converter; positions are counted with at least 14.
        ranges: largest value of each channel that the converter shows.
        drift: amplitude of the force's drift, in units of its noise.
    """

    levels: dict[str, float]
    ranges: dict[str, float]
    bits: int = 16
    drift: float = 0.0

    def white(self, channel: str, rows: int, rng: np.random.Generator) -> Array:
        """White noise of a channel."""
        return rng.normal(0.0, self.levels.get(channel, 0.0), rows)

    def drifting(self, channel: str, time: Array) -> Array:
        """A slow drift that levels off, of the force alone."""
        if channel != "force" or not self.drift:
            return np.zeros_like(time)
        span = float(time[-1] - time[0])
        return self.drift * self.levels["force"] * (1.0 - np.exp(-3.0 * (time - time[0]) / span))

    def quantised(self, channel: str, values: Array) -> Array:
        """Values in steps of the converter."""
        bits = max(self.bits, 14) if channel in ("length", "diameter") else self.bits
        step = self.ranges[channel] / 2.0**bits
        return np.round(values / step) * step
