"""The base class of signals of time, and the shapes made of straight pieces.

The unit of the levels depends on the use: a share of the valve opening ("1"), a stroke ("m"), a force ("N").
"""

from __future__ import annotations

import math
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from mckibben.physics.errors import InputError
from mckibben.simulation.command.segments import Array, Segments, clipped

MAX_SEGMENTS = 100_000
#: Largest distance of a smooth shape from its chords, as a share of the amplitude.
SMOOTH_ERROR = 1e-4

#: Beyond these a slope or a square would overflow.
LARGEST, SHORTEST_TIME = 1e30, 1e-9

POSITIVE, NOT_NEGATIVE = "positive", "positive or zero"

Pieces = tuple[Array, Array, Array]


def key(kind: str, default: Any = MISSING, *, name: str = "", rule: str = "") -> Any:
    """A field of a document: its kind of quantity, default, name in the document, and range.

    The defaults "rest" and "full" are replaced by the values of `signal_from` for rest and full signal.
    """
    metadata = {"kind": kind, "default": default, "rule": rule, "name": name}
    # "rest" and "full" are no defaults of the constructor.
    known = default is not MISSING and default not in ("rest", "full")
    return field(default=default, metadata=metadata) if known else field(metadata=metadata)


def require(holds: bool, name: str, message: str, hint: str | None = None) -> None:
    """Raise InputError unless the condition holds."""
    if not holds:
        raise InputError(message, field=name, hint=hint)


@dataclass(frozen=True, kw_only=True, eq=False)
class Signal:
    """A signal from t = 0 on. Subclasses define its pieces.

    Raises:
        InputError: an impossible value, with ``field`` its path in the document; more than `MAX_SEGMENTS`.
    """

    shape: ClassVar[str]
    path: str = field(default="", repr=False)  # path in the document, for messages

    def __post_init__(self) -> None:
        for item in fields(self):
            rule, value = item.metadata.get("rule"), getattr(self, item.name)
            where = self._at(item.metadata.get("name") or item.name)
            if item.metadata.get("kind") not in (None, "column", "word"):
                require(abs(value) <= LARGEST, where, f"{where}: {value:g} is not a number that can be used")
            if rule:
                good = value > 0.0 if rule == POSITIVE else value >= 0.0
                require(good, where, f"{where}: {value:g} is not {rule}")
                short = item.metadata["kind"] == "time" and 0.0 < value < SHORTEST_TIME and rule == POSITIVE
                require(not short, where, f"{where}: {value:g} s is shorter than {SHORTEST_TIME:g} s")

    @property
    def before(self) -> float:
        """Value before t = 0; if it differs from the first value, there is an edge at 0 (see `delayed`)."""
        return float(self.value(0.0))

    @property
    def extent(self) -> tuple[float, float]:
        """The lowest and the highest value it can take."""
        raise NotImplementedError

    def value(self, time: ArrayLike) -> Array:
        """Exact value at any times [s], right-continuous at jumps; before t = 0 the value at 0."""
        t = np.maximum(np.asarray(time, dtype=np.float64), 0.0)
        starts, values, slopes = self._pieces(float(t.max(initial=0.0)))
        piece = np.maximum(np.searchsorted(starts, t, side="right") - 1, 0)
        return values[piece] + slopes[piece] * np.maximum(t - starts[piece], 0.0)

    def segments(self, duration: float, smooth_step: float | None = None) -> Segments:
        """Linear segments on [0, duration]: breakpoints exact, a jump is a new segment.

        Args:
            duration: end [s].
            smooth_step: longest chord of a smooth shape [s]; shorter where `SMOOTH_ERROR` requires it.
        """
        if not (math.isfinite(duration) and duration > 0.0):
            raise InputError(
                f"the duration {duration:g} s is not positive", field="duration", hint="e.g. '4 s'"
            )
        return clipped(*self._pieces(duration, smooth_step), duration=duration)

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        """Start, value and slope of each piece that begins up to ``until``; each lasts until the next."""
        raise NotImplementedError

    def _at(self, key: str) -> str:
        return f"{self.path}.{key}" if self.path else key

    def _check_count(self, count: float, why: str) -> None:
        too_many = f"{self.path or self.shape}: {why} makes {count:.3g} segments, at most {MAX_SEGMENTS}"
        require(count <= MAX_SEGMENTS, self.path, too_many)

    def _periods(self, until: float, period: float, pieces: int) -> Array:
        """The starts of all periods up to ``until``."""
        self._check_count(pieces * (until / period), f"{until:g} s in steps of {period:g} s")
        return period * np.arange(math.floor(until / period) + 1, dtype=np.float64)


def array(*values: float) -> Array:
    """Numbers as an array."""
    return np.array(values, dtype=np.float64)


