"""Effectiveness: what a factor keeps, and the threshold form."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

EFFECT = default_catalogue()["effectiveness"]
MUSCLE = Muscle(0.1, 0.01, radians(25.0))


def force(factor: float, threshold: float, length: object, pressure: object) -> np.ndarray:
    values = {"effectiveness": EFFECT.defaults | {"factor": factor, "threshold": threshold}}
    return Model([EFFECT]).evaluate(muscle=MUSCLE, values=values, length=length, pressure=pressure).force


def test_a_constant_factor_is_proportional_to_pressure_and_keeps_the_largest_contraction() -> None:
    assert force(0.85, 0.0, 0.09, 6e5) == pytest.approx(3.0 * force(0.85, 0.0, 0.09, 2e5), rel=1e-13)
    shortest = 0.1 * (1.0 - ideal.max_contraction(braid_angle=radians(25.0)))
    assert force(0.85, 0.0, shortest, 6e5) == pytest.approx(0.0, abs=1e-10)


def test_threshold_form() -> None:
    """E (P - P0) times the ideal area above P0, nothing below, no push and no NaN at P = 0."""
    pressures = np.array([0.0, 1e3, 5e4, 1e5, 1.0001e5, 3e5, 8e5])
    got = force(0.9, 1e5, 0.1, pressures)
    area = ideal.area(braid=MUSCLE.braid, length=0.1)
    assert got == pytest.approx(0.9 * np.maximum(pressures - 1e5, 0.0) * area, abs=1e-9)
    assert (got >= 0.0).all()


def test_a_loss_that_fades_with_pressure() -> None:
    """E (1 - s exp(-P/Ps)) of the ideal force: 1 - s at P = 0+, 1 - s/e at Ps, all of E far beyond."""
    values = {"effectiveness": EFFECT.defaults | {"factor": 0.9, "fading_loss": 0.4, "decay_pressure": 5e4}}
    pressures = np.array([1.0, 5e4, 3e6])
    got = Model([EFFECT]).evaluate(muscle=MUSCLE, values=values, length=0.1, pressure=pressures).force
    ideal_force = pressures * ideal.area(braid=MUSCLE.braid, length=0.1)
    assert got / ideal_force == pytest.approx(0.9 * np.array([0.6, 1.0 - 0.4 * 0.36787944, 1.0]), rel=3e-5)
