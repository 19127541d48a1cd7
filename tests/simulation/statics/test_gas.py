"""Closed-valve stiffness where the gas volume also depends on pressure, and behind a series spring."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from scipy.optimize import brentq

from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
ATMOSPHERE, GAMMA, DEAD = 101325.0, 1.3, 15e-6


@pytest.mark.parametrize(
    "effects",
    [
        {"thread_extensibility": {"compliance": 2e-5}},
        {"rig_compliance": {"compliance": 5e-6}},
        {"thread_extensibility": {"compliance": 2e-5}, "rig_compliance": {"compliance": 5e-6}},
    ],
)
def test_sealed_muscle_by_solving_for_its_pressure(effects):
    model = StaticModel(MUSCLE, effects)

    def volume(length, pressure):
        return model.outputs(length=length, pressure=pressure)["volume"][0] + DEAD

    rest = (3e5 + ATMOSPHERE) * volume(0.27, 3e5) ** GAMMA

    def sealed(length):
        pressure = brentq(lambda p: (p + ATMOSPHERE) * volume(length, p) ** GAMMA - rest, 1e5, 6e5, xtol=1e-7)
        return model.force(length=length, pressure=pressure)[0]

    h = 2e-5
    expected = (sealed(0.27 + h) - sealed(0.27 - h)) / (2 * h)
    curves = model.curves(np.array([3e5]), np.array([0.27]), dead_volume=DEAD, polytropic_exponent=GAMMA)
    assert curves.stiffness_closed[0, 0] == pytest.approx(expected, rel=1e-5)
