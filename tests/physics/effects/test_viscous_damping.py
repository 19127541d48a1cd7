"""Viscous damping: published coefficients, direction, power of the speed, and never a gain of work."""

from __future__ import annotations

import numpy as np
import pytest
import symengine as se

from mckibben.physics import ops
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle

MUSCLE = Muscle(0.3, 0.0218, 0.46)
DAMPING = default_catalogue()["viscous_damping"]
REYNOLDS = {"coefficient": 1010.0, "pressure_coefficient": 6.91e-3, "lengthening_ratio": 0.074}


def force(velocity: object, pressure: object = 4e5, **values: float) -> np.ndarray:
    context = {"velocity": velocity, "pressure": pressure, "muscle": MUSCLE}
    return DAMPING.call("friction", context, {**DAMPING.defaults, **values})


def test_reynolds_muscle_at_400_kpa() -> None:
    """3770 N s/m on shortening, 279 N s/m on lengthening."""
    assert force(-1.0, **REYNOLDS) == pytest.approx(-3770.0, rel=2e-3)
    assert force(1.0, **REYNOLDS) == pytest.approx(279.0, rel=2e-3)


def test_damping_vanishes_at_rest_and_only_takes_work() -> None:
    speeds = np.linspace(-0.5, 0.5, 101)
    for pressure in (-2e4, 0.0, 2.07e5, 6.21e5):
        got = force(speeds, pressure, **REYNOLDS)
        assert got[50] == 0.0
        assert (got * speeds >= 0.0).all()
    np.testing.assert_allclose(force(2.0 * speeds), 2.0 * force(speeds), rtol=1e-12)


@pytest.mark.parametrize("exponent", [0.3, 0.7, 1.0, 2.0])
def test_force_goes_with_the_power_of_the_speed(exponent: float) -> None:
    """At 0.1 m/s it is coefficient times speed; 16 times the speed is 16^n times the force."""
    assert force(-0.1, coefficient=300.0, exponent=exponent) == pytest.approx(-30.0, rel=1e-12)
    slow, fast = force(np.array([0.025, 0.4]), exponent=exponent)
    assert fast / slow == pytest.approx(16.0**exponent, rel=2e-5)


@pytest.mark.parametrize("exponent", [0.3, 0.7, 1.0, 2.0])
def test_power_of_the_speed_is_smooth_at_rest_and_only_takes_work(exponent: float) -> None:
    """Odd and rising everywhere; at rest the slope is c (1e-4/0.1)^(n-1)."""
    speeds = np.concatenate([-np.geomspace(1.0, 1e-9, 200), [0.0], np.geomspace(1e-9, 1.0, 200)])
    got = force(speeds, exponent=exponent)
    assert got[200] == 0.0
    np.testing.assert_allclose(got, -got[::-1], rtol=1e-14)
    assert (np.diff(got) > 0.0).all()
    speed = se.Symbol("v")
    slope = ops.derivative(lambda v: force(v, exponent=exponent), speed).subs({speed: 0.0})
    assert float(slope) == pytest.approx(200.0 * 1e-3 ** (exponent - 1.0), rel=1e-6)


def test_with_a_length_power_of_1_equal_rates_of_strain_give_equal_forces() -> None:
    """A muscle of twice the length at twice the speed has the same rate of strain, so the same force."""
    values = {"coefficient": 60.0, "length_power": 1.0}
    context = {"pressure": 3e5, **{name: DAMPING.defaults[name] for name in DAMPING.defaults}, **values}
    one, two = (
        DAMPING.call(
            "friction", {"velocity": speed, "muscle": MUSCLE._replace(nominal_length=length)}, context
        )
        for speed, length in ((0.02, 0.25), (0.04, 0.5))
    )
    assert one == pytest.approx(60.0 * 0.02, rel=1e-12)
    assert two == pytest.approx(one, rel=1e-12)
