"""Friction with memory on the branches of a slow loop: the end of a long motion, integrated here by hand."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle
from mckibben.physics.sliding import acting_at_rest, sliding_effects

CATALOGUE = default_catalogue()
MUSCLE = Muscle(0.3, 0.0218, 0.46, 0.0018, 0.02)
SLIDING = [effect for effect in CATALOGUE.values() if any(state.sliding for state in effect.states)]
STATE = {"length": 0.28, "pressure": 4e5}


def force(effect: Effect, **state: float) -> float:
    return float(
        Model([effect])
        .evaluate(muscle=MUSCLE, values={effect.id: effect.defaults}, **{**STATE, **state})
        .force
    )


def after_a_long_motion(effect: Effect, direction: float) -> float:
    """Friction after 30 mm of slow motion and 4 bar of slow change of pressure, by Euler's method."""
    values = dict(effect.defaults)
    states = {state.name: state.initial for state in effect.states}
    speed, step = 1e-3 * direction, 1e-2
    context = {**STATE, "muscle": MUSCLE, "velocity": speed, "direction": direction, "temperature": 293.15}
    context |= {"pressure_rate": -4e5 / 30.0 * direction, "area": 1e-3}
    for _ in range(3000):
        rates = effect.call("rates", context, {**values, **states})
        for name, rate in zip(states, rates, strict=True):
            states[name] += float(rate) * step
    return float(effect.call("friction", context, {**values, **states}))


@pytest.mark.parametrize("effect", SLIDING, ids=[effect.id for effect in SLIDING])
@pytest.mark.parametrize("direction", [-1.0, 1.0])
def test_a_branch_has_the_friction_after_a_long_motion(effect: Effect, direction: float) -> None:
    (sliding,) = sliding_effects(effects=[effect])
    branch = force(sliding, direction=direction) - force(sliding)
    assert branch == pytest.approx(after_a_long_motion(effect, direction), rel=1e-3)
    assert branch * direction > 0.0  # filling pulls less, venting more


@pytest.mark.parametrize("effect", SLIDING, ids=[effect.id for effect in SLIDING])
def test_without_a_direction_it_is_the_mean_curve_to_the_bit(effect: Effect) -> None:
    (sliding,) = sliding_effects(effects=[effect])
    assert force(sliding) == force(effect)
    assert np.mean([force(sliding, direction=way) for way in (-1.0, 1.0)]) == pytest.approx(force(effect))


def test_every_friction_of_the_muscle_with_memory_slides_except_creep() -> None:
    with_memory = {effect.id for effect in CATALOGUE.values() if effect.states and "friction" in effect.slots}
    relaxing = {"creep", "pressure_creep"}  # they relax on a slow loop
    assert {effect.id for effect in SLIDING} == with_memory - relaxing


def test_others_stay_the_same_object_and_the_changed_one_is_made_once() -> None:
    effects = (CATALOGUE["dahl"], CATALOGUE["bladder_elasticity"], CATALOGUE["creep"])
    first, second = sliding_effects(effects=effects), sliding_effects(effects=effects)
    assert first == second
    assert first[0] is not effects[0]
    assert first[1:] == effects[1:]


def test_effects_that_are_left_out_at_rest_change_nothing_there() -> None:
    left_out = set(CATALOGUE.values()) - set(acting_at_rest(effects=CATALOGUE.values()))
    assert {"dahl", "viscous_damping", "coulomb_friction"} <= {effect.id for effect in left_out}
    assert "elasticity" not in {effect.id for effect in left_out}
    ideal = Model([])
    for effect in left_out:
        for length in (0.22, 0.28, 0.3, 0.305):
            at = {"length": length, "pressure": 4e5, "velocity": 0.0, "direction": 0.0}
            assert force(effect, **at) == ideal.evaluate(muscle=MUSCLE, values={}, **at).force, effect.id
