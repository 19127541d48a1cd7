"""Wall thickness: its losses, the angle where it vanishes, and a wall that keeps its volume."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np
import pytest

from mckibben.physics import ideal
from mckibben.physics.braid import volume
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

EFFECT = default_catalogue()["wall_thickness"]
MUSCLE = Muscle(0.1, 0.01, radians(25.0))
BRAID = MUSCLE.braid


def loss(thickness: float, theta: float) -> float:
    """Change of force [N] at 6 bar and a braid angle [rad]."""
    length = BRAID.thread_length * cos(theta)
    values = {"wall_thickness": {"thickness": thickness}}
    got = Model([EFFECT]).evaluate(muscle=MUSCLE, values=values, length=length, pressure=6e5).force
    return float(got - ideal.force(braid=BRAID, pressure=6e5, length=length))


@pytest.mark.parametrize(("thickness", "expected"), [(0.5e-3, -34.390), (1e-3, -69.72), (1.8e-3, -128.2)])
def test_losses_at_rest(thickness: float, expected: float) -> None:
    digits = abs(expected) * 6e-4 if thickness > 1e-3 else 5e-3
    assert loss(thickness, radians(25.0)) == pytest.approx(expected, abs=digits)


@pytest.mark.parametrize("thickness", [1e-4, 1e-3])
def test_only_the_square_of_the_wall_is_left_at_45_degrees(thickness: float) -> None:
    assert loss(thickness, radians(45.0)) == pytest.approx(-pi * 6e5 * thickness**2, rel=1e-9)
    assert loss(thickness, radians(40.0)) < 0.0 < loss(thickness, radians(52.0))


def test_bore_is_the_cylinder_inside_the_wall() -> None:
    lengths = np.linspace(0.07, 0.103, 9)
    values = {"wall_thickness": {"thickness": 1.2e-3}}
    got = Model([EFFECT]).evaluate(muscle=MUSCLE, values=values, length=lengths, pressure=6e5)
    assert got.volume == pytest.approx(pi / 4.0 * (got.diameter - 2.4e-3) ** 2 * lengths, rel=1e-12)


def test_a_wall_that_keeps_its_volume_changes_nothing() -> None:
    """Bore = braid cylinder minus a constant: the slope, and so the force, is the ideal one."""
    rubber = pi * 0.009 * 0.001 * 0.1
    lengths, step = np.linspace(0.07, 0.103, 9), 1e-6
    bore = [volume(braid=BRAID, length=lengths + sign * step) - rubber for sign in (1.0, -1.0)]
    force = -6e5 * (bore[0] - bore[1]) / (2.0 * step)
    assert force == pytest.approx(ideal.force(braid=BRAID, pressure=6e5, length=lengths), abs=1e-5)
