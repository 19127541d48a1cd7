"""Smooth and sampled shapes: sine, chirp, random levels, tables.

A smooth shape is replaced by its chords, with an error of at most `SMOOTH_ERROR` of its amplitude.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mckibben.physics.errors import did_you_mean
from mckibben.simulation.command.segments import SHORTEST, Array
from mckibben.simulation.command.shapes import (
    LARGEST,
    NOT_NEGATIVE,
    POSITIVE,
    SMOOTH_ERROR,
    Pieces,
    Signal,
    key,
    require,
)

_CHIRP_BLOCKS = 64


@dataclass(frozen=True, kw_only=True, eq=False)
class _Smooth(Signal):
    """offset + amplitude sin(angle(t)), cut into chords.

    The error of a chord of width h is at most h^2/8 max|y''|, with |y''| <= amplitude (angle'^2 + |angle''|).
    """

    amplitude: float = key("value", "full")
    offset: float = key("value", 0.0)

    @property
    def extent(self) -> tuple[float, float]:
        """Offset minus and plus the amplitude."""
        return self.offset - abs(self.amplitude), self.offset + abs(self.amplitude)

    def value(self, time: ArrayLike) -> Array:
        """Exact value at any times [s]; before t = 0 the value at 0."""
        t = np.maximum(np.asarray(time, dtype=np.float64), 0.0)
        return self.offset + self.amplitude * np.sin(self._angle(t))

    def _angle(self, time: Array) -> Array:
        raise NotImplementedError

    def _bends(self, until: float) -> tuple[Array, Array]:
        """Boundaries of blocks on [0, until], and the maximum of angle'^2 + |angle''| within each [1/s^2]."""
        raise NotImplementedError

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        limits, bends = self._bends(until)
        # 1 % below the stated error, as a margin for rounding.
        steps = np.sqrt(8.0 * 0.99 * SMOOTH_ERROR / np.maximum(bends, 1e-12))  # zero frequency: a constant
        if smooth_step is not None:
            steps = np.minimum(steps, smooth_step)
        counts = np.ceil(np.diff(limits) / steps)
        self._check_count(float(counts.sum()), f"{until:g} s of this {self.shape}")
        blocks = zip(limits[:-1], limits[1:], counts.astype(int), strict=True)
        nodes = np.concatenate([np.linspace(a, b, n, endpoint=False) for a, b, n in blocks] + [[until]])
        values = self.value(nodes)
        return nodes[:-1], values[:-1], np.diff(values) / np.diff(nodes)


@dataclass(frozen=True, kw_only=True, eq=False)
class Sine(_Smooth):
    """offset + amplitude sin(2 pi frequency t + phase); a document may give ``period`` for ``frequency``."""

    shape = "sine"
    frequency: float = key("frequency", rule=POSITIVE)
    phase: float = key("angle", 0.0)

    def _angle(self, time: Array) -> Array:
        return 2.0 * math.pi * self.frequency * time + self.phase

    def _bends(self, until: float) -> tuple[Array, Array]:
        return np.array([0.0, until]), np.array([(2.0 * math.pi * self.frequency) ** 2])


@dataclass(frozen=True, kw_only=True, eq=False)
class Chirp(_Smooth):
    """A sine whose frequency changes linearly within ``duration`` and then stays constant."""

    shape = "chirp"
    begin: float = key("frequency", name="from", rule=NOT_NEGATIVE)
    end: float = key("frequency", name="to", rule=NOT_NEGATIVE)
    duration: float = key("time", rule=POSITIVE)

    def _angle(self, time: Array) -> Array:
        swept = np.minimum(time, self.duration)
        rate = (self.end - self.begin) / self.duration
        turns = self.begin * swept + 0.5 * rate * swept**2 + self.end * (time - swept)
        return 2.0 * math.pi * turns

    def _bends(self, until: float) -> tuple[Array, Array]:
        limits = np.linspace(0.0, self.duration, _CHIRP_BLOCKS + 1)
        limits = np.unique(np.r_[limits[limits < until], until])
        frequency = np.interp(limits, [0.0, self.duration], [self.begin, self.end])
        fastest = np.maximum(frequency[1:], frequency[:-1])
        sweep = 2.0 * math.pi * abs(self.end - self.begin) / self.duration
        return limits, (2.0 * math.pi * fastest) ** 2 + sweep


@dataclass(frozen=True, kw_only=True, eq=False)
class Random(Signal):
    """A new level every ``hold``, uniform between ``lower`` and ``upper``; reproducible by its seed."""

    shape = "random"
    hold: float = key("time", rule=POSITIVE)
    seed: int = key("seed", 0, rule=NOT_NEGATIVE)
    lower: float = key("value", "rest")
    upper: float = key("value", "full")

    def __post_init__(self) -> None:
        super().__post_init__()
        where = self._at("upper")
        require(
            self.upper > self.lower, where, f"{where}: {self.upper:g} is not above lower = {self.lower:g}"
        )

    @property
    def extent(self) -> tuple[float, float]:
        """Lower and upper bound."""
        return self.lower, self.upper

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        starts = self._periods(until, self.hold, 1)
        # Drawn in order: a longer run begins with the levels of a shorter one.
        values = np.random.default_rng(self.seed).uniform(self.lower, self.upper, len(starts))
        return starts, values, np.zeros(len(starts))


@dataclass(frozen=True, kw_only=True, eq=False)
class TableSignal(Signal):
    """A table of points, joined by lines or each held until the next; constant outside its range.

    Two points at the same time are a jump. Times may begin before 0.
    """

    shape = "table"
    times: Array = key("column")  # noqa: RUF009 - a field()
    values: Array = key("column")  # noqa: RUF009
    interpolation: str = key("word", "linear")

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("times", "values"):
            column = np.array(getattr(self, name), dtype=np.float64)
            column.setflags(write=False)
            object.__setattr__(self, name, column)
            where = self._at(name)
            bad = np.flatnonzero(~(np.abs(column) <= LARGEST))
            require(len(column) > 0, where, f"{where}: the table is empty")
            require(
                not len(bad), where, f"{where}: entry {bad[:1].sum() + 1} is not a number that can be used"
            )
        where, count = self._at("times"), len(self.times)
        require(count == len(self.values), where, f"{where}: {count} times for {len(self.values)} values")
        self._check_count(count, "the table")
        back = np.flatnonzero(np.diff(self.times) < 0.0)
        number = int(back[:1].sum()) + 2
        require(not len(back), where, f"{where}: entry {number} is earlier than the one before it")
        where = self._at("interpolation")
        known = ("linear", "hold")
        require(
            self.interpolation in known,
            where,
            f"{where}: '{self.interpolation}' is not known",
            did_you_mean(self.interpolation, known),
        )

    @property
    def extent(self) -> tuple[float, float]:
        """The lowest and the highest entry."""
        return float(self.values.min()), float(self.values.max())

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        slopes = np.zeros(len(self.times))
        if self.interpolation == "linear":
            gaps = np.diff(self.times)
            np.divide(np.diff(self.values), gaps, out=slopes[:-1], where=gaps > SHORTEST)
        return self.times, self.values, slopes
