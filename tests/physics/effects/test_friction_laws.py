"""Friction laws: loop width, contact area and the Stribeck curve."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()
MUSCLE = Muscle(0.3, 0.02, radians(25.0))
TONDU = {"static_coefficient": 0.015, "kinetic_coefficient": 0.105, "stribeck_speed": 0.15}


def loop_width(
    effect_id: str, values: dict[str, float], *, speed: float = 0.01, **state: object
) -> np.ndarray:
    """Force on lengthening minus force on shortening [N]."""
    model = Model([CATALOGUE[effect_id]])
    own = {effect_id: CATALOGUE[effect_id].defaults | values}
    up, down = (
        model.evaluate(muscle=MUSCLE, values=own, velocity=sign * speed, direction=sign, **state)
        for sign in (1.0, -1.0)
    )
    return up.force - down.force


def test_coulomb_width_is_twice_the_force_at_any_speed() -> None:
    for speed in (1e-6, 0.01, 1.0):
        width = loop_width("coulomb_friction", {"force": 2.5}, speed=speed, length=0.28, pressure=3e5)
        assert width == pytest.approx(5.0, abs=1e-9), "Chou & Hannaford: 2.5 N, a loop of 5 N"


def test_coulomb_loop_takes_force_times_travel() -> None:
    """A cycle of stroke dx: 2 F_c dx."""
    width = loop_width("coulomb_friction", {"force": 10.0}, length=np.linspace(0.25, 0.29, 5), pressure=3e5)
    assert np.mean(width) * 0.04 == pytest.approx(2.0 * 10.0 * 0.04, rel=1e-9)


def test_coulomb_falls_from_static_to_kinetic_with_a_static_share() -> None:
    """F_s = 1.4 F_c at rest, F_c at high speed, 1/e of the difference at the Stribeck speed."""
    values = {"force": 10.0, "static_share": 0.4, "stribeck_speed": 0.02}
    for speed, half in ((0.0, 14.0), (1e-12, 14.0), (0.02, 10.0 + 4.0 / np.e), (2.0, 10.0)):
        width = loop_width("coulomb_friction", values, speed=speed, length=0.28, pressure=3e5)
        assert width == pytest.approx(2.0 * half, rel=1e-9)


def test_coulomb_with_a_static_share_is_odd_and_takes_work() -> None:
    effect = CATALOGUE["coulomb_friction"]
    speeds = np.linspace(-0.1, 0.1, 401)
    own = {parameter.name: parameter.upper for parameter in effect.parameters}
    got = effect.call("friction", {"velocity": speeds, "direction": np.sign(speeds)}, own)
    np.testing.assert_allclose(got, -got[::-1], rtol=1e-11)
    assert (got * speeds >= 0.0).all()
    assert got[200] == 0.0


def test_pressure_friction_grows_with_pressure() -> None:
    """4 N/bar either way, and none below atmospheric pressure."""
    pressures = np.array([-2e4, 0.0, 1e5, 5e5])
    width = loop_width("pressure_friction", {"area": 4e-5}, length=0.28, pressure=pressures)
    assert width == pytest.approx([0.0, 0.0, 8.0, 40.0], abs=1e-9)


def test_friction_of_hertzian_contacts_grows_with_a_power_of_the_pressure() -> None:
    """Stated at 3 bar: 4 N/bar there; eight times the pressure gives four times the friction at q = 2/3."""
    own = {"area": 4e-5, "exponent": 2.0 / 3.0}
    width = loop_width("pressure_friction", own, length=0.28, pressure=np.array([-2e4, 0.0, 3e5, 24e5]))
    assert width == pytest.approx([0.0, 0.0, 24.0, 96.0], abs=1e-9)


def test_contact_area_is_the_cylinder_at_rest_and_smallest_at_45_degrees() -> None:
    """Half the loop over f P is S; f(0) = f_s."""
    lengths = MUSCLE.braid.thread_length * np.cos(np.radians(np.linspace(24.0, 60.0, 721)))
    area = loop_width("contact_friction", TONDU, speed=0.0, length=lengths, pressure=1e5) / (
        2.0 * 0.015 * 1e5
    )
    assert lengths[np.argmin(area)] == pytest.approx(
        MUSCLE.braid.thread_length * cos(radians(45.0)), rel=1e-3
    )
    assert area.min() == pytest.approx(pi * 0.02 * 0.3 * np.sin(radians(50.0)), rel=1e-6)
    at_rest = loop_width("contact_friction", TONDU, speed=0.0, length=0.3, pressure=1e5) / (2.0 * 0.015 * 1e5)
    assert at_rest == pytest.approx(pi * 0.02 * 0.3, rel=1e-9)


def test_contact_coefficient_runs_from_static_to_kinetic() -> None:
    def coefficient(speed: float) -> float:
        width = loop_width("contact_friction", TONDU, speed=speed, length=0.3, pressure=1e5)
        return float(width) / (2.0 * 1e5 * pi * 0.02 * 0.3)

    assert coefficient(0.0) == pytest.approx(0.015, rel=1e-9)
    assert coefficient(100.0) == pytest.approx(0.105, rel=1e-9)
    assert coefficient(0.15) == pytest.approx(0.105 - 0.09 / np.e, rel=1e-9)
