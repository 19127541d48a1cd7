"""Inverse questions against closed forms of the ideal muscle and against the forward model."""

from __future__ import annotations

from math import cos, radians

import numpy as np
import pytest

from mckibben.physics.ideal import blocked_force
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics import inverse
from mckibben.simulation.statics.limits import MuscleLimits
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
LIMITS = MuscleLimits(6e5, 1500.0, 0.25, 0.04)


@pytest.fixture(scope="module")
def ideal() -> StaticModel:
    return StaticModel(MUSCLE, limits=LIMITS)


@pytest.fixture(scope="module")
def real() -> StaticModel:
    effects = {"bladder_elasticity": {}, "prestress": {"force": 100.0}, "coulomb_friction": {"force": 20.0}}
    return StaticModel(MUSCLE, effects, limits=LIMITS)


def codes(answer: inverse.Answer) -> set[str]:
    return {flag.code for flag in answer.flags}


def test_free_contraction_of_the_ideal_muscle_is_the_neutral_angle(ideal):
    answer = inverse.contraction_for_force(ideal, force=0.0, pressure=3e5)
    assert answer.value == pytest.approx(1 - 1 / (3**0.5 * cos(MUSCLE.braid_angle)), abs=1e-9)
    assert codes(answer) == {"over_contraction_limit"}


def test_pressure_for_the_blocked_force(ideal):
    force = float(blocked_force(diameter=0.0218, braid_angle=MUSCLE.braid_angle, pressure=4e5))
    answer = inverse.pressure_for_force(ideal, force=force, length=0.3)
    assert answer.value == pytest.approx(4e5, rel=1e-9)
    assert answer.flags == []


@pytest.mark.parametrize("pressure", [2e5, 4e5, 6e5])
@pytest.mark.parametrize("direction", [-1.0, 0.0, 1.0])
def test_answers_invert_the_forward_model(real, pressure, direction):
    force = float(real.force(length=0.275, pressure=pressure, direction=direction)[0])
    assert force > 0.0
    back = inverse.contraction_for_force(real, force=force, pressure=pressure, direction=direction)
    assert back.value == pytest.approx(1 - 0.275 / 0.3, abs=1e-8)
    needed = inverse.pressure_for_force(real, force=force, length=0.275, direction=direction)
    assert needed.value == pytest.approx(pressure, rel=1e-8)


def test_friction_makes_filling_fall_short_of_venting(real):
    pressures = np.linspace(2e5, 6e5, 9)
    filling = inverse.contraction_at(real, load=300.0, pressures=pressures, direction=-1.0)
    venting = inverse.contraction_at(real, load=300.0, pressures=pressures, direction=1.0)
    assert np.all(venting > filling)


def test_a_load_nothing_can_carry_is_out_of_reach_and_not_clipped(ideal):
    answer = inverse.contraction_for_force(ideal, force=1e5, pressure=6e5)
    assert answer.value is None
    assert codes(answer) == {"out_of_reach", "over_force_limit"}


def test_pressure_over_the_limit_is_answered_and_flagged(ideal):
    answer = inverse.pressure_for_force(ideal, force=1400.0, length=0.27)
    assert answer.value is not None
    assert answer.value > 6e5
    assert codes(answer) == {"over_pressure"}


@pytest.mark.parametrize(
    ("force", "length", "why"), [(10.0, 0.15, "slack"), (10.0, 0.34, "locks"), (9e5, 0.29, "gives only")]
)
def test_unreachable_pressure_says_why(ideal, force, length, why):
    answer = inverse.pressure_for_force(ideal, force=force, length=length)
    assert answer.value is None
    assert any(why in flag.message for flag in answer.flags if flag.code == "out_of_reach")


def test_a_stretched_muscle_that_already_pulls_more_is_out_of_reach(real):
    answer = inverse.pressure_for_force(real, force=10.0, length=0.312)
    assert answer.value is None
    assert "without any pressure" in answer.flags[-1].message


def test_stroke_pressure_lifts_the_load_by_the_stroke(real):
    answer = inverse.stroke_pressure(real, load=400.0, stroke=0.03)
    assert answer.value is not None
    reached = inverse.contraction_for_force(real, force=400.0, pressure=answer.value, direction=-1.0)
    assert reached.value == pytest.approx(0.1, abs=1e-8)


def test_working_range_stops_at_the_contraction_limit_and_says_so(ideal):
    answer = inverse.working_range(ideal, load=50.0, pressure=6e5)
    assert answer.details == {"start": 0.0, "end": 0.25}
    assert answer.value == pytest.approx(0.25 * 0.3)
    assert codes(answer) == {"over_contraction_limit"}


def test_working_range_starts_where_the_preload_stretches_the_muscle(real):
    answer = inverse.working_range(real, load=400.0, pressure=6e5, preload=150.0)
    start = answer.details["start"]
    assert start is not None
    assert -0.04 < start < 0.0
    stretched = real.force(length=0.3 * (1 - start), pressure=0.0, direction=1.0)
    assert stretched[0] == pytest.approx(150.0, rel=1e-6)


def test_working_range_of_an_ideal_muscle_cannot_hold_a_preload_without_pressure(ideal):
    answer = inverse.working_range(ideal, load=400.0, pressure=6e5, preload=50.0)
    assert answer.value is None
    assert "out_of_reach" in codes(answer)


@pytest.mark.parametrize("pressure", [2e5, 5e5])
def test_without_a_direction_both_ends_of_what_friction_holds_are_told(real, pressure):
    force = float(real.force(length=0.28, pressure=pressure)[0])
    answer = inverse.pressure_for_force(real, force=force, length=0.28)
    low, high = answer.details["lowest_pressure"], answer.details["highest_pressure"]
    assert low < answer.value < high
    # Each is the pressure of its branch.
    for end, direction in ((low, 1.0), (high, -1.0)):
        assert real.force(length=0.28, pressure=end, direction=direction)[0] == pytest.approx(force, abs=1e-3)
    held = inverse.contraction_for_force(real, force=force, pressure=pressure)
    for name, direction in (("lowest_contraction", -1.0), ("highest_contraction", 1.0)):
        length = 0.3 * (1.0 - held.details[name])
        reached = real.force(length=length, pressure=pressure, direction=direction)[0]
        assert reached == pytest.approx(force, abs=1e-3)
    stated = inverse.pressure_for_force(real, force=force, length=0.28, direction=1.0)
    assert "lowest_pressure" not in stated.details


def test_without_friction_there_is_no_interval(ideal):
    answer = inverse.pressure_for_force(ideal, force=200.0, length=0.27)
    assert set(answer.details) == {"length", "contraction", "force"}
