"""A made-up muscle on a test bench: the readings that the file writers of these tests write down."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
STEPS = 12  # readings of one way


class Readings(NamedTuple):
    """Readings in SI, one after the other; ``run`` numbers the held pressures (or lengths)."""

    time: Array
    pressure: Array
    stroke: Array
    force: Array
    run: NDArray[np.int64]


def force_of(pressure: Array, contraction: Array) -> Array:
    """Pulling force [N] of Tondu's model for 20 mm and 25 degrees, with a bladder that takes 10 N."""
    area, angle = np.pi * 0.01**2, np.radians(25.0)
    a, b = 3.0 / np.tan(angle) ** 2, 1.0 / np.sin(angle) ** 2
    return pressure * area * (a * (1.0 - contraction) ** 2 - b) - 10.0


def isobaric(
    *pressures: float, rest: float = 0.25, longest: float = 0.2, seed: int = 1, step: float = 0.2
) -> Readings:
    """There and back at each pressure [Pa], up to a contraction."""
    random = np.random.default_rng(seed)
    way = np.concatenate([np.linspace(0.0, longest, STEPS), np.linspace(longest, 0.0, STEPS)[1:]])
    contraction = np.tile(way, len(pressures))
    held = np.repeat(pressures, len(way))
    pressure = held + 150.0 * random.standard_normal(len(held))
    force = force_of(pressure, contraction) + 0.4 * random.standard_normal(len(held))
    force += np.tile(np.where(np.arange(len(way)) < STEPS, -6.0, 6.0), len(pressures))
    run = np.repeat(np.arange(len(pressures)), len(way))
    return Readings(step * np.arange(len(held)), pressure, contraction * rest, force, run)


def isotonic(*, load: float = 98.0, rest: float = 0.25, seed: int = 2, step: float = 0.5) -> Readings:
    """The pressure up and down under a load [N]."""
    random = np.random.default_rng(seed)
    way = np.concatenate([np.linspace(2e5, 6e5, 3 * STEPS), np.linspace(6e5, 2e5, 3 * STEPS)[1:]])
    pressure = way + 100.0 * random.standard_normal(len(way))
    grid = np.linspace(-0.05, 0.35, 2000)
    stroke = np.array([np.interp(-load, -force_of(np.full(2000, p), grid), grid) for p in way])
    rows = len(way)
    return Readings(
        step * np.arange(rows), pressure, stroke * rest, np.full(rows, load), np.zeros(rows, np.int64)
    )
