"""Contraction factor: Tondu's and Kerscher's force, and a gas balance that agrees with it."""

from __future__ import annotations

from math import pi, radians, sin, tan

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()
EFFECT = CATALOGUE["contraction_factor"]
THETA = radians(26.5)
MUSCLE = Muscle(0.3, 0.0218, THETA, 0.0018, 0.020)
FALLING = {"factor": 1.09, "excess": 0.3, "decay_pressure": 1.3e5}
PRESSURES = np.array([0.0, 0.2e5, 1e5, 2.6e5, 6e5])
CONTRACTIONS = np.array([-0.03, 0.0, 0.1, 0.22])


def evaluate(
    values: dict[str, float], length: object, pressure: object, others: tuple[str, ...] = ()
) -> State:
    effects = [EFFECT, *(CATALOGUE[other] for other in others)]
    own = {effect.id: effect.defaults for effect in effects}
    own[EFFECT.id] = EFFECT.defaults | values
    return Model(effects).evaluate(muscle=MUSCLE, values=own, length=length, pressure=pressure)


def work_of_a_cycle(values: dict[str, float], others: tuple[str, ...] = ()) -> float:
    """Closed integral of F dL - V dP over an ellipse in length and pressure, relative to that of |F dL|."""
    phase = np.linspace(0.0, 2.0 * pi, 20001)[:-1]
    length, length_rate = 0.3 * (0.89 + 0.13 * np.sin(phase)), 0.039 * np.cos(phase)
    pressure, pressure_rate = 3e5 + 2.9e5 * np.cos(phase + 0.7), -2.9e5 * np.sin(phase + 0.7)
    got = evaluate(values, length, pressure, others)
    work = np.sum(got.tension * length_rate - got.volume * pressure_rate)
    return float(work / np.abs(got.tension * length_rate).sum())


@pytest.mark.parametrize("excess", [0.0, 0.08, 0.3])
def test_force_is_kerschers(excess: float) -> None:
    """F = P A0 [a (1 - k(P) eps)^2 - c_b], k(P) = k + a_k exp(-P/P_k)."""
    contraction, pressure = np.meshgrid(CONTRACTIONS, PRESSURES)
    k = 1.09 + excess * np.exp(-pressure / 1.3e5)
    a, c_b, a0 = 3.0 / tan(THETA) ** 2, 1.0 / sin(THETA) ** 2, pi * 0.0218**2 / 4.0
    got = evaluate(FALLING | {"excess": excess}, 0.3 * (1.0 - contraction), pressure)
    want = pressure * a0 * (a * (1.0 - k * contraction) ** 2 - c_b)
    np.testing.assert_allclose(got.force, want, rtol=1e-11, atol=1e-9)
    middle = 0.3 * (1.0 - k * contraction)
    turns = MUSCLE.braid.turns
    np.testing.assert_allclose(
        got.diameter, np.sqrt(MUSCLE.braid.thread_length**2 - middle**2) / (turns * pi), rtol=1e-12
    )


def test_force_by_pressure_is_minus_volume_by_length() -> None:
    """The relation of Maxwell between the two halves of the energy balance, by differences."""
    length, pressure = np.meshgrid(0.3 * (1.0 - CONTRACTIONS), PRESSURES[1:])
    by_pressure = (
        evaluate(FALLING, length, pressure + 10.0).tension
        - evaluate(FALLING, length, pressure - 10.0).tension
    ) / 20.0
    by_length = (
        evaluate(FALLING, length + 1e-6, pressure).volume - evaluate(FALLING, length - 1e-6, pressure).volume
    ) / 2e-6
    np.testing.assert_allclose(by_pressure, -by_length, atol=1e-7 * np.abs(by_length).max())
    np.testing.assert_allclose(
        evaluate(FALLING, length, pressure).area, -by_length, atol=1e-7 * np.abs(by_length).max()
    )


@pytest.mark.parametrize("others", [(), ("thread_extensibility",), ("bladder_elasticity", "prestress")])
def test_cycles_gain_no_work(others: tuple[str, ...]) -> None:
    """Exactly also with stretched threads: V_k holds b^2 L/(4 pi n^2) whatever k is."""
    assert abs(work_of_a_cycle(FALLING, others)) < 1e-9


def test_below_the_atmosphere_the_factor_stays_at_its_largest() -> None:
    vacuum = evaluate(FALLING, 0.27, -2e4)
    constant = evaluate({"factor": 1.39, "excess": 0.0}, 0.27, -2e4)
    assert float(vacuum.force) == pytest.approx(float(constant.force), rel=1e-12)
    assert float(vacuum.volume) == pytest.approx(float(constant.volume), rel=1e-12)


def test_a_factor_that_grows_with_contraction_gives_the_area_of_the_braid_there() -> None:
    """F = P A0 [a (1 - k eps - g eps^2)^2 - c_b], and the gas balance agrees: a cycle gains no work."""
    growing = {"factor": 1.05, "growth": 0.5}
    a, c = 3.0 / tan(THETA) ** 2, 1.0 / sin(THETA) ** 2
    for contraction in (0.0, 0.1, 0.22):
        middle = 1.05 * contraction + 0.5 * contraction**2
        expected = 3e5 * pi * 0.0218**2 / 4.0 * (a * (1.0 - middle) ** 2 - c)
        assert float(evaluate(growing, 0.3 * (1.0 - contraction), 3e5).force) == pytest.approx(expected)
    assert abs(work_of_a_cycle(FALLING | {"growth": 0.5})) < 1e-6
