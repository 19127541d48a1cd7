"""What a hidden effect can change, and the muscle that has several of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from tests.truth.muscle import Array, Muscle, ideal_force

#: force of the gas [N] from gauge pressure [Pa] and length [m]
GasLaw = Callable[[Array, Array], Array]
#: additive tension [N] from length [m] and temperature [K]
Elastic = Callable[[Array, Array], Array]


@dataclass
class Record:
    """A test as it runs, finer than it is written down; SI.

    Attributes:
        kept: rows of the fine record that are written down.
        group: label of each fine row.
        load: of an isotonic test [N].
    """

    time: Array
    pressure: Array
    length: Array
    group: Array
    kept: np.ndarray
    temperature: Array
    load: Array | None = None

    def velocity(self) -> Array:
        """dL/dt [m/s], positive on lengthening."""
        return np.gradient(self.length, self.time)


@dataclass(frozen=True)
class Hidden:
    """One effect that the user's model does not have, in a form of its own.

    Attributes:
        name: what it is.
        accepted: effect ids that are right answers.
        gas: turns the gas law into another.
        elastic: additive tension.
        memory: additive tension along a record.
        slip: half width of a friction band [N] from pressure and length, for isotonic tests.
        reading: changes the channels of a record ("pressure", "length", "force") by their "time".
        rig: stretch [m] of what is in series, from the force.
        diameter: what a diameter sensor sees, from pressure and length; replaces the ideal one.
        air: numbers of the transient run that differ.
    """

    name: str
    accepted: frozenset[str]
    gas: Callable[[GasLaw], GasLaw] | None = None
    elastic: Elastic | None = None
    memory: Callable[[Record], Array] | None = None
    slip: Callable[[Array, Array], Array] | None = None
    reading: Callable[[dict[str, Array]], dict[str, Array]] | None = None
    rig: Callable[[Array], Array] | None = None
    diameter: Callable[[Array, Array], Array] | None = None
    air: dict[str, float] = field(default_factory=dict)


def accept(*ids: str) -> frozenset[str]:
    """The right answers for one hidden effect."""
    return frozenset(ids)


@dataclass(frozen=True)
class Truth:
    """A muscle with effects: what the user knows (``known``) and what is hidden."""

    muscle: Muscle
    known: tuple[Hidden, ...] = ()
    hidden: tuple[Hidden, ...] = ()

    @property
    def parts(self) -> tuple[Hidden, ...]:
        """All effects, the known ones first."""
        return (*self.known, *self.hidden)

    def without(self, index: int) -> Truth:
        """The same without one hidden effect."""
        return Truth(self.muscle, self.known, self.hidden[:index] + self.hidden[index + 1 :])

    def force(self, pressure: Array, length: Array, temperature: Array) -> Array:
        """Tension without memory [N] at the length of the rig."""
        rigs = [part.rig for part in self.parts if part.rig]
        if not rigs:
            return self._muscle_force(pressure, length, temperature)
        own = length
        for _ in range(60):  # F/k is small against the length: the iteration contracts quickly
            force = np.maximum(self._muscle_force(pressure, own, temperature), 0.0)
            own = 0.5 * own + 0.5 * (length - sum(rig(force) for rig in rigs))
        return self._muscle_force(pressure, own, temperature)

    def _muscle_force(self, pressure: Array, length: Array, temperature: Array) -> Array:
        law: GasLaw = lambda p, x: ideal_force(self.muscle, p, x)  # noqa: E731
        for part in self.parts:
            if part.gas:
                law = part.gas(law)
        total = law(pressure, length)
        for part in self.parts:
            if part.elastic:
                total = total + part.elastic(length, temperature)
        return total

    def memory(self, record: Record) -> Array:
        """Tension of all effects with memory along a record [N]."""
        total = np.zeros_like(record.time)
        for part in self.parts:
            if part.memory:
                total = total + part.memory(record)
        return total

    def read(self, channels: dict[str, Array]) -> dict[str, Array]:
        """The channels as the sensors show them, without noise."""
        for part in self.parts:
            if part.reading:
                channels = part.reading(dict(channels))
        return channels

    def longest_contraction(self, pressure: float, share: float = 0.04) -> float:
        """Largest contraction at which the muscle still pulls that share of its blocked force."""
        contraction = np.linspace(-0.05, 0.34, 400)
        length = self.muscle.nominal * (1.0 - contraction)
        force = self.force(np.full_like(length, pressure), length, np.full_like(length, 293.15))
        weak = np.flatnonzero(force < share * self.muscle.blocked)
        return float(contraction[weak[0] - 1] if len(weak) and weak[0] > 0 else contraction[-1])

    def least_pressure(self, length: float, share: float = 0.04) -> float:
        """Smallest pressure at which it does so at a length."""
        pressure = np.linspace(1e4, 7e5, 400)
        force = self.force(pressure, np.full_like(pressure, length), np.full_like(pressure, 293.15))
        strong = np.flatnonzero(force > share * self.muscle.blocked)
        return float(pressure[strong[0]] if len(strong) else pressure[-1])
