"""Springs that act on one side only: the stretched braid, the locked braid, and the threshold pressure."""

from __future__ import annotations

from math import asin, pi, radians, sin

import numpy as np
import pytest

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()
MUSCLE = Muscle(0.3, 0.0218, radians(26.5))


def force(effect_id: str, values: dict[str, float], length: object, pressure: object = 0.0) -> np.ndarray:
    model = Model([CATALOGUE[effect_id]])
    own = {effect_id: CATALOGUE[effect_id].defaults | values}
    return model.evaluate(muscle=MUSCLE, values=own, length=length, pressure=pressure).force


def test_braid_stiffening_is_a_continuous_spring_that_only_pulls() -> None:
    values = {"stiffness": 2e5, "onset": -0.01}
    lengths = np.linspace(0.25, 0.315, 400)
    got = force("braid_stiffening", values, lengths)
    assert (got >= 0.0).all()
    assert np.array_equal(got[lengths <= 0.303], np.zeros((lengths <= 0.303).sum()))
    beyond = lengths > 0.3035
    assert np.diff(got[beyond]) / np.diff(lengths[beyond]) == pytest.approx(2e5, rel=1e-9)
    assert float(force("braid_stiffening", values, 0.303 + 1e-12)) < 1e-6


def test_1000_newton_on_the_paper_s_stretched_muscle() -> None:
    """Size 10, 247 mm, 6 bar, 20 mm stretch: 495.9 N of the ideal muscle, the rest of a 25.2 kN/m spring."""
    muscle = Muscle(0.247, 0.01, radians(25.0))
    effect = CATALOGUE["braid_stiffening"]
    values = {"braid_stiffening": effect.defaults | {"stiffness": 25.2e3, "onset": 0.0}}
    model = Model([effect])
    got = model.evaluate(muscle=muscle, values=values, length=0.267, pressure=6e5).force
    assert float(got) == pytest.approx(1000.0, abs=0.5)


def test_braid_lock_begins_where_strands_touch() -> None:
    """Strands of width w on rhombi of side l touch at l sin(2 theta) = w; w/l = sin(80°) is 50 degrees."""
    lock = pi / 2.0 - 0.5 * asin(sin(radians(80.0)))
    assert lock == pytest.approx(radians(50.0), rel=1e-12)
    at = MUSCLE.braid.thread_length * np.cos(lock)
    values = {"stiffness": 1e6, "lock_angle": lock}
    assert force("braid_lock", values, at + np.array([1e-9, 0.05])) == pytest.approx([0.0, 0.0], abs=1e-12)
    assert force("braid_lock", values, at - 0.001) == pytest.approx(-1000.0, rel=1e-9)


def test_braid_lock_ends_the_contraction_at_any_pressure() -> None:
    """Without load a stiff lock holds the muscle at its length, far from the ideal 36 %."""
    values = {"stiffness": 5e6, "lock_angle": radians(45.0)}
    at = float(MUSCLE.braid.thread_length * np.cos(radians(45.0)))
    for pressure in (2e5, 8e5):
        assert float(force("braid_lock", values, at, pressure)) > 0.0
        assert float(force("braid_lock", values, at - 0.0002, pressure)) < 0.0


@pytest.mark.parametrize("exponent", [1.0, 1.3, 2.0, 3.0])
def test_braid_lock_stiffens_with_the_power_of_the_way(exponent: float) -> None:
    """1 % of 300 mm beyond the lock the force is stiffness times way; at twice the way 2^m times that."""
    values = {"stiffness": 1e5, "lock_angle": radians(45.0), "exponent": exponent}
    lock = float(MUSCLE.braid.thread_length * np.cos(radians(45.0)))
    got = force("braid_lock", values, lock - np.array([-0.01, 0.0, 0.003, 0.006]))
    assert got == pytest.approx([0.0, 0.0, -300.0, -300.0 * 2.0**exponent], rel=1e-9)
    near = force("braid_lock", values, lock - np.geomspace(1e-12, 1e-2, 300))
    assert (np.diff(near) <= 0.0).all(), "no step where the law begins"


@pytest.mark.parametrize("exponent", [1.0, 2.0, 5.0])
def test_taut_threads_pull_with_the_power_of_the_way(exponent: float) -> None:
    """1 % of 300 mm beyond the onset the force is stiffness times way; at twice the way 2^m times that."""
    values = {"stiffness": 1e5, "onset": -0.01, "exponent": exponent}
    got = force("braid_stiffening", values, 0.303 + np.array([-0.01, 0.0, 0.003, 0.006]))
    assert got == pytest.approx([0.0, 0.0, 300.0, 300.0 * 2.0**exponent], rel=1e-9)


def test_no_force_below_the_threshold_pressure() -> None:
    pressures = np.array([0.0, 1e4, 4e4, 4.1e4, 3e5])
    got = force("threshold_pressure", {"threshold": 4e4}, 0.28, pressures)
    area = ideal.area(braid=MUSCLE.braid, length=0.28)
    assert got == pytest.approx(np.array([0.0, 0.0, 0.0, 1e3, 2.6e5]) * area, abs=1e-9)


def test_default_threshold_is_that_of_a_thin_latex_tube() -> None:
    """E H (r_b - r_i)/r_i^2 with 1 MPa, 1 mm, from 5 to 6 mm."""
    default = CATALOGUE["threshold_pressure"].defaults["threshold"]
    assert default == pytest.approx(1e6 * 1e-3 * 1e-3 / 5e-3**2)


def test_a_vacuum_is_left_alone() -> None:
    """Without a threshold a gauge pressure below 0 still drives the braid backwards."""
    got = force("threshold_pressure", {"threshold": 0.0}, 0.28, -2e4)
    assert got == pytest.approx(ideal.force(braid=MUSCLE.braid, pressure=-2e4, length=0.28), rel=1e-13)
