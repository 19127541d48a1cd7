"""The static model against closed forms, finite differences and a series spring solved by hand."""

from __future__ import annotations

from math import cos, pi, radians, sin, tan

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics.limits import MuscleLimits
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
PRESSURES = np.array([1e5, 3e5, 6e5])
LENGTHS = np.linspace(0.23, 0.305, 40)


def ideal_force(pressure: float, length: np.ndarray) -> np.ndarray:
    a, c = 3 / tan(MUSCLE.braid_angle) ** 2, 1 / sin(MUSCLE.braid_angle) ** 2
    return pressure * pi * MUSCLE.braid_diameter**2 / 4 * (a * (length / MUSCLE.nominal_length) ** 2 - c)


def test_ideal_curves_are_the_closed_form():
    curves = StaticModel(MUSCLE).curves(PRESSURES, LENGTHS, clipped=False)
    for row, pressure in enumerate(PRESSURES):
        np.testing.assert_allclose(curves.force[row], ideal_force(pressure, LENGTHS), rtol=1e-12)
    a = 3 / tan(MUSCLE.braid_angle) ** 2
    area = pi * MUSCLE.braid_diameter**2 / 4
    expected = 2 * a * LENGTHS / 0.3 * area * 6e5 / 0.3
    np.testing.assert_allclose(curves.stiffness[2], expected, rtol=1e-12)


def test_closed_valve_stiffness_is_that_of_a_sealed_chamber():
    # An independent sealed muscle: p V^gamma constant, force (p - p_atm) * area, differenced.
    gamma, dead, atmosphere, h = 1.3, 20e-6, 101325.0, 1e-6
    b = 0.3 / cos(MUSCLE.braid_angle)
    n = 0.3 * tan(MUSCLE.braid_angle) / (pi * 0.0218)

    def volume(length):
        return length * (b**2 - length**2) / (4 * pi * n**2) + dead

    def force(length, rest):
        absolute = (3e5 + atmosphere) * (volume(rest) / volume(length)) ** gamma
        return (absolute - atmosphere) * (3 * length**2 - b**2) / (4 * pi * n**2)

    expected = (force(0.27 + h, 0.27) - force(0.27 - h, 0.27)) / (2 * h)
    curves = StaticModel(MUSCLE).curves(
        np.array([3e5]), np.array([0.27]), dead_volume=dead, polytropic_exponent=gamma
    )
    assert curves.stiffness_closed[0, 0] == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("unclipped", [False, True])
def test_slack_muscle_does_not_push(unclipped):
    model = StaticModel(MUSCLE, {"bladder_elasticity": {}})
    curves = model.curves(np.array([0.2e5]), LENGTHS, clipped=not unclipped)
    if unclipped:
        assert np.min(curves.force) < -20.0
    else:
        assert np.min(curves.force) == 0.0
        assert np.all(curves.stiffness[curves.force == 0.0] == 0.0)


def test_stiffness_is_the_derivative_with_every_effect_of_the_catalogue():
    from mckibben.physics.catalogue import default_catalogue

    model = StaticModel(MUSCLE, {effect: {} for effect in default_catalogue()})
    h = 1e-7
    lengths = np.linspace(0.24, 0.295, 12)
    state = {"pressure": 4e5, "direction": -1.0, "velocity": -0.01}
    out = model.outputs(length=lengths, **state)
    up = model.outputs(length=lengths + h, **state)["force"]
    down = model.outputs(length=lengths - h, **state)["force"]
    np.testing.assert_allclose(out["force_by_length"], (up - down) / (2 * h), rtol=2e-5)
    more = model.outputs(length=lengths, **{**state, "pressure": 4e5 + 10.0})["force"]
    less = model.outputs(length=lengths, **{**state, "pressure": 4e5 - 10.0})["force"]
    np.testing.assert_allclose(out["force_by_pressure"], (more - less) / 20.0, rtol=2e-5)


