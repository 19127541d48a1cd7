"""How several effects combine into one model."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import permutations
from math import pi, radians

import numpy as np
import pytest
import symengine as se

from mckibben.physics import ideal, ops
from mckibben.physics.braid import angle, diameter, volume
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import GEOMETRY, Muscle

CATALOGUE = default_catalogue()
MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.020)
BRAID = MUSCLE.braid
STATE = {"length": np.linspace(0.23, 0.305, 7), "pressure": 4e5, "velocity": -0.01, "direction": -1.0}


def evaluate(values: Mapping[str, Mapping[str, float]], **state: object) -> State:
    """The model of the named effects; parameters that are not given keep their defaults."""
    effects = [CATALOGUE[effect_id] for effect_id in values]
    full = {effect.id: {**effect.defaults, **values[effect.id]} for effect in effects}
    return Model(effects).evaluate(muscle=MUSCLE, values=full, **{**STATE, **state})


def test_no_effects_is_the_ideal_muscle() -> None:
    got = evaluate({})
    length = STATE["length"]
    force = ideal.force(braid=BRAID, pressure=4e5, length=length)
    assert got.force == pytest.approx(force, rel=1e-13)
    assert got.tension == pytest.approx(force, rel=1e-13)
    assert got.area == pytest.approx(ideal.area(braid=BRAID, length=length), rel=1e-13)
    assert np.array_equal(got.volume, volume(braid=BRAID, length=length))
    assert np.array_equal(got.diameter, diameter(braid=BRAID, length=length))
    assert np.array_equal(got.braid_angle, angle(braid=BRAID, length=length))
    assert np.array_equal(got.length, length)
    assert (got.slack_force, got.compliance) == (0.0, 0.0)


def test_scalars_arrays_and_grids_give_the_same() -> None:
    lengths, pressures = np.meshgrid(STATE["length"], [1e5, 4e5])
    grid = evaluate({"bladder_elasticity": {}}, length=lengths, pressure=pressures).force
    assert grid.shape == (2, 7)
    for index in np.ndindex(grid.shape):
        one = evaluate({"bladder_elasticity": {}}, length=lengths[index], pressure=pressures[index]).force
        assert float(one) == pytest.approx(grid[index], rel=1e-14)


def test_wall_keeps_its_volume() -> None:
    """H D L is constant; at rest the outer diameter is braid plus wall."""
    got = evaluate({}, length=np.array([0.3, 0.25]))
    assert float(got.outer_diameter[0]) == pytest.approx(0.0218 + 0.0018, rel=1e-12)
    wall = got.outer_diameter - got.diameter
    assert wall * got.diameter * np.array([0.3, 0.25]) == pytest.approx(0.0018 * 0.0218 * 0.3, rel=1e-12)


def test_additive_effects_commute_and_add() -> None:
    chosen = ("bladder_elasticity", "braid_lock", "coulomb_friction", "prestress")
    alone = sum(evaluate({name: {}}).force - evaluate({}).force for name in chosen)
    together = evaluate({name: {} for name in chosen}).force
    assert together == pytest.approx(evaluate({}).force + alone, abs=1e-10)
    for order in permutations(chosen):
        assert np.array_equal(evaluate({name: {} for name in order}).force, together)


def test_a_force_factor_scales_the_gas_alone() -> None:
    """Not the elastomer, not the friction, and not the volume."""
    others = {"bladder_elasticity": {}, "coulomb_friction": {}}
    both = evaluate({**others, "effectiveness": {"factor": 0.8}})
    expected = evaluate(others).force - 0.2 * evaluate({}).force
    assert both.force == pytest.approx(expected, rel=1e-12)
    assert np.array_equal(both.volume, evaluate({}).volume)


def test_an_elastomer_factor_scales_the_elastomer_alone() -> None:
    elastic = evaluate({"bladder_elasticity": {}, "prestress": {}}).force - evaluate({}).force
    warm = evaluate(
        {"bladder_elasticity": {}, "prestress": {}, "temperature": {"coefficient": -0.005}},
        temperature=313.15,
    )
    assert warm.force == pytest.approx(evaluate({}).force + 0.9 * elastic, rel=1e-12)


def test_sensors_are_undone_before_and_applied_after_the_physics() -> None:
    """Reading = scale (true + offset), in the order of the ids: offset first."""
    sensors = {
        "pressure_offset": {"offset": 1e4},
        "pressure_scale": {"scale": 1.02},
        "length_offset": {"offset": 0.002},
        "force_offset": {"offset": 7.0},
        "force_scale": {"scale": 0.98},
    }
    got = evaluate({**sensors, "bladder_elasticity": {}})
    true = evaluate({"bladder_elasticity": {}}, length=STATE["length"] - 0.002, pressure=4e5 / 1.02 - 1e4)
    assert got.tension == pytest.approx(true.tension, rel=1e-12)
    assert got.force == pytest.approx(0.98 * (true.tension + 7.0), rel=1e-12)
    assert got.slack_force == pytest.approx(0.98 * 7.0, rel=1e-12)
    assert got.length == pytest.approx(STATE["length"] - 0.002, rel=1e-14)
    assert got.diameter == pytest.approx(true.diameter, rel=1e-12)


def test_threshold_and_thread_see_the_pressure_at_the_muscle() -> None:
    """The threshold takes from what drives the braid; the threads carry all of the pressure."""
    both = evaluate({"threshold_pressure": {"threshold": 5e4}, "thread_extensibility": {}})
    stretched = evaluate({"thread_extensibility": {}})
    assert both.force == pytest.approx(3.5e5 * stretched.area, rel=1e-12)
    assert np.array_equal(both.volume, stretched.volume)


@pytest.mark.parametrize("first", ["contraction_factor", "end_caps", "wall_thickness"])
@pytest.mark.parametrize("second", ["contraction_factor", "end_caps", "wall_thickness"])
def test_shapes_chain_and_area_stays_the_slope_of_the_volume(first: str, second: str) -> None:
    chosen = {first: {}, second: {}}
    step = 1e-6
    slope = (
        evaluate(chosen, length=STATE["length"] + step).volume
        - evaluate(chosen, length=STATE["length"] - step).volume
    ) / (2.0 * step)
    got = evaluate(chosen)
    assert got.area == pytest.approx(-slope, abs=2e-8 * float(np.max(got.area)))
    assert got.force == pytest.approx(4e5 * got.area, rel=1e-13)


def test_compliances_in_series_are_reported() -> None:
    assert evaluate({"rig_compliance": {"compliance": 3e-6}}).compliance == 3e-6


def test_every_effect_at_once() -> None:
    """All effects together stay finite, on numbers and on symbols, and agree."""
    effects = tuple(CATALOGUE.values())
    model = Model(effects)
    point = {"length": 0.27, "pressure": 3e5, "velocity": 0.01, "direction": 1.0, "temperature": 310.0}
    defaults = {effect.id: effect.defaults for effect in effects}
    numeric = model.evaluate(muscle=MUSCLE, values=defaults, **point)
    inputs = {name: se.Symbol(name) for name in point}
    symbolic = model.evaluate(muscle=MUSCLE, values=defaults, **inputs)
    function = se.Lambdify(list(inputs.values()), [se.sympify(output) for output in symbolic], backend="llvm")
    got = function(np.array(list(point.values())))
    assert np.isfinite(got).all()
    assert got == pytest.approx([float(value) for value in numeric], rel=1e-11)


def test_geometry_may_be_symbols() -> None:
    """Blocked force F = P A0 (2/sin^2 - 3): dF/dD0 = 2 F/D0, dF/dtheta0 = -4 P A0 cos/sin^3."""
    geometry = {name: se.Symbol(name) for name in GEOMETRY}
    force = se.sympify(
        Model()
        .evaluate(muscle=Muscle(**geometry), values={}, length=geometry["nominal_length"], pressure=1e5)
        .force
    )
    numbers = dict(zip(geometry.values(), MUSCLE, strict=True))
    blocked = float(ideal.blocked_force(diameter=0.0218, braid_angle=radians(26.5), pressure=1e5))
    assert float(force.subs(numbers)) == pytest.approx(blocked, rel=1e-12)
    slope = float(force.diff(geometry["braid_diameter"]).subs(numbers))
    assert slope == pytest.approx(2.0 * blocked / 0.0218, rel=1e-11)
    slope = float(force.diff(geometry["braid_angle"]).subs(numbers))
    theta = radians(26.5)
    expected = 1e5 * pi * 0.0218**2 / 4.0 * -4.0 * np.cos(theta) / np.sin(theta) ** 3
    assert slope == pytest.approx(float(expected), rel=1e-10)


def test_ops_are_what_the_model_returns_on_symbols() -> None:
    length = se.Symbol("L")
    state = Model().evaluate(muscle=MUSCLE, values={}, length=length, pressure=se.Symbol("P"))
    assert ops.is_symbolic(state.force)
    assert float(state.area.subs({length: 0.27})) == pytest.approx(
        float(ideal.area(braid=BRAID, length=0.27)), rel=1e-12
    )
