"""Viscous damping: published coefficients, direction, and never a gain of work."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue

DAMPING = default_catalogue()["viscous_damping"]
REYNOLDS = {"coefficient": 1010.0, "pressure_coefficient": 6.91e-3, "lengthening_ratio": 0.074}


def force(velocity: object, pressure: object = 4e5, **values: float) -> np.ndarray:
    context = {"velocity": velocity, "pressure": pressure}
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