def test_series_compliance_against_a_bisection():
    compliance = 5e-6
    model = StaticModel(MUSCLE, {"rig_compliance": {"compliance": compliance}})
    for length in (0.25, 0.28, 0.3):
        low, high = length - 0.02, length
        for _ in range(80):  # length of the muscle alone: L_m + c F(L_m) = L
            middle = (low + high) / 2
            if middle + compliance * ideal_force(5e5, np.array(middle)) < length:
                low = middle
            else:
                high = middle
        expected = ideal_force(5e5, np.array(low))
        assert model.force(length=length, pressure=5e5)[0] == pytest.approx(float(expected), rel=1e-9)


def test_series_compliance_adds_to_the_stiffness_like_two_springs():
    plain = StaticModel(MUSCLE)
    soft = StaticModel(MUSCLE, {"rig_compliance": {"compliance": 5e-6}})
    out = soft.outputs(length=0.28, pressure=5e5)
    inner = 0.28 - 5e-6 * out["tension"][0]
    muscle = plain.outputs(length=inner, pressure=5e5)["force_by_length"][0]
    assert 1 / out["force_by_length"][0] == pytest.approx(1 / muscle + 5e-6, rel=1e-9)


def test_unknown_effect_names_the_nearest():
    with pytest.raises(InputError) as error:
        StaticModel(MUSCLE, {"bladder_elastic": {}})
    assert error.value.hint == "Did you mean 'bladder_elasticity'?"


@pytest.mark.parametrize(
    ("values", "field"),
    [
        ({"shear_moduls": 1e5}, "effects.bladder_elasticity.shear_moduls"),
        ({"shear_modulus": -1.0}, "effects.bladder_elasticity.shear_modulus"),
        ({"shear_modulus": float("nan")}, "effects.bladder_elasticity.shear_modulus"),
    ],
)
def test_bad_parameter_is_named(values, field):
    with pytest.raises(InputError) as error:
        StaticModel(MUSCLE, {"bladder_elasticity": values})
    assert error.value.field == field


def test_effect_that_needs_the_wall_refuses_a_muscle_without_one():
    with pytest.raises(InputError, match="wall thickness") as error:
        StaticModel(MUSCLE._replace(wall_thickness=0.0), {"bladder_elasticity": {}})
    assert error.value.field == "muscle.wall_thickness"


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"braid_angle": radians(56)}, "lengthen"),
        ({"braid_angle": -0.1}, "above 0"),
        ({"nominal_length": float("nan")}, "nominal length"),
        ({"braid_diameter": 0.0}, "braid diameter"),
        ({"wall_thickness": 0.03}, "no bore"),
    ],
)
def test_geometry_that_cannot_pull_is_refused_in_physical_words(change, word):
    with pytest.raises(InputError, match=word):
        StaticModel(MUSCLE._replace(**change))


def test_limits_flag_every_crossing():
    limits = MuscleLimits(6e5, 1500.0, 0.25, 0.04)
    codes = {flag.code for flag in limits.flags(pressure=7e5, force=1600.0, contraction=0.3)}
    assert codes == {"over_pressure", "over_force_limit", "over_contraction_limit"}
    assert [flag.code for flag in limits.flags(contraction=-0.05)] == ["over_pretension_limit"]
    assert limits.flags(pressure=6e5, force=1500.0, contraction=0.25) == []
    assert MuscleLimits().flags(pressure=9e9, force=9e9, contraction=0.9) == []


def test_a_value_out_of_bounds_is_told_with_its_unit_and_a_share_without_one():
    with pytest.raises(InputError, match=r"is 1e\+09 N, outside 0 to") as force:
        StaticModel(MUSCLE, {"coulomb_friction": {"force": 1e9}})
    assert force.value.hint == "a typical value is 10 N"
    with pytest.raises(InputError, match=r"is 5, outside 0 to 1$") as share:
        StaticModel(MUSCLE, {"pressure_hysteresis": {"along_area": 5.0}})
    assert share.value.hint == "a typical value is 0"
