"""Extensible threads: the balance of work they come from, limits, and the growth of the diameter."""

from __future__ import annotations

from math import pi, radians

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import Muscle

EFFECT = default_catalogue()["thread_extensibility"]
MUSCLE = Muscle(0.3, 0.0218, radians(26.6))
BRAID = MUSCLE.braid


def evaluate(compliance: float, length: object, pressure: object) -> State:
    values = {"thread_extensibility": {"compliance": compliance}}
    return Model([EFFECT]).evaluate(muscle=MUSCLE, values=values, length=length, pressure=pressure)


def change(compliance: float, length: float, pressure: float) -> float:
    """Change of force [N]."""
    whole = ideal.force(braid=BRAID, pressure=pressure, length=length)
    return float(evaluate(compliance, length, pressure).force - whole)


@pytest.mark.parametrize("compliance", [1e-6, 1e-5, 5e-5])
@pytest.mark.parametrize("length", [0.24, 0.3])
def test_thread_length_minimises_the_energy(compliance: float, length: float) -> None:
    """The thread's energy N E A b eps^2/2 minus the work P V of the gas is smallest there."""
    b, n = BRAID
    pressure = 6e5

    def energy(strain: float) -> float:
        stretched = b * (1.0 + strain)
        gas = pressure * length * (stretched**2 - length**2) / (4.0 * pi * n**2)
        return b * strain**2 / (2.0 * compliance) - gas

    best = minimize_scalar(energy, bounds=(0.0, 0.5), method="bounded", options={"xatol": 1e-12})
    diameter = np.sqrt((b * (1.0 + best.x)) ** 2 - length**2) / (n * pi)
    assert evaluate(compliance, length, pressure).diameter == pytest.approx(diameter, rel=1e-6)


def test_force_loss_grows_with_the_square_of_pressure() -> None:
    """Exactly so for small strain: dF(2P)/dF(P) tends to 4."""
    assert change(1e-6, 0.27, 2e4) / change(1e-6, 0.27, 1e4) == pytest.approx(4.0, rel=1e-4)
    assert change(1e-6, 0.27, 8e5) / change(1e-6, 0.27, 4e5) == pytest.approx(4.0, rel=1e-2)


def test_force_loss_of_small_strain() -> None:
    """dF = -P b^2 eps/(2 pi n^2), nearly the same at every contraction; 2 kN of 1 MN are 0.2 % strain."""
    strain = 1e-6 * 1998.0
    b, n = BRAID
    assert change(1e-6, 0.3, 6e5) == pytest.approx(-6e5 * b**2 * strain / (2.0 * pi * n**2), rel=5e-3)


def test_stiff_threads_are_ideal() -> None:
    assert abs(change(1e-12, 0.27, 6e5)) < 1e-5


def test_diameter_grows_with_pressure_at_constant_length() -> None:
    """The ideal model predicts no growth at all."""
    pressures = np.array([0.0, 2e5, 4e5, 6e5])
    assert np.ptp(evaluate(0.0, 0.27, pressures).diameter) == 0.0
    assert (np.diff(evaluate(1e-6, 0.27, pressures).diameter) > 0.0).all()


def test_absurd_threads_stay_finite() -> None:
    assert np.isfinite(evaluate(1e-3, 0.3, 8e5).force)
