"""Sensors and rig: how large the published errors are on a real muscle, and the series spring."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from scipy.optimize import brentq

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics.model import StaticModel

CATALOGUE = default_catalogue()
SIZE_20 = Muscle(0.3, 0.0218, radians(26.6), 0.0018, 0.02)


def change(effect_id: str, values: dict[str, float], *, length: float = 0.3, pressure: float = 6e5) -> float:
    """Change of the force as measured [N]."""
    state = {"muscle": SIZE_20, "length": length, "pressure": pressure}
    with_it = Model([CATALOGUE[effect_id]]).evaluate(values={effect_id: values}, **state).force
    return float(with_it - Model().evaluate(values={}, **state).force)


def test_one_atmosphere_on_the_gauge_is_265_newton() -> None:
    """Absolute read as gauge on a size 20 muscle, with the slope of 2620 mm^2 of its measured map."""
    assert -change("pressure_offset", {"offset": 101325.0}) == pytest.approx(265.0, rel=0.02)
    assert change("pressure_offset", {"offset": 3e3}) == pytest.approx(-8.0, abs=0.2), "the weather"


def test_one_millimetre_is_18_newton() -> None:
    """On 300 mm at 6 bar; and it is the same as asking for the length without it."""
    assert change("length_offset", {"offset": 1e-3}) == pytest.approx(-18.0, abs=0.5)
    shifted = ideal.force(braid=SIZE_20.braid, pressure=6e5, length=0.269)
    whole = ideal.force(braid=SIZE_20.braid, pressure=6e5, length=0.270)
    assert change("length_offset", {"offset": 1e-3}, length=0.270) == pytest.approx(shifted - whole, rel=1e-9)


def test_five_millimetres_at_a_kilonewton() -> None:
    """5 mm/kN is 7.5 mm at 1.5 kN: the muscle is that much shorter than the rig says."""
    model = StaticModel(SIZE_20, {"rig_compliance": {"compliance": 5e-6}})

    def muscle_force(length: float) -> float:
        return float(ideal.force(braid=SIZE_20.braid, pressure=6e5, length=length))

    for length in (0.25, 0.28, 0.305):
        inside = brentq(
            lambda x, length=length: x + 5e-6 * muscle_force(x) - length, 0.15, length, xtol=1e-15
        )
        got = float(model.force(length=length, pressure=6e5)[0])
        assert got == pytest.approx(muscle_force(inside), rel=1e-9)
    at_1500 = brentq(lambda x: muscle_force(x) - 1500.0, 0.2, 0.33, xtol=1e-15)
    assert float(model.force(length=at_1500 + 7.5e-3, pressure=6e5)[0]) == pytest.approx(1500.0, rel=1e-9)


def test_springs_in_series() -> None:
    """1/k = 1/k_muscle + 1/k_rig, by differences of the force as measured."""
    compliance, step = 4e-6, 1e-5
    model = StaticModel(SIZE_20, {"rig_compliance": {"compliance": compliance}})
    low, middle, high = model.force(length=np.array([0.28 - step, 0.28, 0.28 + step]), pressure=6e5)
    inside = 0.28 - compliance * middle
    muscle = ideal.stiffness(braid=SIZE_20.braid, pressure=6e5, length=inside)
    expected = 1.0 / (1.0 / muscle + compliance)
    assert (high - low) / (2.0 * step) == pytest.approx(float(expected), rel=1e-6)


def test_elastomer_alone_follows_its_temperature() -> None:
    """Ideal rubber at 40 K more is 40/293 stiffer; the gas force stays."""
    chosen = [CATALOGUE["bladder_elasticity"], CATALOGUE["temperature"]]
    values = {effect.id: effect.defaults for effect in chosen}
    values["temperature"] = {"coefficient": 1.0 / 293.15, "reference_temperature": 293.15}

    def force(pressure: float, temperature: float) -> float:
        model = Model(chosen)
        state = {"muscle": SIZE_20, "length": 0.27, "pressure": pressure, "temperature": temperature}
        return float(model.evaluate(values=values, **state).force)

    assert force(0.0, 333.15) / force(0.0, 293.15) == pytest.approx(333.15 / 293.15, rel=1e-12)
    gas = ideal.force(braid=SIZE_20.braid, pressure=5e5, length=0.27)
    for temperature in (293.15, 333.15):
        assert force(5e5, temperature) - force(0.0, temperature) == pytest.approx(float(gas), rel=1e-12)
