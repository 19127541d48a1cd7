"""Forces that no usual catalogue of muscle effects has."""

from __future__ import annotations

import numpy as np

from tests.truth.composition import GasLaw, Hidden, Record, accept
from tests.truth.muscle import Array, Muscle

NOBODY = accept()


def ripple(muscle: Muscle, amplitude: float, wave: float, phase: float) -> Hidden:
    """Strands that snap over each other: a wave of the contraction, the same at every pressure."""

    def tension(length: Array, _: Array) -> Array:
        return amplitude * np.sin(2.0 * np.pi * (1.0 - length / muscle.nominal) / wave + phase)

    return Hidden("force ripple", NOBODY, elastic=tension)


def torsion(muscle: Muscle, area: float, turn: float) -> Hidden:
    """An unbalanced braid twists to and fro: P times an S-shaped course over the contraction."""

    def turned(law: GasLaw) -> GasLaw:
        def force(p: Array, x: Array) -> Array:
            bent = (1.0 - x / muscle.nominal) / turn
            return law(p, x) + p * area * np.sin(2.0 * np.pi * bent)

        return force

    return Hidden("torsion", NOBODY, gas=turned)


def magnet(muscle: Muscle, force: float, at: float, width: float) -> Hidden:
    """A latch magnet on the carriage: a pull about one position."""

    def tension(length: Array, _: Array) -> Array:
        return force / (1.0 + (((1.0 - length / muscle.nominal) - at) / width) ** 2) ** 2

    return Hidden("magnet", NOBODY, elastic=tension)


def humidity(amplitude: float, period: float) -> Hidden:
    """A drift that comes and goes with the air conditioning, not with the muscle."""
    return Hidden(
        "periodic drift",
        NOBODY,
        memory=lambda record: amplitude * np.sin(2.0 * np.pi * record.time / period + 0.4),
    )


def sticking_point(muscle: Muscle, force: float, at: float, width: float) -> Hidden:
    """A burr on the rod: friction at one length only."""

    def tension(record: Record) -> Array:
        off = ((1.0 - record.length / muscle.nominal) - at) / width
        return force * np.exp(-0.5 * off**2) * np.tanh(record.velocity() / 2e-4)

    return Hidden("sticking point", NOBODY, memory=tension)


def moving_frame(amplitude: float, frequency: float) -> Hidden:
    """A compressor next door shakes the rig: a force on the load at one frequency (transients)."""
    return Hidden("shaken rig", NOBODY, air={"shake": amplitude, "shake_frequency": frequency})


def swinging_mass(coefficient: float) -> Hidden:
    """An inertance that changes along the stroke: a force q v^2, the same in both directions (transients)."""
    return Hidden("quadratic velocity", NOBODY, air={"inertance": coefficient})
