"""The lost stroke of the ends: nothing at the reference length, else the force at a shifted contraction."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import Muscle

LOST = default_catalogue()["lost_stroke"]
STROKE, REFERENCE = 0.012, 0.25


def state(nominal_length: float, length: object, *, stroke: float = STROKE) -> State:
    muscle = Muscle(nominal_length, 0.0118, radians(26.0), 0.0018, 0.01)
    values = {"lost_stroke": {"stroke": stroke, "reference_length": REFERENCE}}
    return Model([LOST]).evaluate(muscle=muscle, values=values, length=length, pressure=5e5)


@pytest.mark.parametrize("nominal_length", [0.06, 0.153, 0.25, 0.8, 9.0])
def test_the_gas_pulls_as_at_a_contraction_shifted_by_the_lost_share(nominal_length: float) -> None:
    contraction = np.linspace(-0.02, 0.2, 23)
    shift = STROKE * (1.0 / nominal_length - 1.0 / REFERENCE)
    muscle = Muscle(nominal_length, 0.0118, radians(26.0), 0.0018, 0.01)
    expected = ideal.force(
        braid=muscle.braid, pressure=5e5, length=nominal_length * (1.0 - contraction - shift)
    )
    got = state(nominal_length, nominal_length * (1.0 - contraction))
    np.testing.assert_allclose(got.force, expected, rtol=1e-9, atol=1e-6)


def test_force_is_the_slope_of_the_volume_and_the_volume_at_rest_is_the_braids() -> None:
    length, step = np.linspace(0.075, 0.1, 11), 1e-6
    slope = (state(0.1, length + step).volume - state(0.1, length - step).volume) / (2.0 * step)
    np.testing.assert_allclose(state(0.1, length).force, -5e5 * slope, rtol=1e-6)
    assert state(0.1, 0.1).volume == pytest.approx(state(0.1, 0.1, stroke=0.0).volume, rel=1e-14)


def test_at_the_reference_length_nothing_changes() -> None:
    length = np.linspace(0.2, 0.255, 12)
    for with_it, without in zip(state(0.25, length), state(0.25, length, stroke=0.0), strict=True):
        np.testing.assert_allclose(with_it, without, rtol=1e-14)


def test_a_longer_muscle_pulls_more_up_to_a_limit() -> None:
    forces = [float(state(L, L).force) for L in (0.06, 0.1, 0.25, 1.0, 9.0)]
    assert np.all(np.diff(forces) > 0.0)
    muscle = Muscle(9.0, 0.0118, radians(26.0), 0.0018, 0.01)
    limit = ideal.force(braid=muscle.braid, pressure=5e5, length=9.0 * (1.0 + STROKE / REFERENCE))
    assert 0.99 < forces[4] / limit < 1.0
    assert np.isfinite(state(9.0, 9.2).diameter)