@dataclass(frozen=True, kw_only=True, eq=False)
class Step(Signal):
    """``initial`` until ``at``, then ``level``."""

    shape = "step"
    at: float = key("time", 0.0, rule=NOT_NEGATIVE)
    level: float = key("value", "full")
    initial: float = key("value", "rest")

    @property
    def before(self) -> float:
        """The level before the step, also if the step is at t = 0."""
        return self.initial

    @property
    def extent(self) -> tuple[float, float]:
        """Both levels."""
        return min(self.level, self.initial), max(self.level, self.initial)

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        if self.at == 0.0:
            return array(0.0), array(self.level), array(0.0)
        return array(0.0, self.at), array(self.initial, self.level), np.zeros(2)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scaled(Signal):
    """Another signal times a factor: an angle as a position on the rim of a pulley."""

    shape = "scaled"
    of: Signal
    factor: float

    @property
    def before(self) -> float:
        """That of the other signal, scaled."""
        return self.factor * self.of.before

    @property
    def extent(self) -> tuple[float, float]:
        """Those of the other signal, scaled."""
        low, high = sorted(self.factor * end for end in self.of.extent)
        return low, high

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        starts, values, slopes = self.of._pieces(until, smooth_step)
        return starts, self.factor * values, self.factor * slopes


@dataclass(frozen=True, kw_only=True, eq=False)
class Pulse(Step):
    """``level`` from ``on`` to ``off``, ``initial`` otherwise."""

    shape = "pulse"
    at: float = field(init=False, repr=False, default=0.0)
    on: float = key("time", 0.0, rule=NOT_NEGATIVE)
    off: float = key("time")

    def __post_init__(self) -> None:
        super().__post_init__()
        where = self._at("off")
        message = f"{where}: {self.off:g} s is not after on = {self.on:g} s"
        require(self.off > self.on, where, message, f"e.g. '{self.on + 2:g} s'")

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        values = array(self.initial, self.level, self.initial)
        skipped = 1 if self.on == 0.0 else 0
        return array(0.0, self.on, self.off)[skipped:], values[skipped:], np.zeros(3 - skipped)


@dataclass(frozen=True, kw_only=True, eq=False)
class Square(Step):
    """``level`` for the share ``duty`` of each period, then ``initial``; starts with ``level`` at t = 0.

    A document may give ``amplitude`` = level - initial instead of one of the two.
    """

    shape = "square"
    at: float = field(init=False, repr=False, default=0.0)
    period: float = key("time", rule=POSITIVE)
    duty: float = key("share", 0.5)

    def __post_init__(self) -> None:
        super().__post_init__()
        where = self._at("duty")
        require(0.0 < self.duty < 1.0, where, f"{where}: {self.duty:g} is not between 0 and 1", "e.g. '50 %'")

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        begin = self._periods(until, self.period, 2)
        starts = np.column_stack([begin, begin + self.duty * self.period]).ravel()
        return starts, np.tile(array(self.level, self.initial), len(begin)), np.zeros(len(starts))


@dataclass(frozen=True, kw_only=True, eq=False)
class Triangle(Signal):
    """From ``offset`` up to ``offset + amplitude`` and back in each period.

    The amplitude is the full height, so that a stroke reference with offset 0 is never negative.
    """

    shape = "triangle"
    amplitude: float = key("value", "full")
    period: float = key("time", rule=POSITIVE)
    offset: float = key("value", 0.0)

    @property
    def extent(self) -> tuple[float, float]:
        """Base and tip."""
        tip = self.offset + self.amplitude
        return min(self.offset, tip), max(self.offset, tip)

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        begin = self._periods(until, self.period, 2)
        half = 0.5 * self.period
        rate = self.amplitude / half
        starts = np.column_stack([begin, begin + half]).ravel()
        values = np.tile(array(self.offset, self.offset + self.amplitude), len(begin))
        return starts, values, np.tile(array(rate, -rate), len(begin))


@dataclass(frozen=True, kw_only=True, eq=False)
class Ramp(Signal):
    """``from`` until ``start``, linear to ``to`` within ``duration``, then ``to``."""

    shape = "ramp"
    begin: float = key("value", "rest", name="from")
    end: float = key("value", "full", name="to")
    start: float = key("time", 0.0, rule=NOT_NEGATIVE)
    duration: float = key("time", rule=POSITIVE)

    @property
    def extent(self) -> tuple[float, float]:
        """Both ends."""
        return min(self.begin, self.end), max(self.begin, self.end)

    def _pieces(self, until: float, smooth_step: float | None = None) -> Pieces:
        starts = array(0.0, self.start, self.start + self.duration)
        rate = (self.end - self.begin) / self.duration
        return starts, array(self.begin, self.begin, self.end), array(0.0, rate, 0.0)
