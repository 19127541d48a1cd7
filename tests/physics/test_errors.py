"""Nearest matches for a mistyped name."""

from __future__ import annotations

import pytest

from mckibben.physics.errors import did_you_mean

EFFECTS = (
    "bladder_elasticity",
    "linear_elasticity",
    "coulomb_friction",
    "creep",
    "valve_delay",
    "valve_deadband",
)


@pytest.mark.parametrize(
    ("typed", "expected"),
    [
        ("couloumb_friction", "Did you mean 'coulomb_friction'?"),
        ("blader", "Did you mean 'bladder_elasticity'?"),
        ("Coulomb", "Did you mean 'coulomb_friction'?"),
        ("elastic", "Did you mean one of bladder_elasticity, linear_elasticity?"),
        ("delay", "Did you mean 'valve_delay'?"),
        ("valve", "Did you mean one of valve_deadband, valve_delay?"),
        ("xyz", f"Known: {', '.join(sorted(EFFECTS))}."),
    ],
)
def test_the_nearest_name_or_a_part_of_one(typed, expected):
    assert did_you_mean(typed, EFFECTS) == expected
